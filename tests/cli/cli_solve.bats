#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge solve and impinge demo: scenes from files and from standard input.

load ../support/cli_helper

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
    json '.a.body == "left" and .b.body == "right" and .scene == "scene.json"'
    [ "$(jq -c 'del(.stats, .scene)' <<<"$output")" = \
        "$("$IMPINGE" solve - --gamma 1e-4 --json <scene.json | jq -c 'del(.stats, .scene)')" ]
}

@test "what the scene asks for is done" {
    run -0 solve_text "$(scene '"time": [0, 0.25], "gamma": 1e-3, "gamma_clear": 1e-5,')" --json
    json '.verdict == "clear" and .t_lower == 0.25 and .gamma == 1e-3 and .gamma_clear == 1e-5'
}

@test "options override what the scene asks for" {
    run -0 solve_text "$(scene '"time": [0, 0.25], "gamma": 1e-3, "gamma_clear": 1e-5,')" --json \
        --time 0,1 --gamma 1e-4 --gamma-clear 2e-5
    json '.verdict == "contact" and .gamma == 1e-4 and .gamma_clear == 2e-5'
}

@test "bodies that ignore each other are clear for that reason" {
    run -0 solve_text "$(bodies ', "ignore": [["a", "b"]]')" --json
    valid result
    json '.verdict == "clear" and .reason == "no-pairs"'
    run -0 solve_text "$(bodies ', "ignore": [["a", "b"]]')"
    [[ $output == *'there are no two bodies to test with each other'* ]]
}

# An arm of three links before a ball; in the second text each link spells out the maps of all joints
# below it.
arm() { # PARENTS
    local ball='{"name": "ball", "surfaces": [{"type": "sphere", "radius": 0.3}],
        "maps": [{"type": "translate", "offset": [[1,0.9,1.5]]}]}'
    local link='{"type": "cylinder", "radius": 0.2, "height": 1}' up='{"type": "translate", "offset": [[0,0,1]]}'
    local hip='{"type": "rotate", "axis": [0,0,1], "rate": 1.5}'
    local knee='{"type": "rotate", "axis": [0,1,0], "rate": 2}'
    if [ "$1" = parents ]; then
        echo '{"define": {"link": ['"$link"'], "knee": ['"$knee, $up"']}, "bodies": [
            {"name": "c", "group": "arm", "parent": "b", "surfaces": ["link"], "maps": ["knee"]},
            {"name": "b", "group": "arm", "parent": "a", "surfaces": ["link"], "maps": ["knee"]},
            {"name": "a", "group": "arm", "surfaces": ["link"], "maps": ['"$hip"']}, '"$ball"'],
            "ignore": [["arm", "arm"]]}'
    else
        echo '{"bodies": [
            {"name": "c", "surfaces": ['"$link"'], "maps": ['"$knee, $up, $knee, $up, $hip"']},
            {"name": "b", "surfaces": ['"$link"'], "maps": ['"$knee, $up, $hip"']},
            {"name": "a", "surfaces": ['"$link"'], "maps": ['"$hip"']}, '"$ball"'],
            "ignore": [["c", "b"], ["b", "a"], ["a", "c"]]}'
    fi
}

@test "many bodies that ignore each other are not asked about two by two" {
    ! has_sanitizers || skip 'they take processor time of their own'
    # 2e8 pairs, some 5 seconds of the processor if each is looked at
    jq -nc '{bodies: [range(20000) | {group: ["all"], surfaces: [{type: "sphere", radius: 0.4,
        center: [. % 100, 0, (. / 100 | floor)]}]}], ignore: [["all", "all"]]}' >many.json
    quickly() { run "-$1" bash -c 'ulimit -t 3; exec "$@"' - "$IMPINGE" "${@:2}" --json; }
    quickly 0 solve many.json
    json '.verdict == "clear" and .reason == "no-pairs"'
    quickly 0 solve many.json --each
    quickly 0 clearance many.json
    json '.lower == null and .reason == "no-pairs"'
    quickly 0 clearance many.json --each
    json '.pairs == []'
    # one more body that meets them all
    jq -c '.bodies += [{surfaces: [{type: "sphere", center: [50, 0, 50]}]}]' many.json >one.json
    quickly 0 solve one.json
    json '.verdict == "contact" and .a.body != .b.body and .t == 0'
}

@test "parents, definitions and groups mean what they stand for, bit for bit" {
    arm parents >mechanism.json
    run -0 solve_text "$(cat mechanism.json)" --gamma 1e-4 --json
    json '.verdict == "contact" and .a.body == "c" and .b.body == "ball"'
    # The scene as it is written differs, and max-bytes counts it.
    [ "$(jq -c 'del(.stats.seconds, .stats.bytes)' <<<"$output")" = \
        "$(solve_text "$(arm spelled-out)" --gamma 1e-4 --json | jq -c 'del(.stats.seconds, .stats.bytes)')" ]
    output=$(cat mechanism.json)
    valid scene
}

# --- Tables from files ------------------------------------------------------------------------

# One arm about the z axis, by a file: swing PARAMETERS.
swing() {
    echo '{"bodies": [{"name": "arm", "surfaces": [{"type": "sphere", "radius": 0.25, "center": [1,0,0]}],
        "maps": [{"type": "rotate", '"$1"'}]},
        {"name": "wall", "surfaces": [{"type": "sphere", "radius": 0.25, "center": [0,1,0]}]}]}'
}

@test "names of tables are relative to the scene file" {
    mkdir -p scenes/data
    printf '# in rad\ntime, q1, "q2"\n\n0,0,7\n 0.5,1e0,7\r\n1,2,7\n' | tr -d ' ' >scenes/data/joints.csv
    swing '"file": "data/joints.csv", "column": "q1"' >scenes/by_name.json
    sed 's/"q1"/"2"/' scenes/by_name.json >scenes/by_number.json
    sed 's/, "column": "q1"//' scenes/by_name.json >scenes/second.json
    run -0 "$IMPINGE" solve scenes/by_name.json --gamma 1e-6 --json
    json '.verdict == "contact" and .t > 0.5 and .t < 0.54'
    local answer
    answer=$(jq -c '[.t, .a, .b]' <<<"$output")
    for scene in by_number second; do
        [ "$("$IMPINGE" solve scenes/$scene.json --gamma 1e-6 --json | jq -c '[.t, .a, .b]')" = "$answer" ]
    done
    cd scenes
    [ "$("$IMPINGE" solve - --gamma 1e-6 --json <by_name.json | jq -c '[.t, .a, .b]')" = "$answer" ]
}

refuses_table() { # TABLE PARAMETERS SAYING
    printf "$1" >table.csv
    run -4 solve_text "$(swing "\"file\": \"table.csv\"$2")"
    [[ $output == *"/bodies/0/maps/0/"*"$3"* ]]
}

@test "tables that cannot be read are refused with line and column" {
    refuses_table 't,q\n0,0\n1,x\n' '' "'table.csv' line 3 column 2: found 'x', allowed is a number"
    refuses_table 't,q\n0,0\n1,nan\n' '' "found 'nan'"
    refuses_table 't,q\n0,0\n1,1e999\n' '' "found '1e999'"
    refuses_table 't,q\n0,0\n1\n' '' "line 3 has 1 column, line 1 has 2"
    refuses_table 't,q\n0,0\n1,1\n1,2\n' '' "1 after 1 (row 3 of the table); times must increase"
    refuses_table '0,0\n' '' "a table of 1 row; it must have two or more"
    refuses_table '' '' "a table of 0 rows"
    refuses_table 't,q\n0,0\n1,1\n' ', "column": "p"' "'p' is no column of 'table.csv'"
    refuses_table '0,0\n1,1\n' ', "column": "9"' "'9' is no column of 'table.csv'; it has no head, and columns 1 to 2"
    refuses_table '0,0\n1,1\n' ', "rate": 1' 'given beside rate'
    refuses_table '0,0\n1,1\n' ', "interpolation": "round"' 'allowed "linear" or "cubic"'
    refuses_table '0,0\n1,1\n' ', "velocities": [0,1]' 'velocities: belongs to times, which is missing'
    rm table.csv
    local -r rows='"times": [0,1], "angles": [0,1]'
    run -4 solve_text "$(swing "$rows"', "velocities": [0,1,2]')"
    [[ $output == *"/maps/0/velocities: 3 for 2 times; there must be one for each"* ]]
    run -4 solve_text "$(swing "$rows"', "accelerations": [0,1]')"
    [[ $output == *"/maps/0/accelerations: belongs to velocities, which is missing"* ]]
    run -4 solve_text "$(swing "$rows"', "velocities": [0,1], "interpolation": "cubic"')"
    [[ $output == *"given beside interpolation, which takes slopes from the values"* ]]
    run -4 solve_text "$(swing '"file": "table.csv"')"
    [[ $output == *"/bodies/0/maps/0/file: 'table.csv' cannot be read"* ]]
    mkdir table.csv
    run -4 solve_text "$(swing '"file": "table.csv"')"
    [[ $output == *"'table.csv' cannot be read"* ]]
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
    [[ ${lines[3]} == *'of "Kännchen "x""  u '* ]]
    [[ ${lines[4]} == *'of "b"             u '* ]]
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
    fails 4 '/bodies: got an array of 0' solve_text '{"bodies": []}'
    fails 4 'must be a scene' solve_text '[]'
}

@test "an unknown key is answered with the nearest" {
    fails 4 "/gama: unknown key, did you mean 'gamma'?" \
        solve_text "$(bodies ', "gama": 1')"
}

@test "a wrong value is answered with its JSON pointer" {
    fails 4 '/bodies/1/surfaces/0/center: ' solve_text "$(bodies | sed 's/5,0,0/5,0/')"
    fails 4 '/bodies/1/surfaces/0/type: ' solve_text "$(bodies | sed 's/"sphere", /"spere", /')"
    fails 4 '/gamma: got -1, must be > 0' solve_text "$(bodies ', "gamma": -1')"
    fails 4 '/time: got the empty interval' solve_text "$(bodies ', "time": [1, 0]')"
    fails 4 '/gamma_clear: ' solve_text "$(bodies ', "gamma_clear": 1')"
    fails 4 '/ignore/0/1: got "c"' solve_text "$(bodies ', "ignore": [["a", "c"]]')"
    fails 4 "/bodies/1/name: got the name 'a'" solve_text "$(bodies | sed 's/"b"/"a"/')"
}

@test "a NURBS surface whose cells would fill the memory is refused at once, with the limit" {
    nurbs_scene() { # POINTS DEGREE
        jq -nc --argjson n "$1" --argjson p "$2" '
            ([range($p + 1) | 0] + [range(1; $n - $p)] + [range($p + 1) | $n - $p]) as $knots |
            {bodies: [{surfaces: [{type: "nurbs", degree: [$p, $p], knots_u: $knots, knots_v: $knots,
                points: [range($n) as $i | range($n) | [$i, ., 0]]}]},
                {surfaces: [{type: "sphere", center: [5,5,0]}]}]}'
    }
    nurbs_scene 300 20 >large.json
    run -4 timeout 60 "$IMPINGE" solve large.json
    [[ $output == *'/bodies/0/surfaces/0/points: 280 x 280 spans of degree 20 x 20 would take '*' MiB, must be at most 1024 MiB: give a lower degree'* ]]
    nurbs_scene 300 1 >low.json
    run -0 "$IMPINGE" solve low.json
    [[ $output == contact* ]]
}

@test "the schema of scenes takes what solve takes and refuses what it refuses" {
    output=$(bodies) && valid scene
    output=$(scene '"id": 1, "note": "x", "reference": {}, "time": [0,1], "gamma_clear": 0,')
    valid scene
    for output in '{}' '{"bodies": []}' '[]' "$(bodies ', "gama": 1')" "$(bodies ', "time": [1]')" \
        "$(bodies ', "gamma": 0')" "$(bodies ', "ignore": [["a"]]')"; do
        run ! valid scene
    done
}

# --- Demo -------------------------------------------------------------------------------------------

@test "the demo's teapot meets the torus, by its spout" {
    run -0 "$IMPINGE" demo teapot --json
    valid result
    json '.verdict == "contact" and .gap <= 1e-2 and .gamma == 1e-2'
    # By dense sampling of both surfaces: 0.048 apart at t = 0.52, crossing before 0.54.
    json '.t > 0.52 and .t < 0.53'
    json '.a.body == "teapot" and (.a.surface | IN(16, 17, 18, 19)) and .b.body == "torus"'
}

@test "demo teapot tells what it does, the answer, and the command to repeat it" {
    run -0 "$IMPINGE" demo teapot
    [[ ${lines[0]} == *'Utah teapot (M. Newell 1975'* ]]
    [[ $output == *'contact at t = 0.52'*'surface '*' of "teapot"  u '*' v '*'gap '* ]]
    local path=${lines[-1]##* }
    [ "${lines[-1]}" = "  impinge solve $path" ]
    run -0 "$IMPINGE" solve "$path" --json
    [ "$(jq -c 'del(.stats, .scene)' <<<"$output")" = \
        "$("$IMPINGE" demo teapot --json | jq -c 'del(.stats, .scene)')" ]
}

@test "the demo finds by proof what no frame shows, and writes what is to be looked at" {
    run -0 "$IMPINGE" demo
    [[ $output == *'16 moments, 60 frames a second: no contact.'* ]]
    [[ $output == *'contact at t = 0.201'*'Between the frames'*'o'*'|  contact, t = 0.201'* ]]
    [[ $output == *'impinge-demo.'*' surfaces to within 0.000'*'Try next:'*'impinge demo teapot'* ]]
    [ -s impinge-demo.png ] || [ -s impinge-demo.svg ]
    [[ $output != *impinge-demo.html* ]] || [ -s impinge-demo.html ]
    local command count=0
    impinge() { "$IMPINGE" "$@"; }
    while read -r command; do
        eval "$command" >/dev/null
        count=$((count + 1))
    done < <(sed '1,/^Try next:/d' <<<"$output")
    [ "$count" -eq 5 ]
    run -0 "$IMPINGE" demo --json
    valid result
    json '.verdict == "contact" and .a.body == "blade" and .b.body == "sheet"'
}

@test "at each frame of the demo blade and sheet are far apart, by a search of their own" {
    without_sanitizers
    local frame t
    for frame in 0 5 10 12 13 15; do
        t=$(jq -n "$frame / 60")
        run -0 "$IMPINGE" solve "$top_srcdir/tools/data/blade.json" --time "$t,$t" --gamma 0.02 --json
        json '.verdict == "clear"'
    done
}

@test "a demonstration there is not is refused, and so is a folder that cannot be written to" {
    fails 2 "unknown demonstration 'kettle'; there are blade, teapot" "$IMPINGE" demo kettle
    run -4 --separate-stderr "$IMPINGE" demo --output nowhere
    [[ $stderr == "impinge: demo: nowhere/impinge-demo."*": No such file or directory" ]]
}

@test "the teapot's scene is one file, as the schema says" {
    output=$(cat "$top_srcdir/tools/data/teapot.json")
    valid scene
    json '.bodies[0].surfaces | length == 32'
    json '.note | contains("Newell")'
    cmp "$top_srcdir/tools/data/teapot.json" "$top_builddir/tools/built-data/teapot.json"
}

# --- Errors and numbers for programs -----------------------------------------------------------

@test "with --json an error is an object too, and on standard error as always" {
    echo '{"bodies": 7}' >bad.json
    for verb in solve; do
        run -4 --separate-stderr "$IMPINGE" $verb bad.json --json
        jq -e 'keys == ["error"] and (.error | contains("bad.json"))' <<<"$output"
        [[ $stderr == "impinge: $verb: bad.json"* ]]
    done
    run -4 --separate-stderr "$IMPINGE" pair spher sphere --json
    valid result
    jq -e '.error | contains("sphere")' <<<"$output"
}

@test "numbers have the fewest digits that read back exactly" {
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0 ! translate velocity=-1.1,0,0' --gamma 0.1 \
        --gamma-clear 0.7e-1 --json
    [[ $output == *'"gamma":0.1,"gamma_clear":0.07,'* ]]
    local text=$output number
    for number in $(grep -oE '[-0-9][-+.0-9eE]*' <<<"${text%%\"scene\"*}"); do
        python3 -c "import sys; s = sys.argv[1]; \
            sys.exit(len(s.lstrip('-')) > len(repr(float(s)).lstrip('-')) + 2)" "$number"
    done
}

@test "names with quotes and digits come through as they are" {
    echo '{"bodies": [{"name": "1.50\\\"e7", "surfaces": [{"type": "sphere"}]},
        {"name": "0.10000000000000001", "surfaces": [{"type": "sphere", "center": [2.5,0,0]}],
         "maps": [{"type": "translate", "velocity": [-1,0,0]}]}]}' >names.json
    run -0 "$IMPINGE" solve names.json --json
    json '.a.body == "1.50\\\"e7" and .b.body == "0.10000000000000001"'
}

@test "who reads the first line only is told nothing of the rest" {
    local status
    (set +o pipefail; trap '' PIPE; for _ in 1 2 3; do "$IMPINGE" list --json; "$IMPINGE" help; done |
        head -n 1 >/dev/null) 2>told
    "$IMPINGE" list 2>>told | true
    [ ! -s told ]
}

@test "reading counts in --max-seconds" {
    local verb
    scene >scene.json
    for verb in solve 'solve --each' clearance 'clearance --each' 'clearance --profile 3'; do
        # shellcheck disable=SC2086 # words on purpose
        run -3 --separate-stderr bash -c '"$@" < <(sleep 1.5; cat scene.json)' - \
            "$IMPINGE" $verb - --max-seconds 1 --json
        [[ $output == *'"max-seconds"'* ]]
        # shellcheck disable=SC2086 # words on purpose
        run --separate-stderr bash -c '"$@" < <(sleep 0.1; cat scene.json)' - \
            "$IMPINGE" $verb - --max-seconds 60 --json
        [[ $output != *'"max-seconds"'* && $status -ne 3 ]]
    done
}

@test "a body without surfaces is a frame for its children" {
    local ball='{"name": "ball", "surfaces": [{"type": "sphere"}], "parent": "joint"}'
    local wall='{"name": "wall", "surfaces": [{"type": "plane", "origin": [3,-5,-5], "edge_u": [0,10,0], "edge_v": [0,0,10]}]}'
    local maps='"maps": [{"type": "translate", "velocity": [4,0,0]}]'
    for frame in "{\"name\": \"joint\", $maps}" "{\"name\": \"joint\", \"surfaces\": [], $maps}"; do
        echo "{\"bodies\": [$frame, $ball, $wall]}" >frame.json
        jq . frame.json >/dev/null
        run -0 "$IMPINGE" solve frame.json --json
        json '.verdict == "contact" and (.t - 0.5 | fabs) < 1e-5 and .a.body == "ball" and .b.body == "wall"'
        run -0 "$IMPINGE" clearance frame.json --each --json
        json '.pairs | length == 1'
        run -0 "$IMPINGE" solve frame.json --each --json
        json '.bodies == ["ball", "wall"]'
        "$IMPINGE" view frame.json -o frame.svg 2>/dev/null || "$IMPINGE" view frame.json -o frame.png
    done
    echo '{"bodies": [{"name": "alone"}]}' >alone.json
    run -0 "$IMPINGE" solve alone.json --json
    json '.verdict == "clear" and .reason == "no-pairs"'
}

@test "a scene may require versions of plugins" {
    local wanted text
    for wanted in '">= 0.1"' '">=0.1.0,<1"' '"> 0.1.0-rc1"' '"== 0.1"' '"<= 00.1.0.0"'; do
        scene "\"plugins\": {\"sphere\": $wanted, \"translate\": \">= 0\"}," >pinned.json
        run -0 "$IMPINGE" solve pinned.json --gamma 1e-3 --json
    done
    while read -r wanted text; do
        scene "\"plugins\": $wanted," >pinned.json
        fails 4 "$text" "$IMPINGE" solve pinned.json
    done <<'END'
{"sphere":">=0.2"} /plugins/sphere: found version 0.1.0 in
{"sphere":">=0.1,<0.1.0"} must be < 0.1.0; install such a version
{"sphere":">0.1"} must be > 0.1
{"sphere":">=10"} must be >= 10
{"spheer":">=0"} did you mean 'sphere'?
{"sphere":"0.1"} must be comparisons with >=, >, ==, < or <= and a version
{"sphere":">=0.1,"} must be comparisons
{"sphere":1} must be a text such as
["sphere"] must be an object of plugins' names and versions
END
}
