#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The release, made by the build that tests/local.mk installs.

bats_require_minimum_version 1.5.0

setup_file() {
    unset MAKEFLAGS MFLAGS DESTDIR # of the make that runs us
    export build=$top_builddir/tests/installed/build
}

setup() { cd "$BATS_TEST_TMPDIR"; }

# A distcheck that fails leaves its copy of the sources write-protected.
teardown_file() {
    chmod -R u+w "$build"
}

@test "the release builds, installs and uninstalls from a source folder that cannot be written" {
    # These suites write caches, which clean must remove. They load none of the faulty plugins.
    local suites='tests/unit/test_query tests/cli/cli_list.bats'
    # bats exports functions, which dash would keep from the bats that distcheck runs.
    # What configure has found for that build, the same compiler and flags as here, is not looked for again.
    cp "$build/config.cache" .
    make -s -j2 -C "$build" distcheck SHELL="$BASH" TESTS="$suites" check_PROGRAMS="${suites% *}" check_LTLIBRARIES= \
        DISTCHECK_CONFIGURE_FLAGS="CC='$CC' CFLAGS=-O0 --cache-file=$PWD/config.cache" >log 2>&1 ||
        { tail -n 15 log; false; }
    [ "$(grep -c '^PASS: ' log)" -eq 2 ]
    cp "$build"/impinge-*.tar.gz "$BATS_FILE_TMPDIR/first.tar.gz"
}

@test "the release holds every file of the repository" {
    git -C "$top_srcdir" ls-files >committed 2>/dev/null || skip "not a git repository"
    [ -s committed ] || skip "not a git repository"
    (umask 077 && make -s -C "$build" dist)
    cmp "$build"/impinge-*.tar.gz "$BATS_FILE_TMPDIR/first.tar.gz" # the bytes that distcheck made
    tar tzf "$build"/impinge-*.tar.gz | sed 's|^[^/]*/||' | sort >released
    comm -23 <(sort committed) released >missing
    cat missing
    [ ! -s missing ]
}

@test "bench --tune tells what other values of a constant cost" {
    make -s -C "$build" tools/impinge-tunable CFLAGS=-O0 >log 2>&1 || { tail -n 15 log; false; }
    local tunable=$build/tools/impinge-tunable
    "$tunable" bench tori --tune TUNING_GJK_GAP >table 2>/dev/null
    # The usual value, which takes as many pairs as the installed command, half of it, half-way to 1.
    [ "$(awk '$1 == "tori" { print $2 }' table | paste -sd,)" = 0.7,0.35,0.85 ]
    pairs_of() { # SET
        "$IMPINGE" bench "$1" --method models --repeat 1 --json |
            jq '[.sets[].cases[] | .scenes * .methods[0].pairs.mean] | add'
    }
    pairs=$(pairs_of tori)
    [ "$(awk '$2 == 0.7 { print $3 }' table)" = "$pairs" ]
    [ "$(awk '$2 == 0.35 { print $3 }' table)" -gt "$pairs" ]

    # Along the lines of tori one step is as good as 20.
    "$tunable" bench rates --tune TUNING_GJK_STEPS=20,1 >table 2>/dev/null
    pairs=$(pairs_of rates)
    [ "$(awk '$2 == 20 { print $3 }' table)" = "$pairs" ]
    [ "$(awk '$2 == 1 { print $3 }' table)" -gt "$pairs" ]
    run -2 "$tunable" bench --tune TUNING_GJK_STEP
    [[ $output == *"did you mean 'TUNING_GJK_STEPS'?"* ]]
    local value
    for value in 0 -1 1.5 nan 1e10 x 1,,2; do
        run -2 "$tunable" bench tori --tune "TUNING_GJK_STEPS=$value"
        [[ $output == *"must be whole numbers from 1 to"* ]]
    done
    run -2 "$tunable" bench tori --tune TUNING_GJK_GAP=0
    [[ $output == *"must be numbers above 0 and up to"* ]]
}
