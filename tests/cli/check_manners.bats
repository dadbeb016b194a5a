#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge check: callbacks that misbehave are exposed, and planted mistakes are found.

load ../support/check_helper

# --- Manners ------------------------------------------------------------------------------------
@test "an answer that changes from call to call is exposed" {
    exposes determinism liar_counter "eval's points differ from call to call"
}

@test "a change of errno or of the rounding mode is exposed" {
    exposes environment liar_errno 'rate sets errno'
    exposes environment liar_rounding 'rate changes the rounding mode'
}

# leaves TYPE PHASE SIN TEXT: the check of the environment fails with that text.
leaves() {
    HOSTILE="$2 $3" run -6 "$IMPINGE" check "$1" --plugin-path "$PWD/own" --only environment
    echo "$1 $2 $3: $output"
    [[ $output == *"FAIL  environment "*"$2 $4"* ]]
}

@test "a change of what belongs to the thread or the process is exposed, in each callback" {
    local phase
    mkdir own
    ln -s "$liars/hostile.so" own
    for phase in create domain eval rate include destroy; do
        leaves hostile $phase write 'writes to standard output'
        leaves hostile $phase chdir "changes the working directory to '/'"
    done
    for phase in time_domain eval rate apply; do
        leaves hostile-map $phase write 'writes to standard output'
    done
    leaves hostile eval print 'writes to standard output'
    leaves hostile destroy umask 'changes the umask to 777, before '
    leaves hostile create block 'changes the signal mask: signal 10 ('
    leaves hostile domain trap 'changes how subnormal numbers are treated, which exceptions trap'
    leaves hostile-map apply round 'changes the rounding mode'
    leaves hostile include errno 'sets errno to 33'
    leaves hostile rate uselocale 'changes the locale'
    LC_ALL=C.UTF-8 leaves hostile eval locale 'changes the locale'
    leaves hostile eval thread 'leaves a thread behind'
    [ "$(uname -m)" != x86_64 ] || leaves hostile rate x87 'changes how subnormal numbers are treated'
    run -0 "$IMPINGE" check hostile --plugin-path "$PWD/own" --only environment
}

@test "writing beyond an output is exposed" {
    exposes buffers liar_beyond 'eval writes beyond its outputs'
}

@test "create that reads past an argument, or keeps a pointer to one, is exposed" {
    ! has_sanitizers || skip 'AddressSanitizer finds it first'
    shows arguments manners list_read_too_far \
        "in create of 'list_read_too_far radius=1.5 wave=0.3 path=0.1,0.5,0.125', whose arguments end"
    shows arguments manners list_kept "though create's arguments are gone: it keeps a pointer to one"
}

@test "reading or writing past the end of an array is exposed" {
    ! has_sanitizers || skip 'AddressSanitizer finds it first'
    shows buffers manners point_read_too_far 'in eval at u='
    [[ $output == *'whose arrays end where readable memory ends'* ]]
    shows buffers manners error_written_when_null 'in eval at u='
    shows buffers map apply_reads_too_far 'in rate, include or apply, whose arrays end'
}

@test "a cache that calls write to is exposed, though its answers are right" {
    shows state manners static_cache 'eval changes static data: called from several threads'
    shows state manners static_scratch 'rate changes static data'
    # Sanitizers have a heap of their own, which is not looked at.
    grep -q __asan_init "$(readlink -f mistakes_manners.so)" ||
        shows state manners instance_cache 'eval changes memory on the heap (such as the instance)'
}

@test "a callback that allocates is exposed, also where a function that it calls does" {
    shows allocations manners eval_allocates 'eval calls malloc: it must not allocate'
    # AddressSanitizer has a strdup of its own, which calls no malloc that could be seen.
    local call=malloc
    ! has_sanitizers || call=free
    shows allocations manners include_copies_text "include calls $call: it must not allocate"
}

@test "values that create takes, and that make nonsense, are exposed" {
    shows parameters manners odd_value_is_taken 'create accepts radius=4.94'
    [[ $output == *'e-324: eval gives x = '* ]]
    shows parameters manners create_crashes_on_odd_value 'in create of '
}

@test "a leak is exposed" {
    run "$IMPINGE" check sphere --only memory
    [[ $output != *"skip  memory"* ]] || skip "malloc does not report"
    exposes memory liar_leak '256 instances, created, used and destroyed, leak'
    exposes memory liar_refusal '64 times size=-1, rejected or destroyed, leak'
}

@test "an instance that is refilled like no new one is exposed" {
    exposes renewal liar_renew "eval's points differ between an instance refilled by renew and a new one"
    "$IMPINGE" check sphere --only renewal | grep -q "pass  renewal  *an instance that renew refills"
    "$IMPINGE" check formula --only renewal | grep -q "skip  renewal  *it has no renew"
}

@test "a renew that breaks another rule is exposed" {
    exposes renewal renew_rounds_up "renew changes the rounding mode"
    exposes renewal renew_overflows "renew wrote beyond the imp_create_error it was given"
    exposes renewal renew_notes "renew notes 'a slope was taken', and create ''"
    exposes renewal renew_leaks "64 calls of renew leak"
}

@test "a complaint that is longer than its place is exposed" {
    exposes parameters create_overflows 'create wrote beyond the imp_create_error it was given'
}

@test "a coordinate that is not a number is exposed" {
    exposes finite liar_nan 'eval gives x = nan at'
}

@test "a hole inside of the domain is exposed, at a round number or where rates lead" {
    shows finite manners nan_inside 'nan at u=1.3,'
    shows finite manners nan_at_odd_place "eval returned 'domain' for 1 points, the first at u=1.2345678"
}

@test "a second exported symbol and a factory for unknown ids are exposed" {
    exposes exports liar_exports "exports 'liar_helper' beside impinge_plugin"
    exposes factories liar_factory 'get_factory returns a factory for "impinge.surface/'
}

@test "a crash fails the check it happens in, and names the call" {
    exposes finite liar_crash 'liar_crash crashed (Aborted) in rate over u in [0, 0]'
}

@test "a crash in create or destroy names it and what was created, and ends the checks of its type" {
    run -6 "$IMPINGE" check "$liars/create_crashes.so"
    [[ $output == *"FAIL  parameters "*"create_crashes crashed ("*") in create of 'create_crashes'"* ]]
    [ "$(grep -c FAIL <<<"$output")" -eq 1 ]
    blamed manners destroy_frees_twice
    [[ $output == *" in destroy of 'destroy_frees_twice radius=1.5 "* ]]
    [ "$(grep -c FAIL <<<"$output")" -eq 1 ]
}

@test "one mistake is told once, and which other checks it shows in" {
    blamed manners error_of_z_not_written
    [[ $output == *"FAIL  finite "*"eval gives the error "*" of z at "*"  FAIL  also "*"rates, errors, inclusions"* ]]
    [ "$(grep -c FAIL <<<"$output")" -eq 2 ]
    blamed manners error_of_z_not_written --json
    valid check
    json '[.types[0].checks[] | select(.verdict == "fail") | [.name, .told_before]][:2]
          == [["finite", false], ["domain", true]]'
}

@test "a long check shows on a terminal what it is at, and nowhere else" {
    needs_terminal
    export IMPINGE
    run script -qec '"$IMPINGE" check torus --effort 4' /dev/null
    [[ $output == *$'\r'[1-9]*' s: torus: '*$'\e[K'* ]]
    run --separate-stderr "$IMPINGE" check torus --effort 4
    [ -z "$stderr" ]
}

@test "a hang fails the check it happens in, and ends the checks of its type" {
    run -6 "$IMPINGE" check "$liars/liar_hang.so" --max-seconds 0.5
    [[ $output == *"FAIL  finite "*"timed out after 0.5 s in rate over"* ]]
    [ "$(grep -c FAIL <<<"$output")" -eq 1 ]
}

@test "a plugin the host refuses has failed, with the host's reason" {
    run -6 "$IMPINGE" check "$liars/no_note.so"
    [[ $output == *"FAIL  load "*"the host rejects it: "* ]]
}

# --- Planted mistakes ---------------------------------------------------------------------------

tube='(radius+wave*sin(3*v+t))*cos(u); (radius+wave*sin(3*v+t))*sin(u); 2*v+path0+path1*t+path2*t^2'

@test "of 57 kinds of mistakes that authors make, 54 at least are found, and no truth is accused" {
    local name unproved
    # Rounding shows to a proof only, and what is meant to those who are told.
    unproved=$(missed bounds --effort 0.5)
    echo "not found in bounds without a formula: $unproved"
    [ "$(wc -w <<<"$unproved")" -le 3 ]
    ln -sf "$liars/mistakes_bounds.so" .
    for name in $unproved; do
        run "$IMPINGE" check "$name" --plugin-path . --only proof --formula "$tube"
        [ "$status" -eq 6 ] || echo "$name" >>all
    done
    missed manners --effort 0.2 >>all
    missed map --effort 0.2 >>all
    missed stated --effort 0.2 --formula "$tube" --domain '0,2*pi; -1,2' >>all
    cat all
    [ "$(wc -l <seen)" -eq 59 ]
    grep -qx no_mistake all
    grep -qx map_no_mistake all
    [ "$(wc -l <all)" -le 5 ] # the two truths, and three that are missed
}

@test "mistakes in the pose of a map are exposed, and a true one is not accused" {
    local missed name
    missed=$(missed pose --only poses)
    [ "$missed" = $'pose_remembers\npose_no_mistake' ]
    [ "$(wc -l <seen)" -eq 12 ]
    says() { blamed pose "$1" --only poses && [[ $output == *"$2"* ]]; }
    says pose_remainder_halved 'off the pose, whose remainder is'
    says pose_rate_halved "and the pose's rate"
    says pose_range_halved 'outside of the range'
    says pose_turns_backward 'off the pose, whose remainder is'
    says pose_without_pivot 'shift[0] is '
    says pose_depends_on_u 'depends on more than t'
    says pose_mirrors 'has the determinant -'
    blamed pose pose_remembers --only state
    [[ $output == *'rigid changes static data'* ]]
    says pose_of_a_wave 'off the place where the pose over'
    says pose_swells "the square of a column's length ("
    run -0 "$IMPINGE" check sphere --only poses
    [[ $output == *'skip  poses '*'only maps have poses'* ]]
}

@test "bounds that are not padded are refuted by the last digits, and the cure is told" {
    shows proof bounds rate_not_padded 'ulp too little: round it outward' --formula "$tube"
    shows proof bounds range_not_padded 'ulp too little: round it outward' --formula "$tube"
}
