#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Files that the command writes: links, devices and pipes stay what they are, a file that is not ours
# keeps every byte, and of two runs on one output the second is refused.

load ../support/cli_helper

drop='{"time": [0,0.5], "gravity": [0,0,-10], "bodies": [
    {"name": "floor", "surfaces": [{"type": "plane", "edge_u": [4,0,0], "edge_v": [0,4,0]}]},
    {"name": "ball", "mass": 1, "surfaces": [{"type": "sphere", "center": [2,2,2]}]}]}'

# Commands that take -o, each with a file of its own kind: name, ending.
writers='view svg
view png
view glb
view html
view obj
view vtu
plot svg
plot png
simulate json'

# writes VERB OUT [OPTION...]: a small output of that verb.
writes() {
    local verb=$1 to=$2
    shift 2
    case $verb in
    simulate) "$IMPINGE" simulate - -o "$to" "$@" <<<"$drop" ;;
    plot) "$IMPINGE" plot "$left" "$right" --slices 2 -o "$to" "$@" ;;
    view) "$IMPINGE" view "$left" "$right" --tolerance 0.5 --frames 2 -o "$to" "$@" ;;
    esac
}

# Runs BODY for each writer that this build has, with verb and ending set.
each_writer() { # BODY
    local verb ending
    while read -r verb ending; do
        writes "$verb" "probe.$ending" >/dev/null 2>&1 || [ "$ending" != png ] && [ "$ending" != html ] ||
            continue # without libpng or three.js
        rm -f "probe.$ending"
        "$1" || return 1
    done <<<"$writers"
}

# --- Links, devices, pipes -------------------------------------------------------------------------

through_links() {
    local name="$verb.$ending"
    mkdir -p far
    echo old >"far/old.$name"
    chmod 640 "far/old.$name"
    ln -sf "far/old.$name" "link.$name"
    ln -sf "link.$name" "chain.$name"
    ln -sf "far/new.$name" "dangling.$name"
    writes "$verb" "chain.$name"
    writes "$verb" "dangling.$name"
    [ -L "chain.$name" ] && [ -L "link.$name" ] && [ -L "dangling.$name" ]
    [ -s "far/new.$name" ]
    cmp <(head -c 4 "far/old.$name") <(head -c 4 "far/new.$name")
    [ "$(stat -c %a "far/old.$name")" = 640 ]
    [ -z "$(find . -name '*.part')" ]
}
@test "a symbolic link stays, and the file it leads to is written, in every format" {
    each_writer through_links
}

straight_through() {
    writes "$verb" "whole.$ending" >/dev/null
    local as=()
    [ "$verb" = simulate ] || as=(--format "$ending")
    local to
    for to in - /dev/stdout /dev/fd/1 /proc/self/fd/1; do
        writes "$verb" "$to" "${as[@]}" >shown
        cmp shown "whole.$ending"
        writes "$verb" "$to" "${as[@]}" | cmp - "whole.$ending"
    done
    writes "$verb" /dev/fd/7 "${as[@]}" 7>handed >/dev/null
    cmp handed "whole.$ending"
    writes "$verb" /dev/null "${as[@]}" >/dev/null
    [ -c /dev/null ]
    mkfifo pipe
    cat pipe >piped &
    writes "$verb" pipe "${as[@]}" >/dev/null
    wait $!
    cmp piped "whole.$ending"
    [ -p pipe ]
    rm pipe
}
@test "standard output, descriptors, devices and pipes are written straight through" {
    each_writer straight_through
}

@test "links to standard output and devices stay what they are" {
    mkdir dev
    ln -s /proc/self/fd/1 dev/out.svg
    ln -s /dev/null dev/null.svg
    writes view dev/out.svg >shown
    writes view dev/null.svg
    writes view whole.svg
    cmp shown whole.svg
    [ "$(readlink dev/out.svg)" = /proc/self/fd/1 ] && [ "$(readlink dev/null.svg)" = /dev/null ]
    [ "$(ls -A dev)" = $'null.svg\nout.svg' ]
}

@test "a circle of links, a folder, a descriptor that is closed and a collection in a pipe are refused" {
    ln -s one.svg two.svg
    ln -s two.svg one.svg
    fails 4 'one.svg: Too many levels of symbolic links' writes view one.svg
    mkdir folder.svg
    fails 4 'folder.svg: Is a directory' writes view folder.svg
    fails 4 '/dev/fd/77: Bad file descriptor' writes view /dev/fd/77 --format svg
    fails 2 '--output must be a file that ends with .pvd' writes view - --format pvd
    fails 2 'or --format say which' writes view /dev/null
}

@test "a file that may not be written is not replaced" {
    [ "$(id -u)" -ne 0 ] || skip 'root may write all files'
    echo old >mine.svg
    chmod 444 mine.svg
    fails 4 'mine.svg: Permission denied' writes view mine.svg
    [ "$(cat mine.svg)" = old ]
}

disk_full() {
    local as=()
    [ "$verb" = simulate ] || as=(--format "$ending")
    fails 4 "impinge: $verb: /dev/full: No space left on device" writes "$verb" /dev/full "${as[@]}"
}
@test "what is read is never the file that is written, whatever its name" {
    echo "$drop" >scene.json
    ln -s scene.json link.svg
    scene '"parameters": {"p": [0, 1]},' | jq -c '.bodies[0].maps[0].clock = "p"' >values.json
    scene >plain.json
    ln -s plain.json link.json
    local file
    for file in scene plain values; do cp $file.json $file.was; done
    refuse() { fails 2 "$1 is what is read, and would be overwritten" "$IMPINGE" "${@:2}"; }
    refuse "--output scene.json" simulate scene.json -o scene.json
    refuse "--output link.svg" view scene.json -o link.svg
    refuse "--output scene.json" view link.svg -o scene.json --format svg
    refuse "--output link.svg" plot scene.json -o link.svg
    refuse "--proof plain.json" solve plain.json --proof plain.json
    refuse "--proof plain.json" clearance link.json --proof plain.json
    refuse "--boxes values.json" solve values.json --boxes values.json
    refuse "--resume values.json" clearance values.json --resume values.json
    for file in scene plain values; do cmp $file.json $file.was; done
}

@test "a full disk is told in one true line by every writer" {
    [ -c /dev/full ] || skip 'no /dev/full'
    each_writer disk_full
}

# --- Two runs on one output ------------------------------------------------------------------------

# held FILE: another process writes FILE until the pipe `done` is opened; sets holder.
held() {
    [ "$PYTHON3" != no ] || skip 'no python3'
    mkfifo held done
    "$PYTHON3" -c 'import fcntl, sys
file = open(sys.argv[1], "w")
fcntl.lockf(file, fcntl.LOCK_EX)
open("held", "w").close()
open("done").close()' "$1" &
    holder=$!
    cat held >/dev/null
}

@test "a file that grows beyond its limit in the middle of a write is told truly, and not left" {
    limited() { bash -c 'trap "" XFSZ; ulimit -f 9; exec "$@"' - "$IMPINGE" "$@"; }
    local ending
    for ending in glb obj svg; do # 9 KiB of some hundred
        fails 4 "big.$ending: File too large" limited view "$left" "$right" -o "big.$ending"
        [ ! -e "big.$ending" ] && [ ! -e "big.$ending.part" ]
    done
}

@test "an output that another run is writing is refused, and the run named" {
    held out.svg.part
    fails 4 "view: out.svg: process $holder is writing it" writes view out.svg
    : >done
    wait "$holder"
    writes view out.svg # takes over the draft that was left
    [ "$(ls -A -- *svg*)" = out.svg ]
}

@test "of many runs on one output each leaves a whole file or is refused" {
    local pids=() pid status k
    for k in {1..8}; do
        writes simulate out.json >"said.$k" 2>&1 &
        pids+=($!)
    done
    for pid in "${pids[@]}"; do
        status=0
        wait "$pid" || status=$?
        [ "$status" -eq 0 ] || [ "$status" -eq 4 ]
    done
    jq -e '.events | length > 0' out.json
    [ -z "$(find . -name '*.part')" ]
    ! grep -h '^impinge' said.* | grep -v 'out.json: process [0-9]* is writing it'
}

@test "what is in the way of a draft, and may be a trap, is not written" {
    echo precious >other
    ln -s other out.svg.part
    fails 4 'out.svg.part: is in the way' writes view out.svg
    rm out.svg.part
    ln other out.svg.part
    fails 4 'out.svg.part: is in the way' writes view out.svg
    [ "$(cat other)" = precious ]
}

# --- Outputs that are resumed ------------------------------------------------------------------------

three() { for k in 1 2 3; do scene "\"id\": $k,"; done; }

# kept FILE TEXT COMMAND...: the command is refused with that text, and the file keeps every byte.
kept() {
    local file=$1
    shift
    cp "$file" before
    fails 4 "$@"
    cmp "$file" before
}

@test "a file that is no output of a batch keeps every byte" {
    three >scenes.jsonl
    printf 'no newline' >notes
    kept notes 'notes: its last line is no answer of a batch' \
        "$IMPINGE" batch scenes.jsonl --resume notes
    printf 'a line\nand no newline' >notes
    kept notes 'notes: its last line is no answer' "$IMPINGE" batch scenes.jsonl --resume notes
    printf 'a line\n' >notes
    kept notes 'notes, line 1: not the answer to that scene' \
        "$IMPINGE" batch scenes.jsonl --resume notes
    # A zero byte is a place that was never written only where there are results.
    printf '\177ELF\2\1\1\0\0\0\n' >notes
    kept notes 'notes: its last line is no answer' "$IMPINGE" batch scenes.jsonl --resume notes
    printf '\0\0\n' >notes
    kept notes 'notes: its last line is no answer' "$IMPINGE" batch scenes.jsonl --resume notes
    [ "$(echo notes*)" = notes ]
}

@test "an output that is refused keeps its last, unterminated line" {
    three >scenes.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    truncate -s -20 out
    { scene '"id": 7,' && three; } >others.jsonl
    kept out 'out, line 1: not the answer to that scene' "$IMPINGE" batch others.jsonl --resume out
    "$IMPINGE" batch scenes.jsonl --resume out
    [ "$(jq -s -c 'map(.id)' out)" = '[1,2,3]' ]
}

@test "an output with more answers than the input has scenes is refused" {
    three >scenes.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    head -n 2 scenes.jsonl >fewer.jsonl
    kept out 'out, line 3: the input has no scene for this line' \
        "$IMPINGE" batch fewer.jsonl --resume out
    head -n 2 out >part
    printf '{"id":3,"verd' >>part
    kept part 'part, line 3: the input has no scene for this line' \
        "$IMPINGE" batch fewer.jsonl --resume part
}

@test "answers made with other options are refused, and the option named" {
    three >scenes.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out --gamma 1e-3
    head -n 1 out >part
    cp out.options part.options
    kept part 'part: its answers were made with --gamma 1e-3, this run has --gamma 1e-6' \
        "$IMPINGE" batch scenes.jsonl --resume part --gamma 1e-6
    kept part 'part: its answers were made with --gamma 1e-3, this run has none' \
        "$IMPINGE" batch scenes.jsonl --resume part
    kept part 'part: its answers were made without --time, this run has --time 0,0.25' \
        "$IMPINGE" batch scenes.jsonl --resume part --gamma 1e-3 --time 0,0.25
    kept part 'part: its answers were made without --shard' \
        "$IMPINGE" batch scenes.jsonl --resume part --gamma 1e-3 --shard 1/2
    rm part.options # an output that was moved without it
    kept part 'part, line 1: the answer was asked for with another gamma' \
        "$IMPINGE" batch scenes.jsonl --resume part
    [ ! -e part.options ]
    "$IMPINGE" batch scenes.jsonl --resume part --gamma 1e-3 --threads 2 --max-pairs 1M
    [ "$(jq -s -c 'map([.id, .gamma])' part)" = '[[1,0.001],[2,0.001],[3,0.001]]' ]
    [ "$(jq -c .options part.options)" = '{"gamma":"1e-3"}' ]
}

@test "answers to another input whose scenes have no ids are refused" {
    { scene && scene; } >scenes.jsonl
    { scene '"gamma_clear": 1e-7,' && scene; } >others.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    kept out 'out: its answers were made from another input' \
        "$IMPINGE" batch others.jsonl --resume out
    { cat scenes.jsonl && scene; } | sed 's/$/\r/' >longer.jsonl # a line's end is not the scene's
    "$IMPINGE" batch longer.jsonl --resume out
    [ "$(wc -l <out)" -eq 3 ]
    jq -c 'del(.scene)' out.options >old && mv old out.options # a record of an earlier version
    "$IMPINGE" batch longer.jsonl --resume out
    [ "$(jq 'has("scene")' out.options)" = false ]
}

@test "an output that another batch is writing is refused, and the batch named" {
    three >scenes.jsonl
    mkfifo lines
    "$IMPINGE" batch lines --resume out &
    local first=$!
    exec 8>lines
    scene '"id": 1,' >&8
    until [ -s out ]; do sleep 0.05; done
    fails 4 "batch: out: process $first is writing it" "$IMPINGE" batch scenes.jsonl --resume out
    scene '"id": 2,' >&8
    exec 8>&-
    wait "$first"
    [ "$(jq -s -c 'map(.id)' out)" = '[1,2]' ]
    "$IMPINGE" batch scenes.jsonl --resume out
    [ "$(jq -s -c 'map(.id)' out)" = '[1,2,3]' ]
}

@test "of many batches on one output none spoils it" {
    for k in {1..40}; do scene "\"id\": $k,"; done >scenes.jsonl
    local pids=() pid status
    for _ in {1..8}; do
        "$IMPINGE" batch scenes.jsonl --resume out --threads 1 2>>said &
        pids+=($!)
    done
    for pid in "${pids[@]}"; do
        status=0
        wait "$pid" || status=$?
        [ "$status" -eq 0 ] || [ "$status" -eq 4 ]
    done
    "$IMPINGE" batch scenes.jsonl --resume out
    [ "$(jq -s 'map(.id) == [range(1; 41)]' out)" = true ]
}

@test "an output is resumed through a link, and needs to be a file" {
    three >scenes.jsonl
    ln -s far link
    "$IMPINGE" batch scenes.jsonl --resume link
    [ -L link ] && [ "$(wc -l <far)" -eq 3 ] && [ -f far.options ]
    for to in /dev/null - /dev/stdout; do
        fails 4 "$to: --resume needs a file" "$IMPINGE" batch scenes.jsonl --resume "$to"
    done
    fails 4 'batch: folder: ' "$IMPINGE" batch scenes.jsonl --resume "$(mkdir folder && echo folder)"
}

@test "a batch that cannot begin leaves no output behind" {
    three >scenes.jsonl
    run -4 "$IMPINGE" batch scenes.jsonl --resume out --isolate nowhere
    [ ! -e out ] && [ ! -e out.options ]
}
