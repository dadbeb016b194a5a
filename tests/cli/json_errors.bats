#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# With --json every verb tells what failed on standard output, too: one object, {"error": text}.

load ../support/cli_helper

# The verbs that take --json, from the help.
verbs_with_json() {
    local verb
    "$IMPINGE" help | sed -n 's/^  \([a-z]*\) .*/\1/p' | sort -u | while read -r verb; do
        ! "$IMPINGE" help "$verb" | grep -q -e '--json' || echo "$verb"
    done
}

# tells STATUS COMMAND...: ends with that status; the last line on standard output is the error that is
# the first on standard error.
tells() {
    run "-$1" --separate-stderr "${@:2}"
    echo "${*:2}: $output / $stderr"
    output=${lines[-1]}
    valid error
    [[ "${stderr_lines[0]}" == "impinge: "*"$(jq -r .error <<<"$output")" ]]
}

@test "a usage error is told by every verb, wherever --json stands" {
    local verb count=0
    for verb in $(verbs_with_json); do
        tells 2 "$IMPINGE" "$verb" --no-such-option --json
        tells 2 "$IMPINGE" "$verb" --json --no-such-option
        count=$((count + 1))
    done
    [ "$count" -ge 12 ]
    tells 2 "$IMPINGE" --json no-such-verb
    tells 2 "$IMPINGE" --json
}

@test "a file that is not there is told by every verb that reads one" {
    local verb
    for verb in solve clearance plot batch; do
        tells 4 "$IMPINGE" "$verb" nowhere.json --json
    done
    tells 4 "$IMPINGE" view nowhere.json -o x.svg --json
    tells 4 "$IMPINGE" simulate nowhere.json -o x.json --json
    tells 4 "$IMPINGE" solve nowhere.json --each --json
    tells 4 "$IMPINGE" clearance nowhere.json --each --json
    tells 4 "$IMPINGE" batch "$BATS_TEST_FILENAME" --resume no/where --json
}

@test "a type that is not there, and standard input that is no scene, are told" {
    for verb in pair clearance plot; do tells 4 "$IMPINGE" "$verb" no-such-type sphere --json; done
    tells 4 "$IMPINGE" view no-such-type sphere -o x.svg --json
    for verb in info check; do tells 4 "$IMPINGE" "$verb" no-such-type --json; done
    for verb in solve clearance plot; do tells 4 "$IMPINGE" "$verb" - --json <<<'{"bodies": 3}'; done
    tells 4 "$IMPINGE" view - -o x.svg --json <<<'{"bodies": 3}'
    tells 4 "$IMPINGE" simulate - -o x.json --json <<<'{"bodies": 3}'
}

@test "what a plugin does wrong is told, also where it crashes" {
    local type verb more
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/{eval_nan_late,eval_crashes}.so plugins
    for type in eval_nan_late eval_crashes; do
        for verb in pair clearance 'plot -o x.svg' 'view -o x.svg' 'pair --isolate all'; do
            [[ $type == eval_crashes ]] || [[ $verb == pair* ]] || continue
            # shellcheck disable=SC2086 # options are words
            tells 5 "$IMPINGE" $verb "$type" sphere --plugin-path plugins --json
        done
    done
}

@test "without --json standard output stays empty" {
    fails 4 'nowhere.json: ' "$IMPINGE" clearance nowhere.json
    fails 2 'unknown option' "$IMPINGE" solve --no-such-option
}

@test "lines of a batch that cannot be answered are in their places, and not told twice" {
    run -4 --separate-stderr "$IMPINGE" batch - --json <<<'{"id": 1}'
    [ "${#lines[@]}" -eq 1 ]
    json '.id == 1 and .line == 1 and has("error")'
}

@test "an output that is resumed gets no error among its answers" {
    { scene '"id": 1,' && echo '{"id": 2}'; } >scenes.jsonl
    run -4 "$IMPINGE" batch scenes.jsonl --resume out --json
    [ "$(wc -l <out)" -eq 2 ]
}
