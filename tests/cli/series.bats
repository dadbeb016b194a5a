#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge solve --each and --refine: more than one answer from one search.

load ../support/cli_helper

# a and b overlap at rest; c flies through both; d is far away.
four() {
    cat <<END | tr -d '\n'
{"bodies": [
{"name": "a", "surfaces": [{"type": "sphere", "center": [0,0.1,0]}]},
{"name": "b", "surfaces": [{"type": "sphere", "center": [1,0,0]}]},
{"name": "c", "surfaces": [{"type": "sphere", "center": [-4,0,0]}],
"maps": [{"type": "translate", "velocity": [4,0,0]}]},
{"name": "d", "surfaces": [{"type": "sphere", "center": [0,0,50]}]}],
"ignore": [["c", "d"]]}
END
}

@test "each pair of bodies in order of time, those that stay clear last" {
    four >four.json
    run -0 "$IMPINGE" solve four.json --each --json
    valid result
    [ "$(jq -r '[.bodies[], .verdict] | join(" ")' <<<"$output")" = \
        $'a b contact\na c contact\nb c contact\na d clear\nb d clear' ]
    [ "$(jq -c '.at_rest' <<<"$output" | tr '\n' ' ')" = "true false false false false " ]
    jq -s -e '[.[:3][].t] as $t | $t == ($t | sort)' <<<"$output"
    run -1 "$IMPINGE" solve four.json --each --exit-code
    [ "${lines[0]}" = "overlap at rest, all the time: a, b" ]
    [[ ${lines[1]} == "contact at t = 0.50"*": a, c" && ${lines[4]} == "clear from t = 0 to 1: b, d" ]]
}

@test "an answer is printed as soon as no other can come before it" {
    cat >slow.json <<'END'
{"gamma": 1e-9, "bodies": [
{"name": "left", "surfaces": [{"type": "sphere", "center": [-2,9,0]}],
"maps": [{"type": "translate", "velocity": [2,0,0]}], "group": ["two"]},
{"name": "right", "surfaces": [{"type": "sphere", "center": [1,9,0]}], "group": ["two"]},
{"name": "shell", "surfaces": [{"type": "sphere", "radius": 1.000000002}], "group": ["nested"]},
{"name": "grows", "surfaces": [{"type": "sphere"}],
"maps": [{"type": "scale", "factors": [[0.5], [0.5]]}], "group": ["nested"]}],
"ignore": [["two", "nested"]]}
END
    coproc env --default-signal=INT "$IMPINGE" solve slow.json --each --max-bytes 0 --max-pairs 0
    local pid=$COPROC_PID status=0 rest
    exec {answers}<&"${COPROC[0]}"
    read -r output <&"$answers" # before the end, which a lifetime would not see
    [[ $output == "contact at t = 0.49"*": left, right" ]]
    kill -INT "$pid"
    rest=$(cat <&"$answers")
    wait "$pid" || status=$?
    [ "$status" -eq 3 ]
    echo "$rest"
    [[ ${rest%%$'\n'*} == "undecided from t = "*": shell, grows" ]] # advice may follow
}

@test "what a budget leaves is undecided" {
    four >four.json
    run -3 "$IMPINGE" solve four.json --each --json --max-pairs 1
    valid result
    jq -s -e 'length == 5 and any(.verdict == "undecided" and .reason == "max-pairs") and
        all(.[3:][]; .verdict == "clear")' <<<"$output"
}

without_seconds() { sed -E 's/"seconds":[^,]*,//g'; }

@test "many bodies, deforming ones among them: the same bytes for any number of threads" {
    "$top_builddir"/tests/support/crowd_scene 60 1 >crowd.json
    for threads in 1 2 5; do
        "$IMPINGE" solve crowd.json --each --json --threads "$threads" >answers
        without_seconds <answers >"answers.$threads"
        cmp answers.1 "answers.$threads"
    done
    output=$(<answers)
    valid result
    jq -s -e 'length == 60 * 59 / 2 and (map(select(.verdict != "clear")) | length >= 5) and
        ([.[] | .verdict == "clear"] | . == sort) and ([.[] | .t_lower] | . == sort)' answers
}

@test "one search of many bodies: the same bytes for any number of threads" {
    "$top_builddir"/tests/support/crowd_scene 60 1 >crowd.json
    for threads in 1 2 5; do
        "$IMPINGE" solve crowd.json --json --threads "$threads" >answer
        "$IMPINGE" solve crowd.json --json --threads "$threads" --refine 1e-2,1e-4 >>answer
        without_seconds <answer >"answer.$threads"
        cmp answer.1 "answer.$threads"
    done
    jq -s -e 'length == 3 and all(.verdict == "contact" and .stats.pairs > 60)' answer
    "$IMPINGE" solve crowd.json --json | without_seconds >answer
    head -n 1 answer.1 | cmp - answer
}

@test "threads of a clearance are for --each" {
    scene >scene.json
    fails 2 "--threads belongs to --each" "$IMPINGE" clearance scene.json --threads 2
}

@test "the first body whose plugin fails is named, however many threads there are" {
    four | sed 's/"sphere", "center": \[1,0,0\]/"eval_nan_late"/' >four.json
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/eval_nan_late.so plugins
    for threads in 1 3; do
        run -5 --separate-stderr "$IMPINGE" solve four.json --each --threads "$threads" \
            --plugin-path plugins
        [ -z "$output" ]
        echo "$stderr" >"said.$threads"
        cmp said.1 "said.$threads"
    done
}

@test "finer and finer from one search" {
    run -0 "$IMPINGE" solve <(scene) --refine 1e-2,1e-4,1e-8 --json
    valid result
    jq -s -e 'map(.gamma) == [1e-2, 1e-4, 1e-8]' <<<"$output"
    jq -s -e 'all(.[]; .verdict == "contact" and .gap <= .gamma) and
        .[0].t < .[1].t and .[1].t < .[2].t and .[0].stats.pairs < .[2].stats.pairs' <<<"$output"
}

@test "what cannot be asked is refused" {
    scene >scene.json
    for wrong in 1e-2,1e-2 1e-3,1e-2 0 -1 1e-2, x 1e-2,,1e-3 nan; do
        fails 2 "--refine must be numbers above 0" "$IMPINGE" solve scene.json --refine "$wrong"
    done
    fails 2 "exclude each other" "$IMPINGE" solve scene.json --refine 1e-2 --each
    fails 2 "exclude each other" "$IMPINGE" solve scene.json --refine 1e-2 --gamma 1e-3
}

# spaced COUNT: a line of balls, neighbours far from each other.
spaced() {
    jq -nc --argjson n "$1" '{bodies: [range($n) | {surfaces: [{type: "sphere", center: [3 * ., 0, 0]}]}]}'
}

@test "pairs of bodies that a limit leaves out are one line with their count, and lines on request" {
    spaced 2000 >spaced.json
    run -3 "$IMPINGE" solve spaced.json --each --max-seconds 1e-9 --json
    [ "${#lines[@]}" -eq 1 ]
    valid result
    json '.not_listed == {clear: 0, not_examined: 1999000} and .reason == "max-seconds"'
    run -3 "$IMPINGE" solve spaced.json --each --max-seconds 1e-9
    [ "$output" = "not examined: 1999000 pairs of bodies (the time limit is reached); --list-all lists them" ]
    spaced 20 >few.json
    run -3 "$IMPINGE" solve few.json --each --max-seconds 1e-9 --list-all --json
    valid result
    [ "${#lines[@]}" -eq 190 ]
    jq -es 'all(.verdict == "undecided" and .reason == "max-seconds" and .t_lower == 0)' <<<"$output"
    fails 2 '--list-all belongs to --each' "$IMPINGE" solve few.json --list-all
}

@test "lines that take longer than the limit end, and say how many are left" {
    spaced 3000 >spaced.json
    "$IMPINGE" solve spaced.json --each --max-seconds 1 --threads 1 --json >out
    output=$(tail -n 1 out)
    valid result
    json '.not_listed.not_examined == 0 and .not_listed.clear > 0'
    [ $(($(wc -l <out) - 1 + $(jq .not_listed.clear <<<"$output"))) -eq 4498500 ]
}

@test "a list of all pairs ends a tenth and 0.1 s behind the limit, and says how many are left" {
    spaced 3000 >spaced.json
    run -3 bash -c '"$IMPINGE" solve spaced.json --each --list-all --max-seconds 1e-9 --threads 1 --json >out'
    output=$(tail -n 1 out)
    valid result
    json '.not_listed.clear == 0 and .not_listed.not_examined > 0 and .reason == "max-seconds"'
    [ $(($(wc -l <out) - 1 + $(jq .not_listed.not_examined <<<"$output"))) -eq 4498500 ]
    run -0 bash -c '"$IMPINGE" solve spaced.json --each --list-all --max-seconds 1e-9 --threads 1 | tail -n 1'
    [[ $output == 'not examined: '*' pairs of bodies (the time limit is reached); there was no time to list them' ]]
}

@test "a signal ends the output" {
    spaced 3000 >spaced.json
    mkfifo lines
    "$IMPINGE" solve spaced.json --each --json >lines &
    local pid=$! status=0
    exec 8<lines
    read -r line <&8
    kill -TERM "$pid"
    cat <&8 >rest
    wait "$pid" || status=$?
    tail -n 1 rest | jq -e '.reason == "cancelled" and .not_listed.clear > 0'
    [ "$(wc -l <rest)" -lt 1000000 ]
}
