#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# --progress: how far a run is, for programs; nothing where nobody asked.

load ../support/cli_helper

@test "one search tells its pairs, its queue and what is proved so far" {
    run -0 --separate-stderr "$IMPINGE" pair "$left" "$right" --progress=json
    jq -es 'length >= 1 and all(has("seconds") and has("t_lower") and .pairs >= 0 and .heap >= 0 and
        .lower == null)' <<<"$stderr"
    [[ $output == contact* ]]
}

@test "a minimum distance tells its bracket" {
    run -3 --separate-stderr "$IMPINGE" clearance "${endless[@]}" --max-pairs 100K --progress json
    jq -es 'length >= 1 and (.[-1] | has("lower") and has("upper"))' <<<"$stderr"
}

@test "answers are counted, the last count being all of them" {
    "$top_builddir"/tests/support/crowd_scene 20 1 >crowd.json
    run -0 --separate-stderr "$IMPINGE" solve crowd.json --each --progress json
    jq -es '.[-1] | .of == "pairs of bodies" and .done == .total and .done > 0' <<<"$stderr"
    { scene '"id": 1,' && echo && scene '"id": 2,' && scene '"id": 3,'; } >scenes.jsonl
    run -0 --separate-stderr "$IMPINGE" batch scenes.jsonl --progress json
    jq -es '.[-1] | .of == "scenes" and .done == 3 and .total == 3' <<<"$stderr"
    run -0 --separate-stderr "$IMPINGE" batch scenes.jsonl --progress json --shard 2/2
    jq -es '.[-1] | .done == 1 and .total == 1 and .left == 0' <<<"$stderr"
}

@test "what an earlier run answered is done, and a stream has no total" {
    { scene '"id": 1,' && scene '"id": 2,'; } >scenes.jsonl
    "$IMPINGE" batch scenes.jsonl --resume out
    head -n 1 out >part
    run -0 --separate-stderr "$IMPINGE" batch scenes.jsonl --resume part --progress json
    jq -es '.[0].done == 1 and .[-1].done == 2 and .[-1].total == 2' <<<"$stderr"
    run -0 --separate-stderr "$IMPINGE" batch - --progress json <scenes.jsonl
    jq -es '.[-1] | .done == 2 and .total == null and .left == null' <<<"$stderr"
}

@test "nothing is told unless it is asked for, or there is a terminal" {
    scene >scenes.jsonl
    for how in '' --progress=none --progress=auto; do
        run -0 --separate-stderr "$IMPINGE" batch scenes.jsonl $how
        [ -z "$stderr" ]
    done
    fails 2 "--progress must be one of auto, json, none, not 'xml'" "$IMPINGE" batch scenes.jsonl \
        --progress xml
}
