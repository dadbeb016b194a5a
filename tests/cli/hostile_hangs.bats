#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Callbacks that hang: isolated, in the host, and in the threads of a batch.

load ../support/hostile_helper

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

@test "isolated, a callback that hangs is ended when --max-seconds is over" {
    local phase start took
    for phase in create domain eval include; do
        start=$(date +%s%N)
        run -3 --separate-stderr hostile "$phase" hang --isolate all --max-seconds 0.3
        took=$((($(date +%s%N) - start) / 1000000))
        echo "$phase: $took ms: $output / $stderr"
        [ "$took" -lt 3000 ] # 0.3 s on an idle machine; 5 s without the limit
        [[ $stderr != *'5 s'* && $stderr == *'max_seconds '*'allow more (0: no limit)'* ]]
        json 'has("error")'
        [[ $phase != eval && $phase != include ]] || [[ $stderr == *"($phase of 'hostile')"* ]]
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
    run -3 --separate-stderr "$IMPINGE" batch lines.jsonl --plugin-path "$here/plugins" --isolate all --max-seconds 0.3
    json -s 'length == 3 and .[0].verdict == "clear" and .[2].verdict == "clear" and
        (.[1].error | contains("max_seconds is not enough to read this"))'
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
