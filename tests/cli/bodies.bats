#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Types that are a whole body in one line: box, capsule, disc, and cylinder and cone with their ends.

load ../support/cli_helper

# meets BODY POINT DIRECTION DISTANCE PIECE: a ball of radius 0.1 that starts at POINT and moves along
# the unit vector DIRECTION touches BODY after that way, at that piece.
meets() {
    run -0 "$IMPINGE" pair "$1" "sphere radius=0.1 center=$2 ! translate velocity=$3" --time 0,9 --gamma 1e-7 --json
    jq -e --argjson way "$4" --argjson piece "$5" \
        '.verdict == "contact" and (.t - $way | fabs) < 1e-6 and .a.piece == $piece' <<<"$output"
}

# misses BODY POINT DIRECTION
misses() {
    run -0 "$IMPINGE" pair "$1" "sphere radius=0.1 center=$2 ! translate velocity=$3" --time 0,9 --json
    json '.verdict == "clear"'
}

@test "a box is met at each of its faces" {
    local box='box size=2,4,6 center=1,2,3' # from 0,0,0 to 2,4,6
    meets "$box" -3,1,1 1,0,0 2.9 0
    meets "$box" 5,1,1 -1,0,0 2.9 1
    meets "$box" 1,-3,1 0,1,0 2.9 2
    meets "$box" 1,7,1 0,-1,0 2.9 3
    meets "$box" 1,1,-3 0,0,1 2.9 4
    meets "$box" 1,1,9 0,0,-1 2.9 5
    misses "$box" -3,4.11,1 1,0,0
    run -0 "$IMPINGE" clearance "$box" 'sphere radius=1 center=5,7,6' --json
    json '(.lower <= 3.2426406871192855) and (.upper >= 3.2426406871192847) and .upper - .lower < 0.01'
}

@test "a capsule is met at its side and at both ends" {
    local capsule='capsule radius=0.5 from=1,0,0 to=4,0,0'
    meets "$capsule" 2,3,0 0,-1,0 2.4 0
    meets "$capsule" -3,0,0 1,0,0 3.4 1
    meets "$capsule" 8,0,0 -1,0,0 3.4 2
    # along a slanted axis, (3,0,4) / 5: the end is 5.5 from the start
    meets 'capsule radius=0.5 from=0,0,0 to=3,0,4' 6,0,8 -0.6,0,-0.8 4.4 2
    misses "$capsule" 2,3,0.61 0,-1,0
    # the same point twice: a sphere
    run -0 "$IMPINGE" pair 'capsule radius=0.5 from=1,1,1 to=1,1,1' 'sphere radius=0.1 center=1,1,4 ! translate velocity=0,0,-1' \
        --time 0,9 --gamma 1e-7 --json
    json '.verdict == "contact" and (.t - 2.4 | fabs) < 1e-6'
}

@test "a disc is met within its radius only, whatever its axis" {
    run -0 "$IMPINGE" pair 'disc radius=2 center=0,0,1' 'sphere radius=0.1 center=1.9,0,3 ! translate velocity=0,0,-1' \
        --time 0,9 --gamma 1e-7 --json
    json '.verdict == "contact" and (.t - 1.9 | fabs) < 1e-6'
    misses 'disc radius=2 center=0,0,1' 2.11,0,3 0,0,-1
    run -0 "$IMPINGE" pair 'disc radius=2 axis=3,0,4' 'sphere radius=0.1 center=3,0,4 ! translate velocity=-0.6,0,-0.8' \
        --time 0,9 --gamma 1e-7 --json
    json '.verdict == "contact" and (.t - 4.9 | fabs) < 1e-6'
}

@test "cylinder and cone are closed where ends are asked for, and else as they were" {
    misses cylinder 0,0,4 0,0,-1
    meets 'cylinder ends=true' 0.5,0,4 0,0,-1 2.9 2
    meets 'cylinder ends=true' 0.5,0,-4 0,0,1 2.9 1
    meets 'cylinder ends=true' 4,0,0 -1,0,0 2.9 0
    misses cone 0,0,-1 0,0,0.12
    meets 'cone ends=true height=2 center=0,0,1' 0.5,0,-3 0,0,1 3.9 1
    run -0 "$IMPINGE" pair cylinder 'sphere center=3,0,0 ! translate velocity=-1,0,0' --time 0,2 --json
    json '.a | has("piece") | not'
}

@test "a ring that one piece of a cylinder is concentric to meets another piece" {
    local ring='torus major_radius=2 minor_radius=0.25' at
    for at in -0.3 0.1 0.3; do
        run -0 "$IMPINGE" pair "$ring" "cylinder ends=true height=1 center=0.76,0,$at" --time 0,0 --json
        json '.verdict == "contact"'
        run -0 "$IMPINGE" clearance "$ring" "cylinder ends=true height=1 center=0.76,0,$at" --time 0,0 --json
        json '.lower == 0 and .upper < 1e-6'
    done
}

@test "the answers of isolated types are the same" {
    local type
    for type in cylinder 'cylinder ends=true' 'box size=2,2,2'; do
        "$IMPINGE" pair "$type" 'sphere center=3,0,0 ! translate velocity=-1,0,0' --time 0,2 --json |
            jq -c 'del(.stats.seconds)' >plain
        "$IMPINGE" pair "$type" 'sphere center=3,0,0 ! translate velocity=-1,0,0' --time 0,2 --json --isolate all |
            jq -c 'del(.stats.seconds)' >isolated
        diff <(jq 'del(.stats)' plain) <(jq 'del(.stats)' isolated)
    done
}

@test "check finds nothing to refute in these types" {
    without_sanitizers
    for type in box capsule disc cylinder cone 'cylinder ends=true' 'cone ends=true height=-2' \
        'extrusion ends=true' \
        'capsule from=1,2,3 to=1,2,3' 'disc axis=0,-2,0'; do
        run -0 "$IMPINGE" check "$type" --effort 0.1 --json
    done
}

@test "an extrusion is met at its side and at both ends, and holds what is in it" {
    local bar='extrusion profile=[[1,0],[1,1],[-1,1],[-1,-1],[1,-1],[1,0]] degree=1 vector=0,0,4 ends=true'
    meets "$bar" 5,0.5,2 -1,0,0 3.9 0
    meets "$bar" 0.3,5,2 0,-1,0 3.9 1
    meets "$bar" 5,-0.5,2 -1,0,0 3.9 4
    meets "$bar" 0.7,0.2,-3 0,0,1 2.9 5
    meets "$bar" 0.2,0.6,7 0,0,-1 2.9 11
    misses "$bar" 5,1.11,2 -1,0,0
    bar='extrusion profile=[[1,0],[1,2],[-1,2],[-1,-2],[1,-2],[1,0]] degree=2 vector=0,0,4 ends=true'
    meets "$bar" 5,0,2 -1,0,0 3.9 0
    meets "$bar" 0,0,-3 0,0,1 2.9 1
    meets "$bar" 0,0,7 0,0,-1 2.9 2
}

@test "an extrusion of degree 1 is closed by flat pieces, wherever its points are repeated" {
    scene='{"bodies": [{"name": "bar", "solid": true, "surfaces": [{"type": "extrusion", "degree": 1,
        "profile": [[1,0.1],[0.3,1.7],[0.3,1.7],[-1.1,1],[-1,-1],[1,-1],[1,0.1]], "vector": [0.3,0.1,4.7],
        "ends": true}]}, {"name": "pea", "surfaces": [{"type": "sphere", "radius": 0.1, "center": [0.1,0,2]}]}]}'
    echo "$scene" >bar.json
    run -0 "$IMPINGE" info bar.json
    [[ $output == *'bar: 1 surface of 15 pieces, solid, closed'* ]]
    run -0 "$IMPINGE" solve bar.json --json
    json '.kind == "inside"'
    sed 's/0.1,0,2/0.1,9,2/' bar.json >beside.json
    run -0 "$IMPINGE" solve beside.json --json
    json '.verdict == "clear"'
    local square='[[1,1],[-1,1],[-1,-1],[1,-1],[1,1]] degree=1'
    run -0 "$IMPINGE" pair "extrusion profile=$square ends=true ! rotate axis=1,2,3 angle=[0.7]" \
        "extrusion profile=$square vector=0,0,3 ! scale factor=1.001,1.001,1 ! translate offset=[[0,0,-1]] ! \
rotate axis=1,2,3 angle=[0.7]" --gamma 1e-4 --json
    json '.verdict == "clear" and .stats.pairs < 50'
}

@test "an extrusion whose last point misses the first by rounding is closed" {
    bar='{"bodies": [{"name": "bar", "solid": true, "surfaces": [{"type": "extrusion", "degree": DEGREE,
        "profile": [[1,0.1],[0.3,1.7],[-1.1,1],[-1,-1],[1,-1],[1,LAST]], "ends": true}]}]}'
    for degree in 1 2; do
        sed "s/LAST/0.10000000000000002/; s/DEGREE/$degree/" <<<"$bar" >bar.json
        run -0 "$IMPINGE" info bar.json
        [[ $output == *' solid, closed'* ]]
        sed "s/LAST/0.1000001/; s/DEGREE/$degree/" <<<"$bar" >open.json
        fails 4 'ends at [1,0.1000001], must end at its first point, [1,0.1]' "$IMPINGE" info open.json
    done
}

@test "who is inside a solid body at the start is in contact, for each verb" {
    scene='{"bodies": [{"name": "pot", "solid": true, "surfaces": [{"type": "box", "size": [4,4,4]}]},
        {"name": "pea", "surfaces": [{"type": "sphere", "radius": 0.1, "center": [1,0,0]}]}]}'
    echo "$scene" >scene.json
    run -0 "$IMPINGE" solve scene.json
    [[ $output == *'"pea" is inside "pot"'* && $output == *'"pot", which is solid, holds'* ]]
    run -0 "$IMPINGE" solve scene.json --json
    json '.verdict == "contact" and .kind == "inside" and .t == 0 and .gap == 0 and .a.surface == null
        and .a.u == null and .b.surface == 0 and .a.point == .b.point and .normal == null'
    run -0 "$IMPINGE" solve scene.json --each --json
    json '.kind == "inside" and .bodies == ["pot", "pea"]'
    run -0 "$IMPINGE" clearance scene.json --json
    json '.lower == 0 and .upper == 0 and .kind == "inside"'
    run -0 "$IMPINGE" clearance scene.json --each
    run -1 "$IMPINGE" clearance scene.json --require 0.1 --json
    json '.verdict == "violated" and .t_violated == 0'
    run -0 "$IMPINGE" clearance scene.json --profile 2 --json
    json '[.slices[] | .lower == 0 and .upper == 0] | all'
    tr -d '\n' <scene.json | run -0 "$IMPINGE" batch -
    json '.kind == "inside"'
    run -0 "$IMPINGE" view scene.json -o scene.obj
    jq '.bodies[1] += {"mass": 1}' scene.json >heavy.json
    run -4 "$IMPINGE" simulate heavy.json -o motion.json
    [[ $output == *'one is inside the other, which is solid'* ]]
    sed 's/true/1/' scene.json >wrong.json
    run -4 "$IMPINGE" solve wrong.json
    [[ $output == *'/bodies/0/solid: got 1, must be true or false'* ]]
}

@test "info tells which bodies of a scene are closed" {
    scene='{"bodies": [{"name": "pot", "solid": true, "surfaces": [{"type": "box"}]},
        {"name": "pipe", "surfaces": [{"type": "cylinder"}]}, {"name": "frame"}]}'
    echo "$scene" >scene.json
    run -0 "$IMPINGE" info scene.json
    [[ ${lines[0]} == 'pot: 1 surface of 6 pieces, solid, closed' ]]
    [[ ${lines[1]} == 'pipe: 1 surface, open at ('*'), an edge of surface 0, piece 0' ]]
    [[ ${lines[2]} == 'frame: 0 surfaces, empty' ]]
    run -0 "$IMPINGE" info scene.json --json
    json '[.bodies[].closure] == ["closed", "open", "empty"] and .bodies[0].solid'
    run -4 "$IMPINGE" info nothing.json
}
