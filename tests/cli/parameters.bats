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
    arms >arms.json
    in_parts '--max-boxes 6' "$IMPINGE" solve arms.json --gamma 0.09
    in_parts '--max-boxes 12' "$IMPINGE" clearance arms.json --require 0.095
    in_parts '--max-boxes 30' "$IMPINGE" clearance arms.json --tolerance 0.1
    arms 2.9 '0,0],[-0.3,0,0' >arms.json # their shafts come nearer: a contact in time
    in_parts '--max-boxes 150' "$IMPINGE" solve arms.json --gamma 0.05
}

@test "a box that a limit interrupts is asked again, so that nothing changes" {
    arms >arms.json
    in_parts '--max-pairs 6000' "$IMPINGE" clearance arms.json --tolerance 0.1
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
    fails 4 'got "x", which is not a parameter' "$IMPINGE" pair 'sphere ! rotate axis=0,0,1 rate=1 clock=x' sphere
    for option in --each '--refine 1e-2,1e-3' '--proof p' --explain; do
        # shellcheck disable=SC2086 # an option and its value
        fails 2 'does not go with the parameters that the scene has' "$IMPINGE" solve arms.json $option
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
        fails 2 "got 'angel', which the scene does not declare" "$IMPINGE" $verb arms.json \
            --parameter angel=0,1
        [[ $stderr == *"did you mean 'angle'? its parameters are: angle, b"* ]]
    done
    arms | sed 's/"clock": "a"/"clock": [-1, 1]/' >own.json
    fails 2 "got 'rotate#1'" "$IMPINGE" solve own.json --parameter rotate#1=0,1
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
