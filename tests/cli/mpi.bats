#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge-mpi: batch and solve --each by the processes of an MPI run.

load ../support/cli_helper

# ranks COUNT COMMAND...: an MPI run on this machine alone that cannot hang.
ranks() {
    local count=$1
    shift
    timeout -k 5 "${limit-120}" mpirun --oversubscribe --allow-run-as-root -np "$count" "$@" </dev/null
}

setup_file() {
    export OMPI_MCA_plm_rsh_agent=/bin/false # no other machines
    export why_not=
    if [ ! -x "$top_builddir/tools/impinge-mpi" ]; then
        why_not='configure found no MPI (libopenmpi-dev)'
    elif has_sanitizers; then
        why_not='libraries of MPI are not made for AddressSanitizer'
    elif ! command -v mpirun >/dev/null; then
        why_not='no mpirun (openmpi-bin)'
    elif ! limit=30 ranks 2 true >/dev/null 2>&1; then
        why_not='mpirun cannot start here'
    fi
}

setup() {
    [ -z "$why_not" ] || skip "$why_not"
    cd "$BATS_TEST_TMPDIR" || return
    mpi=$top_builddir/tools/impinge-mpi
}

without_seconds() { sed -E 's/"seconds":[^,]*,//g'; }

# Scenes with ids from 1 to COUNT, of unequal work, one in seven wrong: many COUNT.
many() {
    local k
    for ((k = 1; k <= $1; ++k)); do
        if ((k % 7 == 0)); then
            echo "{\"id\": $k, \"bodies\": 3}"
        else
            scene "\"id\": $k, \"gamma\": 1e-$((1 + k % 6)),"
        fi
    done
}

@test "one scene of many bodies has the same bytes from four ranks as from one thread" {
    "$top_builddir"/tests/support/crowd_scene 60 1 >crowd.json
    "$IMPINGE" solve crowd.json --each --json --threads 1 | without_seconds >whole
    ranks 4 "$mpi" solve crowd.json --each --json | without_seconds | cmp - whole
}

# Balls on three arms, of which two meet at some angles; the hall comes nearer in time.
turning() {
    local arm='{"name": "%s", "surfaces": [{"type": "sphere", "radius": 0.3, "center": [%s,0,0]}],
        "maps": [{"type": "rotate", "axis": [0,0,1], "rate": 1, "clock": "%s"}, {"type": "translate",
        "offset": [[%s,0,0],[%s,0,0]]}]}'
    # shellcheck disable=SC2059 # the format is above
    printf "{\"gamma\": 1e-2, \"parameters\": {\"a\": [-1,1], \"b\": [-1,1]}, \"bodies\": [$arm, $arm, $arm]}" \
        one 1 a 0 0  two -1 b 2.7 -0.2  three -1 b 5.4 -0.1 | tr -d '\n'
}

@test "a scene with parameters has the same bytes from four ranks, by pairs and in a batch" {
    turning >turning.json
    "$IMPINGE" solve turning.json --each --json --threads 1 | without_seconds >whole
    [ "$(jq -s 'map(.verdict == "contact" and .parameters.a != null) | any' whole)" = true ]
    ranks 4 "$mpi" solve turning.json --each --json | without_seconds | cmp - whole
    run -3 --separate-stderr ranks 3 "$mpi" solve turning.json --each --json --max-boxes 2
    jq -es 'length == 3 and any(.verdict == "undecided" and .worst.parameters.b != null)' <<<"$output"
    for k in 1 2 3 4 5; do turning | jq -c ".id = $k | .parameters.a = [0, 0.1 * $k]"; done >lines.jsonl
    "$IMPINGE" batch lines.jsonl | without_seconds >whole
    ranks 4 "$mpi" batch lines.jsonl --resume lines.out
    without_seconds <lines.out | cmp - whole
}

@test "advice about undecided pairs comes from the rank that has searched them" {
    egg() { printf '{"name": "%s", "surfaces": [{"type": "ellipsoid", "radii": [1,1.0005,%s]}]}' "$@"; }
    printf '{"time": [0,1], "bodies": [%s, %s, %s, %s]}' "$(egg a 1)" "$(egg b 0.999)" \
        "$(egg c 0.998)" "$(egg d 0.997)" >eggs.json
    limits=(--each --json --gamma 1e-7 --max-pairs 200)
    run -3 "$IMPINGE" solve eggs.json "${limits[@]}" --threads 1
    without_seconds <<<"$output" >whole
    jq -se 'any(.advice)' whole
    run -3 --separate-stderr ranks 4 "$mpi" solve eggs.json "${limits[@]}"
    without_seconds <<<"$output" | cmp - whole
}

@test "a batch by four ranks has the same bytes as by one process, and goes on where it was cut" {
    many 600 >scenes.jsonl # more than two blocks
    run -4 "$IMPINGE" batch scenes.jsonl --resume whole
    without_seconds <whole >expected
    run -4 --separate-stderr ranks 4 "$mpi" batch scenes.jsonl --resume out
    [ -z "$output" ]
    [[ $stderr == *'85 of 600 lines could not be answered'* ]]
    without_seconds <out | cmp - expected
    local size cut
    size=$(wc -c <out)
    for cut in 1 $((size / 2)); do
        head -c "$cut" out >part
        run -4 ranks 4 "$mpi" batch scenes.jsonl --resume part
        without_seconds <part | cmp - expected
    done
}

@test "shards divide the scenes" {
    many 20 >scenes.jsonl
    run ranks 3 "$mpi" batch scenes.jsonl --resume o --shard 2/8 # a short name, too
    [ "$(jq -s -c 'map(.id)' o)" = '[2,10,18]' ]
}

@test "a rank that fails ends the run, and --resume continues what is there" {
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/eval_crashes.so plugins
    { many 300 && echo '{"id": 301, "bodies": [{"surfaces": [{"type": "eval_crashes"}]},
        {"surfaces": [{"type": "sphere"}]}]}' | tr -d '\n' && echo && scene '"id": 302,'; } >scenes.jsonl
    run ! ranks 4 "$mpi" batch scenes.jsonl --resume out --plugin-path plugins
    [[ $output == *"crashed in the "*" of type 'eval_crashes'"* ]]
    [ "$(head -n 256 out | jq -s -c 'map(.id) == [range(1; 257)]')" = true ]
    run ranks 4 "$mpi" batch scenes.jsonl --resume out --plugin-path plugins --isolate eval_crashes
    [ "$(jq -s -c 'map(.id) == [range(1; 303)]' out)" = true ]
    jq -s -e '.[300].error | contains("eval_crashes")' out
}

# Two nested surfaces that never touch, too near to each other to prove it in a lifetime.
endless_scene() {
    echo '{"id": 700, "gamma": 1e-9, "bodies": [{"surfaces": [{"type": "superellipsoid"}]},
        {"surfaces": [{"type": "superellipsoid", "radii": [1.000000002,1.000000002,1.000000002]}]}]}' | tr -d '\n'
    echo
}

@test "a run that loses any one rank to SIGKILL is resumed to the same bytes" {
    { many 699 && endless_scene && many 60; } >scenes.jsonl
    run -4 "$IMPINGE" batch scenes.jsonl --resume whole --max-pairs 1000
    without_seconds <whole >expected
    local victim
    for victim in 0 3; do # the first rank holds the output, the last one only answers
        rm -f out out.options
        # shellcheck disable=SC2016 # each rank expands it
        ranks 4 bash -c 'echo $$ >"pid.$OMPI_COMM_WORLD_RANK"; exec "$@"' - \
            "$mpi" batch scenes.jsonl --resume out --max-bytes 0 >said 2>&1 &
        local run=$! status=0
        until [ "$(wc -l 2>/dev/null <out)" = 512 ]; do sleep 0.1; done
        kill -KILL "$(cat "pid.$victim")"
        wait "$run" || status=$?
        [ "$status" -ne 0 ]
        run -4 --separate-stderr ranks 4 "$mpi" batch scenes.jsonl --resume out --max-pairs 1000
        without_seconds <out | cmp - expected
    done
}

@test "an output that another run is writing is refused, and its process named" {
    mkfifo lines
    "$IMPINGE" batch lines --resume out 8>&- &
    local first=$!
    exec 8>lines
    scene '"id": 1,' >&8
    until [ -s out ]; do sleep 0.05; done
    scene '"id": 1,' >scenes.jsonl
    run -4 --separate-stderr ranks 2 "$mpi" batch scenes.jsonl --resume out 8>&-
    [[ $stderr == *"out: process $first is writing it"* ]]
    exec 8>&-
    wait "$first"
}

@test "an output of other scenes is not resumed, and keeps its answers" {
    scene '"id": 1,' >scenes.jsonl
    { scene '"id": 2,' && scene '"id": 1,'; } >others.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    cp out before
    run -4 --separate-stderr ranks 4 "$mpi" batch others.jsonl --resume out
    [[ $stderr == *'out, line 1: not the answer to that scene of the input'* ]]
    cmp out before
}

@test "a fault of the command line, the scene or a plugin is told once" {
    scene >scene.json
    run -2 --separate-stderr ranks 3 "$mpi" solve scene.json
    [ "$(grep -c '^impinge: solve: impinge-mpi solves a scene with --each only' <<<"$stderr")" = 1 ]
    run -2 --separate-stderr ranks 3 "$mpi" batch scene.json
    [ "$(grep -c '^impinge: batch: impinge-mpi needs --resume OUT' <<<"$stderr")" = 1 ]
    run -2 --separate-stderr ranks 3 "$mpi" pair sphere sphere
    run -4 --separate-stderr ranks 3 "$mpi" batch nowhere.jsonl --resume out
    [ "$(grep -c 'nowhere.jsonl: No such file' <<<"$stderr")" = 1 ]
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/eval_nan_late.so plugins
    echo '{"bodies": [{"surfaces": [{"type": "eval_nan_late"}]}, {"surfaces": [{"type": "sphere"}]}]}' \
        >scene.json
    run -5 --separate-stderr ranks 3 "$mpi" solve scene.json --each --plugin-path plugins
    [ "$(grep -c '^impinge: solve: ' <<<"$stderr")" = 1 ]
}

@test "help and version come once" {
    run -0 --separate-stderr ranks 2 "$mpi" --version
    [[ ${#lines[@]} -eq 1 && $output == 'impinge-mpi '* ]]
    run -0 --separate-stderr ranks 2 "$mpi" --help
    [ "$(grep -c '^Usage: mpirun' <<<"$output")" = 1 ]
}
