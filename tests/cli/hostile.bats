#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# A plugin that does its worst in each phase of its life: isolated, it costs at most the answer;
# otherwise it is named, and nothing is taken for an answer that is none.

load ../support/hostile_helper

# --- Isolated -----------------------------------------------------------------------------------
@test "isolated, what a plugin prints does not reach the answer" {
    local phase sin
    for phase in $surface; do
        for sin in print write; do
            contact hostile $phase $sin --isolate all
        done
    done
    for phase in $map; do
        OPERAND=$lifted contact hostile $phase write --isolate all
    done
}

@test "isolated, a plugin that forks and returns gives one answer" {
    local phase
    for phase in $surface; do
        contact hostile $phase fork --isolate all
    done
    for phase in $map; do
        OPERAND=$lifted contact hostile $phase fork --isolate all
    done
}

@test "isolated, the children of a plugin end with the query and hold no pipe" {
    export -f hostile
    export ball here
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

# --- In the host's own process ------------------------------------------------------------------
# Ways to crash while loaded or unloaded; with AddressSanitizer the recursion ends in its own stack.
crashes() { echo crash abort && { has_sanitizers || echo overflow; }; }

# Ways to end the process; AddressSanitizer ends it itself where the main thread does.
ends() { echo exit _exit _Exit quick_exit && { has_sanitizers || echo pthread_exit; }; }

# named PHASE SIN WHAT [WHO]: the hostile pair ends with status 5 and one line that names plugin and
# phase; --json has it too.
named() {
    local says="*${4-hostile}*' $3 in its $1;*"
    [ "$3" != crashes ] || says="crashed in the $1 of *${4-hostile}*';*"
    run -5 --separate-stderr hostile "$1" "$2"
    echo "$1 $2: $output / $stderr"
    # shellcheck disable=SC2053 # a pattern
    [[ $stderr == "impinge: "$says && ${#stderr_lines[@]} -eq 1 ]]
    committed "$1" "$2"
    valid result
    jq -es --arg said "${stderr#impinge: }" 'last.error == $said' <<<"$output"
}

@test "a crash or the end of the process is laid at the door of the type, in each callback" {
    local phase sin
    for phase in $surface; do
        for sin in crash abort overflow; do named $phase $sin crashes; done
        for sin in $(ends); do
            named $phase $sin 'ends the process'
        done
        named $phase fork 'forks the process'
    done
}

@test "the same in each callback of a map is laid at the door of the map" {
    local phase sin
    for phase in $map; do
        for sin in crash overflow; do OPERAND=$lifted named $phase $sin crashes hostile-map; done
        OPERAND=$lifted named $phase exit 'ends the process' hostile-map
        OPERAND=$lifted named $phase fork 'forks the process' hostile-map
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
    for phase in constructor get_factory $surface destructor; do
        for sin in print write; do
            contact hostile $phase $sin
            [[ $stderr == '{"verdict": '* ]]
        done
    done
    for phase in $map; do
        OPERAND=$lifted contact hostile $phase write
        [[ $stderr == '{"verdict": "written"}' ]]
    done
}

@test "a changed floating-point mode ends the query and is laid at the door of the type" {
    local phase sin
    for phase in create domain eval rate include; do
        run -5 --separate-stderr hostile $phase round
        echo "$phase: $stderr"
        [[ $stderr == *"'hostile'"* && $stderr == *' mode '* && $stderr == *"$phase"* ]]
    done
    for phase in create time_domain eval rate apply; do
        OPERAND=$lifted run -5 --separate-stderr hostile $phase round
        [[ $stderr == *"'hostile-map'"* && $stderr == *' mode '* && $stderr == *"$phase"* ]]
    done
    for sin in round x87 trap; do
        contact hostile destroy $sin
        contact hostile destructor $sin
        run -4 --separate-stderr hostile constructor $sin
        [[ $stderr == *"'$PWD/plugins/hostile.so'"*'changes the mode of arithmetic'* ]]
    done
}

@test "whatever a plugin makes of working directory, umask, signals, locale and threads: the answer stays" {
    local phase sin
    for phase in constructor create eval destroy; do
        for sin in chdir umask block thread errno uselocale; do
            contact hostile $phase $sin
        done
    done
    # One in which numbers have a comma, which the plugin makes that of the process.
    "$top_srcdir"/tests/support/comma_locale . || skip "localedef cannot make a locale here"
    surroundings=(LOCPATH="$PWD" LC_ALL=comma_XX)
    for phase in constructor create eval destroy; do
        contact hostile $phase locale
    done
}

# --- What belongs to the process ----------------------------------------------------------------
@test "whatever a plugin makes of standard output and of descriptors: the answer comes, or an error tells" {
    local phase sin
    for phase in create eval destroy; do
        for sin in fclose setvbuf; do contact hostile $phase $sin; done
        named $phase freopen crashes # in the C library, which cannot do that to our stream
        [ $phase != destroy ] || continue # then the answer is out
        for sin in close reuse; do
            run -4 --separate-stderr hostile $phase $sin
            echo "$phase $sin: $output / $stderr"
            committed $phase $sin
            [ "$stderr" = 'impinge: pair: standard output: Bad file descriptor' ]
            [ -z "$output" ]
        done
    done
    [ ! -s stolen ]
    for sin in fclose setvbuf close reuse; do
        contact hostile eval $sin --isolate all
    done
}

@test "limits that a plugin sets cost at most the answer, and that is told" {
    local sin status
    for sin in no_file no_descriptor no_memory no_stack; do
        status=0
        hostile eval $sin >answer 2>said || status=$?
        echo "$sin: $status $(cat answer said)"
        committed eval $sin
        [ "$status" -eq 4 ] && [ -s said ] || { [ "$status" -eq 0 ] && jq -e '.verdict == "contact"' answer; }
    done
    for sin in no_file no_descriptor no_stack; do contact hostile eval $sin --isolate all; done
}

@test "a crash of a thread that a plugin has left, or at the end of one, is laid at its door" {
    has_sanitizers && skip 'they catch crashes themselves'
    local phase
    for phase in create eval include; do
        run -5 --separate-stderr hostile $phase later
        echo "$phase: $stderr"
        committed $phase later
        [[ $stderr == "impinge: crashed in plugin '$PWD/plugins/hostile.so' outside of its callbacks"* ]]
        valid result
        json '.error | startswith("crashed in plugin")'
    done
}

@test "a crash of a thread whose plugin is no longer loaded is reported" {
    has_sanitizers && skip 'they catch crashes themselves'
    # The program waits where it unloads the plugin, so that the thread runs on without its code.
    cat >wait.c <<'END'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <link.h>
#include <string.h>
#include <unistd.h>
int dlclose(void *library)
{
    int (*real)(void *) = (int (*)(void *))dlsym(RTLD_NEXT, "dlclose");
    struct link_map *map;
    const int waits =
        dlinfo(library, RTLD_DI_LINKMAP, &map) == 0 && strstr(map->l_name, "hostile") != NULL;
    const int result = real(library);
    if (waits) usleep(200000);
    return result;
}
END
    $CC -shared -fPIC -o wait.so wait.c -ldl
    LD_PRELOAD=$PWD/wait.so run -5 --separate-stderr hostile eval unloaded
    committed eval unloaded
    [[ $stderr == "impinge: crashed in code that is no longer loaded"*"run with --isolate all" ]]
}

@test "isolated, whatever a callback does ends the query, not the host, and is laid at the door of the type" {
    local phase sin end='crashes or ends its process, in which it runs isolated'
    for phase in create domain eval rate include; do
        for sin in crash abort overflow exit _exit _Exit quick_exit pthread_exit; do
            run -5 --separate-stderr hostile $phase $sin --isolate all
            echo "$phase $sin: $stderr"
            blamed $phase hostile "$end" "$stderr"
        done
    done
    for phase in create time_domain eval rate apply; do
        for sin in crash exit; do
            OPERAND=$lifted run -5 --separate-stderr hostile $phase $sin --isolate all
            echo "$phase $sin: $stderr"
            blamed $phase hostile-map "$end" "$stderr"
        done
    done
    for sin in crash exit pthread_exit; do
        contact hostile destroy $sin --isolate all
        blamed destroy hostile "$end" "$stderr"
        OPERAND=$lifted contact hostile destroy $sin --isolate all
        blamed destroy hostile-map "$end" "$stderr"
    done
}

@test "what a type need not offer is laid at its door alike" {
    local each type phase end='crashes or ends its process, in which it runs isolated'
    local ball=$ball OPERAND
    for each in $offered; do
        type=${each%:*} phase=${each#*:}
        operands_of "$type"
        named "$phase" crash crashes "$type"
        named "$phase" exit 'ends the process' "$type"
        named "$phase" fork 'forks the process' "$type"
        contact hostile "$phase" write
        contact hostile "$phase" write --isolate all
        run -5 --separate-stderr hostile "$phase" crash --isolate all
        echo "$each: $stderr"
        blamed "$phase" "$type" "$end" "$stderr"
        run -5 --separate-stderr hostile "$phase" round
        echo "$each: $stderr"
        [[ $stderr == *"'$type'"* && $stderr == *' mode '* && $stderr == *"$phase"* ]]
    done
}

@test "isolated, a write before or behind what a callback fills is laid at the door of its type" {
    local each sin phase end='crashes or ends its process, in which it runs isolated'
    local ball=$ball OPERAND
    for sin in before after; do
        for phase in domain eval rate include; do
            run -5 --separate-stderr hostile $phase $sin --isolate all
            echo "$phase $sin: $stderr"
            blamed $phase hostile "$end" "$stderr"
        done
        for phase in time_domain eval rate apply; do
            OPERAND=$lifted run -5 --separate-stderr hostile $phase $sin --isolate all
            echo "$phase $sin: $stderr"
            blamed $phase hostile-map "$end" "$stderr"
        done
        for each in $offered; do
            phase=${each#*:}
            [[ $phase != piece* ]] || continue
            operands_of "${each%:*}"
            run -5 --separate-stderr hostile "$phase" $sin --isolate all
            echo "$each $sin: $stderr"
            blamed "$phase" "${each%:*}" "$end" "$stderr"
        done
        unset OPERAND ball
        ball=$usual_ball
    done
}

@test "an exception of C++ that leaves a callback is laid at the door of the type" {
    local phase end='crashes or ends its process, in which it runs isolated'
    ! has_sanitizers || skip 'the plugin is linked here, without them'
    command -v c++ >/dev/null || skip 'no C++ compiler'
    echo 'extern "C" void hostile_throw() { throw 1; }' | c++ -fPIC -x c++ -c - -o throw.o
    $CC -std=c11 -D_GNU_SOURCE -O1 -ffp-contract=off -shared -fPIC -I"$top_builddir" -I"$top_srcdir" \
        -I"$top_srcdir/sdk" "$top_srcdir/tests/plugins/hostile.c" throw.o -o plugins/hostile.so \
        -lstdc++ -lm -lpthread
    for phase in create domain eval rate include destroy; do
        run -5 --separate-stderr hostile $phase throw
        echo "$phase: $output / $stderr"
        [[ $stderr == *"impinge: crashed in the $phase of "*"hostile"*"';"* ]]
        committed $phase throw
        [ $phase != destroy ] || continue
        run -5 --separate-stderr hostile $phase throw --isolate all
        blamed $phase hostile "$end" "$stderr"
    done
}
