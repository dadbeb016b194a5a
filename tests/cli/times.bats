#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Which times are examined where nobody says so, and that every answer says from when to when it is.

load ../support/cli_helper

# A ball that comes from 10 to 4 at times 0 to 410, by a table; another that rests.
long='sphere ! translate file=long.csv'

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    printf '0,10,0,0\n410,4,0,0\n' >long.csv
    printf '5,10,0,0\n15,4,0,0\n' >late.csv
    printf '10,0,10,0\n20,0,4,0\n' >later.csv
    printf '30,0,10,0\n40,0,4,0\n' >last.csv
}

# file NAME...: a scene of a ball at rest and one for each table.
tables() {
    local name rows=
    for name in "$@"; do
        rows+=", {\"surfaces\": [{\"type\": \"sphere\"}],
            \"maps\": [{\"type\": \"translate\", \"file\": \"$name.csv\"${hold-}}]}"
    done
    tr -d '\n' <<<"{${keys-} \"bodies\": [{\"name\": \"rest\", \"surfaces\": [{\"type\": \"sphere\"}]}$rows]}"
    echo
}

@test "a table is examined from its first time to its last, by every question" {
    tables long >long.json
    for verb in solve "solve --each" clearance "clearance --each" "clearance --require 3"; do
        # shellcheck disable=SC2086 # words
        run "$IMPINGE" $verb long.json --json
        [ "$status" -lt 2 ]
        valid "$(cut -d' ' -f1 <<<"$verb" | sed s/solve/result/)"
        json '.time == [0, 410]'
    done
    json '.verdict == "violated" and .t_violated > 300'
    run -0 "$IMPINGE" pair "$long" sphere --json
    valid result
    json '.time == [0, 410]'
    run -0 "$IMPINGE" batch long.json
    json '.time == [0, 410]'
    run -0 "$IMPINGE" clearance long.json --profile 2 --json
    tail -1 <<<"$output" | jq -e '.time == [0, 410] and [.slices[].t1] == [205, 410]'
    run -0 "$IMPINGE" clearance long.json --each --json
    json 'all(.pairs[]; .time == [0, 410])'
    run -0 "$IMPINGE" solve long.json --refine 1e-3,1e-6 --json
    json '.time == [0, 410]'
}

@test "each answer for people says from when to when it is" {
    tables long >long.json
    for verb in solve clearance "clearance --require 1" "clearance --require 3" "clearance --each"; do
        # shellcheck disable=SC2086 # words
        run "$IMPINGE" $verb long.json
        grep -qx '  time     from 0 to 410' <<<"$output"
    done
    run -0 "$IMPINGE" solve --each long.json
    [[ ${lines[0]} == "clear from t = 0 to 410: "* ]]
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0'
    grep -qx '  time     from 0 to 1' <<<"$output"
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0' --time 0.1,0.7
    grep -qx '  time     from 0.1 to 0.7' <<<"$output"
}

@test "several tables are examined while all of them tell where things are" {
    tables late later >both.json
    run -0 "$IMPINGE" solve both.json --json
    json '.time == [10, 15]'
    run -0 "$IMPINGE" solve both.json --json --time 11,12
    json '.time == [11, 12]'
    keys='"time": [12, 13],' tables late later >told.json
    run -0 "$IMPINGE" solve told.json --json
    json '.time == [12, 13]'
}

@test "tables that share no time are an error that names both" {
    tables late last >apart.json
    for verb in solve "solve --each" clearance "view -o x.png" "plot -o x.png"; do
        # shellcheck disable=SC2086 # words
        fails 4 "'translate' is defined from t = 30 on" "$IMPINGE" $verb apart.json
        [[ $stderr == *"'translate' of body 'body1' only up to t = 15"*'"time"'*"--time"* ]]
    done
    run -4 --separate-stderr "$IMPINGE" batch apart.json
    json '.error | contains("up to t = 15")'
    fails 4 "is defined from t = 30 to 40 only" "$IMPINGE" solve apart.json --time 6,7
    jq -c '.ignore = [["body1", "body2"], ["rest", "body2"]]' apart.json >ignored.json
    run -0 "$IMPINGE" solve ignored.json --time 6,7 --json
    json '.time == [6, 7]'
}

@test "tables that hold at their ends are examined from the first time of any to the last" {
    hold=', "hold": true' tables late last >hold.json
    run -0 "$IMPINGE" solve hold.json --json
    json '.time == [5, 40]'
    run -0 "$IMPINGE" solve hold.json --json --isolate all
    json '.time == [5, 40]'
    jq -c '.bodies[2].maps[0].hold = false' hold.json >mixed.json
    run -0 "$IMPINGE" solve mixed.json --json
    json '.time == [30, 40]'
}

@test "keyframes, trajectories and surfaces that exist for a while have a span, too" {
    local positions='positions=[[9,0,0],[8,0,0]]'
    run -0 "$IMPINGE" pair sphere "sphere ! keyframes times=2,4 $positions" --json
    json '.time == [2, 4]'
    run -0 "$IMPINGE" pair sphere "sphere ! keyframes times=2,4 $positions hold=true" --json
    json '.time == [2, 4]'
    run -0 "$IMPINGE" pair sphere "sphere ! trajectory times=2,4 $positions" --json
    json '.time == [2, 4]'
    run -0 "$IMPINGE" pair sphere 'formula x=u y=v z=5 time=5,6' --json
    json '.time == [5, 6] and .verdict == "clear" and .reason == null'
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0 ! rotate rate=2' --json
    json '.time == [0, 1]'
    run -0 "$IMPINGE" pair sphere "sphere center=3,0,0 ! rotate times=3,4,5 angles=0,1,2" --json
    json '.time == [3, 5]'
}

@test "a simulation lasts as long as the tables that bodies are moved by" {
    cat >fall.json <<'END'
{"gravity": [0, 0, -1], "bodies": [
{"name": "ball", "surfaces": [{"type": "sphere", "center": [0, 0, 9]}], "mass": 1},
{"name": "lift", "surfaces": [{"type": "sphere"}],
"maps": [{"type": "translate", "times": [0, 2.5], "positions": [[0, 0, 0], [0, 0, 1]]}]}]}
END
    run -0 "$IMPINGE" simulate fall.json -o motion.json --json
    json '.time == [0, 2.5]'
    jq -e '.time == [0, 2.5]' motion.json
}

@test "a recorded answer is drawn over the times that it is about" {
    tables long >long.json
    "$IMPINGE" solve long.json --json --time 3,70 >answer.json
    run -0 "$IMPINGE" view answer.json -o view.pvd --frames 2
    [ "$(grep -o 'timestep="[^"]*"' view.pvd | tr '\n' ' ')" = 'timestep="3" timestep="70" ' ]
    run -0 "$IMPINGE" view answer.json -o view.pvd --frames 2 --time 4,5
    [ "$(grep -o 'timestep="[^"]*"' view.pvd | tr '\n' ' ')" = 'timestep="4" timestep="5" ' ]
}

@test "--max-seconds holds while the times at which bodies exist together are compared" {
    jq -nc '{time: [-1, 2], bodies: [range(100) | {surfaces: [{type: "formula", x: "u", y: "v", z: "0",
        domain: [[0, 1], [0, 1]], time: [. / 100, (. + 1.5) / 100]}]}]}' >brief.json
    run -0 "$IMPINGE" solve brief.json --json
    json '.verdict == "contact" and .t_examined[0] > 0 and .t_examined[1] < 1'
    # Not all of 4950 pairs were looked at, so that nothing is known of the times.
    for verb in solve clearance; do
        run -3 "$IMPINGE" $verb brief.json --max-seconds 1e-9 --json
        json '.reason == "max-seconds"'
        [ $verb = clearance ] || json '.t_examined == [-1, 2] and .t_lower == -1'
    done
}
