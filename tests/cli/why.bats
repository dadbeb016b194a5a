#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge why: what is checked of a plugin file, in its order, and what was found.

load ../support/cli_helper

checks='file format class machine kind headers segments note abi'

@test "every check of a good plugin passes, in order" {
    run -0 "$IMPINGE" why "$top_builddir/plugins/.libs/sphere.so"
    [ "${lines[0]}" = "$top_builddir/plugins/.libs/sphere.so" ]
    [ "$(awk '$2 == "passed" { print $1 }' <<<"$output" | xargs)" = "$checks trial" ]
    [ "${lines[-1]}" = 'This file is accepted.' ]
}

@test "every plugin that is installed is taken" {
    local file
    for file in $("$IMPINGE" list --json | jq -r '.types[].file' | sort -u); do
        run -0 "$IMPINGE" why "$file" --json
        valid why
        json --arg file "$file" '.taken and .file == $file and all(.checks[]; .text != "")'
    done
}

@test "as JSON a refusal has the checks before it and those that were not reached" {
    echo 'no plugin' >text.so
    run -5 "$IMPINGE" why text.so --json
    valid why
    json '.taken | not'
    json '[.checks[].finding] | .[0] == "passed" and .[1] == "refused"
        and (.[2:] | all(. == "not reached"))'
    json --arg checks "$checks trial" '[.checks[].check] == ($checks | split(" "))'
    json '.checks | all((.text == "") == (.finding == "not reached"))'
}

@test "what is wrong inside is told by the check that found it" {
    run -5 "$IMPINGE" why "$top_builddir/tests/plugins/.libs/half_bad.so" --json
    valid why
    json '.checks[-1] | .check == "types" and .finding == "refused"
        and .text == "half_bad: create is NULL; only include, apply and net may be"'
    run -5 "$IMPINGE" why "$top_builddir/tests/plugins/.libs/note_disagrees.so" --json
    valid why
    json '.checks[-1] | .check == "entry" and .finding == "refused"'
}

@test "all that can be read is checked, past the first refusal" {
    cp "$top_builddir/tests/plugins/.libs/wrong_abi_major.so" p.so
    printf '\010' | dd of=p.so bs=1 seek=18 conv=notrunc status=none
    run -5 "$IMPINGE" why p.so --json
    valid why
    json '[.checks[] | select(.finding == "refused") | .check] == ["machine", "abi"]'
}

@test "a file that is not there is refused, whatever its name" {
    run -5 "$IMPINGE" why nowhere.so
    [[ $output == *'file '*'refused '*'No such file'*'This file is rejected.' ]]
    run -5 "$IMPINGE" why "" --json
    valid why
    run -5 "$IMPINGE" why $'odd\n\xff' --json
    valid why
}

@test "why wants one file" {
    fails 2 'why' "$IMPINGE" why
    fails 2 'why' "$IMPINGE" why one two
}
