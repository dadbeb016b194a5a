#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge simulate: impacts against closed forms and what is promised of the motion written.

load ../support/simulate_helper

@test "a ball bounces to e^2n of its height" {
    echo "{\"time\": [0,3], \"gravity\": [0,0,-10], \"bodies\": [$floor},
        $(ball ball 2 0,0,1.5 '"restitution": 0.8,')]}" >bounce.json
    simulated bounce.json
    json '.impacts == 6 and .resting == 0 and .reason == null and .time == [0, 3]'
    # From height 1: v = sqrt(20), impulses 2 (1 + e) v e^n, the first after sqrt(0.2).
    json '[.events[].impulse[2]] | to_entries | all(.[];
        (.value / (3.6 * (20 | sqrt) * pow(0.8; .key)) - 1 | fabs) < 1e-5)'
    near '.events[0].t' '0.2 | sqrt'
    near '.events[2].t - .events[1].t' '0.64 * 2 * (0.2 | sqrt)'
    json '.energy.drift | fabs < 1e-12' && json '.momentum.drift < 1e-12'
    json '.energy.lost / (20 * (1 - pow(0.8; 12))) - 1 | fabs < 1e-5'
    json '.bodies[0] | (.volume - 0.5235987755982988 | fabs) < 1e-8 and .error < 1e-6
        and (.inertia[0][0] - 0.2 | fabs) < 1e-8 and (.inertia[0][1] | fabs) < 1e-12'
    never_nearer
    never_nearer whole
    jq -e '.bodies[1].mass == 2 and (has("gravity") | not)' out.json
}

# cradle GAP NUMBER: a row of balls, the first of which comes from the left.
cradle() {
    local i row
    row=$(ball b0 1 -2,0,0 '"velocity": [1,0,0],')
    for ((i = 1; i < $2; ++i)); do
        row+=,$(ball "b$i" 1 "$(jq -n "($i - 1) * (1 + $1)"),0,0")
    done
    echo "{\"time\": [0,3], \"bodies\": [$row]}"
}

@test "Newton's cradle: of three and of five balls, touching or not, the last one leaves" {
    without_sanitizers
    local number gap
    for number in 3 5; do
        for gap in 8e-7 1e-3; do
            cradle $gap $number >cradle.json
            simulated cradle.json
            json --argjson n $number '.impacts == $n - 1'
            json '[.events[] | .impulse[0] - 1 | fabs] | max < 1e-6'
            json --argjson n $number '[.events[].b] == [range(1; $n) | "b\(.)"]'
            json '(.energy.end - .energy.start | fabs) < 1e-14 and .momentum.drift < 1e-14'
            # All but the last are at rest: it has all the momentum.
            [ "$gap" != 8e-7 ] || [ "$(jq '[.events[].t] | unique | length' out.json)" = 1 ]
            near "$(jq -c '.bodies[-1].maps[-1].positions | last[0] - first[0]' out.json)" \
                '3 - .events[-1].t'
            near "$(jq -c '.bodies[1].maps[-1].positions | last[0] - first[0]' out.json)" \
                '.events[1].t - .events[0].t'
            never_nearer whole
        done
    done
}

@test "unequal balls head-on: velocities by the closed form, momentum to rounding" {
    echo "{\"time\": [0,2], \"bodies\": [$(ball a 1 -2,0,0 '"velocity": [2,0,0],'),
        $(ball b 3 1,0,0 '"velocity": [-1,0,0], "restitution": 0.5,')]}" >unequal.json
    simulated unequal.json
    # Impulse (1 + e) mu (v_a - v_b), mu = 3/4.
    near '.events[0].impulse[0]' '1.5 * 0.75 * 3'
    near '.energy.lost' '0.5 * 0.75 * 9 * 0.75'
    json '.momentum | .drift < 1e-14 and (.start[0] - .end[0] | fabs) < 1e-14'
    json '.angular_momentum | [.start, .end] | transpose | all(.[]; .[0] - .[1] | fabs < 1e-12)'
    near '.events[0].t' '2 / 3'
    never_nearer
}

# slope FRICTION: a spinning ball falls obliquely on a rough floor.
oblique() {
    echo "{\"time\": [0,1], \"bodies\": [$floor, \"friction\": $1},
        {\"name\": \"ball\", \"mass\": 2, \"velocity\": [3,0,-4], \"spin\": [0,1,2], \"restitution\": 0.5,
         \"surfaces\": [{\"type\": \"sphere\", \"center\": [0,0,3]}]}]}"
}

@test "a spinning ball meets a rough floor: it sticks or slides as the cone of friction says" {
    # The point that touches slides by 3 - 1 = 2; 1/m + r^2/I = 1.75; the normal impulse is 12.
    oblique 0.2 >stick.json
    simulated stick.json
    near '.events[0].impulse[2]' 12 && near '.events[0].impulse[0]' '-2 / 1.75'
    near '.momentum.end[0]' '6 - 2 / 1.75' && near '.momentum.end[2]' 4
    never_nearer
    never_nearer whole
    oblique 0.05 >slide.json
    simulated slide.json
    near '.events[0].impulse[2]' 12 && near '.events[0].impulse[0]' -0.6
    # The spin about y grows by r J / I: 0.6 / 0.8.
    near "$(jq '.bodies[1].maps[0].spins[1][1]' out.json)" 1.75
    near "$(jq '.bodies[1].maps[0].spins[1][2]' out.json)" 2
    never_nearer whole
}

@test "a driven body hits with its own speed" {
    echo "{\"bodies\": [$floor, \"maps\": [{\"type\": \"translate\", \"velocity\": [0,0,3]}]},
        $(ball ball 1 0,0,2)]}" >driven.json
    simulated driven.json
    near '.events[0].impulse[2]' 6 && near '.events[0].t' 0.5
    near "$(jq '.bodies[1].maps[0].positions | last[2] - first[2]' out.json)" 3
    never_nearer
}

@test "a ball comes to rest, and that is the end of its impacts" {
    echo "{\"time\": [0,100], \"gravity\": [0,0,-10], \"gamma\": 1e-4, \"bodies\": [$floor},
        $(ball ball 2 0,0,1.5 '"restitution": 0.3,')]}" >rest.json
    simulated rest.json
    json '.held == 1 and .bodies[0].rests and .events[-1].kind == "resting"
        and .events[-1].held == "ball" and .time[1] == 100 and .momentum.end == [0,0,0]'
    json '.events[0].kind == "impact" and .impacts + .resting == (.events | length)'
    json '.impacts + .resting < 40'
    near '.energy.end' '2 * 10 * 0.5' || json '.energy.end - 10 | . > 0 and . < 0.002'
    never_nearer
}

@test "a body slides and rolls on: contacts that last do not hold what moves" {
    echo "{\"time\": [0,1], \"gravity\": [0,0,-10], \"gamma\": 1e-3, \"bodies\": [$floor, \"friction\": 0.5},
        $(ball ball 1 -2,0,0.501 '"restitution": 0, "velocity": [2,0,0],')]}" >roll.json
    simulated roll.json
    json '.held == 0 and .resting > 3'
    # Sliding friction makes a solid ball roll at 5/7 of its speed.
    json '.momentum.end[0] - 10 / 7 | fabs < 0.02'
}

@test "torque-free turning of unequal inertia keeps angular momentum, and states its error" {
    echo '{"time": [0,4], "bodies": [{"name": "brick", "mass": 1, "spin": [0.1,3,0.1],
        "inertia": [[1,0,0],[0,2,0],[0,0,3]], "center": [0,0,0], "surfaces": [{"type": "plane"}]}]}' >brick.json
    simulated brick.json
    json '.substep_error > 0 and .substep_error <= 3e-4 and (.energy.drift | fabs) < 1e-3'
    json '.angular_momentum | [.start, .end] | transpose | all(.[]; .[0] - .[1] | fabs < 1e-12)'
    # The middle axis is not stable: the body turns over.
    [ "$(jq '[.bodies[0].maps[0].rotations[] | 1 - 2 * (.[1] * .[1] + .[3] * .[3])] | min < -0.9' out.json)" = true ]
    run -0 "$IMPINGE" simulate brick.json -o out.json
    [[ $output == *"orientations within"* ]]
}

@test "spiked balls collide and recoil" {
    simulated "$top_srcdir/tools/data/recoil.json"
    json '.impacts >= 1 and .reason == null and .momentum.drift < 1e-12 and .energy.lost > 0'
    # Closing at 2 they met; they part the other way.
    [ "$(jq '[.bodies[].maps[-1].positions] | map(last[0] - .[-2][0]) | .[0] < 0 and .[1] > 0' out.json)" = true ]
    never_nearer
    run -0 "$IMPINGE" solve out.json --json
    json --slurpfile out out.json '.verdict == "contact" and (.t - $out[0].events[0].t | fabs) < 1e-4'
}

@test "superquadrics fall into a bowl" {
    without_sanitizers
    simulated "$top_srcdir/tools/data/bowl.json"
    json '.impacts >= 3 and .reason == null and .energy.end < .energy.start'
    never_nearer
}

@test "a fast bolt does not tunnel through a nut" {
    simulated "$top_srcdir/tools/data/bolt.json"
    json '.events[0].a == "nut" and .events[0].b == "bolt"'
    never_nearer
}

@test "a budget ends the motion early, with what is proved so far" {
    echo "{\"time\": [0,3], \"gravity\": [0,0,-10], \"bodies\": [$floor},
        $(ball ball 2 0,0,1.5 '"restitution": 0.8,')]}" >bounce.json
    run -3 "$IMPINGE" simulate bounce.json -o out.json --json --max-events 2
    valid simulate
    json '.reason == "max-events" and (.events | length) == 2 and .time[1] < 3 and .time[1] > 1'
    [ "$(jq '.time[1]' out.json)" = "$(jq '.time[1]' <<<"$output")" ]
    never_nearer
    run -3 "$IMPINGE" simulate bounce.json -o out.json --json --max-pairs 1
    json '.reason == "max-pairs" and .time == [0, 0]'
    run -0 "$IMPINGE" clearance out.json
    run -3 "$IMPINGE" simulate bounce.json -o out.json --max-events 0
    [[ ${lines[0]} == "ended early from t = 0 to 0.44721"* ]]
}

@test "a signal ends the motion between two events, and what is proved so far is written" {
    local signal
    # Each search of it is short, and there is no end of them.
    echo "{\"time\": [0,1e4], \"gravity\": [0,0,-10], \"bodies\": [$floor}, $(ball ball 2 0,0,1.5)]}" >bounce.json
    for signal in INT TERM; do
        interrupted 3 "$signal" "$IMPINGE" simulate bounce.json -o out.json --json --max-events 1000000000
        [ -z "$stderr" ]
        valid simulate
        json '.reason == "cancelled" and .impacts > 0 and .time[1] < 1e4'
        jq -e --argjson last "$(jq '.time[1]' <<<"$output")" \
            '.time[1] == $last and (.events | length) > 0 and .events[-1].t <= $last' out.json
        run -0 "$IMPINGE" solve out.json --json --time "0,$(jq '.events[0].t' out.json)"
        json --slurpfile out out.json '.verdict == "contact" and (.t - $out[0].events[0].t | fabs) < 1e-4'
    done
}

@test "a signal ends a search that would take a lifetime" {
    local gap='{"name": "b", "mass": 1,
        "surfaces": [{"type": "superellipsoid", "radii": [1.000000002,1.000000002,1.000000002]}]}'
    echo "{\"gamma\": 1e-9, \"bodies\": [{\"name\": \"a\", \"surfaces\": [{\"type\": \"superellipsoid\"}]}, $gap]}" >near.json
    interrupted 3 TERM "$IMPINGE" simulate near.json -o out.json --json --max-bytes 0
    valid simulate
    json '.reason == "cancelled" and .time == [0, 0] and .events == []'
    [ "$(jq -c '.time | map(floor)' out.json)" = '[0,0]' ]
}

@test "maps that move a body with a mass are refused; those that place it or change its shape are not" {
    local maps
    for maps in '"type": "translate", "velocity": [1,0,0]' '"type": "rotate", "axis": [0,0,1], "rate": 6.283185307179586' \
        '"type": "translate", "times": [0,1], "positions": [[0,0,0],[0,0,1]]'; do
        echo "{\"bodies\": [$(ball ball 2 0,0,1.5 "\"maps\": [{$maps}],")]}" >moved.json
        fails 4 "moved.json: /bodies/0/maps: found maps that move a body with a mass, whose motion \"velocity\"" \
            "$IMPINGE" simulate moved.json -o out.json
    done
    for maps in '"type": "translate", "offset": [[1,0,0]]' '"type": "scale", "factors": [[1,1,1],[0.5,0,0]]'; do
        echo "{\"bodies\": [$(ball ball 2 0,0,1.5 "\"maps\": [{$maps}],")]}" >placed.json
        run -0 "$IMPINGE" simulate placed.json -o out.json
    done
    # A motion that was simulated is a scene whose bodies are moved.
    echo "{\"gravity\": [0,0,-10], \"bodies\": [$(ball ball 2 0,0,1.5)]}" >fall.json
    "$IMPINGE" simulate fall.json -o out.json
    fails 4 'out.json: /bodies/0/maps: found maps that move' "$IMPINGE" simulate out.json -o again.json
}

@test "a scene with parameters is refused, whoever follows them" {
    local moves='"maps": [{"type": "translate", "velocity": [0,0,1], "clock": "j"}],'
    for scene in "$(ball ball 2 0,0,1.5 "$moves")" \
        "$(ball ball 2 0,0,1.5), {\"name\": \"still\", $moves \"surfaces\": [{\"type\": \"sphere\"}]}"; do
        echo "{\"parameters\": {\"j\": [0,1]}, \"bodies\": [$scene]}" >ranges.json
        fails 4 'ranges.json: found the parameter "j", must be none; simulate finds one motion' \
            "$IMPINGE" simulate ranges.json -o out.json
    done
}

@test "bodies too large to integrate are told so" {
    echo '{"bodies": [{"mass": 1, "surfaces": [{"type": "sphere", "radius": 1e100}]}]}' >huge.json
    fails 4 '/bodies/0/surfaces: found points farther than 1e50 from the origin, too far to integrate; choose other units' \
        "$IMPINGE" simulate huge.json -o out.json
    run -0 "$IMPINGE" info huge.json
    [[ $output == *'unbounded: it reaches farther than 1e50' ]] || [[ $output == *'/bodies/0/mass'* ]]
    echo '{"bodies": [{"solid": true, "surfaces": [{"type": "sphere", "radius": 1e100}]}, {"surfaces": [{"type": "sphere"}]}]}' >solid.json
    fails 4 'reach farther than 1e50, too far to tell what they bound; leave out "solid", or choose other units' \
        "$IMPINGE" solve solid.json
}

@test "--max-seconds ends the motion, and no search is begun after that" {
    echo "{\"time\": [0,1e4], \"gravity\": [0,0,-10], \"bodies\": [$floor}, $(ball ball 2 0,0,1.5)]}" >bounce.json
    run -3 "$IMPINGE" simulate bounce.json -o out.json --json --max-seconds 1e-9
    valid simulate
    json '.reason == "max-seconds" and .time == [0, 0] and .stats.searches == 0'
    run -3 "$IMPINGE" simulate bounce.json -o out.json --json --max-seconds 0.5 --max-events 1000000000
    valid simulate
    json '.reason == "max-seconds" and .time[1] < 1e4'
}

@test "--max-seconds and --max-bytes hold while pairs of many bodies are listed" {
    without_sanitizers
    # 20000 bodies make 2e8 pairs, which take five seconds to go through.
    jq -cn '{bodies: [range(20000) | {name: "b\(.)", mass: 1, group: ["all"], inertia: [[1,0,0],[0,1,0],[0,0,1]],
        center: [., 0, 0], surfaces: [{type: "sphere", radius: 0.4, center: [., 0, 0]}]}], ignore: [["all", "all"]]}' >many.json
    local seconds limit=1 TIMEFORMAT=%U
    seconds=$({ time "$IMPINGE" simulate many.json -o out.json --json --max-seconds "$limit" >limited || true; } 2>&1)
    echo "$seconds seconds of the processor"
    output=$(<limited)
    json '.reason == "max-seconds" and .stats.searches == 0'
    jq -en --argjson seconds "$seconds" '$seconds < 4'
    # Where a limit leaves no time to read and to write, nothing is written.
    for limit in 1e-09 0.1 0.3; do
        rm -f out.json
        seconds=$({ time "$IMPINGE" simulate many.json -o out.json --max-seconds "$limit" 2>said || true; } 2>&1)
        echo "$limit: $seconds seconds of the processor"
        [ -e out.json ] || grep -q -e "--max-seconds $limit is over before the motion of many.json begins" -e 'was over while the scene was read' said
        jq -en --argjson seconds "$seconds" "\$seconds < 1.1 * $limit + 0.25"
    done
    jq -c 'del(.ignore)' many.json >all.json
    run -3 --separate-stderr "$IMPINGE" simulate all.json -o out.json --json --max-bytes 10M
    json '.error | contains("--max-bytes 10485760 is not enough to read this")'
    run -3 "$IMPINGE" simulate all.json -o out.json --json --max-bytes 150M
    json '.reason == "max-bytes" and .stats.searches == 0'
}

@test "a budget that ends in the middle of an event leaves the event out" {
    local pairs most
    cradle 8e-7 3 >cradle.json
    simulated cradle.json
    cp out.json whole.json
    # All impacts are at one time.
    [ "$(jq '[.events[].t] | unique | length' whole.json)" = 1 ]
    most=$(jq .stats.pairs <<<"$output")
    for ((pairs = 1; pairs <= most; pairs += most / 12)); do
        run "$IMPINGE" simulate cradle.json -o out.json --max-pairs $pairs
        echo "$pairs: $status"
        [ "$(jq -c .events out.json)" = '[]' ] || [ "$(jq -c .events out.json)" = "$(jq -c .events whole.json)" ]
    done
}
