#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Plugins that crash, and plugins whose answers break the ABI: the search ends and names them.

load ../support/host_helper

# --- Crashes ------------------------------------------------------------------------------------
# blames TYPE TEXT [OPTION]...: the pair of TYPE and the ball ends with status 5 and this message.
blames() { fails 5 "$2" pair "$1" "$ball" "${@:3}"; }

@test "a crash, an exit or a stack used up is laid at the door of type and callback" {
    takes create_crashes domain_crashes eval_crashes eval_aborts eval_exits eval_overflows_stack
    blames create_crashes "crashed in the create of type 'create_crashes';"
    blames domain_crashes "crashed in the domain of type 'domain_crashes';"
    blames eval_crashes "crashed in the eval of type 'eval_crashes';"
    blames eval_aborts "crashed in the eval of type 'eval_aborts';"
    blames eval_exits "type 'eval_exits' ends the process in its eval;"
    blames eval_overflows_stack "crashed in the eval of type 'eval_overflows_stack';"
    run -5 --separate-stderr pair eval_crashes "$ball" --json
    [[ $stderr == "impinge: crashed in the eval of type 'eval_crashes';"* ]]
    valid result
    json --arg said "${stderr#impinge: }" '.error == $said'
    still_works
}

@test "isolated, the same cost an error that names the point, and so does a hang" {
    takes create_crashes domain_crashes eval_crashes eval_exits eval_hangs eval_overflows_stack
    blames create_crashes "a: create of 'create_crashes' ($PWD/plugins/create_crashes.so) crashes" \
        --isolate all
    blames domain_crashes "domain_crashes.so) crashes or ends its process" --isolate all
    blames 'eval_crashes height=.25' \
        "type 'eval_crashes height=0.25' at u = 0, v = 0, t = 0: crashes or ends" --isolate all
    blames eval_exits "type 'eval_exits' at u = 0, v = 0, t = 0: crashes or ends" --isolate eval_exits
    blames eval_overflows_stack "type 'eval_overflows_stack' at u = 0" --isolate all
    blames eval_hangs "type 'eval_hangs' at u = 0, v = 0, t = 0: does not answer within 5 s" \
        --isolate eval_hangs
}

@test "what a batch has answered before a crash is not lost" {
    takes eval_crashes
    {
        scene '"id": 1,'
        sed 's/sphere", "center": \[-2,0,0\]/eval_crashes"/' < <(scene '"id": 2,')
    } >scenes.jsonl
    # with one thread line 1 is answered before line 2 begins
    run -5 --separate-stderr "$IMPINGE" batch scenes.jsonl --threads 1 --plugin-path "$PWD/plugins"
    [[ $stderr == *"crashed in the eval of type 'eval_crashes'"* ]]
    valid result
    [ "$(jq .id <<<"$output")" = 1 ]
}

# --- Lies ---------------------------------------------------------------------------------------
whole='over u [-1, 1], v [-1, 1], t [0, 1]'

@test "create that fails, gives nothing or changes the arithmetic is named with its file" {
    takes create_fails create_null create_rounds
    blames create_fails "a: create failed with status 4: bug in plugin type 'create_fails' ($PWD/plugins/"
    blames create_null "a: create returned IMP_STATUS_OK without an instance: bug in plugin type 'create_null' ("
    blames create_rounds "a: create changed the mode of arithmetic: bug in plugin type 'create_rounds' ("
    still_works
}

@test "a domain that is none, or changes the arithmetic, ends the query" {
    takes domain_nan domain_rounds
    blames domain_nan "domain_nan.so) has a domain that is empty, NaN, or infinite in u or v"
    blames domain_rounds "domain_rounds.so) changes the floating-point mode of its caller"
    blames domain_rounds "domain_rounds.so) changes the floating-point mode" --isolate all
}

@test "pieces that are none, too many, missing or of other times end the query; those in order are named" {
    takes pieces pieces_none pieces_many pieces_null pieces_times pieces_half
    blames pieces_none "pieces_none.so) gives a piece_count that is 0 or above IMP_PIECES_MAX"
    blames pieces_many "pieces_many.so) gives a piece_count that is 0 or above IMP_PIECES_MAX"
    blames pieces_null "pieces_null.so) gives NULL for one of its pieces"
    blames pieces_null "pieces_null.so) gives NULL for one of its pieces" --isolate all
    blames pieces_many "pieces_many.so) gives a piece_count that is 0 or above" --isolate all
    blames pieces_times "pieces_times.so) has pieces whose domains differ in time"
    run -0 list --json
    left_out pieces_half.so 'pieces_half: piece is NULL; give piece_count and piece, or neither'
    local way
    for way in '' '--isolate all'; do
        # shellcheck disable=SC2086 # words on purpose
        run -0 pair pieces 'sphere radius=.25 center=.3,.2,3.5 ! translate velocity=0,0,-1' --json $way
        json '.verdict == "contact" and .a.piece == 2 and (.b | has("piece") | not) and .t > 0.62 and .t < 0.63'
    done
}

@test "points that are no numbers end the query and name body, type, parameters and point" {
    takes eval_nan_late eval_error_negative
    blames 'eval_nan_late height=.1' "body 'a', surface 0: type 'eval_nan_late height=0.1' at u = "
    run -0 pair eval_nan_late 'sphere radius=.5 center=.3,.2,.8' --time 0,.4 --json
    json '.verdict == "contact" and .t < 0.31'
    blames eval_error_negative "type 'eval_error_negative' at u = "
    run -5 --separate-stderr pair 'eval_nan_late' 'sphere radius=.5 center=.3,.2,1' --time .7,.9
    [[ $stderr == *"type 'eval_nan_late'"*'t = 0.'*'eval gives a point that is infinite or NaN' ]]
}

@test "bounds that are infinite, negative or inverted end the query and name the region" {
    takes rate_infinite rate_negative include_inverted include_negative
    blames 'rate_infinite height=.5' "type 'rate_infinite height=0.5' $whole: a rate is negative"
    blames rate_negative "body 'a', surface 0: type 'rate_negative' $whole: a rate is negative"
    blames include_inverted "type 'include_inverted' $whole: the range is inverted"
    blames include_negative "type 'include_negative' $whole: the remainder is negative"
    local type
    for type in rate_infinite rate_negative; do
        blames $type "type '$type' $whole: " --method paper
    done
    still_works
}

@test "bounds that break the ABI do not hide behind a map, nor do a map's behind a surface" {
    takes rate_negative include_inverted include_negative map_rate_negative
    local type turned='rotate axis=1,1,1 rate=.7'
    for type in rate_negative include_inverted include_negative; do
        blames "$type ! $turned" "type '$type ! rotate axis=1,1,1 rate=0.7' $whole: a r"
    done
    blames 'sphere radius=.1 ! map_rate_negative' \
        "type 'sphere radius=0.1 ! map_rate_negative' over u [0, "
    blames "sphere ! map_rate_negative ! $turned" 'a rate is negative, infinite or NaN'
    blames 'sphere ! map_rate_negative' 'negative' --method paper
}

@test "lies that the search meets end it, and --audit finds the others" {
    takes include_lies rate_lies
    local ball='sphere radius=.5 center=.3,.2,.9' # which the half of its speed meets, too
    blames include_lies "body 'a', surface 0: type 'include_lies' breaks its own bounds $whole: at u = "
    blames 'rate_lies height=.5' "type 'rate_lies height=0.5' breaks its own bounds $whole: at u = " --audit
    blames include_lies "breaks its own bounds" --audit
    still_works
}

@test "control nets that break the ABI end the query, and --audit finds those that points refute" {
    takes net_nan liar_net
    blames net_nan "type 'net_nan' over u [0, 4], v [0, 4], t [0, 1]: a control net has too many points"
    blames liar_net "type 'liar_net' breaks its control net over u [" --audit
}

@test "poses that break the ABI end the query, and --audit finds those that points refute" {
    takes mistakes_pose
    blames 'torus center=2,0,1 ! pose_depends_on_u' "! pose_depends_on_u' over t [0, 1]: a pose depends on more than time"
    blames 'torus center=2,0,1 ! pose_turns_backward' 'breaks its own bounds over u ['
    blames 'torus center=2,0,1 ! pose_turns_backward' 'breaks its own bounds over u [0, ' --audit
}

@test "distances that break the ABI end the query, and --audit finds those that points refute" {
    takes distance_nan distance_infinite liar_distance liar_distance_remainder liar_truthful_distance
    # Its type gives no distance, so that the other's is asked for.
    local type within='superellipsoid radii=.98,.97,.5 exponents=1,1 center=0,0,1 ! rotate rate=3'
    for type in distance_nan distance_infinite; do
        fails 5 "type '$type': a distance from it has a remainder that is negative or NaN, or" \
            pair $type "$within" --gamma 1e-3
    done
    for type in liar_distance liar_distance_remainder; do
        fails 5 "type '$type' claims too large a distance over u [" pair $type "$within" --gamma 1e-3 --audit
    done
    run -0 pair liar_truthful_distance "$within" --gamma 1e-3 --audit --json
    json '.verdict == "clear"'
}

@test "a symmetry that breaks the ABI ends the query" {
    takes symmetry_nan liar_truthful_symmetry
    local within='cylinder radius=.98 height=1 center=.01,0,1 ! rotate rate=3'
    fails 5 "type 'symmetry_nan': its symmetry has an unknown kind, a center or an axis that is not finite" \
        pair symmetry_nan "$within" --gamma 1e-3
    run -0 pair liar_truthful_symmetry "$within" --gamma 1e-3 --json
    json '.verdict == "clear" and .stats.pairs < 40'
}

@test "distances and symmetries that lie where the search asks are found by --audit" {
    takes mistakes_distance
    local ring='bezier degree=[1,1] points=[[50,-1,0],[50,-1,2],[50,1,0],[50,1,2]] ! rotate axis=0,0,1 rate=2'
    local ball='sphere radius=0.15 center=0.9,0,1 ! rotate axis=0,0,1 times=0,1 angles=3.5,7'
    run -0 pair symmetry_half "$ball" --json
    json '.verdict == "clear"' # wrongly
    fails 5 "type 'symmetry_half' is not as symmetric as it says: the distance from a surface that does not turn claims at least" \
        pair symmetry_half "$ball" --audit
    clearance() { "$IMPINGE" clearance --plugin-path "$PWD/plugins" "$@"; }
    fails 5 "type 'distance_farther' claims too large a distance: distance claims at least" \
        clearance distance_farther "$ring" --audit
    clearance distance_no_mistake "$ring" --json | jq 'del(.stats)' >plain
    clearance distance_no_mistake "$ring" --json --audit | jq 'del(.stats)' >audited
    cmp plain audited
}

@test "distances under rigid maps are held against points too" {
    takes liar_distance liar_truthful_distance
    local maps='! rotate axis=1,2,3 angle=0.7 ! translate velocity=1,2,3'
    local within="cylinder radius=.99 height=1 center=0,0,1 ! rotate rate=3 $maps"
    fails 5 "type 'liar_distance ! rotate axis=1,2,3 angle=0.7 ! translate velocity=1,2,3' claims too large a distance" \
        pair "liar_distance $maps" "$within" --gamma 1e-3 --audit
    run -0 pair "liar_truthful_distance $maps" "$within" --gamma 1e-3 --audit --json
    json '.verdict == "clear"'
}

@test "distances are asked for at times at which the surface exists" {
    takes pipe_absent
    run -0 pair pipe_absent 'cylinder radius=.99 height=1 center=0,0,1 ! rotate rate=3' --gamma 1e-3 --json
    json '.verdict == "clear" and .t_examined == [0.25, 0.5]'
}

@test "callbacks that change the arithmetic end the query" {
    takes eval_rounds include_rounds
    blames eval_rounds "type 'eval_rounds' at u = 0, v = 0, t = 0: changes the floating-point mode"
    blames include_rounds "type 'include_rounds' $whole: changes the floating-point mode"
}

@test "a scene with a liar has no answer, and one that ignores it answers as ever" {
    takes include_inverted
    scene >good.json
    sed 's/"bodies": \[/&{"name": "liar", "surfaces": [{"type": "include_inverted"}]},/' good.json >bad.json
    fails 5 "body 'liar', surface 0: type 'include_inverted'" \
        "$IMPINGE" solve bad.json --plugin-path "$PWD/plugins"
    run -0 "$IMPINGE" solve good.json --plugin-path "$PWD/plugins" --json
    json '.verdict == "contact"'
}
