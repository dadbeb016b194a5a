#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge batch: one answer a line, in order, whatever the lines hold.

load ../support/cli_helper

batch_lines() { printf '%s\n' "$@" | "$IMPINGE" batch - "${options[@]}"; }
options=()

@test "answers come one a line, in order, with the ids of the scenes" {
    run -0 batch_lines "$(scene '"id": "x",')" "$(scene '"id": [1, {"k": null}],')" "$(scene)"
    valid result
    [ "${#lines[@]}" -eq 3 ]
    jq -es 'map(.id) == ["x", [1, {"k": null}], null]' <<<"$output"
    jq -es 'map(.verdict) == ["contact", "contact", "contact"]' <<<"$output"
}

@test "a file has the same answers as standard input" {
    { scene '"id": 1,' && scene '"id": 2, "gamma": 1e-2,'; } >scenes.jsonl
    run -0 "$IMPINGE" batch scenes.jsonl
    [ "$(jq -c 'del(.stats)' <<<"$output")" = \
        "$("$IMPINGE" batch - <scenes.jsonl | jq -c 'del(.stats)')" ]
    jq -es 'map(.gamma) == [1e-6, 1e-2]' <<<"$output"
}

@test "an answer is the one that solve gives" {
    run -0 batch_lines "$(scene)"
    [ "$(jq -c 'del(.stats, .id)' <<<"$output")" = \
        "$(scene | "$IMPINGE" solve - --json | jq -c 'del(.stats, .scene)')" ]
}

@test "a line has any length, with a line end behind it or the end of the file" {
    local n lengths="700 4094 4095 4096 4097 4098 8191 8192 8193 65534 65535 65536 65537 300000"
    for n in $lengths; do
        printf '%-*s\n' $((n - 1)) "$(scene '"id": '"$n,")"
        printf '\0%*s\0\n' $((n - 3)) ""
    done >lines
    for n in $lengths; do
        { cat lines && printf '%-*s' "$n" "$(scene '"id": "last",')"; } >scenes.jsonl
        run -4 --separate-stderr "$IMPINGE" batch scenes.jsonl
        [ "$(jq -c .id <<<"$output" | paste -sd " ")" = "${lengths// / null } null \"last\"" ]
        [ "$("$IMPINGE" batch - 2>errors <scenes.jsonl | jq -c .id)" = "$(jq -c .id <<<"$output")" ]
    done
}

@test "a bad line is answered by its error, and the rest goes on" {
    run -4 --separate-stderr batch_lines "$(scene '"id": 1,')" 'not JSON' '{"id": 7, "bodies": 3}' \
        "$(scene '"id": 2,')"
    valid result
    jq -es 'map(.id) == [1, null, 7, 2]' <<<"$output"
    jq -es 'map(.line) == [null, 2, 3, null]' <<<"$output"
    jq -es '.[2].error | contains("standard input, line 3") and contains("/bodies")' <<<"$output"
    [[ $stderr == 'impinge: batch: standard input: 2 of 4 lines could not be answered'* ]]
}

@test "blank lines are passed over and counted" {
    run -4 --separate-stderr batch_lines '' "$(scene '"id": 1,')" $' \t\r' '{}'
    [ "${#lines[@]}" -eq 2 ]
    jq -es '.[0].id == 1 and .[1].line == 4' <<<"$output"
}

@test "a last line without its end is answered" {
    run -0 bash -c 'printf %s "$1" | "$IMPINGE" batch -' - "$(scene '"id": 1,')"
    json '.id == 1'
}

@test "nothing is answered with nothing" {
    run -0 "$IMPINGE" batch - </dev/null
    [ -z "$output" ]
}

@test "numbers have the fewest digits that read back, unless they are no shorter than 17" {
    python3 -c '
import random
random.seed(7)
ball = "{\"surfaces\": [{\"type\": \"sphere\"}]}"
scene = "{\"id\": %r, \"gamma\": %r, \"bodies\": [" + ball + ", " + ball + "]}"
for k in range(3000):
    x = random.random() * 10 ** random.randint(-12, 18)
    x = float("%.*g" % (random.choice([14, 15, 16, 17, 17]), x))
    print(scene % (x, x))
' >scenes.jsonl
    run -0 "$IMPINGE" batch scenes.jsonl
    python3 -c '
import re, sys
count = 0
for line in sys.stdin:
    for name in "id", "gamma", "gamma_clear":
        text = re.search(r"\"%s\":([^,}]*)" % name, line).group(1)
        exact = re.sub("e[+]?(-?)0*", r"e\1", "%.17g" % float(text))
        exact += ".0" if exact.isdigit() else ""
        tries = ["%.*g" % (digits, float(text)) for digits in (15, 16)]
        shorter = [t for t in tries if len(t) < len(exact) and float(t) == float(text)]
        assert text == (shorter + [exact])[0], (text, exact, shorter)
        count += 1
assert count == 9000, count
' <<<"$output"
}

@test "a zero byte in a line is that line's error" {
    run -4 --separate-stderr bash -c '{ printf "{\"id\": 1\0}\n"; echo "$1"; } | "$IMPINGE" batch -' \
        - "$(scene '"id": 2,')"
    valid result
    jq -es 'map(has("error")) == [true, false]' <<<"$output"
}

@test "options hold for every scene" {
    options=(--gamma 1e-3 --time 0,0.25)
    run -0 batch_lines "$(scene)" "$(scene '"gamma": 1e-5,')"
    jq -es 'all(.gamma == 1e-3 and .verdict == "clear")' <<<"$output"
}

@test "an option that does not fit one scene is that scene's error" {
    options=(--gamma-clear 1e-4)
    run -4 --separate-stderr batch_lines "$(scene '"gamma": 1e-5,')" "$(scene '"gamma": 1e-3,')" \
        '{}'
    jq -es 'map(has("error")) == [true, false, true]' <<<"$output"
    jq -es '.[0].error | contains("gamma_clear")' <<<"$output"
}

@test "the exit status is the greatest of all lines" {
    local clear
    clear=$(scene '"time": [0, 0.25],')
    options=(--exit-code)
    run -0 batch_lines "$clear" "$clear"
    run -1 batch_lines "$clear" "$(scene)" "$clear"
    options=(--exit-code --max-pairs 1)
    run -3 batch_lines "$clear" "$(scene)" "$clear"
    run -4 --separate-stderr batch_lines '{}' "$(scene)"
}

@test "each answer is out before the next line is read" {
    coproc "$IMPINGE" batch -
    local id pid=$COPROC_PID
    for id in 1 2; do
        scene "\"id\": $id," >&"${COPROC[1]}"
        read -r -t 20 output <&"${COPROC[0]}"
        json ".id == $id"
    done
    exec {COPROC[1]}>&-
    wait "$pid"
}

@test "a signal ends the line at work with what is proved, and reads no further" {
    { scene '"id": 1,' && echo '{"id": 2, "gamma": 1e-9, "bodies": [
        {"name": "a", "surfaces": [{"type": "superellipsoid"}]},
        {"name": "b", "surfaces": [{"type": "superellipsoid", "radii": [1.000000002,1.000000002,1.000000002]}]}]}' | tr -d '\n'
        echo && scene '"id": 3,'; } >scenes.jsonl
    interrupted 3 INT "$IMPINGE" batch scenes.jsonl --max-bytes 0
    valid result
    jq -es 'map(.id) == [1, 2] and .[1].reason == "cancelled"' <<<"$output"
    [[ $stderr == *'interrupted after line 2' ]]
}

@test "a signal ends the wait for the next line" {
    coproc "$IMPINGE" batch - 2>said
    local pid=$COPROC_PID status=0
    scene >&"${COPROC[1]}"
    read -r -t 20 output <&"${COPROC[0]}"
    kill -TERM "$pid"
    wait "$pid" || status=$?
    [ "$status" -eq 3 ]
    [[ $(<said) == *'interrupted after line 1' ]]
}

@test "output that cannot be written ends the batch" {
    [ -c /dev/full ] || skip 'no /dev/full'
    { scene && scene; } >scenes.jsonl
    run -4 --separate-stderr bash -c '"$IMPINGE" batch scenes.jsonl >/dev/full'
    [ "$stderr" = 'impinge: batch: standard output: No space left on device' ]
}

@test "files that cannot be read are named" {
    mkdir folder
    fails 4 'batch: nowhere.jsonl: No such file or directory' "$IMPINGE" batch nowhere.jsonl
    fails 4 'batch: folder: Is a directory' "$IMPINGE" batch folder
}

@test "a line without end is refused, and memory stays in bounds" {
    bash -c 'ulimit -v 300000; "$IMPINGE" --version' || skip 'sanitizers need more of it'
    run -4 --separate-stderr bash -c 'ulimit -v 300000; "$IMPINGE" batch /dev/zero'
    [[ $stderr == 'impinge: batch: /dev/zero: '* ]]
    run -4 --separate-stderr bash -c 'ulimit -v 300000; "$IMPINGE" solve - </dev/zero'
    [[ $stderr == 'impinge: solve: standard input: '* ]]
}

# --- Threads, shards, resuming ----------------------------------------------------------------

# many COUNT: scenes of unequal work, with ids, a blank line and one that is wrong among them.
many() {
    local k
    for ((k = 1; k <= $1; ++k)); do
        case $((k % 7)) in
        0) echo "{\"id\": $k, \"bodies\": 3}" ;;
        1) echo && scene "\"id\": $k, \"gamma\": 1e-9," ;;
        *) scene "\"id\": $k, \"gamma\": 1e-$((k % 7))," ;;
        esac
    done
}

without_seconds() { jq -c 'if .stats then del(.stats.seconds) else . end'; }

@test "answers are the same bytes in the same order for any number of threads" {
    many 100 >scenes.jsonl
    for threads in 1 2 3 16; do
        run -4 --separate-stderr "$IMPINGE" batch scenes.jsonl --threads "$threads"
        without_seconds <<<"$output" >"answers.$threads"
        cmp answers.1 "answers.$threads"
    done
    [ "$(jq -s 'map(.id) == [range(1; 101)]' answers.1)" = true ]
}

@test "shards divide the scenes among runs" {
    many 20 >scenes.jsonl
    run -4 --separate-stderr "$IMPINGE" batch scenes.jsonl
    without_seconds <<<"$output" | sort >whole
    for shard in 1/3 2/3 3/3; do
        run --separate-stderr "$IMPINGE" batch scenes.jsonl --shard "$shard"
        without_seconds <<<"$output"
    done | sort >parts
    cmp whole parts
    [ "$("$IMPINGE" batch scenes.jsonl --shard 2/8 2>/dev/null | jq -s -c 'map(.id)')" = '[2,10,18]' ]
}

@test "a shard that is none is refused with what it must be" {
    for shard in 0/3 4/3 3 1/0 -1/3 a/b 1/3x; do
        fails 2 "--shard: got '$shard', must be I/N with 1 <= I <= N" \
            "$IMPINGE" batch nowhere.jsonl --shard "$shard"
    done
}

@test "an output that was cut anywhere is resumed to the same bytes" {
    many 20 >scenes.jsonl
    run -4 --separate-stderr "$IMPINGE" batch scenes.jsonl --resume out
    [ -z "$output" ]
    without_seconds <out >whole
    [ "$(wc -l <out)" -eq 20 ]
    local size cut
    size=$(wc -c <out)
    for cut in 0 1 $((size / 3)) $((size / 2)) $((size - 1)) "$size"; do
        head -c "$cut" out >part
        run -4 --separate-stderr "$IMPINGE" batch scenes.jsonl --resume part
        without_seconds <part | cmp - whole
        [[ $stderr == *'2 of 23 lines could not be answered'* ]]
    done
}

@test "places of the output that were never written are torn too" {
    many 6 >scenes.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    without_seconds <out >whole
    { head -n 3 out && head -c 100 /dev/zero && tail -n 2 out; } >part
    "$IMPINGE" batch scenes.jsonl --resume part
    without_seconds <part | cmp - whole
}

@test "an output of other scenes is not resumed, and keeps its answers" {
    scene '"id": 1,' >scenes.jsonl
    { scene '"id": 2,' && scene '"id": 1,'; } >others.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    cp out before
    fails 4 'out, line 1: not the answer to that scene of the input' \
        "$IMPINGE" batch others.jsonl --resume out
    cmp out before
    fails 4 'scenes.jsonl: the output must not be the input' \
        "$IMPINGE" batch scenes.jsonl --resume scenes.jsonl
    fails 4 'folder/none/out: No such file or directory' \
        "$IMPINGE" batch scenes.jsonl --resume folder/none/out
}

@test "what a signal has cut short is solved again by a resumed run" {
    { scene '"id": 1,' && echo '{"id": 2, "gamma": 1e-9, "bodies": [
        {"name": "a", "surfaces": [{"type": "superellipsoid"}]},
        {"name": "b", "surfaces": [{"type": "superellipsoid", "radii": [1.000000002,1.000000002,1.000000002]}]}]}' | tr -d '\n'
        echo && scene '"id": 3,'; } >scenes.jsonl
    interrupted 3 INT "$IMPINGE" batch scenes.jsonl --max-bytes 0 --resume out
    [ "$(jq -s -c 'map(.id)' out)" = '[1]' ]
    run -3 --separate-stderr "$IMPINGE" batch scenes.jsonl --max-pairs 1000 --resume out
    [ "$(jq -s -c 'map(.id)' out)" = '[1,2,3]' ]
}

@test "an endless input is answered in constant memory" {
    bash -c 'ulimit -v 600000; "$IMPINGE" --version' || skip 'sanitizers need more of it'
    mkfifo scenes
    local hundreds
    hundreds=$(scaled 40) && hundreds=${hundreds%.*}
    { for ((k = 0; k < hundreds; ++k)); do many 100; done >scenes; } &
    run -4 --separate-stderr bash -c 'ulimit -v 600000; "$IMPINGE" batch scenes --threads 2 | wc -l;
        exit "${PIPESTATUS[0]}"'
    [ "$output" -eq "${hundreds}00" ]
}

@test "a plugin that crashes in a thread of the pool is named" {
    local plugins=$top_builddir/tests/plugins/.libs
    mkdir plugins
    cp "$plugins/eval_crashes.so" "$plugins/eval_overflows_stack.so" plugins
    local type
    for type in eval_crashes eval_overflows_stack; do
        echo "{\"bodies\": [{\"surfaces\": [{\"type\": \"$type\"}]}, {\"surfaces\": [{\"type\": \"sphere\"}]}]}" \
            >scenes.jsonl
        run -5 --separate-stderr "$IMPINGE" batch scenes.jsonl --threads 2 --plugin-path plugins
        [[ $stderr == *"crashed in the "*" of type '$type'"* ]]
    done
}
