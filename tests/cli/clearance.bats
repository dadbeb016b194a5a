#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge clearance: brackets, requirements, pairs of bodies, slices of time.

load ../support/cli_helper

# The gap is sqrt((3 - 6 t)^2 + 9) - 2: 1 at t = 0.5.
passing=('sphere' 'sphere center=-3,3,0 ! translate velocity=6,0,0')

three() {
    cat <<END | tr -d '\n'
{"bodies": [
{"name": "a", "surfaces": [{"type": "sphere"}]},
{"name": "b", "surfaces": [{"type": "sphere", "center": [3,0,0]}]},
{"name": "c", "surfaces": [{"type": "sphere", "center": [8,0,0]}],
"maps": [{"type": "translate", "velocity": [-2.5,0,0]}]}]${1-}}
END
    echo
}

@test "each pair of many bodies: the same bytes for any number of threads" {
    "$top_builddir"/tests/support/crowd_scene 9 3 >crowd.json
    for threads in 1 2; do
        "$IMPINGE" clearance crowd.json --each --json --tolerance 0.1 --threads "$threads" |
            sed -E 's/"seconds":[^,]*,//g' >"answers.$threads"
        cmp answers.1 "answers.$threads"
    done
    jq -e '.pairs | length == 36 and ([.[].lower] | . == sort) and all(.lower <= .upper)' answers.1
}

@test "what a budget keeps from being begun is undecided too" {
    run -3 "$IMPINGE" clearance 'sphere' 'sphere center=5,0,0' --require 1 --profile 3 \
        --max-pairs 1 --json
    jq -s -e 'any(.verdict == "undecided") and all(has("verdict"))' <<<"$output"
}

@test "the minimum distance is bracketed, with its witness" {
    run -0 "$IMPINGE" clearance "${passing[@]}" --json
    valid clearance
    json '.lower <= 1 and .upper >= 1 and .upper - .lower <= 1e-3 * .upper and .reason == null'
    json '(.t - 0.5 | fabs) < 0.02 and .a.body == "a" and .b.body == "b" and (has("verdict") | not)'
    run -0 "$IMPINGE" clearance "${passing[@]}" --json --tolerance 1e-7
    json '.lower <= 1 and .upper >= 1 - 1e-15 and .upper - .lower <= 1e-7'
    run -0 "$IMPINGE" clearance "${passing[@]}"
    [[ $output == 'nearest distance 1.0000'*' between "a" and "b"'* && $output == *"never nearer than 0.999"* ]]
}

@test "a can and a box beside each other take one pair in either order" {
    local can box
    can='cylinder radius=0.56 height=1.4 ends=true ! translate'
    box='box size=0.76,1,1 ! translate offset=[[1.67,1.40,-0.58],[1.15,-0.82,-0.95]]'
    can="$can offset=[[-0.13,-0.20,-0.47],[0.41,-0.35,-1.95]]"
    run -0 "$IMPINGE" clearance "$can" "$box" --json
    json '.stats.pairs == 1 and .upper < 1.2363'
    run -0 "$IMPINGE" clearance "$box" "$can" --json
    json '.stats.pairs == 1 and .upper < 1.2363'
    can='cylinder radius=0.69 height=0.81 ends=true ! translate'
    box='box size=1.21,0.98,1.19 ! translate offset=[[1.57,-0.30,0.70],[0.18,1.78,1.19]]'
    can="$can offset=[[1.45,-1.91,-0.53],[1.39,0.84,-0.86]]"
    run -0 "$IMPINGE" clearance "$box" "$can" --json
    json '.stats.pairs == 1 and .upper < 0.4877'
}

@test "parts that slide in each other are bracketed by a few thousand pairs" {
    shaft='cylinder radius=0.99 ! rotate rate=3'
    run -0 "$IMPINGE" clearance "$shaft" cylinder --json
    json '.lower >= 0.00999 and .lower <= 0.01 and .stats.pairs < 20000'
    run -0 "$IMPINGE" clearance "$shaft" cylinder --require 0.009 --json
    json '.verdict == "holds" and .stats.pairs < 2000'
    run -0 "$IMPINGE" clearance 'cylinder radius=0.99 height=1 ! translate velocity=0,0,0.5' \
        'cylinder height=4' --json
    json '.lower >= 0.00999 and .stats.pairs < 200'
    run -0 "$IMPINGE" clearance 'thread radius=0.99' 'thread height=0.5 ! screw pitch=0.5 rate=1' \
        --require 0.005 --json
    json '.verdict == "holds" and .stats.pairs < 50000'
}

@test "a lead that is rounded costs steep threads no room in their distance" {
    for pitch in 12345678.1 1234567890.1 1234567890123.4; do
        local steep="thread starts=7 pitch=$pitch"
        run -0 "$IMPINGE" pair "$steep height=0.5 ! rotate axis=0,0,1 angle=0.001" \
            "$steep radius=1.01" --gamma 4e-3 --json
        json '.verdict == "clear" and .stats.pairs < 100'
    done
}

@test "what is required holds, is violated from a time on, or is undecided" {
    run -0 "$IMPINGE" clearance "${passing[@]}" --require 0.9999999 --json
    valid clearance
    json '.verdict == "holds" and .required == 0.9999999 and .lower >= 0.9999989'
    run -1 "$IMPINGE" clearance "${passing[@]}" --require 1.2 --json
    valid clearance
    json '.verdict == "violated" and (.t_violated - 0.314407 | fabs) < 1e-5'
    json '.a_violated.body == "a" and .b_violated.body == "b" and .t_violated <= .t'
    run -3 "$IMPINGE" clearance 'torus ! rotate axis=1,2,3 rate=2' --require 0.5 --json \
        'torus ! rotate axis=0,1,0 rate=1 ! translate offset=[[3,0.2,0.4]]' --max-pairs 20
    valid clearance
    json '.verdict == "undecided" and .reason == "max-pairs" and .lower < 0.5 and .upper > 0.5'
    run -0 "$IMPINGE" clearance "${passing[@]}" --require 0.9
    [[ $output == "holds: at least 0.9"* ]]
    run -1 "$IMPINGE" clearance "${passing[@]}" --require 1.2 --tolerance 1e-3
    [[ ${lines[0]} == 'violated at t = 0.3144'*': "a" and "b" 1.'*' apart' ]]
    [[ $output == *'nearest  distance 1.000'*' at t = 0.5'*' between "a" and "b"'* ]]
}

@test "a requirement ends the search as soon as it is decided, unless a tolerance is given too" {
    local torus='torus ! rotate axis=1,2,3 rate=2' other='ellipsoid radii=1,1.2,0.8 center=3,0,0 ! rotate axis=1,1,3 rate=1'
    run -0 "$IMPINGE" clearance "$torus" "$other" --json
    json '.lower > 0.6'
    local pairs
    pairs=$(jq .stats.pairs <<<"$output")
    for required in 0.05 0.2; do
        run -0 "$IMPINGE" clearance "$torus" "$other" --require $required --json
        valid clearance
        json ".verdict == \"holds\" and .reason == \"decided\" and .lower >= $required * (1 - 1e-6)"
        json ".upper > .lower and .stats.pairs < $pairs / 2"
    done
    run -0 "$IMPINGE" clearance "$torus" "$other" --require 0.05 --tolerance 1e-3 --json
    json '.reason == null and .upper - .lower <= 1e-3 * .upper'
    run -0 "$IMPINGE" clearance "$torus" "$other" --require 0.05
    [[ ${lines[0]} == "holds: at least 0.05 (to within 1e-6 of it)" ]]
    [[ $output == *"nearest  distance not searched for; add --tolerance 1e-3 to get it"* ]]
    run -1 "$IMPINGE" clearance "$torus" "$other" --require 0.8 --json
    valid clearance
    json '.verdict == "violated" and .upper <= 0.8 and .t_violated <= .t'
    run -1 "$IMPINGE" clearance "$torus" "$other" --require 0.8
    [[ ${lines[0]} == 'violated at t = 0'*': "a" and "b" 0.'*' apart' ]]
    run -0 "$IMPINGE" clearance "$torus" "$other" --require 0.05 --profile 2 --json
    jq -s -e 'all(.upper - .lower <= 1e-3 * .upper and .verdict == "holds")' <<<"$output"
}

@test "an arm of six joints, by a table of angles, keeps its distance from a fixture" {
    run -0 "$IMPINGE" clearance "$top_srcdir/tools/data/arm.json" --require 2 \
        --tolerance 1e-3
    [[ ${lines[0]} =~ ^'holds: at least 2, nearest distance 2.'[0-9]+' at t = 0.5'[0-9]+' between "link5" and "fixture"'$ ]]
}

@test "the first moment of a long violation is found in thousands of pairs, not millions" {
    local required
    for required in 4 5 6 10; do
        run -1 "$IMPINGE" clearance "$top_srcdir/tools/data/arm.json" --require "$required" --json \
            --max-pairs 100000
        json ".verdict == \"violated\" and .stats.pairs < 8000 and .t_violated > 0.4"
    done
}

@test "what meets has no clearance" {
    run -0 "$IMPINGE" clearance "$left" "$right" --json
    valid clearance
    json '.lower <= .upper and .upper <= 1e-6 and .reason == null'
    run -0 "$IMPINGE" clearance "$left" "$right"
    [[ ${lines[0]} == 'they touch or overlap at t = '*': "a" and "b"' && $output != *"never nearer"* ]]
    [[ $output == *"gap "*", at most gamma = 1e-06"* ]]
    run -0 "$IMPINGE" clearance sphere 'sphere center=2.0006,0,0' --gamma 1e-3
    [[ ${lines[0]} == 'they come within gamma, which counts as contact, at t = 0: "a" and "b"' ]]
    [[ $output == *"never nearer than 0.0005994"* ]]
}

@test "advice about a bracket tells how narrow it is so far" {
    run -3 "$IMPINGE" clearance 'torus ! rotate rate=9 axis=1,0.2,0' 'torus center=4,0,0.2' \
        --tolerance 1e-8 --max-pairs 250
    [[ ${lines[-1]} == *'advice '*' is reached so far), and so does --require D'* ]]
}

@test "each pair of bodies, what is proved to be nearest first" {
    three >three.json
    run -1 "$IMPINGE" clearance three.json --each --require 2 --tolerance 1e-3 --json
    valid clearance
    json '[.pairs[].bodies | join("")] == ["bc", "ab", "ac"] and .scene == "three.json"'
    json '[.pairs[].verdict] == ["violated", "violated", "holds"] and .verdict == "violated"'
    json '.upper == .pairs[0].upper and (.pairs[0].lower - 0.5 | fabs) < 1e-3'
    json '.pairs[0].t_violated > 0.3 and .pairs[1].t_violated == 0'
    run -1 "$IMPINGE" clearance three.json --each --require 2 --json
    valid clearance
    json '[.pairs[].verdict] == ["violated", "violated", "holds"] and .reason == "decided"'
    json '.t_violated == 0 and .a_violated.body == "a" and .b_violated.body == "b"'
    run -0 "$IMPINGE" clearance three.json --each
    [[ ${lines[-3]} == 0.49*"b, c" && ${lines[-2]} == 0.99*"a, b" && ${lines[-1]} == 3.49*"a, c" ]]
}

# b and c come towards a, b first and less far: 3 - 1.8 t and 6 - 5.5 t apart from it.
late() {
    cat <<END | tr -d '\n'
{"bodies": [
{"name": "a", "surfaces": [{"type": "sphere"}]},
{"name": "b", "surfaces": [{"type": "sphere", "center": [5,0,0]}],
"maps": [{"type": "translate", "velocity": [-1.8,0,0]}]},
{"name": "c", "surfaces": [{"type": "sphere", "center": [0,8,0]}],
"maps": [{"type": "translate", "velocity": [0,-5.5,0]}]}]}
END
    echo
}

@test "the first violation of many pairs is that of the earliest pair, not of the nearest" {
    late >late.json
    run -1 "$IMPINGE" clearance late.json --require 2 --json
    json '(.t_violated - 5 / 9 | fabs) < 1e-5'
    for tolerance in "" "--tolerance 1e-3"; do
        # shellcheck disable=SC2086 # no word when empty
        run -1 "$IMPINGE" clearance late.json --require 2 $tolerance --each --json
        valid clearance
        json '(.t_violated - 5 / 9 | fabs) < 1e-5'
        json '.t_violated == ([.pairs[].t_violated // 9] | min)'
        json '.a_violated.body == "a" and .b_violated.body == "b"'
        # shellcheck disable=SC2086
        run -1 "$IMPINGE" clearance late.json --require 2 $tolerance --each
        [[ ${lines[0]} == 'violated at t = 0.5555'*': "a" and "b" '*' apart'* ]]
    done
}

@test "while an earlier violation is possible none is called the first" {
    # Ellipsoids do not say that they are balls, whose distance takes one pair.
    late | sed 's/"type": "sphere"/"type": "ellipsoid", "radii": [1,1,1]/g' >late.json
    run -1 "$IMPINGE" clearance late.json --require 2 --each --max-pairs 100 --json
    valid clearance
    json '.verdict == "violated" and .t_violated == null and .a_violated == null'
    json '[.pairs[] | select(.t_violated != null) | .bodies | join("")] | sort == ["ab", "ac"]'
    json 'any(.pairs[]; .verdict == "undecided")'
    run -1 "$IMPINGE" clearance late.json --require 2 --each --max-pairs 100
    [[ ${lines[0]} == "violated; when first is not known" && $output == *"violated from t = 0.5555"*" a, b"* ]]
}

@test "pairs of bodies are in the order of what is proved of them" {
    local arm=$top_srcdir/tools/data/arm.json
    run -0 "$IMPINGE" clearance "$arm" --require 2 --each --json
    valid clearance
    json '[.pairs[].lower] | . == sort'
    run -0 "$IMPINGE" clearance "$arm" --require 2 --each
    grep -qE '^never nearer than +nearest found so far +at t +verdict +bodies$' <<<"$output"
    [[ $output == *"holds"*" link3, fixture"*" link4, fixture"*" link5, fixture"*" link6, fixture"* ]]
    run -0 "$IMPINGE" clearance "$arm" --each
    grep -qE '^never nearer than +nearest +at t +bodies$' <<<"$output"
    [[ $output == *" link5, fixture"*" link4, fixture"*" link6, fixture"* ]]
}

@test "slices of time as CSV and as JSON lines, and all of them in the last line" {
    run -1 "$IMPINGE" clearance "${passing[@]}" --profile 4 --require 1.2
    [ "${lines[0]}" = "t0,t1,lower,upper,t,verdict,a,b" ]
    [[ ${lines[2]} == *,violated,a,b ]]
    [ "$(printf '%s\n' "${lines[@]}" | awk -F, 'NR > 1 && $3 <= $4 { print $1, $2, $6 }')" = \
        $'0 0.25 holds\n0.25 0.5 violated\n0.5 0.75 violated\n0.75 1 holds' ]
    run -0 "$IMPINGE" clearance "${passing[@]}" --profile 4 --json
    valid clearance
    [ "${#lines[@]}" -eq 5 ]
    [ "$(head -4 <<<"$output" | jq -s -c .)" = "$(tail -1 <<<"$output" | jq -c .slices)" ]
    tail -1 <<<"$output" | jq -e '.lower == ([.slices[].lower] | min) and
        .upper == ([.slices[].upper] | min) and .slices[3].t1 == 1 and .slices[1].bodies == ["a", "b"]'
}

@test "names with commas and quotes are quoted in CSV" {
    jq -nc '{bodies: [{name: "a, \"1\"", surfaces: [{type: "sphere"}]},
        {name: "b", surfaces: [{type: "sphere", center: [4, 0, 0]}]}]}' >names.json
    run -0 "$IMPINGE" clearance names.json --profile 1
    [[ ${lines[1]} == *',,"a, ""1""",b' ]]
}

@test "slices in which a surface does not exist leave the answer of the others as it is" {
    run -0 "$IMPINGE" clearance 'formula time=0,0.4' 'sphere center=0,0,3' --profile 3 --json --time 0,1
    valid clearance
    tail -1 <<<"$output" | jq -e '.reason == null and .upper >= 2 and .slices[2].upper == null'
}

@test "a budget ends it with the bracket so far" {
    run -3 "$IMPINGE" clearance "${endless[@]:0:2}" --gamma 1e-12 --tolerance 1e-9 --max-pairs 200 --json
    valid clearance
    json '.reason == "max-pairs" and .lower == 0 and .upper < 1e-3'
    run -3 "$IMPINGE" clearance "${endless[@]:0:2}" --gamma 1e-12 --tolerance 1e-9 --max-pairs 200
    [[ $output == "nearest distance so far "*"the limit of pairs is reached: raise --max-pairs, or --tolerance; --require asks less"* ]]
}

@test "what a limit ends comes with advice: alone, with a requirement, and of each pair" {
    eggs=(sphere 'ellipsoid radii=0.97,0.98,0.99 ! rotate axis=1,1,1 rate=0.1')
    limits=(--max-pairs 200 --tolerance 1e-6)
    run -3 "$IMPINGE" clearance "${eggs[@]}" "${limits[@]}" --json
    valid clearance
    json ".advice | test(\"'ellipsoid'\")"
    run -3 "$IMPINGE" clearance "${eggs[@]}" "${limits[@]}"
    [[ ${lines[-1]} == "  advice   "*"'ellipsoid'"* ]]
    run -3 "$IMPINGE" clearance "${eggs[@]}" --max-pairs 200 --require 0.009999 --json
    json '.verdict == "undecided" and (.advice | length > 20)'
    run -3 "$IMPINGE" clearance "${eggs[@]}" "${limits[@]}" --each --json
    valid clearance
    json '(has("advice") | not) and (.pairs[0].advice | length > 20)'
    run -3 "$IMPINGE" clearance "${eggs[@]}" "${limits[@]}" --each
    [[ ${lines[-1]} == "  advice   a, b: "*"'ellipsoid'"* ]]
    run -0 "$IMPINGE" clearance "${passing[@]}" --json
    json 'has("advice") | not'
}

@test "bodies that are all beyond what was asked for are an answer" {
    run -0 "$IMPINGE" clearance 'sphere' 'sphere center=9,0,0' --each --within 0.1
    [[ $output == *'never within 0.1: 1 pairs of bodies'* ]]
    run -0 "$IMPINGE" clearance 'sphere' 'sphere center=9,0,0' --each --within 0.1 --json
    json '.reason == "decided" and .beyond == 1'
}

@test "an interrupt ends it with the bracket so far" {
    interrupted 3 INT "$IMPINGE" clearance "${endless[@]:0:2}" --gamma 1e-12 \
        --tolerance 1e-9 --max-bytes 0 --json
    valid clearance
    json '.reason == "cancelled" and .lower == 0 and .upper < 1e-3'
}

@test "where nobody meets anybody there is no distance" {
    echo '{"bodies": [{"name": "a", "surfaces": [{"type": "sphere"}]}]}' >one.json
    for each in "" --each; do
        # shellcheck disable=SC2086 # no word when empty
        run -0 "$IMPINGE" clearance one.json $each --require 1 --json
        valid clearance
        json '.lower == null and .upper == null and .a == null and .reason == "no-pairs"'
        json '.verdict == "holds"'
    done
    run -0 "$IMPINGE" clearance one.json
    [[ $output == "there are no two bodies"* ]]
}

@test "what cannot be asked is refused" {
    fails 2 "--require must be a finite number greater than 0" \
        "$IMPINGE" clearance "${passing[@]}" --require 0
    fails 2 "--require must be a finite number greater than 0" \
        "$IMPINGE" clearance "${passing[@]}" --require -1
    fails 2 "--tolerance must be" "$IMPINGE" clearance "${passing[@]}" --tolerance 0
    fails 2 "tolerance: got 1, must be from 1e-9 to below 1" \
        "$IMPINGE" clearance "${passing[@]}" --tolerance 1
    fails 2 "--profile must be at least 1" "$IMPINGE" clearance "${passing[@]}" --profile 0
    fails 2 "--profile must be a whole number" "$IMPINGE" clearance "${passing[@]}" --profile -3
    fails 2 "slices: got 2000000" "$IMPINGE" clearance "${passing[@]}" --profile 2M
    fails 2 "exclude each other" "$IMPINGE" clearance "${passing[@]}" --profile 2 --each
    fails 4 "cannot be read" "$IMPINGE" clearance missing.json
}

@test "pairs that a limit leaves out are counted, and bound nothing" {
    jq -nc '{bodies: [range(1000) | {surfaces: [{type: "sphere", center: [3 * ., 0, 0]}],
        maps: [{type: "translate", velocity: [0, . % 7, 0]}]}]}' >many.json
    run -3 "$IMPINGE" clearance many.json --each --threads 1 --max-seconds 0.05 --require 0.5 --json
    valid clearance
    json '.lower == 0 and .verdict == "undecided" and .reason == "max-seconds"'
    json '.not_examined + (.pairs | length) == 499500 and .not_examined > 0'
    run -3 "$IMPINGE" clearance many.json --each --threads 1 --max-seconds 1e-9
    [[ $output == *'not examined: 499500 pairs of bodies'* ]]
}

@test "many pairs are answered as they are prepared, so that an end leaves answers" {
    jq -nc '{bodies: [range(500) | {surfaces: [{type: "sphere", center: [3 * ., 0, 0]}],
        maps: [{type: "translate", velocity: [0, . % 7, 0]}]}]}' >many.json
    interrupted 3 INT "$IMPINGE" clearance many.json --each --threads 1 --json # of some 10 s
    json '.not_examined + (.pairs | length) == 124750 and .not_examined > 0'
    json '[.pairs[] | select(.reason == null and .upper - .lower <= .upper * 1e-3)] | length > 100'
}
@test "a limit of time ends the work on many pairs of bodies within it" {
    ! has_sanitizers || skip 'they take processor time of their own'
    jq -nc '{bodies: [range(1000) | {surfaces: [{type: "sphere", center: [3 * ., 0, 0]}],
        maps: [{type: "translate", velocity: [0, . % 7, 0]}]}]}' >many.json
    local used
    used=$(TIMEFORMAT='%U'
        { time "$IMPINGE" clearance many.json --each --threads 1 --max-seconds 1 >/dev/null 2>&1; } 2>&1) || true
    echo "$used s of processor time"
    jq -en --argjson used "$used" '$used < 2' # 14 s were used
}

# grid N: N cubed unit spheres 3 apart, which drift apart.
grid() {
    jq -nc --argjson n "$1" '{bodies: [range($n * $n * $n) | [., ./$n, ./$n/$n | floor % $n] |
        {surfaces: [{type: "sphere", center: [3 * .[0], 3 * .[1], 3 * .[2]]}],
         maps: [{type: "translate", velocity: [.[0], 0, 0]}]}]}'
}

@test "pairs of bodies that never come within a distance are counted, and the others as ever" {
    grid 3 >grid.json
    run -0 "$IMPINGE" clearance grid.json --each --json
    local all=$output
    run -0 "$IMPINGE" clearance grid.json --each --within 2 --json
    valid clearance
    json '.beyond == 351 - (.pairs | length) and (.pairs | length) == 54 and .lower > 0.99'
    jq -e --slurpfile all <(cat <<<"$all") '[.pairs[].lower] == [$all[0].pairs[].lower | select(. < 2)] and
        .lower == $all[0].lower and .upper == $all[0].upper' <<<"$output"
    run -0 "$IMPINGE" clearance grid.json --each --within 2
    [[ ${lines[-1]} == "never within 2: 297 pairs of bodies" ]]
    run -0 "$IMPINGE" clearance grid.json --each --within 0.5 --require 0.5 --json
    valid clearance
    json '.lower == 0.5 and .verdict == "holds" and .beyond == 351 and .pairs == [] and .upper == null'
    run -0 "$IMPINGE" clearance grid.json --each --within 0.5 --require 0.5
    [[ ${lines[0]} == "holds: no two bodies ever come so near" ]]
    fails 2 "--within belongs to --each" "$IMPINGE" clearance grid.json --within 1
    fails 2 "--within must be at least what --require asks for, 2, not 1" \
        "$IMPINGE" clearance grid.json --each --within 1 --require 2
}

@test "many thousands of bodies are measured where they come near, in little memory" {
    without_sanitizers
    # 10,648 bodies, 56,684,628 pairs of them, two by two 0.6 apart at first, all others 1
    grid 22 | jq -c '(.bodies[].surfaces[0].center | select(.[0] % 2 == 1)[0]) -= 0.4' >grid.json
    run -0 "$IMPINGE" clearance grid.json --each --within 0.9 --max-bytes 64M --json
    json '.lower > 0.59 and .upper < 0.61 and .beyond + (.pairs | length) == 56684628'
    json '(.pairs | length) == 22 * 22 * 11 and .stats.bytes < 64e6'
}

@test "the nearest of thousands of bodies are found in little memory" {
    without_sanitizers
    # Two equal bodies that ignore each other say nothing of the nearest.
    grid 14 | jq -c '(.bodies[7].surfaces[0].center[0]) -= 0.3 |
        .bodies[100] += {name: "x"} | .bodies[200] = (.bodies[100] | .name = "y") |
        .ignore = [["x", "y"]]' >grid.json
    run -0 "$IMPINGE" clearance grid.json --max-bytes 100M --json
    json '.lower > 0.69 and .upper < 0.71'
    run -1 "$IMPINGE" clearance grid.json --max-bytes 100M --require 0.8 --json
    json '.t_violated == 0'
    run -0 "$IMPINGE" clearance grid.json --max-bytes 100M --require 0.6
    run -0 "$IMPINGE" clearance grid.json --profile 3 --json
    tail -n 1 <<<"$output" | jq -e '[.slices[].lower | . > 0.69] | length == 3 and all'
}

@test "surfaces nearly about one line are bracketed as narrowly as is asked" {
    local tube='cylinder radius=.5 height=1.2 ! translate offset=[[1e-5,0,0]]'
    run -0 "$IMPINGE" clearance sphere "$tube" --gamma 0.2 --tolerance 1e-7 --json
    json '.upper - .lower <= 1e-7 * .upper and .reason == null'
    run -0 "$IMPINGE" clearance sphere "$tube" --gamma 0.2 --require 0.21896
    # The squares of these radii overflow: 0.34 apart.
    run -3 "$IMPINGE" clearance 'ellipsoid radii=1e200,1,1' 'sphere radius=.1 center=0.9e200,0,0' \
        --require 0.5 --max-pairs 1000
}

@test "each two of hundreds of bodies get an answer, however far apart" {
    without_sanitizers
    jq -nc '{bodies: [range(250) | {surfaces: [{type: "sphere", center: [3 * ., 0, 0]}]}]}' >row.json
    run -0 "$IMPINGE" clearance row.json --each --require 0.5 --tolerance 0.1 --json
    json '(.pairs | length) == 31125 and all(.pairs[]; .lower > 0.89 and .upper < 748)'
}

@test "a ball inside a solid body touches it among hundreds of other bodies" {
    grid 9 | jq -c '.bodies[] += {group: ["grid"]} |
        .bodies += [{name: "case", solid: true, surfaces: [{type: "sphere", radius: 100}]},
        {name: "seed", surfaces: [{type: "sphere", radius: 0.01, center: [50,0,0]}]}] |
        .ignore = [["case", "grid"]]' >inside.json
    run -0 "$IMPINGE" clearance inside.json --json
    json '.upper == 0 and ([.a.body, .b.body] | sort) == ["case", "seed"]'
}

@test "a million slices end at a limit, in one line for the time that is left" {
    run -3 "$IMPINGE" clearance "${passing[@]}" --profile 1000000 --max-bytes 8M
    [[ ${lines[-1]} == 0.0*,1,0,,,* ]] && [ "${#lines[@]}" -lt 100000 ]
    run -3 "$IMPINGE" clearance "${passing[@]}" --profile 1000000 --max-seconds 0.1 --require 1.1 --json
    valid clearance
    jq -se 'last.slices == .[:-1] and last.reason == "max-seconds" and last.verdict == "undecided" and
        (.[-2] | .t1 == 1 and .lower == 0 and .verdict == "undecided") and
        ([.[:-1][].t1][:-1] == [.[:-1][].t0][1:])' <<<"$output"
}

@test "slices leave nothing behind: memory does not grow with their number" {
    run -0 "$IMPINGE" clearance "${passing[@]}" --profile 4000 --max-bytes 16M --json
    jq -se 'length == 4001 and last.stats.bytes < 16e6 and last.slices == .[:-1]' <<<"$output"
    jq -se 'all(.[:-1][]; (if .t1 <= 0.5 then .t1 else .t0 end) as $t |
        (((3 - 6 * $t) * (3 - 6 * $t) + 9 | sqrt) - 2) as $d |
        .lower <= $d * (1 + 1e-15) and .upper >= $d * (1 - 1e-15) and .upper - .lower <= 1e-3 * .upper)' \
        <<<"$output"
}

@test "a type that breaks its promises where it shows is an error, not an answer" {
    local lies="$top_builddir/tests/plugins/.libs"
    fails 5 "but proved to stay 4.04" "$IMPINGE" clearance liar_distance 'cylinder radius=5' \
        --plugin-path "$lies" --require 4.05
    [[ $stderr == *"type 'liar_distance'"*"type 'cylinder radius=5'"*"are seen 4"* ]]
    fails 5 "apart; one of these types breaks a promise" "$IMPINGE" clearance liar_distance \
        'cylinder radius=5' --plugin-path "$lies" --require 4.05 --tolerance 1e-3
    run -0 "$IMPINGE" clearance cylinder 'cylinder radius=5' --require 3.99 --json
    json '.verdict == "holds" and .lower <= .upper'
}

@test "a file and a number are told what --require is for" {
    three >three.json
    fails 2 "'three.json' is a file, which is asked about alone, and '2' is left over; --require" \
        "$IMPINGE" clearance three.json 2
}

@test "slices are written in the fewest digits that read back" {
    run -0 "$IMPINGE" clearance "${passing[@]}" --profile 5
    [[ ${lines[1]} == "0,0.2,"* && ${lines[2]} == "0.2,0.4,"* ]]
    [[ $(cut -d, -f1,2 <<<"$output") != *0000000000* ]]
    run -0 "$IMPINGE" clearance sphere 'sphere center=3,0,0' --time 0.00059,0.000591 --profile 1 \
        --json
    [[ ${lines[0]} == '{"t0":0.00059,"t1":0.000591,'* ]]
}
