#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge solve and impinge demo: scenes from files and from standard input.

load cli_helper

solve_text() { # TEXT [OPTION]...
    local text=$1
    shift
    "$IMPINGE" solve - "$@" <<<"$text"
}

# Two bodies of one sphere each, with more keys behind them: bodies [KEYS].
bodies() {
    echo '{"bodies": [{"name": "a", "surfaces": [{"type": "sphere"}]},' \
        '{"name": "b", "surfaces": [{"type": "sphere", "center": [5,0,0]}]}]'"${1-}}"
}

# --- Answers ------------------------------------------------------------------------------------

@test "a scene file and the same scene on standard input have the same answer" {
    scene >scene.json
    run -0 "$IMPINGE" solve scene.json --gamma 1e-4 --json
    valid result
    json '.verdict == "contact" and .t >= 0.4999 and .t <= 0.5'
    json '.a.body == "left" and .b.body == "right"'
    [ "$(jq -c 'del(.stats)' <<<"$output")" = \
        "$("$IMPINGE" solve - --gamma 1e-4 --json <scene.json | jq -c 'del(.stats)')" ]
}

@test "what the scene asks for is done" {
    run -0 solve_text "$(scene '"time": [0, 0.25], "gamma": 1e-3, "clearance": 1e-5,')" --json
    json '.verdict == "clear" and .t_lower == 0.25 and .gamma == 1e-3 and .gamma_clear == 1e-5'
}

@test "options override what the scene asks for" {
    run -0 solve_text "$(scene '"time": [0, 0.25], "gamma": 1e-3, "clearance": 1e-5,')" --json \
        --time 0,1 --gamma 1e-4 --clearance 2e-5
    json '.verdict == "contact" and .gamma == 1e-4 and .gamma_clear == 2e-5'
}

@test "bodies that ignore each other are clear for that reason" {
    run -0 solve_text "$(bodies ', "ignore": [["a", "b"]]')" --json
    valid result
    json '.verdict == "clear" and .reason == "no-pairs"'
    run -0 solve_text "$(bodies ', "ignore": [["a", "b"]]')"
    [[ $output == *'there are no two bodies to test with each other'* ]]
}

@test "a surface of several is named by its place in the body" {
    run -0 solve_text '{"gamma": 1e-3, "bodies": [
        {"name": "many", "surfaces": [{"type": "sphere", "center": [0,9,0]},
            {"type": "sphere", "center": [0,0,9]}, {"type": "sphere"}]},
        {"name": "one", "surfaces": [{"type": "sphere", "center": [3,0,0]}],
            "maps": [{"type": "translate", "velocity": [-2,0,0]}]}]}' --json
    json '.a.body == "many" and .a.surface == 2 and .b.body == "one" and .b.surface == 0'
}

@test "names of bodies may be any line of text, and columns still stand below each other" {
    local text='{"gamma": 1e-3, "bodies": [{"name": "Kännchen \"x\"", "surfaces": [{"type": "sphere"}]},
        {"name": "b", "surfaces": [{"type": "sphere"}]}]}'
    run -0 solve_text "$text" --json
    valid result
    json '.a.body == "Kännchen \"x\""'
    run -0 solve_text "$text"
    [[ ${lines[2]} == *'of "Kännchen "x""  u '* ]]
    [[ ${lines[3]} == *'of "b"             u '* ]]
    fails 4 '/bodies/0/name' solve_text "${text/x/\\n}"
}

# --- Wrong scenes ---------------------------------------------------------------------------------

@test "a missing file is named" {
    fails 4 'solve: nowhere.json: cannot be read: No such file or directory' \
        "$IMPINGE" solve nowhere.json
}

@test "a directory is no scene" {
    mkdir folder
    fails 4 'folder: cannot be read: Is a directory' "$IMPINGE" solve folder
}

@test "a closed standard input is an error" {
    fails 4 'standard input: ' bash -c '"$IMPINGE" solve - <&-'
}

@test "bad JSON is answered with line and column" {
    printf '{\n "bodies": [}\n' >bad.json
    fails 4 'solve: bad.json:2:' "$IMPINGE" solve bad.json
    fails 4 'solve: standard input:2:' "$IMPINGE" solve - <bad.json
}

@test "an empty scene is refused" {
    fails 4 'is empty' solve_text ''
    fails 4 '/bodies: found an array of 0' solve_text '{"bodies": []}'
    fails 4 'allowed a scene' solve_text '[]'
}

@test "an unknown key is answered with the nearest" {
    fails 4 "/gama: found an unknown key, did you mean 'gamma'?" \
        solve_text "$(bodies ', "gama": 1')"
}

@test "a wrong value is answered with its JSON pointer" {
    fails 4 '/bodies/1/surfaces/0/center: ' solve_text "$(bodies | sed 's/5,0,0/5,0/')"
    fails 4 '/bodies/1/surfaces/0/type: ' solve_text "$(bodies | sed 's/"sphere", /"spere", /')"
    fails 4 '/gamma: found -1, allowed > 0' solve_text "$(bodies ', "gamma": -1')"
    fails 4 '/time: found the empty interval' solve_text "$(bodies ', "time": [1, 0]')"
    fails 4 '/clearance: ' solve_text "$(bodies ', "clearance": 1')"
    fails 4 '/ignore/0/1: found "c"' solve_text "$(bodies ', "ignore": [["a", "c"]]')"
    fails 4 "/bodies/1/name: found the name 'a'" solve_text "$(bodies | sed 's/"b"/"a"/')"
}

@test "the schema of scenes takes what solve takes and refuses what it refuses" {
    output=$(bodies) && valid scene
    output=$(scene '"id": 1, "note": "x", "reference": {}, "time": [0,1], "clearance": 0,')
    valid scene
    for output in '{}' '{"bodies": []}' '[]' "$(bodies ', "gama": 1')" "$(bodies ', "time": [1]')" \
        "$(bodies ', "gamma": 0')" "$(bodies ', "ignore": [["a"]]')"; do
        run ! valid scene
    done
}

# --- Demo -------------------------------------------------------------------------------------------

@test "the demo's teapot meets the torus, by its spout" {
    run -0 "$IMPINGE" demo --json
    valid result
    json '.verdict == "contact" and .gap <= 1e-2 and .gamma == 1e-2'
    # By dense sampling of both surfaces: 0.048 apart at t = 0.52, crossing before 0.54.
    json '.t > 0.52 and .t < 0.53'
    json '.a.body == "teapot" and (.a.surface | IN(16, 17, 18, 19)) and .b.body == "torus"'
}

@test "the demo tells what it does, the answer, and the command to repeat it" {
    run -0 "$IMPINGE" demo
    [[ ${lines[0]} == *'Utah teapot (M. Newell 1975'* ]]
    [[ $output == *'contact at t = 0.52'*'surface '*' of "teapot"  u '*' v '*'gap '* ]]
    local path=${lines[-1]##* }
    [ "${lines[-1]}" = "The same by hand:  impinge solve $path" ]
    run -0 "$IMPINGE" solve "$path" --json
    [ "$(jq -c 'del(.stats)' <<<"$output")" = "$("$IMPINGE" demo --json | jq -c 'del(.stats)')" ]
}

@test "the demo's scene is one file, as the schema says" {
    output=$(cat "$top_srcdir/tools/data/teapot.json")
    valid scene
    json '.bodies[0].surfaces | length == 32'
    json '.note | contains("Newell")'
    cmp "$top_srcdir/tools/data/teapot.json" "$top_builddir/tools/built-data/teapot.json"
}
