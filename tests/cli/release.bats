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
    # These suites write caches, which clean must remove.
    local suites='tests/unit/test_alloc_failure tests/unit/test_registry tests/cli/cli_list.bats'
    make -s -C "$build" distcheck TESTS="$suites" DISTCHECK_CONFIGURE_FLAGS=CFLAGS=-O0 >log 2>&1 ||
        { tail -n 15 log; false; }
    [ "$(grep -c '^PASS: ' log)" -eq 3 ]
}

@test "the release holds every file of the repository" {
    git -C "$top_srcdir" ls-files >committed 2>/dev/null || skip "not a git repository"
    [ -s committed ] || skip "not a git repository"
    make -s -C "$build" dist
    tar tzf "$build"/impinge-*.tar.gz | sed 's|^[^/]*/||' | sort >released
    comm -23 <(sort committed) released >missing
    cat missing
    [ ! -s missing ]
}
