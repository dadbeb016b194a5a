#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What impinge simulate makes of scenes: mass properties, wrong scenes, numbers that overflow.

load ../support/simulate_helper

@test "mass properties of closed surfaces, and of several together" {
    cat >mass.json <<'END'
{"bodies": [{"name": "ring", "mass": 2, "surfaces": [{"type": "torus", "major_radius": 3, "minor_radius": 1}]},
 {"name": "box", "mass": 6, "surfaces": [
  {"type": "plane", "origin": [0,0,9], "edge_u": [0,3,0], "edge_v": [2,0,0]},
  {"type": "plane", "origin": [0,0,10], "edge_u": [2,0,0], "edge_v": [0,3,0]},
  {"type": "plane", "origin": [0,0,9], "edge_u": [2,0,0], "edge_v": [0,0,1]},
  {"type": "plane", "origin": [0,3,9], "edge_u": [0,0,1], "edge_v": [2,0,0]},
  {"type": "plane", "origin": [0,0,9], "edge_u": [0,0,1], "edge_v": [0,3,0]},
  {"type": "plane", "origin": [2,0,9], "edge_u": [0,3,0], "edge_v": [0,0,1]}]}]}
END
    simulated mass.json
    near '.bodies[0].volume' '2 * 9.869604401089358 * 3'
    near '.bodies[0].inertia[2][2]' '2 * (9 + 0.75)'
    near '.bodies[0].inertia[0][0]' '2 * (9 / 2 + 5 / 8)'
    near '.bodies[1].volume' 6
    near '.bodies[1].center[2]' 9.5
    near '.bodies[1].inertia[0][0]' '0.5 * (9 + 1)'
    near '.bodies[1].inertia[2][2]' '0.5 * (9 + 4)'
    jq '.bodies[1].surfaces[0] |= (.edge_u as $u | .edge_u = .edge_v | .edge_v = $u)' mass.json >flipped.json
    simulated flipped.json # which side is outside is found
    near '.bodies[1].volume' 6
    near '.bodies[1].inertia[2][2]' '0.5 * (9 + 4)'
    jq 'del(.bodies[1].surfaces[0])' mass.json >open.json
    fails 4 '/bodies/1/surfaces: found an open surface' "$IMPINGE" simulate open.json -o out.json
    [[ $stderr == *'give "inertia" and "center"'* ]]
}

# body SURFACE...: a scene with one body of mass 1, of these surfaces.
body() {
    local IFS=,
    echo "{\"time\": [0,0.01], \"bodies\": [{\"name\": \"body\", \"mass\": 1, \"surfaces\": [$*]}]}"
}

# A box of 1 x 2 x 3 as a mesh: box_mesh FACES.
box_mesh() {
    body "{\"type\": \"mesh\", \"faces\": $1, \"points\": [[0,0,0],[0,0,3],[0,2,0],[0,2,3],[1,0,0],[1,0,3],[1,2,0],[1,2,3]]}"
}

# is_box: the last answer has the mass properties of that box.
is_box() {
    near '.bodies[0].volume' 6
    json '.bodies[0] | [.center, [0.5, 1, 1.5]] | transpose | all(.[]; .[0] - .[1] | fabs < 1e-12)'
    near '.bodies[0].inertia[0][0]' '(4 + 9) / 12' && near '.bodies[0].inertia[2][2]' '(1 + 4) / 12'
}

@test "closed meshes have an inside, whatever the order of their corners" {
    local quads='[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]'
    box_mesh "$quads" >box.json
    simulated box.json && is_box
    # Some faces the other way round; triangles; each triangle with points of its own, as in STL.
    jq -c '.bodies[0].surfaces[0].faces |= [.[0], (.[1,2] | reverse), .[3], (.[4] | reverse), .[5]]' box.json >mixed.json
    simulated mixed.json && is_box
    jq -c '.bodies[0].surfaces[0].faces |= [.[] | [.[0,1,2]], [.[0,2,3]]]' box.json >triangles.json
    simulated triangles.json && is_box
    jq -c '.bodies[0].surfaces[0] |= (.points as $p | .points = [.faces[][] | $p[.]]
        | .faces = [range(0; .points | length; 3) | [., . + 1, . + 2]])' triangles.json >soup.json
    simulated soup.json && is_box
    box_mesh "$(jq -c '.[1:]' <<<"$quads")" >open.json
    fails 4 '/bodies/0/surfaces: found an open surface' "$IMPINGE" simulate open.json -o out.json
    body '{"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}' >tetrahedron.json
    simulated tetrahedron.json
    near '.bodies[0].volume' '1 / 6'
}

@test "a torus of triangles in an STL file has an inside" {
    jq -n -r 'def torus($i; $j): ($i / 20 * 3.141592653589793) as $u | ($j / 12 * 3.141592653589793) as $v |
        "vertex \((2 + ($v | cos) / 2) * ($u | cos)) \((2 + ($v | cos) / 2) * ($u | sin)) \(($v | sin) / 2)";
        def facet: "facet normal 0 0 0", "outer loop", .[], "endloop", "endfacet";
        "solid torus", (range(40) as $i | range(24) as $j |
            [torus($i; $j), torus($i + 1; $j), torus($i + 1; $j + 1), torus($i; $j + 1)]
            | (.[0:3] | facet), ([.[0,2,3]] | facet)), "endsolid torus"' >torus.stl
    body '{"type": "mesh", "file": "torus.stl"}' >torus.json
    simulated torus.json
    # The polygon of 40 corners around the ring, of 24 around the tube.
    json '.bodies[0].volume / (2 * 3.141592653589793 * 3.141592653589793 * 2 * 0.25) - 1 | . < 0 and . > -0.02'
}

@test "a cylinder with caps of any kind is closed, and so are halves that meet along parts of edges" {
    body '{"type": "cylinder"}' '{"type": "revolution", "profile": [[0,-1],[1,-1]]}' >one_cap.json
    fails 4 'found an open surface' "$IMPINGE" simulate one_cap.json -o out.json
    body '{"type": "cylinder"}' '{"type": "revolution", "profile": [[0,-1],[1,-1]]}' \
        '{"type": "formula", "x": "u*cos(v)", "y": "u*sin(v)", "z": "1", "domain": [[0,1],[0.7,6.983185307179586]]}' >capped.json
    simulated capped.json
    near '.bodies[0].volume' '2 * 3.141592653589793'
    near '.bodies[0].inertia[2][2]' 0.5 && near '.bodies[0].inertia[0][0]' '(3 + 4) / 12'
    # A box whose top is of two planes.
    plane() { echo "{\"type\": \"plane\", \"origin\": [$1], \"edge_u\": [$2], \"edge_v\": [$3]}"; }
    body "$(plane 0,0,0 1,0,0 0,2,0)" "$(plane 0,0,3 1,0,0 0,0.5,0)" "$(plane 0,0.5,3 0,1.5,0 1,0,0)" \
        "$(plane 0,0,0 1,0,0 0,0,3)" "$(plane 0,2,0 1,0,0 0,0,3)" "$(plane 0,0,0 0,2,0 0,0,3)" "$(plane 1,0,0 0,2,0 0,0,3)" >parts.json
    simulated parts.json && is_box
}

@test "a shell inside another is a cavity, beside it a part; a surface without inside is refused" {
    body '{"type": "sphere"}' '{"type": "sphere", "radius": 0.5, "center": [0.1,0,0]}' >hollow.json
    simulated hollow.json
    near '.bodies[0].volume' '4 / 3 * 3.141592653589793 * (1 - 0.125)'
    near '.bodies[0].center[0]' '-0.0125 / 0.875'
    body '{"type": "sphere"}' '{"type": "sphere", "radius": 0.5, "center": [3,0,0]}' >two.json
    simulated two.json
    near '.bodies[0].volume' '4 / 3 * 3.141592653589793 * (1 + 0.125)'
    near '.bodies[0].center[0]' '0.375 / 1.125'
    # Klein's bottle.
    body '{"type": "formula", "domain": [[0,6.283185307179586],[0,6.283185307179586]],
        "x": "(2+cos(u/2)*sin(v)-sin(u/2)*sin(2*v))*cos(u)",
        "y": "(2+cos(u/2)*sin(v)-sin(u/2)*sin(2*v))*sin(u)", "z": "sin(u/2)*sin(v)+cos(u/2)*sin(2*v)"}' >klein.json
    fails 4 'found a surface without an inside' "$IMPINGE" simulate klein.json -o out.json
}

# wrong TEXT FILTER: the scene changed so is refused with that text, and nothing is written.
wrong() {
    jq "$2" good.json >wrong.json
    rm -f out.json
    fails 4 "$1" "$IMPINGE" simulate wrong.json -o out.json
    [ ! -e out.json ]
}

@test "wrong scenes are refused, with the place and the cure" {
    echo "{\"gravity\": [0,0,-10], \"bodies\": [$floor}, $(ball ball 2 0,0,1.5)]}" >good.json
    simulated good.json
    wrong '/bodies/1/mass: got -1.0, must be a number greater than 0' '.bodies[1].mass = -1'
    wrong '/bodies/1/mass: got "heavy", must be a number' '.bodies[1].mass = "heavy"'
    wrong '/bodies/1/restitution: got 1.5, must be a number from 0 to 1' '.bodies[1].restitution = 1.5'
    wrong '/bodies/0/friction: got -1.0, must be a number from 0 to 1e+100' '.bodies[0].friction = -1'
    wrong '/bodies/1/velocity: got [1.0,2.0], must be three numbers' '.bodies[1].velocity = [1,2]'
    wrong '/gravity: got [], must be three numbers' '.gravity = []'
    wrong '/bodies/1/inertia: got 7.0, must be three rows' '.bodies[1].inertia = 7'
    wrong 'must be symmetric' '.bodies[1].inertia = [[1,0.5,0],[0,1,0],[0,0,1]]'
    wrong 'must be positive definite' '.bodies[1].inertia = [[1,2,0],[2,1,0],[0,0,1]]'
    wrong "did you mean 'restitution'" '.bodies[1].restitutoin = 0.5'
    wrong "did you mean 'gravity'" '.gravty = [0,0,1] | del(.gravity)'
    wrong "the bodies 'floor' and 'ball' are nearer than gamma_clear" '.bodies[1].surfaces[0].center[2] = 0.4'
    wrong '/bodies/0/spin: found on a body without "mass"' '.bodies[0].spin = [0,0,1]'
    wrong 'no body has a "mass"' 'del(.bodies[1].mass)'
    wrong '/bodies/1/parent: found on a body with a mass' '.bodies[1].parent = "floor"'
    wrong 'which has a mass; must be a body without' '.bodies[0].parent = "ball"'
    fails 4 'No such file' "$IMPINGE" simulate missing.json -o out.json
    fails 4 'No such file' "$IMPINGE" simulate good.json -o missing/out.json
    fails 2 '--output FILE is missing' "$IMPINGE" simulate good.json
    fails 2 'would be overwritten' "$IMPINGE" simulate good.json -o ./good.json
    fails 2 'must be less than gamma' "$IMPINGE" simulate good.json -o out.json --gamma-clear 1
    echo '{"bodies": [' >broken.json
    fails 4 'broken.json:' "$IMPINGE" simulate broken.json -o out.json
}

@test "other verbs refuse a motion that is not computed, and ignore masses" {
    echo "{\"bodies\": [$floor}, $(ball ball 2 0,0,1.5)]}" >still.json
    run -0 "$IMPINGE" solve still.json
    jq '.bodies[1].velocity = [0,0,-1]' still.json >moving.json
    fails 4 '/bodies/1/velocity: velocity needs `impinge simulate` first; pass its output here' "$IMPINGE" solve moving.json
    run -0 "$IMPINGE" simulate moving.json -o out.json
    run -0 "$IMPINGE" solve out.json --gamma 5e-7 --gamma-clear 4e-7
    [ "${lines[0]}" = clear ]
    run -0 "$IMPINGE" view out.json --tolerance 0.02 -o out.svg
    run -0 "$IMPINGE" view out.json --tolerance 0.02 --frames 3 -o out.html
    [ -s out.svg ] && [ -s out.html ]
}

# overflows PLACE FILTER: the scene changed so is refused with that place, and nothing is written.
overflows() { wrong "wrong.json: $1: " "$2"; }

@test "numbers that would overflow are refused with their place, before anything is written" {
    echo "{\"bodies\": [$floor}, $(ball ball 2 0,0,1.5 '"velocity": [1,0,0], "spin": [0,1,2],')]}" >good.json
    overflows /bodies/1/mass '.bodies[1].mass = 1e300'
    overflows /bodies/1/mass '.bodies[1].mass = 1e-300'
    overflows /bodies/1/mass '.bodies[1] |= (.mass = 1e90 | .surfaces[0].radius = 1e20)'
    overflows /bodies/1/spin '.bodies[1].spin = [0,0,1e300]'
    overflows /bodies/1/spin '.time = [0,1e9]'
    overflows /bodies/1/velocity '.bodies[1].velocity[0] = 1e200'
    overflows /bodies/1/inertia '.bodies[1].inertia = [[1e300,0,0],[0,1e300,0],[0,0,1e300]]'
    overflows /bodies/1/friction '.bodies[1].friction = 1e300'
    overflows /gravity '.gravity = [0,0,-1e300]'
    overflows /time '.time = [0,1e308]'
    overflows /time '.time = [-1e308,1e308]'
    # What each number allows, all of them do not.
    overflows /bodies/1 '.time = [0,1e99] | .bodies[1] |= (.spin = [0,0,0] | .velocity = [100,0,0])'
    overflows /bodies/1 '.gravity = [0,0,-1e99] | .time = [0,10]'
    # The greatest of all together: energies stay finite.
    jq '.time = [0,1e-60] | .bodies[1] |= (.mass = 1e100 | .velocity = [1e100,1e100,0] | .spin = [0,1e50,1e50])' good.json >great.json
    simulated great.json
    json '[.. | numbers | isinfinite or isnan] | any | not'
}
