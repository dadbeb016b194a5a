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
    here=$PWD
    surroundings=()
}

# Any slab meets it at t = 0.9.
ball='sphere radius=.5 center=.3,.2,1.4'

# Those that are called for a surface, and for a map on an innocent one. rate: by the 1990 method.
surface='create domain eval rate include destroy'
map='create time_domain eval rate apply destroy'
square='plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0'
lifted="$square ! hostile-map"

usual_ball=$ball

# Those that a type need not offer, as TYPE:PHASE; and of such a type the two operands.
offered='hostile-net:net hostile-distance:distance hostile-pieces:piece_count hostile-pieces:piece hostile-rigid:rigid hostile-symmetry:symmetry'
operands_of() {
    OPERAND=$1 ball=$usual_ball
    [ "$1" != hostile-rigid ] || OPERAND="$square ! hostile-rigid"
    # No distance is asked for unless the other is much the same for long: here it is nearly flat.
    [[ $1 != hostile-distance && $1 != hostile-symmetry ]] || ball='sphere radius=9 center=.3,.2,9.9'
    # No symmetry is asked for unless the type turns.
    [ "$1" != hostile-symmetry ] || OPERAND='hostile-symmetry ! rotate axis=0,0,1 rate=1'
    # No net is asked for unless the other has one too, and bends.
    [ "$1" != hostile-net ] || ball='bezier degree=2,1 points=[[-1,-1,1.4],[-1,1,1.4],[0,-1,.6],[0,1,.6],[1,-1,1.4],[1,1,1.4]]'
}

# hostile PHASE SIN [OPTION]...: the pair of the plugin's surface, or with OPERAND another, and the
# ball; it is loaded in its right mind once, so that what happens while it is loaded happens in the
# host.
hostile() {
    local method=models
    [ "$1" != rate ] || method=paper
    [ -d "$here/cache" ] || "$IMPINGE" list --plugin-path "$here/plugins" >/dev/null
    : >"$here/confessions"
    HOSTILE="$1 $2" HOSTILE_CONFESSIONS=$here/confessions timeout 60 env --default-signal=QUIT,TERM "${surroundings[@]}" "$IMPINGE" pair "${OPERAND-hostile}" \
        "$ball" --method $method --gamma 0.1 --plugin-path "$here/plugins" --json "${@:3}"
}

# committed PHASE SIN: that was not only asked for, the scene has called the callback.
committed() { grep -qx "$1 $2" "$here/confessions"; }

# contact COMMAND...: the answer is one line that says so.
contact() {
    run -0 --separate-stderr "$@"
    echo "$*: $output / $stderr"
    [ "${#lines[@]}" -eq 1 ]
    json '.verdict == "contact"'
    [ "$1" != hostile ] || committed "$2" "$3"
}

# --- Isolated ----------------------------------------------------------------------------------------

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

# --- In the host's own process ---------------------------------------------------------------------

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

# blamed PHASE TYPE WHAT TEXT: names the phase and the type, and says what they did.
blamed() {
    [[ $4 == *": $1 of '$2' ($PWD/plugins/hostile.so) $3"* || $4 == *": $3"*" ($1 of '$2')" ||
        ($1 == destroy && $4 == *"/hostile.so: destroy of '$2' $3"*) ]]
}

# --- What belongs to the process -----------------------------------------------------------------------

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

# --- Hangs -----------------------------------------------------------------------------------------------

# in_folder NAME COMMAND...: runs it there; its output, errors and status are files. A plugin that
# hangs makes the file `hangs`, with the number of its process.
in_folder() {
    local status=0
    cd "$1" || return
    "${@:2}" >out 2>errors || status=$?
    echo "$status" >status
}

# Begins a query for each phase, in a folder TYPE:PHASE.
all_hang() {
    local each phase ball=$ball
    for phase in $surface; do
        mkdir "hostile:$phase"
        in_folder "hostile:$phase" hostile "$phase" hang "$@" &
    done
    for phase in $map; do
        mkdir "hostile-map:$phase"
        OPERAND=$lifted in_folder "hostile-map:$phase" hostile "$phase" hang "$@" &
    done
    for each in $offered; do
        mkdir "$each"
        (operands_of "${each%:*}" && in_folder "$each" hostile "${each#*:}" hang "$@") &
    done
}

@test "isolated, a callback that hangs is ended after 5 s and named, and its process with it" {
    local folder
    "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    all_hang --isolate all
    wait
    for folder in hostile*:*; do
        echo "$folder: $(<"$folder/status") $(<"$folder/errors")"
        [ -s "$folder/hangs" ]
        run ! kill -0 "$(<"$folder/hangs")"
        if [[ $folder == *:destroy ]]; then
            [ "$(<"$folder/status")" -eq 0 ] && [ "$(jq -r .verdict "$folder/out")" = contact ]
        else
            [ "$(<"$folder/status")" -eq 5 ] && [ "$(jq 'has("error")' "$folder/out")" = true ]
        fi
        blamed "${folder#*:}" "${folder%:*}" 'does not answer within 5 s' "$(<"$folder/errors")"
    done
}

@test "a callback that takes longer than --max-seconds while the scene is read ends the command, and is not blamed" {
    local verb told='--max-seconds 0.1 was over while the scene was read; allow more (0: no limit)'
    run -3 --separate-stderr hostile create spin --max-seconds 0.1
    [ "$stderr" = "impinge: pair: $told" ]
    json --arg told "pair: $told" '. == {error: $told}'
    echo '{"bodies":[{"surfaces":[{"type":"hostile"}]}]}' >slow.json
    for verb in clearance solve 'simulate -o motion.json' 'view -o view.svg'; do
        # shellcheck disable=SC2086 # words
        HOSTILE='create spin' run -3 "$IMPINGE" $verb slow.json --plugin-path "$here/plugins" --max-seconds 0.1
        [ "$output" = "impinge: ${verb%% *}: $told" ]
    done
}

@test "a type that takes too long to read ends a batch after the answers so far, or costs its line alone" {
    local k line='{"bodies":[{"surfaces":[{"type":"sphere"}]},{"surfaces":[{"type":"TYPE","center":[4,0,0]}]}]}'
    local slow='{"bodies":[{"surfaces":[{"type":"sphere"}]},{"surfaces":[{"type":"hostile"}]}]}'
    printf '%s\n' "${line/TYPE/sphere}" "$slow" "${line/TYPE/sphere}" >lines.jsonl
    export HOSTILE='create spin'
    for k in 1 2; do
        run -3 --separate-stderr "$IMPINGE" batch lines.jsonl --plugin-path "$here/plugins" --threads 1 \
            --max-seconds 0.1 --resume answers.jsonl
        [[ $stderr == *'--max-seconds 0.1 was over while lines.jsonl, line 2 was read; allow more (0: no limit), or give --isolate, so that '* ]]
        output=$(<answers.jsonl)
        json -s 'length == 1 and (.[0] | has("verdict"))'
    done
    run -5 --separate-stderr "$IMPINGE" batch lines.jsonl --plugin-path "$here/plugins" --isolate all
    json -s 'length == 3 and .[0].verdict == "clear" and .[2].verdict == "clear" and
        (.[1].error | contains("create of '"'hostile'"'") and contains("does not answer within 5 s"))'
}

@test "a callback that hangs in the host is named when SIGQUIT ends the command" {
    local folder phase whose
    ulimit -c 0
    "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    all_hang
    for phase in constructor get_factory destructor; do
        mkdir "file:$phase"
        in_folder "file:$phase" hostile $phase hang &
    done
    for folder in *:*; do
        until [ -s "$folder/hangs" ]; do sleep 0.05; done
        kill -QUIT "$(<"$folder/hangs")"
    done
    wait
    for folder in *:*; do
        whose="type '${folder%:*}';"
        [[ $folder != file:* ]] || whose="plugin '$PWD/plugins/hostile.so'"
        echo "$folder: $(<"$folder/status") $(<"$folder/errors")"
        [ "$(<"$folder/status")" -eq 131 ]
        [[ $(<"$folder/errors") == "impinge: interrupted in ${folder#*:} of $whose"* ]]
    done
}

@test "of two signals that end a search the second names a callback that hangs" {
    local pid
    "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    mkdir search
    in_folder search hostile eval hang &
    until [ -s search/hangs ]; do sleep 0.05; done
    pid=$(<search/hangs)
    while kill -TERM "$pid" 2>/dev/null; do sleep 0.05; done
    wait
    echo "$(<search/status) $(<search/errors)"
    [ "$(<search/status)" -eq 143 ]
    [[ $(<search/errors) == "impinge: interrupted in eval of type 'hostile'; where a callback hangs, --isolate ends it after 5 s"* ]]
}

# A batch of two lines of which the first one hangs: hanging_batch TYPES PHASE.
hanging_batch() {
    {
        scene '"id": 1,' | jq -c --argjson with "$1" '.bodies[0] += $with'
        scene '"id": 2,'
    } >scenes.jsonl
    local method=models
    [ "$2" != rate ] || method=paper
    HOSTILE="$2 hang" env --default-signal=QUIT,TERM "$IMPINGE" batch scenes.jsonl --threads 2 \
        --method $method --plugin-path "$here/plugins"
}

# ended_by SIGNAL STATUS TYPE BATCH...: a batch hangs in a thread of its own; the signal, twice if need
# be, ends it and names what hangs, and not what waits.
ended_by() {
    local pid folder="$3-${*: -1}-$1"
    mkdir "$folder"
    in_folder "$folder" "${@:4}" &
    until [ -s "$folder/hangs" ]; do sleep 0.05; done
    pid=$(<"$folder/hangs")
    while kill -s "$1" "$pid" 2>/dev/null; do sleep 0.05; done
    wait
    echo "$folder: $(<"$folder/status") $(<"$folder/errors")"
    [ "$(<"$folder/status")" -eq "$2" ]
    [[ $'\n'$(<"$folder/errors") == *$'\nimpinge: interrupted in '"${*: -1} of type '$3'; where"* ]]
}

@test "a callback that hangs in a thread of a batch is named by the signals that end it" {
    local phase
    ulimit -c 0
    "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    for phase in $surface; do
        ended_by QUIT 131 hostile hanging_batch '{"surfaces": [{"type": "hostile"}]}' "$phase"
    done
    for phase in $map; do
        ended_by QUIT 131 hostile-map hanging_batch '{"maps": [{"type": "hostile-map"}]}' "$phase"
    done
    ended_by TERM 143 hostile hanging_batch '{"surfaces": [{"type": "hostile"}]}' eval
}

@test "isolated, a callback that hangs in a thread of a batch costs its line, and the type is named" {
    local phase
    "$IMPINGE" list --plugin-path "$PWD/plugins" >/dev/null
    for phase in eval destroy; do
        {
            scene '"id": 1,' | jq -c '.bodies[0].surfaces = [{"type": "hostile"}]'
            scene '"id": 2,'
        } >scenes.jsonl
        HOSTILE="$phase hang" run --separate-stderr "$IMPINGE" batch scenes.jsonl --threads 2 \
            --plugin-path "$PWD/plugins" --isolate all
        echo "$phase: $status $output / $stderr"
        [ "${#lines[@]}" -eq 2 ] && [ "$(jq -r .verdict <<<"${lines[1]}")" = contact ]
        if [ $phase = destroy ]; then
            [ "$status" -eq 0 ] && [ "$(jq 'has("verdict")' <<<"${lines[0]}")" = true ]
            blamed destroy hostile 'does not answer within 5 s' "$stderr"
        else
            [ "$status" -eq 5 ]
            blamed $phase hostile 'does not answer within 5 s' "$(jq -r .error <<<"${lines[0]}")"
        fi
    done
}
