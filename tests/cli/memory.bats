#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The real command while allocations fail, one or all from one on: each run gives exactly the usual
# answer with the usual status, or ends with another status and a reason, and never part of a JSON
# line.

load ../support/cli_helper

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    ! has_sanitizers || skip 'the sanitizers have an allocator of their own'
    # shellcheck disable=SC2154 # top_builddir comes from the environment
    preload=$top_builddir/tests/support/.libs/fail_allocation.so
    command=$top_builddir/tools/.libs/impinge # the program itself, not libtool's script
    plugins=$PWD/plugins
    [ -x "$command" ] || skip 'the command is not linked with shared libraries'
    mkdir plugins
    ln -s "$top_builddir"/plugins/.libs/{sphere,translate,bezier}.so plugins
    scene >scene.json
    { scene '"id": 1,' && scene '"id": 2,'; } >two.jsonl
    export XDG_CACHE_HOME=$PWD/cache LD_LIBRARY_PATH=$top_builddir/.libs
    "$command" list --plugin-path plugins >/dev/null 2>&1 # from now on nothing is tried out
}

# What differs from run to run.
lasting() { sed -e 's/"seconds":[-0-9.e+]*/"seconds":0/g' -e '/^  cost /d' "$1"; }

# is_refused STATUS: what is left of a run that did not give the usual answer.
is_refused() {
    [ "$1" -gt 0 ] && [ "$1" -lt 124 ] || return 1
    [ -s errors ] || [ -s answer ] || return 1
    [[ ! -s answer || $(head -c 1 answer) != '{' ]] || jq -e . answer >/dev/null
}

# under_failures ARG...: the command, with each of some allocations failing, once and for good: one in
# thirteen parts of them, and the last twenty, when the answer is written.
under_failures() {
    local usual=0 count number mode status runs=0
    "$command" "$@" >answer 2>errors || usual=$?
    lasting answer >wanted
    COUNT_ALLOCATIONS=$PWD/count LD_PRELOAD=$preload "$command" "$@" >/dev/null 2>&1 || :
    count=$(<count)
    [ "$count" -gt 40 ]
    for number in $(seq 1 $((count / 13 + 1)) "$count") $(seq $((count - 20)) "$count"); do
        for mode in '' -; do
            status=0
            FAIL_ALLOCATION=$number$mode LD_PRELOAD=$preload \
                timeout 60 "$command" "$@" >answer 2>errors || status=$?
            runs=$((runs + 1))
            [ "$status" -ne "$usual" ] || ! lasting answer | cmp -s - wanted || continue
            is_refused "$status" || {
                echo "allocation $number$mode of $count: status $status" && head -c 2000 answer errors
                return 1
            }
        done
    done
    echo "$runs runs"
}

@test "pair answers as usual or says why not, whatever allocation fails" {
    under_failures pair "$left" "$right" --json --plugin-path "$plugins"
    under_failures pair "$left" "$right" --plugin-path "$plugins"
}

@test "solve answers as usual or says why not, whatever allocation fails" {
    under_failures solve scene.json --json --plugin-path "$plugins"
}

@test "batch answers as usual or says why not, whatever allocation fails" {
    under_failures batch two.jsonl --threads 1 --plugin-path "$plugins"
}

@test "clearance answers as usual or says why not, whatever allocation fails" {
    under_failures clearance scene.json --json --plugin-path "$plugins"
}

@test "list answers as usual or says why not, whatever allocation fails" {
    under_failures list --json --plugin-path "$plugins"
}

@test "why answers as usual or says why not, whatever allocation fails" {
    under_failures why plugins/sphere.so --json
    under_failures why plugins/sphere.so
}

@test "check answers as usual or says why not, whatever allocation fails" {
    under_failures check plugins/sphere.so --only finite --json
}

# Jansson may leave a key out of a text and report success.
keys() { grep -ao '"[A-Za-z_]*":' "$1" | sort | uniq -c; }

# Where memory fails the curve of a page may know less, as null: its keys are all there.
@test "view writes a whole page or file, or says why not, whatever allocation fails" {
    local format count number status
    for format in html glb; do
        local view=("$command" view scene.json --format "$format" -o - --plugin-path "$plugins")
        "${view[@]}" >answer 2>errors
        keys answer >wanted
        COUNT_ALLOCATIONS=$PWD/count LD_PRELOAD=$preload "${view[@]}" >/dev/null 2>&1
        count=$(<count)
        for number in $(seq 1 $((count / 9 + 1)) "$count") $(seq $((count - 30)) 2 "$count"); do
            status=0
            FAIL_ALLOCATION=$number LD_PRELOAD=$preload "${view[@]}" >answer 2>errors || status=$?
            echo "$format: allocation $number of $count: status $status"
            [ "$status" -eq 0 ] || is_refused "$status"
            [ "$status" -ne 0 ] || keys answer | cmp - wanted
        done
    done
}
