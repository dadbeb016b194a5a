# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the suites of `impinge check` share.

load ../support/cli_helper

liars=$top_builddir/tests/plugins/.libs

# exposes CHECK LIAR TEXT: that check of the liar fails, with that text, and can be replayed.
exposes() {
    run -6 "$IMPINGE" check "$liars/$2.so" --only "$1"
    echo "$output"
    [[ $output == *"FAIL  $1 "*"$3"*"again: impinge check "*" --seed 1 --only $1"* ]]
}

# blamed FILE TYPE [ARG]...: a type of mistakes_FILE.so, which has failed.
blamed() {
    ln -sf "$liars/mistakes_$1.so" .
    run -6 "$IMPINGE" check "$2" --plugin-path . "${@:3}"
    echo "$output"
}

# shows CHECK FILE TYPE TEXT [ARG]...: that check fails with that text.
shows() {
    blamed "$2" "$3" --only "$1" "${@:5}"
    [[ $output == *"FAIL  $1 "*"$4"* ]]
}

# missed FILE [ARG]...: the types of mistakes_FILE.so in which nothing is found.
missed() {
    "$IMPINGE" check "$liars/mistakes_$1.so" --json "${@:2}" >report || [ $? -eq 6 ]
    jq -r '.types[].name' report >>seen
    jq -r '.types[] | select(all(.checks[]; .verdict == "pass" or .verdict == "skip")) | .name' report
}
