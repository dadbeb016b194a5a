#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the README shows works as it stands.

load ../support/cli_helper

setup_file() {
    printf '#!/bin/sh\nexec "%s" "$@"\n' "$IMPINGE" >"$BATS_FILE_TMPDIR/impinge"
    chmod +x "$BATS_FILE_TMPDIR/impinge"
    export PATH="$BATS_FILE_TMPDIR:$PATH"
}

@test "the first pair of the README is answered" {
    pair=$(sed -n '/^    impinge pair/,/[^\\]$/p' "$top_srcdir/README.md")
    [ -n "$pair" ]
    run -0 bash -c "$pair --json"
    json '.verdict == "contact"'
}

@test "the scene of the README is solved" {
    sed -n '/^    { "time"/,/} \] }$/p' "$top_srcdir/README.md" >"$BATS_TEST_TMPDIR/scene.json"
    run -0 impinge solve "$BATS_TEST_TMPDIR/scene.json" --json
    json '.verdict == "contact" and .a.body == "ring" and .b.body == "ball"'
}

@test "the README's way to the types works" {
    run -0 impinge list
    run -0 impinge info torus
    [[ $output == *major_radius* ]]
}

@test "the README's pictures are what its commands draw" {
    grep -q '^#define HAVE_LIBPNG 1' "$top_builddir/config.h" || skip 'built without libpng'
    cd "$top_srcdir"
    local command name count=0
    while read -r command; do
        name=$(sed 's/.* -o \([^ ]*\).*/\1/' <<<"$command")
        (eval "${command/-o $name/-o $BATS_TEST_TMPDIR/$name}")
        [ "$(head -c 24 "tools/data/$name" | cksum)" = "$(head -c 24 "$BATS_TEST_TMPDIR/$name" | cksum)" ]
        [ "$(wc -c <"tools/data/$name")" -lt 150000 ]
        grep -qF "(tools/data/$name)" README.md
        count=$((count + 1))
    done < <(sed -n 's/^    \(impinge [a-z]* tools.data.* -o .*\)/\1/p' README.md)
    [ "$count" -eq 2 ]
}

@test "the README's Python answers" {
    [ "$PYTHON3" != no ] || skip "no python3 with numpy and pytest"
    has_sanitizers && skip "a library with AddressSanitizer needs a program with it"
    sed -n '/^    import impinge, numpy/,/^    print/s/^    //p' "$top_srcdir/README.md" >"$BATS_TEST_TMPDIR/program.py"
    export IMPINGE_LIBRARY=$top_builddir/.libs/libimpinge.so PYTHONPATH=$top_srcdir/sdk/python
    IMPINGE_PLUGIN_PATH=$top_builddir/plugins/.libs run -0 "$PYTHON3" -B "$BATS_TEST_TMPDIR/program.py"
    [[ $output == "Result(verdict='"* ]]
}

@test "the README's arm keeps its distance" {
    cd "$top_srcdir"
    run -0 impinge clearance tools/data/arm.json --require 2
    [[ ${lines[0]} == "holds: at least 2 (to within 1e-6 of it)" ]]
    grep -qF "    impinge clearance tools/data/arm.json --require 2" README.md
}

@test "the README's spiked balls recoil" {
    cd "$top_srcdir"
    run -0 impinge simulate -o "$BATS_TEST_TMPDIR/motion.json" tools/data/recoil.json
    [[ $output == "simulated from t = 0 to 3: "*" impacts"* ]]
    grep -qF "    impinge simulate -o motion.json tools/data/recoil.json " README.md
}
