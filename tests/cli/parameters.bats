#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Scenes with parameters, on the command line.

bats_require_minimum_version 1.5.0
load "$top_srcdir/tests/support/cli_helper.bash"

# Balls of radius 0.3 on two arms of length 1, whose shafts are 2.7 apart: 0.1 at the nearest.
arms() {
    cat <<END | tr -d '\n'
{"gamma": 1e-3, "parameters": {"a": [-1, 1], "b": [-1, 1]}, "bodies": [
{"name": "one", "surfaces": [{"type": "sphere", "radius": 0.3, "center": [1,0,0]}],
"maps": [{"type": "rotate", "axis": [0,0,1], "rate": 1, "clock": "a"}]},
{"name": "two", "surfaces": [{"type": "sphere", "radius": 0.3, "center": [-1,0,0]}],
"maps": [{"type": "rotate", "axis": [0,0,1], "rate": 1, "clock": "b"},
{"type": "translate", "offset": [[${1-2.7},${2-0,0}]]}]}]}
END
}

# Those shapes as ellipsoids, for which a query takes many pairs: balls are parted by their centers.
slow_arms() { arms | sed 's/"sphere", "radius": 0.3/"ellipsoid", "radii": [0.3,0.3,0.3]/g'; }

# --- Answers ----------------------------------------------------------------------------------------

@test "solve answers for all values, or names those of a contact" {
    arms >arms.json
    run -0 "$IMPINGE" solve arms.json --json
    valid result
    json '.verdict == "clear" and .parameters == null and .boxes > 0'
    arms 2.55 >arms.json
    run -0 "$IMPINGE" solve arms.json --json
    valid result
    json '.verdict == "contact" and .t == .t_lower and (.parameters | keys == ["a", "b"])'
    json '.gap <= 1e-3 and (.parameters.a | . > -1 and . < 1)'
    run -1 "$IMPINGE" solve arms.json --exit-code
    [[ $output == *'contact at t = 0'*'values   a = '*', b = '* ]]
}

@test "two surfaces on the command line have parameters and clocks, too" {
    run -0 "$IMPINGE" pair 'sphere ! translate velocity=1,0,0 clock=x' 'sphere center=3.5,0,0' \
        --parameter x=0,1
    [[ $output == clear* ]]
    run -0 "$IMPINGE" pair 'sphere ! translate velocity=1,0,0 clock=x' 'sphere center=3.5,0,0' \
        --parameter x=0,2 --json
    valid result
    json '.verdict == "contact" and .parameters.x >= 1.49 and .parameters.x <= 2'
}

@test "an option gives a parameter another range" {
    arms 2.55 >arms.json
    run -0 "$IMPINGE" solve arms.json --parameter a=0.6,1
    [[ $output == clear* ]]
}

@test "clearance brackets the least of all values, and decides what is required" {
    arms >arms.json
    run -0 "$IMPINGE" clearance arms.json --tolerance 0.1 --json
    valid clearance
    json '.lower <= 0.1 and .lower >= 0.0899 and .upper >= 0.1 and (.parameters.a | fabs) < 0.5'
    run -0 "$IMPINGE" clearance arms.json --require 0.08 --json
    valid clearance
    json '.verdict == "holds" and .parameters == null'
    run -1 "$IMPINGE" clearance arms.json --require 0.12 --json
    valid clearance
    json '.verdict == "violated" and .parameters.b != null'
}

@test "an undecided answer names the share that is proved and the box that is left" {
    arms >arms.json
    run -3 "$IMPINGE" clearance arms.json --require 0.0999 --max-boxes 9 --json
    valid clearance
    json '.verdict == "undecided" and .proved > 0 and .proved < 1 and .boxes == 9'
    json '.worst.parameters | keys == ["a", "b"]'
    json '.worst.bodies == ["one", "two"]'
}

@test "boxes are written as they are proved, and cover the values" {
    arms 2.9 '0,0],[-0.1,0,0' >arms.json # their shafts come nearer
    run -0 "$IMPINGE" solve arms.json --gamma 0.05 --boxes boxes.jsonl --json
    json '.verdict == "clear"'
    jq -es '(.[0] | keys == ["options", "scene"]) and (.[-1] | keys == ["state"])' boxes.jsonl
    jq -es '.[1:-1] | length > 1 and all(.[]; .bodies == ["one", "two"] and
        (.parameters | keys == ["a", "b"]) and (.verdict | IN("clear", "contact", "undecided")))' \
        boxes.jsonl
    jq -es '.[1:-1] | map((.time[1] - .time[0]) * (.parameters.a | .[1] - .[0]) *
        (.parameters.b | .[1] - .[0])) | add | . > 3.999 and . < 4.001' boxes.jsonl
}

# --- Going on ---------------------------------------------------------------------------------------

# in_parts LIMIT COMMAND...: asks with --resume until a part is answered; then the answer and the
# boxes are those of one run, but for its stats.
in_parts() {
    local limit=$1 parts=1 status
    shift
    "$@" --json --boxes whole.jsonl >whole.json || true
    rm -f parts.jsonl
    while [ "$parts" -lt 9 ]; do
        status=0
        # shellcheck disable=SC2086 # an option and its value
        "$@" --json --resume parts.jsonl $limit >parts.json || status=$?
        [ "$status" -eq 3 ] || break
        parts=$((parts + 1))
    done
    echo "$parts parts"
    [ "$parts" -gt 2 ]
    cmp <(jq 'del(.stats)' whole.json) <(jq 'del(.stats)' parts.json)
    cmp whole.jsonl parts.jsonl
}

@test "a run goes on from the boxes that another left, to the same answer and boxes" {
    without_sanitizers
    arms >arms.json
    in_parts '--max-boxes 6' "$IMPINGE" solve arms.json --gamma 0.09
    in_parts '--max-boxes 12' "$IMPINGE" clearance arms.json --require 0.095
    in_parts '--max-boxes 16' "$IMPINGE" clearance arms.json --tolerance 0.1
    arms 2.9 '0,0],[-0.3,0,0' >arms.json # their shafts come nearer: a contact in time
    in_parts '--max-boxes 150' "$IMPINGE" solve arms.json --gamma 0.05
}

@test "a box that a limit interrupts is asked again, so that nothing changes" {
    slow_arms >arms.json
    in_parts '--max-pairs 1500' "$IMPINGE" clearance arms.json --tolerance 0.1
}

@test "boxes of another scene, of other options or of no run are refused, and stay" {
    arms >arms.json
    run -3 "$IMPINGE" solve arms.json --gamma 0.09 --max-boxes 9 --resume boxes.jsonl
    cp boxes.jsonl kept
    fails 4 "boxes.jsonl: its answers were made with --gamma 0.09, this run has --gamma 0.08 (its first line)" \
        "$IMPINGE" solve arms.json --gamma 0.08 --resume boxes.jsonl
    fails 4 'made without --parameter, this run has --parameter a=0,1' \
        "$IMPINGE" solve arms.json --gamma 0.09 --parameter a=0,1 --resume boxes.jsonl
    fails 2 'of the same' "$IMPINGE" clearance arms.json --gamma 0.09 --resume boxes.jsonl
    arms 2.8 >other.json
    fails 4 'another scene' "$IMPINGE" solve other.json --gamma 0.09 --resume boxes.jsonl
    fails 2 'give it without --boxes' \
        "$IMPINGE" solve arms.json --gamma 0.09 --boxes x --resume boxes.jsonl
    fails 2 'needs a scene in a file' "$IMPINGE" solve - --resume boxes.jsonl <arms.json
    fails 2 'needs a file' "$IMPINGE" solve arms.json --resume -
    cmp boxes.jsonl kept
    fails 4 'its first line is not that of a file of boxes' "$IMPINGE" solve arms.json --resume other.json
    head -n -1 kept >cut.jsonl
    fails 4 'its last line, which tells where the run stood, is missing' \
        "$IMPINGE" solve arms.json --gamma 0.09 --resume cut.jsonl
    sed 's/"made":[0-9]*/"made":1/' kept >wrong.jsonl
    fails 2 'does not tell where a survey stands' \
        "$IMPINGE" solve arms.json --gamma 0.09 --resume wrong.jsonl
    [ ! -e x ] && [ ! -e cut.jsonl.part ]
}

@test "boxes are no matter of a scene without parameters" {
    scene >plain.json
    run -0 --separate-stderr "$IMPINGE" solve plain.json --resume boxes.jsonl
    [[ $stderr == *'warning: --resume does nothing: the scene has no parameters'* ]]
    [ ! -e boxes.jsonl ]
}

# --- What does not go -------------------------------------------------------------------------------

@test "what is wrong with parameters is refused with the cure" {
    arms >arms.json
    fails 2 "--parameter must be NAME=LO,HI, such as angle=0,1.5, not 'a=1'" \
        "$IMPINGE" solve arms.json --parameter a=1
    fails 4 '/parameters/b: got the range [1, 0]' "$IMPINGE" solve arms.json --parameter b=1,0
    fails 4 '(or --parameter x=LO,HI)' "$IMPINGE" pair 'sphere ! rotate axis=0,0,1 rate=1 clock=x' sphere
    for option in --each '--refine 1e-2,1e-3'; do
        # shellcheck disable=SC2086 # an option and its value
        fails 2 'and --boxes exclude each other, since the boxes of a file are those of one search; ' "$IMPINGE" solve arms.json $option --boxes p
    done
    [ ! -e p ]
}

@test "a declared parameter that nobody follows is a warning" {
    arms | jq -c '.parameters.c = [0, 1]' >arms.json
    for option in '' '--parameter c=0,2'; do
        # shellcheck disable=SC2086 # an option and its value, or none
        run -0 --separate-stderr "$IMPINGE" solve arms.json $option
        [[ $stderr == *"warning: no surface or map has the parameter 'c' as its clock"* ]]
    done
    for verb in solve clearance; do
        run -0 --separate-stderr "$IMPINGE" $verb arms.json --json
        json '.warnings | length == 1 and .[0].parameter == "c"'
    done
    valid clearance
}

@test "a parameter of the command line that nobody declares or follows is refused" {
    arms | sed 's/"a": \[/"angle": [/; s/"clock": "a"/"clock": "angle"/' >arms.json
    for verb in solve clearance; do
        fails 2 "--parameter: the scene has no parameter 'angel'; did you mean 'angle'?" "$IMPINGE" $verb arms.json \
            --parameter angel=0,1
        [[ $stderr == *"did you mean 'angle'? its parameters are: angle, b"* ]]
    done
    arms | sed 's/"clock": "a"/"clock": [-1, 1]/' >own.json
    fails 2 "no parameter 'rotate#1'" "$IMPINGE" solve own.json --parameter rotate#1=0,1
    [[ $stderr == *'its parameters are: a, b'* ]]
    fails 2 'its parameters are: none' "$IMPINGE" pair sphere 'sphere center=3,0,0' --parameter x=0,1
    fails 2 'its parameters are: x' "$IMPINGE" pair 'sphere ! translate velocity=1,0,0 clock=x' \
        'sphere center=3.5,0,0' --parameter x=0,1 --parameter yy=0,1
}

@test "batch answers a line with parameters for all values" {
    arms 2.55 | jq -c '.id = "near" | .parameters.c = [0, 1]' >lines.jsonl
    arms | jq -c '.id = "far"' >>lines.jsonl
    arms | jq -c '.id = "fine"' >>lines.jsonl
    run -0 --separate-stderr "$IMPINGE" batch lines.jsonl --threads 2
    [ "$(jq -cs 'map([.id, .verdict])' <<<"$output")" = \
        '[["near","contact"],["far","clear"],["fine","clear"]]' ]
    jq -es '(.[0] | .parameters.a != null and .warnings[0].parameter == "c") and
        (.[1] | .parameters == null and .boxes > 0)' <<<"$output"
    run -3 --separate-stderr "$IMPINGE" batch lines.jsonl --max-pairs 1
    jq -es '.[0].verdict == "undecided" and .[0].proved < 1 and .[0].worst != null' <<<"$output"
    run -2 --separate-stderr "$IMPINGE" batch lines.jsonl --method paper
    jq -es 'all(.error | contains("--method paper does not go with the parameters"))' <<<"$output"
}

@test "simulate refuses clocks" {
    arms | sed 's/"name": "one"/"name": "one", "mass": 1/' >heavy.json
    run ! --separate-stderr "$IMPINGE" simulate heavy.json -o out.json
    [[ $stderr == *parameter* ]]
    [ ! -e out.json ]
}

# --- Several answers --------------------------------------------------------------------------------

# A third body that no parameter moves.
three() {
    arms "$@" | jq -c '.bodies |= [.[0], {name: "far", surfaces: [{type: "sphere", radius: 0.3,
        center: [1,0,10]}]}, .[1]]'
}

@test "solve --each answers each pair for all values, in order of time, whoever counts threads" {
    three 2.55 >three.json
    run -0 "$IMPINGE" solve three.json --each --json
    valid result
    jq -es 'map(.bodies) == [["one","two"],["one","far"],["far","two"]] and
        map(.verdict) == ["contact","clear","clear"] and
        (.[0].parameters | keys == ["a","b"]) and all(.boxes > 0)' <<<"$output"
    local many=$output
    run -0 "$IMPINGE" solve three.json --each --json --threads 1
    cmp <(jq 'del(.stats)' <<<"$many") <(jq 'del(.stats)' <<<"$output")
    run -1 "$IMPINGE" solve three.json --each --exit-code
    [[ ${lines[0]} == 'contact at t = 0: one, two, at a = '*', b = '* ]]
    [ "${lines[1]}" = 'clear from t = 0 to 1: one, far' ]
    # A pair's answer is that of the two bodies alone.
    jq -c '.bodies |= [.[0], .[2]]' three.json >two.json
    run -0 "$IMPINGE" solve two.json --json
    cmp <(jq -s '.[0] | del(.stats, .bodies, .at_rest, .scene)' <<<"$many") <(jq 'del(.stats, .scene)' <<<"$output")
}

@test "solve --each counts pairs that a limit left out, or lists them" {
    three >three.json
    run -3 "$IMPINGE" solve three.json --each --max-boxes 1 --json
    valid result
    jq -es '.[0].verdict == "undecided" and .[0].proved < 1 and .[0].worst != null' <<<"$output"
    run -3 "$IMPINGE" solve three.json --each --max-seconds 1e-9 --json
    valid result
    jq -es '.[-1].not_listed.not_examined == 3' <<<"$output"
    run -3 "$IMPINGE" solve three.json --each --max-seconds 1e-9 --list-all --json
    jq -es 'length == 3 and all(.verdict == "undecided")' <<<"$output"
}

@test "clearance --each brackets each pair, and leaves out those beyond --within" {
    three >three.json
    run -0 "$IMPINGE" clearance three.json --each --tolerance 0.1 --json
    valid clearance
    json '.pairs | length == 3 and .[0].bodies == ["one","two"] and .[0].lower <= 0.1 and
        .[0].upper >= 0.1 and (.[0].parameters | keys == ["a","b"]) and .[1].lower > 9'
    run -0 "$IMPINGE" clearance three.json --each --tolerance 0.1
    [[ $output == *'one, two, at a = '* ]]
    run -0 "$IMPINGE" clearance three.json --each --within 1 --tolerance 0.1 --json
    valid clearance
    json '.beyond == 2 and (.pairs | length == 1) and .lower <= 0.1'
    run -0 "$IMPINGE" clearance three.json --each --within 0.05 --json
    valid clearance
    json '.beyond == 3 and .lower == 0.05 and .pairs == []'
    run -1 "$IMPINGE" clearance three.json --each --require 0.12 --json
    valid clearance
    json '.verdict == "violated" and (.pairs | map(.verdict) | sort == ["holds","holds","violated"])'
    run -3 "$IMPINGE" clearance three.json --each --max-seconds 1e-9 --json
    valid clearance
    json '.not_examined == 3 and .lower == 0'
}

@test "clearance --profile slices time, or the range of a parameter" {
    arms >arms.json
    run -0 "$IMPINGE" clearance arms.json --profile 4 --over b --tolerance 0.1
    [ "${lines[0]}" = 'from,to,lower,upper,t,verdict,a,b,at a,at b' ]
    [ "${#lines[@]}" -eq 5 ]
    # Each value lies in its slice; the outer slices are farther apart.
    awk -F, 'NR > 1 && !($1 <= $10 && $10 <= $2 && $3 <= $4) { exit 1 }
        NR == 2 || NR == 5 { if (!($3 > 0.2)) exit 1 } NR == 3 && !($3 < 0.1 && $4 > 0.1) { exit 1 }' <<<"$output"
    run -0 "$IMPINGE" clearance arms.json --profile 2 --over a --tolerance 0.1 --require 0.05 --json
    valid clearance
    jq -es 'length == 3 and .[0].over == {a: [-1, 0]} and .[1].over.a == [0, 1] and
        .[0].verdict == "holds" and .[2].slices == .[:2]' <<<"$output"
    run -0 "$IMPINGE" clearance arms.json --profile 2 --tolerance 0.2 --json
    valid clearance
    jq -es '.[0].t0 == 0 and .[1].t1 == 1 and (.[0] | has("over") | not)' <<<"$output"
    slow_arms >arms.json
    run -3 "$IMPINGE" clearance arms.json --profile 4 --tolerance 0.1 --max-pairs 7000
    [ "${lines[-1]}" = '0.5,1,0,,,,,,,' ]
    fails 2 "--over: the scene has no parameter 'c'; its parameters are: a, b" "$IMPINGE" clearance arms.json --profile 4 --over c
    fails 2 'belongs to --profile' "$IMPINGE" clearance arms.json --over b
    scene >plain.json
    fails 2 "--over: the scene has no parameter 'b'; its parameters are: none" "$IMPINGE" clearance plain.json --profile 2 --over b
}

@test "solve --refine answers for all values at each gamma" {
    arms 2.55 >arms.json
    run -0 "$IMPINGE" solve arms.json --refine 1e-1,1e-2,1e-3 --json
    valid result
    jq -es 'map(.gamma) == [0.1, 0.01, 0.001] and all(.verdict == "contact" and .gap <= .gamma)' <<<"$output"
    arms >arms.json # 0.1 apart: a contact at the first only
    run -0 "$IMPINGE" solve arms.json --refine 0.25,0.05 --json
    jq -es 'map(.verdict) == ["contact", "clear"]' <<<"$output"
    run -3 "$IMPINGE" solve arms.json --refine 0.05,0.01 --max-boxes 1 --json
    jq -es 'map(.verdict) == ["undecided"]' <<<"$output"
}

@test "--explain tells where the boxes went, and what is undecided gets advice" {
    three >three.json
    run -0 "$IMPINGE" solve three.json --explain --json
    valid result
    json '.survey.bodies[0].bodies == ["one","two"] and (.survey.halved | .a + .b > 0)'
    json '.survey.bodies | map(.boxes) | add'
    json '(.survey.bodies | map(.boxes) | add) == .boxes and (.survey.bodies | all(.proved >= 0.999999))'
    run -0 "$IMPINGE" solve three.json --explain
    [[ $output == *'  where '*'one, two'*'  halved   a: '* ]]
    run -3 "$IMPINGE" solve three.json --max-boxes 3 --json
    valid result
    json '.advice | contains("boxes were halved along") and contains("(--parameter)")'
    json 'has("survey") | not'
}

# --- Tolerances, and sweeping a parameter -------------------------------------------------------------

@test "a tolerance is six parameters of its own, also in a pipeline and isolated" {
    for way in '' '--isolate all'; do
        # shellcheck disable=SC2086 # an option and its value, or none
        run -0 "$IMPINGE" clearance 'sphere ! tolerance offset=0.4 angle=0.01' 'sphere center=3.5,0,0' \
            --tolerance 0.05 --json $way
        valid clearance
        json '.lower <= 1.1 and .lower >= 1.04 and (.parameters | keys | length == 6) and
            .parameters["tolerance#4"] > 0.3'
    done
    run -3 "$IMPINGE" clearance 'ellipsoid radii=1,0.9,1 ! tolerance offset=0.4 angle=0.01' 'sphere center=3.5,0,0' --max-boxes 3
    [[ $output == *'  share '*' is done: nothing there is nearer, to within --tolerance'* ]]
    [[ ${lines[-1]} == *"'tolerance#"*'(which a map has of its own: impinge-scene(5)), or a larger --tolerance'* ]]
    fails 4 'has clocks of its own; leave it out' \
        "$IMPINGE" pair 'sphere ! tolerance offset=0.4 clock=0,1' 'sphere center=3.5,0,0'
    fails 4 'must be >= 0' "$IMPINGE" pair 'sphere ! tolerance offset=-1' 'sphere center=3.5,0,0'
    printf '{"bodies": [%s, {"surfaces": [{"type": "sphere", "center": [9,0,0]}]}]}' \
        "$(for k in 1 2 3 4 5 6; do echo '{"surfaces": [{"type": "sphere"}], "maps": [{"type": "tolerance", "offset": 1, "angle": 0.01}]}'; done |
            paste -sd,)" >many.json
    fails 4 'more than 32 parameters' "$IMPINGE" solve many.json
}

@test "view sweeps a parameter in the place of time" {
    arms 2.55 >arms.json
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --at b=0 -o swept.svg
    grep -q 'contact: a = -0\.[0-9]*, one and two' swept.svg
    grep -q 'start: a = -1, b = 0<' swept.svg
    grep -q 'end: a = 1<' swept.svg
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --time 0.5,1 -o part.svg
    [[ $stderr == *'drawn at b = 0; '* ]]
    grep -q ' a = 0.5' part.svg
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --at b=0 -o swept.glb --frames 5
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --at b=0 -o swept.html --frames 5
    grep -q 'arms.json, t is a' swept.html
    fails 2 "--sweep: the scene has no parameter 'c'; its parameters are: a, b" "$IMPINGE" view arms.json --sweep c -o x.svg
    scene >plain.json
    fails 2 "--sweep: the scene has no parameter 'c'" "$IMPINGE" view plain.json --sweep c -o x.svg
    "$IMPINGE" solve arms.json --json >result.json
    fails 2 '--sweep draws a scene, not a result' "$IMPINGE" view result.json --sweep a -o x.svg
    [ ! -e x.svg ]
}

@test "what follows time stands still while a parameter is swept" {
    without_sanitizers
    arms 2.9 '0,0],[-0.3,0,0' >arms.json # 0.3 apart at time 0, in contact at 1
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --at b=0 -o swept.svg
    grep -q 'nearest: a = ' swept.svg
    run -0 --separate-stderr "$IMPINGE" view arms.json --sweep a --at b=0,time=1 -o swept.svg
    grep -q 'nearest: a = .* 0\.0*[0-9.e-]* apart' swept.svg || grep -q 'contact: a = ' swept.svg
    fails 2 "the scene has no parameter 'time'" "$IMPINGE" view arms.json --at time=1 -o x.svg
}

@test "solids are closed within the scene's gamma, whatever room boxes of values need" {
    # The lids leave a gap of 0.02, far above gamma; the box of values needs room for as much.
    can() {
        printf '{"gamma": 1e-3, "parameters": {"a": [-0.02, 0.02]}, "bodies": [{"name": "can", "solid": true,
            "surfaces": [{"type": "cylinder", "radius": 0.3, "height": 0.6},
            {"type": "disc", "radius": %s, "center": [0,0,-0.3]},
            {"type": "disc", "radius": %s, "center": [0,0,0.3]}],
            "maps": [{"type": "rotate", "axis": [0,1,0], "angle": [0.8]},
            {"type": "translate", "velocity": [1,0,0], "clock": "a"}]}, {"name": "ball",
            "surfaces": [{"type": "sphere", "radius": 0.02, "center": [0.38,0,0.38]}],
            "maps": [{"type": "translate", "offset": [[0,0,0],[0.001,0,0]]}]}]}' "$1" "$1" >can.json
    }
    can 0.3
    run -0 "$IMPINGE" solve can.json
    [[ $output == clear* ]]
    can 0.28
    fails 4 'its surfaces are not closed within 0.001' "$IMPINGE" solve can.json
}
