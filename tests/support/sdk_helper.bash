# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The SDK as a newcomer has it: Impinge is installed, its sources and its build are far away. What
# the command, the guide and the examples say is done here as it stands.

bats_require_minimum_version 1.5.0

setup_file() {
    unset MAKEFLAGS MFLAGS DESTDIR IMPINGE XDG_DATA_HOME CPPFLAGS CFLAGS CXXFLAGS LDFLAGS LD_LIBRARY_PATH
    [ ! -d ~/.rustup ] || export RUSTUP_HOME=${RUSTUP_HOME-~/.rustup} # where rustc finds itself
    export prefix=$top_builddir/tests/installed/prefix HOME=$BATS_FILE_TMPDIR/home
    mkdir "$HOME"
    export PATH=$prefix/bin:$PATH PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    export ACLOCAL_PATH=$prefix/share/aclocal

    # configure of all projects below remembers what it found out about this machine.
    echo "cache_file=$BATS_FILE_TMPDIR/config.cache" >"$BATS_FILE_TMPDIR/config.site"
    export CONFIG_SITE=$BATS_FILE_TMPDIR/config.site
    user=$HOME/.local/share/impinge/1
    export user
}

setup() {
    mkdir "$BATS_TEST_TMPDIR/work"
    cd "$BATS_TEST_TMPDIR/work"
    wobble=$BATS_FILE_TMPDIR/wobble
}

teardown() { rm -rf "$user"; }

# What is compiled only to be loaded need not be fast.
hurry() { export CFLAGS=-O0; }

# fails STATUS TEXT COMMAND...: that status, and a complaint in the last line that holds the text.
fails() {
    local status=$1 text=$2
    shift 2
    run "-$status" --separate-stderr "$@"
    # shellcheck disable=SC2154 # set by run
    echo "$stderr"
    [[ ${stderr_lines[-1]} == "impinge: "*"$text"* ]]
}

# has_verb NAME
has_verb() { impinge help "$1" >/dev/null 2>&1; }

# Runs each line of standard input in this shell, up to the first that fails.
run_commands() {
    local command
    while read -r command; do
        if [[ $command == "impinge check "* ]] && ! has_verb check; then continue; fi
        echo "\$ $command"
        eval "$command" </dev/null || return
    done
}

# new_project NAME ARG...: makes it and runs the commands printed; $log holds what they said.
new_project() {
    run -0 impinge new "$@"
    grep '^  ' <<<"$output" >commands
    [ "$(wc -l <commands)" -eq 4 ]
    log=$PWD/log
    run_commands <commands >"$log" 2>&1 || { cat "$log"; false; }
}

# shellcheck disable=SC2034 # for the suites
examples=share/doc/impinge/sdk/examples
