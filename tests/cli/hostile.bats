#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# A plugin that does its worst in each phase of its life: isolated, it costs at most the answer;
# otherwise it is named, and nothing is taken for an answer that is none.

load ../support/cli_helper

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    mkdir plugins
    # shellcheck disable=SC2154 # top_builddir comes from the environment
    cp "$top_builddir/tests/plugins/.libs/hostile.so" plugins
    export XDG_CACHE_HOME=$PWD/cache
}

# Any slab meets it at t = 0.9.
ball='sphere radius=.5 center=.3,.2,1.4'

# hostile PHASE SIN [OPTION]...: the pair of the plugin and the ball; it is loaded in its right mind
# once, so that what happens while it is loaded happens in the host.
hostile() {
    [ -d cache ] || "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    HOSTILE="$1 $2" timeout 60 "$IMPINGE" pair hostile "$ball" --plugin-path "$PWD/plugins" --json "${@:3}"
}

# --- Isolated ----------------------------------------------------------------------------------------

@test "isolated, what a plugin prints does not reach the answer" {
    local phase sin
    for phase in create domain eval include destroy; do
        for sin in print write; do
            run -0 --separate-stderr hostile $phase $sin --isolate all
            [ "${#lines[@]}" -eq 1 ]
            json '.verdict == "contact"'
        done
    done
}

@test "isolated, a plugin that forks and returns gives one answer" {
    local phase
    for phase in create domain eval include destroy; do
        run -0 --separate-stderr hostile $phase fork --isolate all
        [ "${#lines[@]}" -eq 1 ]
        json '.verdict == "contact"'
    done
}

@test "isolated, the children of a plugin end with the query and hold no pipe" {
    export -f hostile
    export ball
    run -0 timeout 30 bash -c 'hostile eval child --isolate all | cat'
    json '.verdict == "contact"'
}

@test "a signal to the process group ends the search, accuses nobody and keeps the proof" {
    local pid status=0
    "$IMPINGE" list >/dev/null
    setsid "$IMPINGE" pair "${endless[@]}" --isolate all --json >out 2>errors &
    pid=$!
    at_work "$pid" TERM
    kill -TERM -- "-$pid"
    wait "$pid" || status=$?
    [ "$status" -eq 3 ] && [ ! -s errors ]
    output=$(cat out)
    valid result
    json '.verdict == "undecided" and .reason == "cancelled" and .stats.pairs > 0'
}

@test "isolated, two thousand bodies take one process for each type" {
    local k
    {
        printf '{"bodies": ['
        for k in {1..2000}; do
            printf '{"name": "%d", "surfaces": [{"type": "sphere", "radius": 0.4, "center": [%d,0,0]}]},' "$k" "$k"
        done
        printf '{"name": "last", "surfaces": [{"type": "torus", "center": [0,9,0]}]}]}'
    } >many.json
    run -0 bash -c 'ulimit -n 40; exec "$@"' - "$IMPINGE" solve many.json --isolate all --json
    json '.verdict == "clear"'
}

# --- In the host's own process ---------------------------------------------------------------------

callbacks='create domain eval include destroy'

# Ways to crash while loaded or unloaded; with AddressSanitizer the recursion ends in its own stack.
crashes() { echo crash abort && { has_sanitizers || echo overflow; }; }

# Ways to end the process; AddressSanitizer ends it itself where the main thread does.
ends() { echo exit _exit _Exit quick_exit && { has_sanitizers || echo pthread_exit; }; }

# named PHASE SIN WHAT: the hostile pair ends with status 5 and one line that names plugin and phase.
named() {
    run -5 --separate-stderr hostile "$1" "$2"
    echo "$1 $2: $output / $stderr"
    [[ $stderr == "impinge: "*hostile*"' $3 in its $1;"* && ${#stderr_lines[@]} -eq 1 ]]
}

@test "a crash or the end of the process is laid at the door of the type, in each callback" {
    local phase sin
    for phase in $callbacks; do
        for sin in crash abort overflow; do named $phase $sin crashes; done
        for sin in $(ends); do
            named $phase $sin 'ends the process'
        done
        named $phase fork 'forks the process'
    done
}

@test "the same while the plugin is loaded or unloaded is laid at the door of its file" {
    local phase sin
    for phase in constructor get_factory destructor; do
        for sin in $(crashes); do named $phase $sin crashes; done
        for sin in $(ends); do
            named $phase $sin 'ends the process'
        done
        named $phase fork 'forks the process'
        [[ $stderr == "impinge: plugin '$PWD/plugins/hostile.so' forks"* ]]
    done
}

@test "loaded for the first time, it is refused for the same" {
    local phase sin
    for phase in constructor get_factory destructor; do
        for sin in crash exit _exit pthread_exit; do
            rm -rf cache
            HOSTILE="$phase $sin" run -0 --separate-stderr "$IMPINGE" list --json \
                --plugin-path "$PWD/plugins"
            valid types
            if [ $sin = crash ]; then
                json '.refused[0].reason | startswith("trial: loading it crashes: signal 11")'
            else
                json '.refused[0].reason | startswith("trial: loading it ends the process")'
            fi
        done
    done
}

@test "what a plugin prints goes to standard error, and the answer stays an answer" {
    local phase sin
    for phase in constructor get_factory $callbacks destructor; do
        for sin in print write; do
            run -0 --separate-stderr hostile $phase $sin
            echo "$phase $sin: $output / $stderr"
            [ "${#lines[@]}" -eq 1 ]
            json '.verdict == "contact"'
            [[ $stderr == '{"verdict": '* ]]
        done
    done
}

@test "isolated, whatever a callback does ends the query, not the host" {
    local phase sin
    for phase in create domain eval include; do
        for sin in crash abort overflow exit _exit _Exit quick_exit pthread_exit; do
            run -5 --separate-stderr hostile $phase $sin --isolate all
            [[ $stderr == *"hostile"*"crashes or ends its process, in which it runs isolated" ]]
        done
    done
    for sin in crash exit pthread_exit; do
        run -0 --separate-stderr hostile destroy $sin --isolate all
        json '.verdict == "contact"'
    done
}
