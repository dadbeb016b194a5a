#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Examples of scenes with parameters; what is listed of them and drawn.

load ../support/cli_helper

setup() {
    cd "$BATS_TEST_TMPDIR"
    data=$top_srcdir/tools/data
}

@test "a spindle and its nozzle reach nothing at any angle of two axes" {
    run -0 "$IMPINGE" solve "$data/spindle.json" --json
    json '.verdict == "clear" and .parameters == null and .boxes > 0'
    run -0 "$IMPINGE" clearance "$data/spindle.json" --json
    json '.lower > 48 and .upper < 49 and (.parameters.b | fabs > 1.9) and (.proved == null)'
}

@test "a distance is kept with every joint of an arm half a degree off" {
    run -0 "$IMPINGE" clearance "$data/arm_off.json" --require 5 --json
    json '.verdict == "holds" and .stats.pairs < 2390' # ten times those of the exact motion
}

@test "the least distance of an arm with six joints off is known to a tenth in seconds" {
    run -0 "$IMPINGE" clearance "$data/arm_off.json" --tolerance 0.1 --max-pairs 150000 --json
    json '.upper > 12.18 and .upper < 12.19 and .lower >= 0.9 * .upper - 1e-9 and .parameters["e2"] > 0.0087'
}

@test "a hinge that is a millimetre off leaves room, and three do not" {
    run -0 "$IMPINGE" clearance "$data/door.json" --require 1.5 --json
    json '.verdict == "holds"'
    run -1 "$IMPINGE" clearance "$data/door.json" --require 1.5 --parameter dx=-1,3 --json
    json '.verdict == "violated" and .parameters.dx > 1 and .bodies == null'
}

@test "a door that touches for a range of values at once names one of them" {
    # at the start, at dx = 3 and every dy from 0 to 1
    run -0 "$IMPINGE" solve "$data/door.json" --parameter dx=-1,3 --max-pairs 300000 \
        --boxes boxes.jsonl --json
    json '.verdict == "contact" and .t == 0 and .t_lower == 0 and .gap <= 1e-6'
    json '.parameters.dx > 2.999998 and .parameters.dy >= 0'
    # all values and times are told of, those after the contact as well
    jq -es 'map(select(.bodies == ["door", "cupboard"]) | (.time[1] - .time[0]) *
        (.parameters.dx | .[1] - .[0]) * (.parameters.dy | .[1] - .[0])) | add |
        . > 7.999 and . < 8.001' boxes.jsonl
}

@test "what a limit leaves tells the share that is proved, and the worst box" {
    run -3 "$IMPINGE" clearance "$data/spindle.json" --tolerance 1e-9 --max-pairs 500 --json
    json '.proved >= 0 and .proved < 1 and (.worst.parameters.b | length == 2)'
    run -3 "$IMPINGE" solve "$data/spindle.json" --max-boxes 1 --json --gamma 1e-6
    json '.verdict == "undecided" and .proved < 1'
}

@test "info lists parameters, and the bodies that follow them" {
    run -0 "$IMPINGE" info "$data/spindle.json" --json
    valid types
    json '.parameters[0] == {"name": "b", "range": [-1.92, 1.92], "followed_by": ["spindle", "nozzle"]}'
    json '.parameters[1].followed_by == ["fork", "spindle", "nozzle"]'
    run -0 "$IMPINGE" info "$data/spindle.json"
    [[ $output == *'parameter b: from -1.92 to 1.92, followed by spindle, nozzle'* ]]
}

@test "a picture is of values: those given, those of a result, or the middle" {
    small=(--width 96 --height 80)
    run -0 --separate-stderr "$IMPINGE" view "$data/spindle.json" -o middle.obj "${small[@]}" --at 0
    [[ $stderr == *'drawn at b = 0, c = 0; --at NAME=VALUE,... shows others'* ]]
    run -0 --separate-stderr "$IMPINGE" view "$data/spindle.json" -o given.obj --at b=0,c=0,0
    [ -z "$stderr" ]
    cmp middle.obj given.obj
    run -0 "$IMPINGE" view "$data/spindle.json" -o other.obj --at c=1,0,b=-1
    run ! cmp -s middle.obj other.obj
    "$IMPINGE" clearance "$data/spindle.json" --json >result.json
    run -0 --separate-stderr "$IMPINGE" view result.json -o result.png "${small[@]}"
    [[ $stderr == *'drawn at b = -1.92'* ]]
}

@test "the titles of a picture name the values, and are broken where they do not fit" {
    "$IMPINGE" clearance "$data/spindle.json" --json >result.json
    run -0 "$IMPINGE" view result.json -o wide.svg
    grep -q '>nearest: b = -1.92, c = [-0-9.e]*, fork and nozzle 48.5 apart<' wide.svg
    run ! grep -q 't = 0' wide.svg # there is one moment only
    run -0 "$IMPINGE" view result.json -o narrow.svg --width 640 --height 480
    grep -q '>nearest: b = -1.92, ' narrow.svg
    grep -q 'nozzle 48.5 apart<' narrow.svg
    run ! grep -q '\.\.\.<' narrow.svg
    run -0 "$IMPINGE" view "$data/door.json" -o moving.svg
    grep -q ': t = 0.*, dx = 0, dy = 0[,<]' moving.svg
}

@test "values that a scene does not have are refused" {
    fails 2 "--at: the scene has no parameter 'bb'; its parameters are: " "$IMPINGE" view "$data/spindle.json" -o x.png --at bb=1
    fails 2 "--at: 'b' must be from -1.92 to 1.92, not '3'" \
        "$IMPINGE" view "$data/spindle.json" -o x.png --at b=3
    fails 2 "--at: the scene has no parameter 'b'; its parameters are: none" "$IMPINGE" view "$data/arm.json" -o x.png --at b=1
    fails 2 '--at must be a finite number' "$IMPINGE" view "$data/spindle.json" -o x.png --at b=1,1,2
    [ ! -e x.png ]
}

@test "what all angles of joints cost is measured" {
    run -0 "$IMPINGE" bench parameters --repeat 1 --max-pairs 20000 --json
    valid bench
    pairs() {
        jq -e --arg case "$1" --argjson most "$2" '.sets[0].cases[] | select(.case == $case).methods[0] |
            .verdicts.clear == 1 and .pairs.max <= $most' <<<"$output"
    }
    pairs '1 joint, c = 0.0001' 100
    pairs '2 joints, c = 0.1' 2000
    pairs '3 joints, c = 0.1' 20000
    pairs '4 joints, c = 0.4' 5000
    jq -e '[.sets[0].cases[] | select(.case | startswith("pairs of links")).methods[0].verdicts.clear] |
        .[0] == 45 and .[1] == 9 and .[2] >= 7' <<<"$output"
    jq -e '.sets[0].findings | .arm_seconds < 60 and .exponent_4_joints < 4' <<<"$output"
}
