#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge check: liars are exposed, each by the right check, and honest plugins are never accused.

load ../support/cli_helper

liars=$top_builddir/tests/plugins/.libs

# exposes CHECK LIAR TEXT: that check of the liar fails, with that text, and can be replayed.
exposes() {
    run -6 "$IMPINGE" check "$liars/$2.so" --only "$1"
    echo "$output"
    [[ $output == *"FAIL  $1 "*"$3"*"again: impinge check "*" --seed 1 --only $1"* ]]
}

# blamed FILE TYPE [ARG]...: a type of mistakes_FILE.so, which has failed.
blamed() {
    ln -sf "$liars/mistakes_$1.so" .
    run -6 "$IMPINGE" check "$2" --plugin-path . "${@:3}"
    echo "$output"
}

# --- Bounds ------------------------------------------------------------------------------------------

@test "the liars' surface without a lie passes every check" {
    run -0 "$IMPINGE" check "$liars/liar_truthful.so"
    [[ $output != *FAIL* && $output == *"tested("*", 1)"* ]]
    run -0 "$IMPINGE" check "$liars/liar_truthful.so" --only allocations
    [[ $output != *FAIL* && $output != *"tested("* ]]
}

@test "rates 1 % low in 1 % of the domain are exposed" {
    exposes rates liar_percent '1.0101010'
}

@test "rates 20 % low in 0.04 % of the domain are exposed, from any seed" {
    exposes rates liar_spot '1.25'
    run -6 "$IMPINGE" check "$liars/liar_spot.so" --only rates --seed 2
    run -6 "$IMPINGE" check "$liars/liar_spot.so" --only rates --seed 3
}

@test "rates 1e-6 low in a strip are exposed, from any seed" {
    local seed
    for seed in 1 2 3; do
        blamed bounds rate_low_in_strip --only rates --seed "$seed"
    done
}

@test "bounds that exist at no size are no pass" {
    shows rates bounds rate_unbounded 'rate has no bound over any region around a place'
    shows inclusions bounds model_unbounded 'include has no bound over any region around a place'
}

@test "rates taken at the corners of a region are exposed" {
    exposes rates liar_corners 'the rates are too small'
}

@test "rates taken on a grid of 5 x 5 are exposed" {
    exposes rates liar_grid 'the rates are too small'
}

@test "a forgotten time derivative is exposed" {
    exposes rates liar_time 'inf times what'
}

@test "a wrong sign in include is exposed" {
    exposes inclusions liar_sign 'off the quadratic'
}

@test "remainders that are half of what they should be are exposed" {
    exposes inclusions liar_remainder 'off the quadratic'
}

@test "a range that ends too early is exposed" {
    exposes inclusions liar_range 'outside the range'
}

@test "models that forget time are exposed" {
    exposes inclusions liar_model_time ''
}

@test "an error bound of eval that is too small is exposed" {
    exposes errors liar_error "eval's errors or the rates are too small"
    exposes errors liar_single ''
}

@test "a control net that is a tenth too small is exposed, and the same net in full is not" {
    exposes nets liar_net 'off the control net, whose error is'
    [[ $output == *$'\n  refuted\n'* ]]
    run -0 "$IMPINGE" check "$liars/liar_truthful_net.so" --only nets
    [[ $output == *'pass  nets '*comparisons* ]]
}

@test "a stated formula that differs from eval, in a digit or a part, is refused" {
    shows formula formula digit_wrong "but by the type's formula it is surely "
    shows formula formula second_part_wrong "but by the type's formula it is surely "
    shows formula formula turn_of_6_28 "by the type's formula u is in [0, 6.28"
    shows formula formula part_left_out "no part of the type's formula holds for "
    shows formula formula name_unknown "'q' is neither a variable"
    run -6 "$IMPINGE" check "$liars/mistakes_formula.so" --only formula --json
    json '[.types[] | select(.checks[].verdict != "fail").name] == ["one_part", "two_parts"]'
}

@test "formulas of tables, weights, velocities and odd axes are those of eval" {
    local stage
    printf 't [ms],a [deg],x [mm],y [in]\n0,10,5,1\n1,40,7,2\n2,-20,11,5\n4,5,-3,6\n' >table.csv
    for stage in 'rotate file=table.csv column=a axis=1,2,3' \
        'rotate file=table.csv column=a interpolation=cubic hold=true center=1,0,2' \
        'translate file=table.csv columns=x,y,x scene_unit=m' \
        'rotate times=[0,1,3] angles=[0,1,0.5] velocities=[0,1,2]' \
        'rotate times=[0,1,3] angles=[0,30,9] velocities=[0,1,2] accelerations=[1,2,-1] degrees=true' \
        'keyframes times=[0,1,2] rotations=[[1,0,0,0],[-0.8,0.6,0,0],[0.8,0,0.6,0]] hold=true' \
        'trajectory times=[0,1] positions=[[0,0,0],[1,1,0]] accelerations=[[0,0,-9.81]]' \
        'bezier degree=1,1 points=[[0,0,0],[0,1,0],[1,0,0],[1,1,0.5]] weights=[1,2,3,1]
            velocities=[[0,0,1],[0,1,0],[1,0,0],[1,1,0.5]]' \
        'revolution profile=[[0,0],[1,0],[0.2,1]] weights=[1,2,3]' 'bend curvature=0.7 along=0,1,3' \
        'subdivision points=[[0,0,0],[0,1,1],[1,0,0],[1,1,0],[2,0,1],[2,1,0]] faces=[[0,2,3,1],[2,4,5,3]]' \
        'disc axis=0,-1,0' 'disc axis=0,1,2' 'capsule from=1,2,3 to=1,2,3' \
        'mesh points=[[0,0,0],[1,0,0],[0,1,0]] faces=[[0,2,1]] velocities=[[0,0,0],[1,0,0],[0,1,0]]' \
        'formula x=u*time0 y=v*domain1 constants={"time0":3,"domain1":4} time=0,1'; do
        run -0 "$IMPINGE" check "$stage" --only formula
        [[ $output == *'  pass  formula '*' are proved '* ]]
    done
}

@test "distances that are too large or too sure are exposed, and true ones are not" {
    exposes distances liar_distance 'distance claims at least '
    exposes distances liar_distance_remainder 'distance claims at least '
    [[ $output == *$'\n  refuted\n'* ]]
    run -0 "$IMPINGE" check "$liars/liar_truthful_distance.so" --only distances
    [[ $output == *'pass  distances '*comparisons* ]]
}

@test "symmetries that are none are exposed, and true ones are not" {
    exposes distances liar_symmetry 'symmetry allows turning by '
    exposes distances symmetry_nan 'the symmetry has an unknown kind'
    run -0 "$IMPINGE" check "$liars/liar_truthful_symmetry.so" --only distances
    [[ $output == *'pass  distances '*comparisons* ]]
}

@test "distances that are too large far away, late or in a spot are exposed, and symmetries there" {
    local missed
    missed=$(missed distance --only distances)
    [ "$missed" = distance_no_mistake ]
    [ "$(wc -l <seen)" -eq 14 ]
    shows distances distance symmetry_orbit 'symmetry says IMP_SYMMETRY_ORBIT_V, but no rotation takes '
    shows distances distance symmetry_open 'symmetry says is_closed, but turning by '
    shows distances distance distance_farthest 'distance claims at least '
    shows distances distance symmetry_leaning 'symmetry allows turning by '
    [[ $output == *'which takes the point ('*' to ('*'there distance claims at least '*', but before it is '* ]]
}

@test "bounds that are wrong long after or before the first times are exposed" {
    shows rates bounds rate_low_late 'the rates are too small'
    shows inclusions bounds model_sure_early 'off the quadratic'
}

@test "a map's missing rates and wrong models are exposed" {
    exposes rates liar_map_rate 'the rates are too small'
    exposes inclusions liar_map_rate 'off the quadratic'
}

@test "what a failure prints to run again finds the same again" {
    run -6 "$IMPINGE" check "$liars/liar_spot.so" --only rates --seed 5 --effort 1.5
    first=$output
    again=$(sed -n 's/^ *again: impinge //p' <<<"$output")
    [ -n "$again" ]
    run -6 bash -c "'$IMPINGE' $again"
    [ "$output" = "$first" ]
}

# --- Proofs ------------------------------------------------------------------------------------------

wavy='u; cos(3*u)*sin(2*v); v+sin(u+2*t)'

# disproves LIAR TEXT: what the truthful formula refutes of it.
disproves() {
    run -6 "$IMPINGE" check "$liars/$1.so" --only proof --formula "$wavy" --effort "${3-0.1}"
    echo "$output"
    [[ $output == *"FAIL  proof "*": $2"*": by the formula "*" is surely in ["*"refuted"* ]]
}

@test "types that take their formula as text are proved" {
    local type
    for type in formula 'formula x=u*exp(-u*v) y=sqrt(1+v*v) z=u*t' \
        'map-formula x=x*cos(t)-y*sin(t) y=x*sin(t)+y*cos(t)'; do
        run -0 "$IMPINGE" check "$type" --effort 0.1
        [[ $output == *"  pass  proof "*" claims over "*" regions are proved"*"  proved("*", 1): "* ]]
    done
}

# follows TYPE X Y Z: what the type claims follows from the formula, but for one claim in a hundred
# at most, where there is no slack to prove it with.
follows() {
    run -0 "$IMPINGE" check "$1" --only proof --formula "$2; $3; $4" --effort 0.05 --json
    echo "$1: $output"
    json '.types[0].proof | .claims > 1000 and .proved >= 0.99 * .claims'
}

@test "tight and right bounds are proved, every claim of them" {
    local r='(major_radius + minor_radius*cos(v))'
    run -0 "$IMPINGE" check sphere --only proof --formula \
        'center0 + radius*cos(v)*cos(u); center1 + radius*cos(v)*sin(u); center2 + radius*sin(v)'
    [[ $output == *"pass  proof        all "*"  proved("* ]]
    run -0 "$IMPINGE" check torus --only proof --formula "$r*cos(u); $r*sin(u); minor_radius*sin(v)"
    [[ $output == *"pass  proof        all "*"  proved("* ]]
}

@test "our types are what they say they are, and their bounds follow from it" {
    local r
    follows 'sphere radius=2 center=0,0,1' '2*cos(v)*cos(u)' '2*cos(v)*sin(u)' '1+2*sin(v)'
    r='(major_radius + minor_radius*cos(v))'
    follows torus "$r*cos(u)" "$r*sin(u)" 'minor_radius*sin(v)'
    follows $'torus\tmajor_radius=+2.\tminor_radius=.5' "$r*cos(u)" "$r*sin(u)" 'minor_radius*sin(v)'
    follows 'ellipsoid radii=1,2,3 center=.1,-.2,.3' 'center0 + radii0*cos(v)*cos(u)' \
        'center1 + radii1*cos(v)*sin(u)' 'center2 + radii2*sin(v)'
    follows cylinder 'radius*cos(u)' 'radius*sin(u)' 'height*v'
    follows cone '(1-v)*radius*cos(u)' '(1-v)*radius*sin(u)' 'height*v'
    follows 'plane origin=-5,-5,0.3 edge_u=10,0.7,0 edge_v=0.1,10,-3' '-5+10*u+.1*v' \
        '-5+.7*u+10*v' '.3-3*v'
    follows 'ripple direction=1,1 size=4,4' u v '.1*sin(2*pi*((u+v)/sqrt(2)-t))'
    r='(1 + exp(-((u-3)^2+v^2)/.36) + exp(-((u-3-2*pi)^2+v^2)/.36) + exp(-((u-3+2*pi)^2+v^2)/.36))'
    follows 'spike width=.6 spikes=[[3,0]]' "$r*cos(v)*cos(u)" "$r*cos(v)*sin(u)" "$r*sin(v)"
    follows 'segment points=[[0,0,0],[2,0,.7]] velocities=[[0,.3,0],[0,1,0]]' '2*u' \
        '(1-u)*.3*t+u*t' '.7*u'
    follows 'triangle points=[[0,0,0],[1,0,0],[.3,1,0]] velocities=[[0,0,1],[.7,0,1],[0,0,2]]' \
        'u*(1+.7*t+v*(.3-1-.7*t))' 'u*v' 't+u*v*t'
}

@test "our maps are what they say they are, and their bounds follow from it" {
    local a m='(x+y+z)/3'
    follows 'translate velocity=1,.3,0' 'x+t' 'y+.3*t' z
    follows 'rotate axis=1,1,1 rate=1' "$m + cos(t)*(x-$m) + sin(t)*(z-y)/sqrt(3)" \
        "$m + cos(t)*(y-$m) + sin(t)*(x-z)/sqrt(3)" "$m + cos(t)*(z-$m) + sin(t)*(y-x)/sqrt(3)"
    follows 'scale factors=[[1],[.5]]' 'x*(1+.5*t)' 'y*(1+.5*t)' 'z*(1+.5*t)'
    follows 'screw pitch=.5 rate=6' 'cos(6*t)*x-sin(6*t)*y' 'sin(6*t)*x+cos(6*t)*y' 'z+1.5*t/pi'
    a='(1 - .5*t*clamp((z+1)/2, 0, 1))'
    follows 'taper end=[1,-.5]' "x*$a" "y*$a" z
    follows 'twist rate=.5' 'cos(.5*z)*x-sin(.5*z)*y' 'sin(.5*z)*x+cos(.5*z)*y' z
    follows 'wave amplitude=0,0,.1 wave_vector=6,0,0' x y 'z+.1*sin(6*x-6*t)'
    a='clamp(y,-1,1)'
    follows 'bend curvature=.5' x "2*sin(.5*$a) - z*sin(.5*$a) + (y-$a)*cos(.5*$a)" \
        "2*(1-cos(.5*$a)) + z*cos(.5*$a) + (y-$a)*sin(.5*$a)"
}

@test "what a proof refutes is a counterexample to what the formula says" {
    disproves liar_corners 'the rate of y by u'
    disproves liar_grid 'the rate of y by u'
    disproves liar_time 'the rate of z by t, 0, over'
    disproves liar_sign 'the remainder of y' 1
    disproves liar_remainder 'the remainder of y'
    disproves liar_range 'the range of z'
    disproves liar_percent 'the rate of x by u, 0.98999999999999999' 1
    run -6 "$IMPINGE" check "$liars/liar_error.so" --only proof --formula "$wavy" --effort 0.1
    [[ $output == *"with the error 0 at "*"surely "*" off"* ]]
}

@test "a domain that is not the one stated is exposed, and ends that almost meet are pointed out" {
    local whole='0,2*pi; -1,2'
    run -0 "$IMPINGE" check sphere --only domain --domain '0,2*pi; -pi/2,pi/2; -1,3'
    [[ $output == *"pass  domain       as stated"* ]]
    blamed stated domain_too_short --only domain --domain "$whole"
    [[ $output == *"v ends at 1, but is said to end at 2"*"again: impinge check "*"--domain '$whole'"* ]]
    run -0 "$IMPINGE" check period_of_6_28 --plugin-path . --only domain
    [[ $output == *"note  domain "*"the ends of u, 0 and 6.2800000000000002, almost meet"*", 1 noted"* ]]
    blamed stated period_of_6_28 --only domain --domain "$whole"
    run -0 "$IMPINGE" check period_of_6_28 --plugin-path . --only domain --json
    valid check
    json '.verdict == "pass" and .types[0].checks[0].verdict == "note"'
    fails 2 '--domain cannot be read: expected LO,HI; LO,HI of u and v' \
        "$IMPINGE" check sphere --domain '0,1'
    fails 2 "'radios' is neither a variable () nor" "$IMPINGE" check sphere --domain '0,radios;0,1'
}

@test "a formula may name parameters, and is compared with each stage" {
    local bowl='center0+radius*cos(v)*cos(u); center1+radius*cos(v)*sin(u); center2+radius*sin(v)'
    run -0 "$IMPINGE" check sphere --only proof --effort 0.05 --formula "$bowl"
    [[ $output == *"as: sphere radius=2"*"as: sphere"*"  pass  proof "* ]]
    run -6 "$IMPINGE" check 'sphere radius=2' --only proof --effort 0.05 \
        --formula "${bowl//radius/2.0000001}"
    [[ $output == *"again: impinge check "*" --formula "*" --effort 0.05 --only proof"*refuted* ]]
}

@test "a formula that cannot be read is told of, with its place, and nothing is checked" {
    run -2 "$IMPINGE" check sphere --only proof --formula 'u;v;radios'
    [[ $output == *"cannot be read: 'radios', character 7: 'radios' is neither a variable (uvt) nor"* ]]
    [[ $output != *"pass  "* ]]
    run -2 "$IMPINGE" check sphere --json --formula 'u;v'
    [[ $output == *"expected three formulas with ';' between them"* ]]
}

@test "a formula may name booleans, and elements of lists that not all instances have" {
    fails 2 "'hat' is neither a variable (xyzt) nor a constant; these are pi, e, times0 ... times2, " \
        "$IMPINGE" check keyframes --formula 'x; y; z*hat'
    [[ $stderr == *', hold' ]]
    run -0 "$IMPINGE" check segment --only proof --effort 0.05 --formula '2*u; u*t*velocities4; 0'
    [[ $output == *'as: segment'*'as: segment'*'  pass  proof        all '* ]]
}

@test "parameters that are wrong are the user's fault, not the plugin's" {
    run -4 "$IMPINGE" check 'sphere radius=-1'
    [[ $output == *"'sphere radius=-1': surface: radius: got -1, must be > 0"* ]]
    [[ $output != *FAIL* ]]
}

@test "a type's own formula proves its bounds, part by part" {
    run -0 "$IMPINGE" check sphere --only proof --effort 0.2
    [[ $output == *"pass  proof        all "*"  proved("* ]]
    run -0 "$IMPINGE" check 'rotate times=[0,1,2] angles=[0,1,0.5]' --only proof --effort 0.2
    [[ $output == *"pass  proof "*" claims over "* ]]
}

@test "without a formula there is no proof" {
    run -0 "$IMPINGE" check "$liars/liar_truthful.so" --only proof
    [[ $output == *"skip  proof "*"no formula is known; state it with --formula "* ]]
}

# --- Manners -------------------------------------------------------------------------------------------

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

# shows CHECK FILE TYPE TEXT [ARG]...: that check fails with that text.
shows() {
    blamed "$2" "$3" --only "$1" "${@:5}"
    [[ $output == *"FAIL  $1 "*"$4"* ]]
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

# --- Planted mistakes ------------------------------------------------------------------------------

tube='(radius+wave*sin(3*v+t))*cos(u); (radius+wave*sin(3*v+t))*sin(u); 2*v+path0+path1*t+path2*t^2'

# missed FILE [ARG]...: the types of mistakes_FILE.so in which nothing is found.
missed() {
    "$IMPINGE" check "$liars/mistakes_$1.so" --json "${@:2}" >report || [ $? -eq 6 ]
    jq -r '.types[].name' report >>seen
    jq -r '.types[] | select(all(.checks[]; .verdict == "pass" or .verdict == "skip")) | .name' report
}

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

# --- Ours ----------------------------------------------------------------------------------------------

# Each with a seed of its own.
@test "none of our types is accused" {
    local so seed=11
    for so in "$top_builddir"/plugins/.libs/*.so; do
        run "$IMPINGE" check "$so" --seed $((seed++)) --effort "$(scaled 0.1)"
        [ "$status" -eq 0 ] || { echo "$output" && false; }
    done
}

# --- Command line ----------------------------------------------------------------------------------------

@test "a type is found by its name, and checked as it is written" {
    run -0 "$IMPINGE" check 'sphere radius=5' --only finite
    [[ $output == *"surface sphere"*"as: sphere radius=5"*"pass  finite"* ]]
    fails 4 "unknown type 'spher', did you mean 'sphere'?" "$IMPINGE" check spher
}

@test "a file that is not there is complained of; a text is refused by the host" {
    fails 4 'nowhere.so: No such file or directory' "$IMPINGE" check nowhere.so
    echo 'a text' >text.so
    run -6 "$IMPINGE" check text.so
    [[ $output == *"FAIL  load "* ]]
}

@test "check --json is as its schema says, for a pass and for a failure" {
    run -0 "$IMPINGE" check torus --json --effort 0.05
    valid check
    json '.verdict == "pass" and .types[0].label == "proved" and .types[0].tests > 1000
          and (.types[0].cost.eval_ns > 0) and .types[0].cost.pairs[1] < 200 and (.types[0].tightness.rates[0] >= 1)'
    run -6 "$IMPINGE" check "$liars/liar_time.so" --json --effort 0.05 --only rates
    valid check
    json '.verdict == "fail" and .types[0].label == "refuted"
          and (.types[0].checks[0].replay | contains("--only rates"))'
    run -0 "$IMPINGE" check formula --json --effort 0.05
    valid check
    json '.types[0].label == "proved" and .types[0].proof.claims == .types[0].proof.proved'
}

@test "what include leaves beside a quadratic is measured, and a missing one is told with its cost" {
    run -0 "$IMPINGE" check torus --json --only tightness
    valid check
    json '.types[0].tightness | (.remainders | all(. >= 0.9 and . < 3)) and .distances >= 1 and .distances < 1.5'
    run -0 "$IMPINGE" check "$liars/liar_percent.so" --only tightness
    [[ $output == *'There is no include: remainders are those of rates'* ]]
    run -0 "$IMPINGE" check "$liars/liar_percent.so" --only tightness --json
    json '.types[0].tightness.remainders[0] > 100'
}

@test "every check can be asked for alone, and an unknown one is refused" {
    local name
    for name in $("$IMPINGE" help check | sed -n 's/^ *--only CHECK *//p' | cut -d: -f1 | tr '|' ' '); do
        run -0 "$IMPINGE" check plane --only "$name" --effort 0.01
        [ "$(grep -c "^  pass  $name \|^  skip  $name " <<<"$output")" -eq 1 ]
    done
    fails 2 "did you mean 'rates'?" "$IMPINGE" check plane --only rate
}

# --- Pieces ------------------------------------------------------------------------------------------

@test "pieces that change, are missing, have other times or lie are exposed; those in order are not" {
    run -0 "$IMPINGE" check "$liars/pieces.so" --only pieces --only rates
    exposes pieces pieces_none 'piece_count is 0, must be from 1 to'
    exposes pieces pieces_null 'piece gives NULL for number 1'
    exposes pieces pieces_change 'piece(self, 0) gave another pointer than before'
    exposes pieces pieces_times 'piece 2 exists for t in'
    exposes rates pieces_lie 'the rates are too small'
    shows pieces pieces pieces_swapped_late 'gave another pointer than before'
    shows pieces pieces pieces_left_out_late 'piece_count was 3, and then 2'
    shows pieces pieces pieces_change_with_use 'gave another pointer than before'
    run -0 "$IMPINGE" check sphere --only pieces
    [[ $output == *'skip  pieces       the type has no pieces'* ]]
}

@test "a type whose whole has no shape, but its pieces, is not accused" {
    ln -sf "$liars/mistakes_pieces.so" .
    run -0 "$IMPINGE" check pieces_of_shapeless --plugin-path .
    [[ $output != *FAIL* && $output == *'pass  arguments'* ]]
}

# --- Badges ------------------------------------------------------------------------------------------

@test "a badge holds what was checked, and --require holds the label against it" {
    run -0 "$IMPINGE" check "$liars/liar_truthful.so" --effort 0.05 --badge badge.json --require tested
    [[ $output == *passed* ]]
    output=$(<badge.json)
    valid badge
    json '.message == "tested" and .color == "green" and .abi.major == 1 and .seed == 1'
    json '.checks.load == "pass" and .types[0].checks.rates == "pass" and .types[0].tightness.rates[0] >= 1'
    fails_check 'the plugin is tested, not proved; state its formula' liar_truthful --require proved
    fails_check 'the plugin is refuted' liar_spot --badge refuted.json --require tested
    jq -e '.message == "refuted" and .verdict == "fail"' refuted.json
    run -2 "$IMPINGE" check "$liars/liar_spot.so" --only rates --badge no.json
    [[ $output == *"leave out --only"* && ! -e no.json ]]
}

fails_check() { # TEXT LIAR OPTION...
    run -6 "$IMPINGE" check "$liars/$2.so" --effort 0.05 "${@:3}"
    [[ $output == *"$1"* ]]
}

@test "a type whose formula is known earns a proved badge" {
    run -0 "$IMPINGE" check 'formula x=u y=v z=u*v' --effort 0.05 --badge - --require proved
    output=$(tail -n 1 <<<"$output")
    valid badge
    json '.message == "proved" and .color == "brightgreen" and .types[0].proof.claims > 100'
}
