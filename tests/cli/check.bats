#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge check: bounds that lie are exposed, each by the right check; honest plugins are not accused.

load ../support/check_helper

# --- Bounds -------------------------------------------------------------------------------------
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

@test "tubes that are too narrow are exposed, and true ones are not" {
    exposes tubes liar_tube 'the tube claims at most 1.4099'
    exposes tubes tube_of_v 'the tube over '
    [[ $output == *'depends on v'* ]]
    for truthful in "$liars/liar_truthful_tube.so" torus; do
        run -0 "$IMPINGE" check "$truthful" --only tubes
        [[ $output == *'pass  tubes '*comparisons* ]]
    done
}

@test "tubes that are wider than their surfaces decide as narrow ones do" {
    local turned='rotate axis=1,0.2,0.3 rate=5 center=0,0,1'
    mkdir wide && cp "$liars/liar_truthful_tube.so" wide
    run -0 "$IMPINGE" pair "liar_truthful_tube ! $turned" "liar_truthful_tube ! $turned
        ! translate offset=[[2.82843,-2,0],[0,4,0]]" --plugin-path "$PWD/wide" --gamma 3e-4 --json
    json '.verdict == "clear" and .stats.pairs < 100'
}

@test "symmetries that are none are exposed, and true ones are not" {
    exposes distances liar_symmetry 'symmetry allows turning by '
    exposes distances symmetry_nan 'the symmetry has an unknown kind'
    exposes distances liar_screw 'symmetry allows turning by '
    exposes distances liar_screw_hand 'symmetry allows turning by '
    exposes distances liar_screw_slit 'symmetry says is_closed, but turning by '
    exposes distances liar_screw_crack 'symmetry says is_closed, but turning by '
    exposes distances liar_screw_wavy 'symmetry says is_closed, but turning by '
    for truthful in symmetry screw; do
        run -0 "$IMPINGE" check "$liars/liar_truthful_$truthful.so" --only distances
        [[ $output == *'pass  distances '*comparisons* ]]
    done
}

@test "distances that are too large far away, late or in a spot are exposed, and symmetries there" {
    local missed
    missed=$(missed distance --only distances)
    [ "$missed" = distance_no_mistake ]
    [ "$(wc -l <seen)" -eq 15 ]
    shows distances distance symmetry_zone 'symmetry says is_closed, but turning by '
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

# --- Ours ---------------------------------------------------------------------------------------
# Each with a seed of its own.
@test "none of our types is accused" {
    local so seed=11
    for so in "$top_builddir"/plugins/.libs/*.so; do
        run "$IMPINGE" check "$so" --seed $((seed++)) --effort "$(scaled 0.1)"
        [ "$status" -eq 0 ] || { echo "$output" && false; }
    done
}

# --- Command line -------------------------------------------------------------------------------
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

# --- Pieces -------------------------------------------------------------------------------------
@test "parts of a map agree with it in the middle of their ranges and where they are left out" {
    shows parts parts parts_off_the_middle "with each clock in the middle of its range"
    shows parts parts parts_not_still_at_0 "the parts of 'parts_not_still_at_0 offset=0'"
    shows parts parts parts_end_early "follows 'parts_end_early#1' from -1 to 1, but is defined from"
    shows parts parts parts_forget_time "with each clock in the middle of its range"
    local file=$liars/parts_unread.so
    for wrong in "parts_unknown unknown map 'nothing_like_it'" 'parts_of_parts one of them has parts' \
        'parts_empty there are none' 'parts_reversed got the range [1, -1], must be finite'; do
        ln -sf "$file" .
        run -6 "$IMPINGE" check "${wrong%% *}" --plugin-path . --only parts
        [[ $output == *"FAIL  parts "*"${wrong#* }"* ]]
    done
    ln -sf "$liars/mistakes_parts.so" .
    "$IMPINGE" check parts_no_mistake --plugin-path .
    "$IMPINGE" check parts_follow_no_mistake --plugin-path . --only parts
    "$IMPINGE" check 'tolerance offset=1 angle=1.5 center=1,2,3' --only parts
}

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

# --- Badges -------------------------------------------------------------------------------------
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
