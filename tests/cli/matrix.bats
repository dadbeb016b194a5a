#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge matrix: everything with everything.

load ../support/cli_helper

quick=(--max-pairs 3000 --gamma 1e-2)

# How many types of a sort are in force.
count() { "$IMPINGE" list --json | jq --arg sort "$1" '[.types[] | select(.kind == $sort
    and .shadowed_by == null)] | length'; }

@test "all installed types meet, under all maps, and none fails" {
    run -0 --separate-stderr "$IMPINGE" matrix "${quick[@]}"
    [ -z "$stderr" ]
    [ "${#lines[@]}" -eq $(($(count surface) + $(count map) + 1)) ]
    [[ ${lines[-1]} =~ ^all\ +[0-9]+\ contact\ +[0-9]+\ clear\ +[0-9]+\ undecided\ +0\ failed ]]
}

@test "as JSON there is a cell for each ordered pair, and for each surface under each map" {
    local surfaces maps
    surfaces=$(count surface) maps=$(count map)
    run -0 "$IMPINGE" matrix "${quick[@]}" --json
    valid matrix
    [ "${#lines[@]}" -eq 1 ]
    json '.failed == 0'
    json "(.cells | length) == $surfaces * ($surfaces + $maps)"
    json "[.cells[] | select(.a == .b)] | length == $surfaces"
    json 'all(.cells[]; .pairs <= 3000)'
}

@test "--all prints each pair as well" {
    run -0 "$IMPINGE" matrix "${quick[@]}" --all
    [ "$(grep -c ' | ' <<<"$output")" -eq $(($(count surface) * ($(count surface) + $(count map)))) ]
    [[ $output =~ (contact|clear)\ +[0-9]+\ pairs.*\ s\ \ sphere.*\|\ \ sphere ]]
}

# The failing ones, and the two at fault on each line.
failing() {
    mkdir plugins
    cp "$top_builddir/tests/plugins/.libs/include_inverted.so" plugins
}

@test "each failure names the two, and the others go on" {
    failing
    local surfaces maps
    surfaces=$(count surface) maps=$(count map)
    run -5 --separate-stderr "$IMPINGE" matrix "${quick[@]}" --plugin-path "$PWD/plugins"
    [[ ${stderr_lines[0]} == 'impinge: matrix: include_inverted  |  include_inverted: body '* ]]
    [ "${#stderr_lines[@]}" -eq $((2 * surfaces + 1 + maps)) ]
    grep -q "^impinge: matrix: include_inverted  |  sphere[^:]*: .*type 'include_inverted' over u" \
        <<<"$stderr"
    grep -qE '^sphere +.* 1 failed' <<<"$output"
    grep -qE '^! rotate +.* 1 failed' <<<"$output"
}

@test "as JSON a failure is a cell with an error" {
    failing
    run -5 --separate-stderr "$IMPINGE" matrix "${quick[@]}" --plugin-path "$PWD/plugins" --json
    valid matrix
    json '.failed > 3 and ([.cells[] | select(has("error"))] | length) == .failed'
    json 'all(.cells[] | select(has("error")); .error | contains("include_inverted"))'
}

@test "one that crashes ends it and leaves no half an answer" {
    mkdir plugins
    cp "$top_builddir/tests/plugins/.libs/eval_crashes.so" plugins
    run -5 --separate-stderr "$IMPINGE" matrix "${quick[@]}" --plugin-path "$PWD/plugins" --json
    [[ $stderr == "impinge: crashed in the eval of type 'eval_crashes'"* ]]
    json '(keys == ["error"]) and (.error | contains("eval_crashes"))'
}

@test "isolated, one that crashes costs its own cells only" {
    mkdir plugins
    cp "$top_builddir/tests/plugins/.libs/eval_crashes.so" plugins
    run -5 --separate-stderr "$IMPINGE" matrix "${quick[@]}" --plugin-path "$PWD/plugins" --json \
        --isolate eval_crashes
    valid matrix
    json '.failed > 0 and all(.cells[]; .error // "type eval_crashes" | contains("eval_crashes"))'
    json 'any(.cells[]; .a == "eval_crashes" and has("error"))'
}

@test "unasked, each pair of bodies is given so many pairs and no more" {
    run -0 timeout 60 "$IMPINGE" matrix --json
    valid matrix
    json 'all(.cells[]; .pairs <= 10010)'
}

@test "an undecided pair is no failure" {
    run -0 "$IMPINGE" matrix --max-pairs 1 --gamma 1e-9 --json
    valid matrix
    json 'any(.cells[]; .verdict == "undecided")'
    run -0 "$IMPINGE" matrix --max-pairs 1 --gamma 1e-9
    [[ ${lines[-2]} =~ ^all\ +[0-9]+\ contact\ +[0-9]+\ clear\ +[1-9][0-9]*\ undecided\ +0\ failed ]]
    [[ ${lines[-1]} == 'undecided: given up at the limit (--max-pairs'* ]]
}
