#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge simulate: contact along faces and edges, rest, stacks, and energy that no event raises.

load ../support/simulate_helper

# box NAME "X,Y,Z" [KEYS]: a unit cube of quads, a mesh, about that point.
box() {
    jq -cn --arg name "$1" --argjson at "[$2]" --argjson keys "{${3-}}" '{name: $name, mass: 1, restitution: 0.5,
        friction: 0.5, surfaces: [{type: "mesh", faces: [[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]],
        points: [[-0.5,0.5] as $x | $x[] as $i | $x[] as $j | $x[] as $k | [$at[0] + $i, $at[1] + $j, $at[2] + $k]]}]} + $keys'
}

# falls TIME BODY...: a scene with these bodies above the floor.
falls() {
    local IFS=, time=$1
    shift
    echo "{\"time\": [0,$time], \"gravity\": [0,0,-10], \"bodies\": [$floor}, $*]}"
}

# all_rest: every body rests at the end, and the whole time was simulated.
all_rest() { json '.reason == null and (.bodies | all(.rests)) and .momentum.end == [0,0,0]'; }

# no_gain: no event raises the kinetic energy, nor does anything between events raise that and the
# potential energy together; entries of one time are parts of one event.
no_gain() {
    json '.events | length > 0 and all(.energy[1] <= .energy[0] * (1 + 1e-12))
        and (group_by(.t) | all(map(.energy) | unique | length == 1))'
    json '((.energy.start + 1) * (1e-9 + .substep_error)) as $rounding
        | .energy | .lost >= 0 and (.drift | fabs) <= $rounding and .end <= .start + $rounding'
}

@test "a box that lands flat touches with four corners, rises flat, and comes to rest" {
    falls 2 "$(box box 0,0,1)" >flat.json
    simulated flat.json
    all_rest
    no_gain
    json '.events[0] | .kind == "impact" and (.manifold | length) == 4 and .normal == [0,0,1]
        and (.manifold | map(.[0:2] | map(fabs - 0.5 | fabs) | max) | max) < 1e-6'
    near '.events[0].impulse[2]' '1.5 * (10 | sqrt)' # m (1 + e) sqrt(2 g h)
    near '.events[0].point[0]' 0
    near '.events[0].point[1]' 0
    json '.events[-1] | .kind == "resting" and .held == "box"'
    json '.events | length < 30'
    # It has not turned.
    [ "$(jq '.bodies[1].maps[0].rotations // [[1,0,0,0]] | last | .[0] > 1 - 1e-9' out.json)" = true ]
    never_nearer
    # A picture finds the contact of the two faces soon.
    run -0 "$IMPINGE" view out.json -o flat.svg --max-seconds 60
    grep -q "contact: t = 0.316" flat.svg
}

@test "boxes of six planes, solids on their faces, and rings come to rest" {
    local shape cap='"type": "revolution", "profile": [[0'
    for shape in '{"type": "cylinder", "height": 1, "radius": 0.5}, {'"$cap"',-0.5],[0.5,-0.5]]}, {'"$cap"',0.5],[0.5,0.5]]}' \
        '{"type": "torus", "major_radius": 0.6, "minor_radius": 0.2}' \
        '{"type": "superellipsoid", "radii": [0.5,0.5,0.5], "exponents": [0.2,0.2]}' \
        '{"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}'; do
        falls 2 "{\"name\": \"a\", \"mass\": 1, \"restitution\": 0.4, \"surfaces\": [$shape],
            \"maps\": [{\"type\": \"translate\", \"offset\": [[0,0,0.8]]}]}" >shape.json
        simulated shape.json
        all_rest
        no_gain
        json '.events[0].manifold | length >= 3'
    done
}

@test "a cylinder on its side touches along a line" {
    local cap='"type": "revolution", "profile": [[0'
    falls 2 '{"name": "roller", "mass": 1, "restitution": 0.3, "friction": 0.4, "maps": [
        {"type": "rotate", "axis": [1,0,0], "angle": [1.5707963267948966]}, {"type": "translate", "offset": [[0,0,0.7]]}],
        "surfaces": [{"type": "cylinder", "height": 1, "radius": 0.5}, {'"$cap"',-0.5],[0.5,-0.5]]}, {'"$cap"',0.5],[0.5,0.5]]}]}' >side.json
    simulated side.json
    all_rest
    no_gain
    json '.events[0].manifold | length == 2 and (map(.[1]) | sort | (.[0] + 0.5 | fabs) < 1e-6 and (.[1] - 0.5 | fabs) < 1e-6)'
}

@test "a box that falls on a corner tips over and comes to rest on a face" {
    # Turned by 0.3 about (1,2,0.5) in its own maps.
    falls 4 "$(box box 0,0,0 '"maps": [{"type": "rotate", "axis": [1,2,0.5], "angle": [0.3]},
        {"type": "translate", "offset": [[0,0,1.2]]}]')" >tilted.json
    simulated tilted.json
    all_rest
    no_gain
    json '.events[0].manifold | length == 1'
    near '.energy.end' 5 || json '.energy.end - 5 | . > 0 and . < 1e-4' # its centre is half its side up
}

@test "stacks of boxes and of balls come to rest, dropped or touching" {
    falls 2 "$(box a 0,0,0.8)" "$(box b 0,0,2)" "$(box c 0,0,3.2)" >stack.json
    simulated stack.json
    all_rest
    no_gain
    json '.energy.end - 45 | . > 0 and . < 1e-3'
    never_nearer
    # Beside each other's middles, they rock before they rest.
    falls 2 "$(box a 0,0,0.8)" "$(box b 0.1,0,2)" "$(box c 0,0.1,3.2)" >askew.json
    simulated askew.json --gamma 1e-4
    all_rest
    no_gain
    falls 2 "$(box a 0,0,0.500002)" "$(box b 0,0,1.500004)" "$(box c 0,0,2.500006)" >touching.json
    simulated touching.json
    all_rest
    no_gain
    json '.events | length < 30'
    local e
    for e in 0 0.5; do
        falls 2 "$(ball a 1 0,0,0.6 "\"restitution\": $e,")" "$(ball b 1 0,0,1.7 "\"restitution\": $e,")" \
            "$(ball c 1 0,0,2.8 "\"restitution\": $e,")" "$(ball d 1 0,0,3.9 "\"restitution\": $e,")" >balls.json
        simulated balls.json --gamma 1e-5
        all_rest
        no_gain
    done
    falls 2 "$(ball a 1 0,0,0.500001)" "$(ball b 1 0,0,1.500002)" "$(ball c 1 0,0,2.500003)" "$(ball d 1 0,0,3.500004)" >near.json
    simulated near.json
    all_rest
    json '.events | length < 20'
}

@test "friction holds a box on a slope, or not, and stops one that slides" {
    local c=0.955336489125606 s=0.29552020666133955 mu # of 0.3
    for mu in 0.5 0.2; do
        echo "{\"time\": [0,0.6], \"gravity\": [0,0,-10], \"bodies\": [{\"name\": \"slope\", \"friction\": 0, \"surfaces\": [
            {\"type\": \"plane\", \"origin\": [$(jq -n "-9 * $c"),-9,$(jq -n "9 * $s")], \"edge_u\": [$(jq -n "18 * $c"),0,$(jq -n "-18 * $s")],
             \"edge_v\": [0,18,0]}]}, $(box box 0,0,0.5002 "\"friction\": $mu, \"restitution\": 0,
             \"maps\": [{\"type\": \"rotate\", \"axis\": [0,1,0], \"angle\": [0.3]}]")]}" >slope.json
        simulated slope.json --gamma 1e-4
        no_gain
        if [ $mu = 0.5 ]; then
            all_rest
        else # it slides with g (sin - mu cos)
            json --argjson a "$(jq -n "10 * ($s - 0.2 * $c)")" '.momentum.end | (.[0] * .[0] + .[2] * .[2] | sqrt) - $a * 0.6 | fabs < 0.02'
        fi
    done
    falls 1 "$(box box -2,0,0.5002 '"velocity": [2,0,0]')" >slide.json
    simulated slide.json --gamma 1e-4
    all_rest
    no_gain
    # v^2 / (2 mu g)
    [ "$(jq '.bodies[1].maps[0].positions | last[0] + 2 - 0.4 | fabs < 0.005' out.json)" = true ]
}

@test "a box that overhangs too far falls off the one below" {
    falls 0.6 "$(box a 0,0,0.5002)" "$(box b 0.7,0,1.5004)" >overhang.json
    simulated overhang.json --gamma 1e-4
    no_gain
    json '.bodies[1].rests | not'
    [ "$(jq '.bodies[2].maps[0].positions | last[2] < 1.45' out.json)" = true ]
    falls 0.6 "$(box a 0,0,0.5002)" "$(box b 0.3,0,1.5004)" >stands.json
    simulated stands.json --gamma 1e-4
    all_rest
}

@test "a ball rests in a groove, between two contacts of one body" {
    echo "{\"time\": [0,3], \"gravity\": [0,0,-10], \"bodies\": [{\"name\": \"groove\", \"friction\": 0.3, \"surfaces\": [
        {\"type\": \"plane\", \"origin\": [0,-5,0], \"edge_u\": [3,0,3], \"edge_v\": [0,10,0]},
        {\"type\": \"plane\", \"origin\": [0,-5,0], \"edge_u\": [-3,0,3], \"edge_v\": [0,10,0]}]},
        $(ball ball 1 0.2,0,1.5 '"restitution": 0.5, "friction": 0.3,')]}" >groove.json
    simulated groove.json
    all_rest
    no_gain
}

@test "what stands on a moving floor goes along with it" {
    falls 1 "$(box box 0,0,0.5002)" |
        jq -c '.bodies[0] += {friction: 0.5, maps: [{type: "translate", velocity: [0.5,0,0]}]}' >conveyor.json
    simulated conveyor.json --gamma 1e-4
    near '.momentum.end[0]' 0.5
    json '.reason == null and .momentum.end[2] * .momentum.end[2] < 1e-3'
}

@test "falls of a rod on a rough plane raise the energy in no event" {
    local n
    for n in 1 2 3 4 5 6 7 8; do
        # e and mu as in a fall that gained 75 percent; other angles and spins each time.
        jq -cn --argjson n $n '{time: [0,0.7], gravity: [0,0,-10], bodies: [
            {name: "floor", friction: 0.418, surfaces: [{type: "plane", origin: [-9,-9,0], edge_u: [18,0,0], edge_v: [0,18,0]}]},
            {name: "rod", mass: 1, restitution: 0.984, velocity: [$n - 4.5, 0.3, -1], spin: [0.2, $n - 3, 0.1],
             surfaces: [{type: "ellipsoid", radii: [1, 0.05, 0.05]}],
             maps: [{type: "rotate", axis: [0,1,0], angle: [0.3 + $n / 8]}, {type: "translate", offset: [[0,0,1.2]]}]}]}' >rod.json
        simulated rod.json --gamma 1e-5 --max-events 400
        no_gain
        json '.energy.lost >= 0'
    done
}

@test "an end for want of resolution says what helps" {
    # At a gamma that double precision does not resolve.
    echo "{\"gamma\": 1e-15, \"bodies\": [$(ball a 1 0,0,0), $(ball b 1 1.0000000001,0,0 '"velocity": [-1,0,0],')]}" >close.json
    run -3 "$IMPINGE" simulate close.json -o out.json --json --max-pairs 100K
    valid simulate
    json '.reason == "resolution" and (.hint | test("greater --gamma"))'
    run -3 "$IMPINGE" simulate close.json -o out.json
    [[ ${lines[1]} == *"resolution"*"'a' and 'b'"*"a greater --gamma helps" ]]
}
