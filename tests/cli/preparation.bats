#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# tools/test and tools/prepare: a miscount would hide failures, a wrong installation annoy.

bats_require_minimum_version 1.5.0

setup() {
    # shellcheck source=tools/test
    source "$top_srcdir/tools/test"
    log=$BATS_TEST_TMPDIR/log
    cd "$BATS_TEST_TMPDIR"
}

# --- Counting -------------------------------------------------------------------------------

@test "a suite of Check counts its single tests, failures and errors apart from the rest" {
    echo '75%: Checks: 12, Failures: 2, Errors: 1' >"$log"
    [ "$(count_log "$log" FAIL)" = "9 3" ]
}

@test "the runners of one suite add up" {
    printf '100%%: Checks: 12, Failures: 0, Errors: 0\n100%%: Checks: 3, Failures: 0, Errors: 0\n' >"$log"
    [ "$(count_log "$log" PASS)" = "15 0" ]
}

@test "a file of bats counts passed and failed sentences, and no skipped ones" {
    printf 'ok 1 it works\nnot ok 2 it does not\n# ok 7\nok 3 it may # skip no clang\n' >"$log"
    [ "$(count_log "$log" FAIL)" = "1 1" ]
}

@test "a suite that dies before its summary counts as failed" {
    echo 'Segmentation fault' >"$log"
    [ "$(count_log "$log" FAIL)" = "0 1" ]
}

@test "a suite that passes all tests and fails afterwards counts as failed" {
    printf '100%%: Checks: 2, Failures: 0, Errors: 0\nLeakSanitizer: detected memory leaks\n' >"$log"
    [ "$(count_log "$log" FAIL)" = "2 1" ]
}

@test "a suite that tells of no test counts as failed" {
    : >"$log"
    [ "$(count_log "$log" PASS)" = "0 1" ]
}

@test "a file of bats whose tests are all skipped is no failure" {
    echo 'ok 1 it may # skip no clang' >"$log"
    [ "$(count_log "$log" PASS)" = "0 0" ]
}

@test "a suite that cannot run here counts as skipped" {
    echo 'skipped: localedef cannot make a locale here' >"$log"
    [ "$(count_log "$log" SKIP)" = "0 0" ]
}

@test "reasons of skipped tests are those of bats, or of a suite as a whole" {
    printf 'ok 1 it works\nok 2 it may # skip no clang\nok 3 it might in 2sec # skip\n' >"$log"
    [ "$(reasons_of_log "$log" PASS)" = $'no clang\nno reason given' ]
    printf 'skipped: localedef cannot make a locale here\n# took 0 s (...)\n' >"$log"
    [ "$(reasons_of_log "$log" SKIP)" = 'localedef cannot make a locale here' ]
    echo '100%: Checks: 12, Failures: 0, Errors: 0' >"$log"
    [ -z "$(reasons_of_log "$log" PASS)" ]
}

@test "a run ends with the reasons of what was skipped, counted, and with what passed and failed" {
    mkdir -p build/tests/cli
    printf 'ok 1 a\nok 2 b # skip no clang\nok 3 c # skip no clang\nok 4 d # skip no npm\n' >build/tests/cli/x.log
    echo ':global-test-result: PASS' >build/tests/cli/x.trs
    echo 'SKIP: tests/unit/test_query (Check not found)' >build/check.log
    count_all build
    run -0 --separate-stderr finish
    echo "$output"
    [ "$output" = '4 skipped:
      2 no clang
      1 Check not found
      1 no npm
1 passed, 0 failed' ]
}

@test "no test at all is a failure" {
    run -1 finish
    [ "${lines[-1]}" = "0 passed, 0 failed" ]
}

@test "each suite is shown with its number, its result and how long it took" {
    mkdir -p tests/cli
    printf 'ok 1 a\n# took 12 s (7 s of processors, 1 s of the system)\nPASS tests/cli/x.bats (exit status: 0)\n' \
        >tests/cli/x.log
    printf 'make: x\nPASS: tests/cli/x.bats\nFAIL: tests/unit/test_y\n# PASS:  1\n' >made
    [ "$(show_progress . 10 <made)" = '[ 1/10] PASS: tests/cli/x.bats, 12 s
[ 2/10] FAIL: tests/unit/test_y' ]
}

@test "a suite keeps its status, and its log ends with the time it took" {
    run -7 "$top_srcdir/tests/support/timed" bash -c 'echo hello; exit 7'
    [[ ${lines[0]} == hello && ${lines[-1]} =~ ^'# took '[0-9]+' s (' ]]
}

# --- Options ----------------------------------------------------------------------------------

@test "help comes at once, and what is no option is refused with the usage, before anything is built" {
    local script
    # No tool is in reach by which they could install or build.
    mkdir tools && ln -s "$(command -v bash)" "$(command -v dirname)" "$(command -v env)" tools
    for script in tools/test tools/demo tests/distributions; do
        run -0 --separate-stderr env PATH="$PWD/tools" "$top_srcdir/$script" --help
        [[ ${lines[0]} == "usage: $script "* && -z $stderr ]]
        [ -z "$(awk 'length > 80' <<<"$output")" ]
        run -2 --separate-stderr env PATH="$PWD/tools" "$top_srcdir/$script" --helpp
        [[ -z $output && ${stderr_lines[0]} == "$script: got '--helpp', must be "* ]]
        [[ ${stderr_lines[1]} == "usage: $script "* ]]
    done
}

# --- Installing -------------------------------------------------------------------------------

@test "what is there is not installed" {
    apt_get() { echo "apt-get $*"; }
    run -0 install_missing 'command bash bash
header stdlib.h libc6-dev
library check check'
    [ -z "$output" ]
}

@test "what is missing is installed under its package's name, and nothing else" {
    apt_get() { echo "apt-get $*" >>called; }
    may_install() { true; }
    top=$PWD
    run -0 --separate-stderr install_missing 'command bash bash
command no-such-command package-of-command
library no-such-library package-of-library'
    [ "$(<called)" = 'apt-get update
apt-get install --no-install-recommends package-of-command package-of-library' ]
    # shellcheck disable=SC2154 # set by run
    [[ ${stderr_lines[1]} == 'Installing package-of-command package-of-library ... '[0-9]*' s' ]]
}

@test "who is neither root nor has sudo is told what to install" {
    id() { echo 1000; }
    have_command() { [ "$1" = apt-get ]; }
    run -1 may_install check bats
    [[ $output == *"neither root nor is there sudo"*"apt-get install check bats"* ]]
}

@test "where there is no apt-get the missing packages are named" {
    have_command() { false; }
    run -1 may_install check bats
    [[ $output == *"no apt-get here to install it: check bats"* ]]
}

@test "sudo that asks for a password without a terminal is told of, not waited for" {
    id() { echo 1000; }
    have_command() { true; }
    sudo() { false; }
    run -1 may_install check </dev/null
    [[ $output == *"sudo wants a password and there is no terminal"* ]]
}

@test "a step that fails shows the end of its log" {
    run -1 step 'Trying it' "$PWD/log" bash -c 'seq 100; exit 3'
    [[ ${lines[0]} == 'Trying it ... failed' && ${lines[-2]} == 100 && ${lines[-1]} == *"all of it in $PWD/log"* ]]
    [ "${#lines[@]}" -eq 42 ]
}

# --- Building ---------------------------------------------------------------------------------

# A project of one file, with `top` in its place: as much as build_in needs of ours.
small_project() {
    top=$BATS_TEST_TMPDIR/project
    mkdir -p "$top/build-aux" && touch "$top/build-aux/ltmain.sh"
    cat >"$top/configure.ac" <<'END'
AC_INIT([small], [1])
AC_CONFIG_SRCDIR([main.c])
AC_CONFIG_AUX_DIR([build-aux])
AM_INIT_AUTOMAKE([foreign])
AC_PROG_CC
AC_CONFIG_FILES([Makefile])
AC_OUTPUT
END
    printf 'bin_PROGRAMS = main\nmain_SOURCES = main.c\n' >"$top/Makefile.am"
    echo 'int main(void) { return 0; }' >"$top/main.c"
    autoreconf -fi "$top" 2>/dev/null
}

@test "a build works beside a source folder that is itself configured and built" {
    unset MAKEFLAGS MFLAGS
    small_project
    build_in demo
    (cd "$top" && ./configure -q && make -s main)
    build_in test
    "$top/build/test/main"
    echo 'int main(void) { return 7; }' >"$top/main.c"
    build_in demo
    run -7 "$top/build/demo/main"
}

@test "a build is configured again where its options differ or a package was installed, else not" {
    unset MAKEFLAGS MFLAGS
    small_project
    run -0 build_in demo
    [[ $output == *Configuring* ]]
    run -0 build_in demo
    [[ $output != *Configuring* ]]
    run -0 build_in demo CFLAGS=-O1
    [[ $output == *Configuring* ]]
    installed=' check' run -0 build_in demo CFLAGS=-O1
    [[ $output == *Configuring* ]]
    run -0 build_in demo CFLAGS=-O1
    [[ $output != *Configuring* ]]
}

# --- Coverage ---------------------------------------------------------------------------------

@test "coverage says of lines that were not run in which function they are, and why" {
    mkdir -p "$BATS_TEST_TMPDIR/tools" && cd "$BATS_TEST_TMPDIR"
    printf '# FILE KIND\n= child ends by SIGKILL\ncore/a.c:serve child\n' >tools/coverage.gaps
    line() { echo "{\"line_number\": $1, \"count\": $2, \"function_name\": \"$3\", \"branches\": [{\"count\": $2}]}"; }
    echo "{\"files\": [{\"file\": \"$PWD/core/a.c\", \"lines\": [$(line 1 7 ask), $(line 2 0 ask),
        $(line 5 0 serve), $(line 6 0 serve)]}]}" | tr -d '\n' >counts
    run -0 python3 "$top_srcdir/tools/coverage.py" . -m <counts
    echo "$output"
    [ "${lines[2]}" = '    not run: ask 2 (unexplained)' ]
    [ "${lines[3]}" = '    not run: serve 5-6 (child)' ]
    [[ ${lines[4]} == 'core/ in all '*' 1 of     4   25.0 % '*' 1 of     4   25.0 %' ]]
    [ "${lines[6]}" = '    2 lines not run, child: ends by SIGKILL' ]
}
