#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the README shows works as it stands.

load cli_helper

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
