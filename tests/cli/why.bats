#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge why: what is checked of a plugin file, in its order, and what was found.

load ../support/cli_helper

# printable: nothing that the last run printed has a control character, or the byte of one, in it.
printable() {
    ! LC_ALL=C grep -q '[[:cntrl:]]' <<<"$output$stderr" || { cat -v <<<"$output$stderr" && return 1; }
    ! grep -q $'\xc2\x9b' <<<"$output$stderr"
}

@test "names of files are printed with control characters escaped" {
    local evil=$'evil \e[31m\a\n\x7f\xc2\x9b \'\\.so' name where
    mkdir $'folder\e[7m'
    cd $'folder\e[7m'
    # shellcheck disable=SC2154 # top_builddir comes from the environment
    cp "$top_builddir/tests/plugins/.libs/kit.so" "$evil"
    cp "$top_builddir/tests/plugins/.libs/null_callback.so" $'bad\e]0;title\a.so'
    printf x >$'worse\r\x80.so'
    where='folder\x1b[7m/evil \x1b[31m\x07\n\x7f\xc2\x9b '"'\\.so"
    run -0 --separate-stderr "$IMPINGE" list --refused --plugin-path .
    printable
    [[ $output == *'/bad\x1b]0;title\x07.so: types: '* && $output == *'/worse\x0d\x80.so: '* ]]
    run -0 --separate-stderr "$IMPINGE" list --files --plugin-path .
    printable
    [[ $output == *"$where"* ]]
    run -0 --separate-stderr "$IMPINGE" why "$evil"
    printable
    [[ $output == 'evil \x1b[31m'* ]]
    run -0 --separate-stderr "$IMPINGE" info kit --plugin-path .
    printable
    [[ $output == *"$where"* ]]
    for name in *.so; do
        run --separate-stderr "$IMPINGE" check "./$name" --only exports
        printable
    done
    fails 4 'were left out, such as ' "$IMPINGE" pair nothing sphere --plugin-path .
    printable
    fails 4 'gone\x1b[31m' "$IMPINGE" solve $'gone\e[31m.json'
    run -0 --separate-stderr "$IMPINGE" list --json --plugin-path .
    printable
    [ "$(jq -j '.types[] | select(.name == "kit").file' <<<"$output" | od -c)" = "$(printf %s "$PWD/$evil" | od -c)" ]
    scene '"id": "\u007f\u009b31m\u00a0\u00c2",' >evil.jsonl
    run -0 --separate-stderr "$IMPINGE" batch evil.jsonl
    printable
    [[ $output == '{"id":"\u007f\u009b31m'$'\xc2\xa0\xc3\x82"'* ]]
    chmod 777 .
    run -0 --separate-stderr "$IMPINGE" pair "$left" "$right" --plugin-path .:$'none\e[1m'
    printable
    chmod 755 .
    cp "$top_builddir/tests/plugins/.libs/hostile.so" .
    "$IMPINGE" list --plugin-path . >/dev/null 2>&1
    HOSTILE='constructor crash' run -5 --separate-stderr "$IMPINGE" pair sphere sphere --plugin-path .
    printable
    [[ $stderr == *"crashed in the constructor of plugin '"*'folder\x1b[7m/hostile.so'"';"* ]]
}

checks='file format class machine kind headers segments tables note abi'

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
        and .text == "half_bad: create is NULL; only include, apply, net, rigid, span, distance, symmetry, tube, formula and write_formula may be"'
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
