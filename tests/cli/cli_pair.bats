#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge pair: verdicts, their two forms, limits, exit status.

load ../support/cli_helper

# --- Verdicts ---------------------------------------------------------------------------------

@test "two balls that meet halfway are in contact just before t = 0.5" {
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-4 --json
    valid result
    json '.verdict == "contact" and .t >= 0.4999 and .t <= 0.5 and .t == .t_lower'
    json '.reason == null and .gap <= .gamma and .gamma == 1e-4 and .gamma_clear == 5e-5'
    json '.a.body == "a" and .b.body == "b" and .a.surface == 0 and .b.surface == 0'
    json '[.a.point[0], .b.point[0]] | all(fabs < 1e-3)'
    json '.normal[0] > 0.99'
}

@test "the paper's method finds the same contact" {
    local bounds
    for bounds in box sphere; do
        run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-2 --json --method paper \
            --bounds "$bounds" --rates full
        valid result
        json '.verdict == "contact" and .t >= 0.49 and .t <= 0.5'
    done
}

@test "the points of a contact are as far apart as the gap says" {
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-4 --json
    json '([.a.point, .b.point] | transpose | map(.[0] - .[1]) | map(. * .) | add | sqrt) as $d
        | ($d - .gap) | fabs < 1e-15'
}

@test "balls that pass each other are clear, and clear has no time, sides or gap" {
    run -0 "$IMPINGE" pair "$left" 'sphere center=2,3,0 ! translate velocity=-2,0,0' --json
    valid result
    json '.verdict == "clear" and .reason == null and .t_lower == 1'
    json '.t == null and .t_examined == [0,1] and .a == null and .b == null and .gap == null and .normal == null'
}

@test "surface means surface: a ball inside a hollow ball is clear" {
    run -0 "$IMPINGE" pair 'sphere radius=0.5' 'sphere radius=2' --json
    json '.verdict == "clear"'
}

# few_pairs MOST VERB A B: neither order of both surfaces takes more than MOST pairs.
few_pairs() {
    local first
    run -0 "$IMPINGE" "$2" "$3" "$4" --gamma 1e-4 --max-pairs 20K --json
    json --argjson most "$1" '.stats.pairs <= $most'
    first=$(jq '.lower // .t' <<<"$output")
    run -0 "$IMPINGE" "$2" "$4" "$3" --gamma 1e-4 --max-pairs 20K --json
    json --argjson most "$1" --argjson first "$first" '.stats.pairs <= $most and
        ((.lower // .t) - $first | fabs < 1e-4)'
}

@test "either order of a and b takes few pairs" {
    local ball='sphere radius=1.08 ! rotate axis=1,2,3 center=3,0,-2 rate=1'
    few_pairs 10 pair 'sphere radius=0.52 ! rotate center=0,1,1 rate=2' \
        'torus major_radius=1 minor_radius=0.25 ! translate velocity=0,.5,0'
    few_pairs 100 pair 'sphere radius=1.04 ! rotate axis=0,0,1 rate=-1' \
        'torus major_radius=1 minor_radius=0.25 ! rotate axis=0,0,1 center=-2,0,1 rate=2'
    few_pairs 1500 pair "$ball" \
        'cylinder radius=0.61 height=1.35 center=-0.223913,0,0 ends=true ! rotate axis=0,1,0 rate=3'
    few_pairs 250 clearance 'sphere radius=1.27 ! rotate axis=0,0,1 rate=-1' \
        'ellipsoid radii=0.61,0.49,0.81 ! rotate axis=0,1,0 rate=0.5'
}

@test "surfaces that are never there together are clear for that reason" {
    build_twin 5 6
    run -0 "$IMPINGE" pair twin "$left" --plugin-path "$PWD" --time 0,1 --json
    valid result
    json '.verdict == "clear" and .reason == "no-time" and .t_lower == 1'
    run -0 "$IMPINGE" pair twin "$left" --plugin-path "$PWD" --time 0,1
    [[ ${lines[3]} == *"no two surfaces that are tested exist together"* ]]
}

@test "times in the text are at most one unit in their tenth digit below those proved" {
    local speed t
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0 ! translate velocity=-1,0,0'
    [ "${lines[0]}" = 'contact at t = 0.9999994999' ]
    for speed in 1.7 2.3 3.1 4.7 97 3e5; do
        run -0 "$IMPINGE" pair sphere "sphere center=3,0,0 ! translate velocity=-$speed,0,0" --json
        t=$(jq .t_lower <<<"$output")
        run -0 "$IMPINGE" pair sphere "sphere center=3,0,0 ! translate velocity=-$speed,0,0"
        awk -v t="$t" -v text="${lines[0]##* }" \
            'BEGIN { exit !(text <= t && t - text < 1e-9 * t) }'
    done
}

@test "products of finite rates that overflow are no fault of a plugin" {
    local fast='formula x="sin(1e200*u)" ! map-formula x="sin(1e200*x)"'
    run -3 "$IMPINGE" pair --method paper --gamma .1 --max-pairs 100 "$fast" 'point position=9,0,0'
}

@test "an undefined place is told the same wherever the partner is" {
    local shape='formula x=u y=v z=log(u) domain=[[0,2],[0,1]]' partner
    for partner in 'point position=0,0.5,1 velocity=0,0,-4' 'point position=0,0.5,-5' \
        'point position=0,0.5,-700' 'point position=1e-9,0.5,-30'; do
        fails 5 'z='"'log(u)'" "$IMPINGE" pair "$shape" "$partner"
        [[ $stderr == *"at u = 0, v = "*"is undefined there"* ]]
    done
}

@test "a moment at which a surface is undefined is told, and what is before it is proved" {
    local at
    for at in 0.25 0.2; do
        fails 5 "t = $at" "$IMPINGE" pair "formula x=u y=v z=\"log(abs(t-$at))\"" \
            'sphere radius=.3 center=0,0.5,-50' --max-pairs 10000
        [[ $stderr == *"is undefined there"* ]]
    done
    run -0 "$IMPINGE" pair 'formula x=u y=v z="log(abs(t-0.25))"' 'point position=0.5,0.5,-3' --json
    json '.verdict == "contact" and .t < 0.25'
}

@test "surfaces that exist for a while only: the answer says what was examined" {
    local short='formula x=u y=v z=t time=[0.25,0.5]'
    run -0 "$IMPINGE" pair "$short" 'point position=0,0,9' --time 0,2 --json
    valid result
    json '.verdict == "clear" and .t_lower == 2 and .t_examined == [0.25,0.5]'
    run -0 "$IMPINGE" pair "$short" 'point position=0,0,9' --time 0,2
    [[ ${lines[3]} == "  examined t from 0.25 to 0.5 only; at other times no two "* ]]
}

@test "times that a map is not defined for are refused, with body, map and times" {
    fails 4 "'keyframes' is defined from t = 0 to 1 only, got a query from 0 to 2; ask about its" \
        "$IMPINGE" pair 'sphere ! keyframes times=0,1 positions=[[0,0,0],[1,0,0]]' \
        'sphere radius=.5 center=0,3,0 ! translate velocity=0.5,-1.5,0' --time 0,2
    [[ $stderr == *"body 'a', surface 0: "* && $stderr == *"impinge info keyframes"* ]]
}

@test "contact at the start is reported at the start" {
    run -0 "$IMPINGE" pair "$left" "$right" --time 0.75,1 --gamma 1e-4 --json
    json '.verdict == "contact" and .t == 0.75 and .t_lower == 0.75'
}

@test "the interval is the one asked for" {
    run -0 "$IMPINGE" pair "$left" "$right" --time -1,0.25 --json
    json '.verdict == "clear" and .t_lower == 0.25'
}

@test "the same question has the same answer, bit for bit" {
    run -0 "$IMPINGE" pair "$left" "$right" --json
    local first
    first=$(jq -c 'del(.stats.seconds)' <<<"$output")
    run -0 "$IMPINGE" pair "$left" "$right" --json
    [ "$first" = "$(jq -c 'del(.stats.seconds)' <<<"$output")" ]
}

# --- Limits -------------------------------------------------------------------------------------

@test "the limit of pairs leaves it undecided, and the text says what to raise" {
    run -3 "$IMPINGE" pair "${endless[@]}" --max-pairs 1K --json
    valid result
    json '.verdict == "undecided" and .reason == "max-pairs" and .stats.pairs < 1100'
    run -3 "$IMPINGE" pair "${endless[@]}" --max-pairs 1K
    [[ ${lines[0]} == 'undecided: the limit of pairs is reached' ]]
    [[ $output == *'nothing nearer than 5e-10 before t = 0'* ]]
    [[ $output == *'raise --max-pairs, or gamma'* ]]
}

@test "the limit of seconds leaves it undecided" {
    run -3 "$IMPINGE" pair "${endless[@]}" --max-seconds 0.05 --json
    json '.reason == "max-seconds" and .stats.seconds < 10'
}

@test "the limit of memory leaves it undecided" {
    run -3 "$IMPINGE" pair "${endless[@]}" --max-bytes 1M --json
    json '.reason == "max-bytes"'
}

@test "SIGINT and SIGTERM end the search, and what is proved is printed" {
    local signal
    for signal in INT TERM; do
        interrupted 3 "$signal" "$IMPINGE" pair "${endless[@]}" --json
        valid result
        json '.verdict == "undecided" and .reason == "cancelled" and .t_lower == 0'
    done
}

# --- Exit status ----------------------------------------------------------------------------------

@test "the verdict is the exit status when asked for" {
    run -1 "$IMPINGE" pair "$left" "$right" --exit-code
    run -0 "$IMPINGE" pair "$left" 'sphere center=9,0,0' --exit-code
    run -3 "$IMPINGE" pair "${endless[@]}" --exit-code --max-pairs 10
    run -0 "$IMPINGE" pair "$left" "$right"
}

# --- Text -------------------------------------------------------------------------------------------

@test "a contact in text tells verdict, proof, both sides, gap, normal and cost" {
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-4
    [[ ${lines[0]} == 'contact at t = 0.49'* ]]
    [[ ${lines[1]} == '  time     from 0 to 1' ]]
    [[ ${lines[2]} == '  proved   nothing nearer than 5e-05 before t = 0.49'* ]]
    [[ ${lines[3]} == '  a        surface 0 of "a"  u '*' v '*' at ('*')' ]]
    [[ ${lines[4]} == '  b        surface 0 of "b"  u '*' v '*' at ('*')' ]]
    [[ ${lines[5]} == '  gap      '*', at most gamma = 0.0001' ]]
    [[ ${lines[6]} == '  normal   ('*'), from a to b' ]]
    [[ ${lines[7]} == '  cost     '*' pair, '*' nodes, '* ]]
    [ "${#lines[@]}" -eq 8 ]
}

@test "the text claims no more than the numbers do" {
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-4 --json
    local exact text
    exact=$(jq .t_lower <<<"$output")
    text=$("$IMPINGE" pair "$left" "$right" --gamma 1e-4 | sed -n 's/.*before t = //p')
    jq -en "$text <= $exact and $exact - $text < 1e-9"
}

# --- Wrong surfaces -----------------------------------------------------------------------------------

@test "an unknown surface type is answered with the nearest" {
    fails 4 "pair: a: unknown surface type 'spere', did you mean 'sphere'?" \
        "$IMPINGE" pair spere sphere
}

@test "a plugin file in place of a type is answered with how to load it" {
    fails 4 "pair: a: './wobble.so' is a file, must be the name of a surface type" \
        "$IMPINGE" pair ./wobble.so sphere
    [[ $stderr == *--plugin-path* ]]
}

@test "an unknown map is answered with the nearest" {
    fails 4 "unknown map 'rotat', did you mean 'rotate'?" \
        "$IMPINGE" pair sphere 'sphere ! rotat axis=1,0,0'
}

@test "an unknown parameter is answered with the nearest" {
    fails 4 "did you mean 'radius'?" "$IMPINGE" pair 'sphere radios=1' sphere
}

@test "a parameter out of range is answered with the range" {
    fails 4 'pair: b: radius: got -1, must be > 0' "$IMPINGE" pair sphere 'sphere radius=-1'
}

@test "a parameter that is no number is refused" {
    local value
    for value in nan inf 1e999 x; do
        fails 4 'radius' "$IMPINGE" pair "sphere radius=$value" sphere
    done
}

@test "an array of the wrong shape is answered with the right one" {
    fails 4 'center: got an array of 2, must be an array of 3 numbers' \
        "$IMPINGE" pair 'sphere center=1,2' sphere
}

@test "a map is not a surface" {
    fails 4 "got the map 'rotate'" "$IMPINGE" pair rotate sphere
}

@test "an empty pipeline is refused" {
    fails 4 "expected a surface type's name" "$IMPINGE" pair '' sphere
}

@test "a formula that is undefined at a point met ends the query with the place and the cure" {
    fails 5 "body 'a', surface 0: type 'formula z='1/(u-0.5)'' at u = 0.5, v = 0.5, t = 0: is undefined \
there, or too large for a double, though that lies in its domain; shrink the domain" \
        "$IMPINGE" pair 'formula z=1/(u-0.5)' 'sphere radius=.1 center=0,0,3'
    fails 5 "at u = 0.5, v = 0.5, t = 0: is undefined there" \
        "$IMPINGE" pair 'formula z=log(u-0.5)' 'sphere radius=.1 center=.5,.5,-30'
    fails 5 "type 'formula y='exp(1e3*u)' z='exp(1e3*u)'' at u = 1, v = 1, t = 0" \
        "$IMPINGE" pair 'formula y=exp(1e3*u) z=exp(1e3*u)' sphere
    run -0 "$IMPINGE" pair 'formula z=log(u-0.5) domain=[[.51,1],[0,1]]' 'sphere radius=.1 center=.5,.5,-30'
    [ "${lines[0]}" = clear ]
}

@test "a step too steep for e^x is met where it stands" {
    run -0 "$IMPINGE" pair 'formula z=1/(1+exp(1e5*(v-.5)))' \
        'sphere radius=.1 center=.5,.5,1.9 ! translate velocity=0,0,-2' --json
    json '.verdict == "contact" and (.t - 0.4 | fabs) < 1e-4'
}

# --- Why it is slow ---------------------------------------------------------------------------

# A hollow ellipsoid and one in it, by formulas of which no distance is known.
hollow='formula x=1.1*cos(u)*cos(v) y=sin(u)*cos(v) z=sin(v) domain=[[0,6.3],[-1.5,1.5]]'
inside='formula x=1.089*cos(u)*cos(v) y=0.99*sin(u)*cos(v) z=0.99*sin(v) domain=[[0,6.3],[-1.5,1.5]]'

@test "--explain tells where the pairs went, and changes no answer" {
    run -0 "$IMPINGE" pair "$hollow" "$inside" --gamma 1e-3 --json
    local plain=$output
    run -0 "$IMPINGE" pair "$hollow" "$inside" --gamma 1e-3 --json --explain
    valid result
    json '.explanation | length == 1 and .[0].tested > 200 and .[0].divided > 100'
    json '.explanation[0] | ([.by[]] | add) == .divided and .by.distance * 3 > .divided'
    json '.explanation[0].a | .type == "formula" and .has_inclusions and (.knows_distance | not)'
    json '.advice | test("callback distance")'
    same='del(.explanation, .advice, .stats.seconds, .stats.bytes)'
    [ "$(jq -c "$same" <<<"$output")" = "$(jq -c "$same" <<<"$plain")" ]
    run -0 "$IMPINGE" pair "$hollow" "$inside" --gamma 1e-3 --explain
    [[ $output == *"surface 0 of \"a\" (formula) and surface 0 of \"b\" (formula)"* ]]
    [[ $output == *"they lie along each other"*advice* ]]
}

@test "what is undecided comes with advice, what is cheap without" {
    run -3 "$IMPINGE" pair "$hollow" "$inside" --gamma 1e-3 --max-pairs 300 --json
    valid result
    json '(.advice | length > 20) and (has("explanation") | not)'
    run -3 "$IMPINGE" pair "$hollow" "$inside" --gamma 1e-3 --max-pairs 300
    [[ $output == *"  advice "* ]]
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-4 --explain
    [[ $output == *"was parted, or met, at once"* && $output != *advice* ]]
}

@test "undecided pairs of --each, and lines of a batch, come with advice" {
    formula() { printf '{"type": "formula", "x": "1.1*%s*cos(u)*cos(v)", "y": "%s*sin(u)*cos(v)",
        "z": "%s*sin(v)", "domain": [[0,6.3],[-1.5,1.5]]}' "$1" "$1" "$1" | tr -d '\n'; }
    printf '{"bodies": [{"name": "a", "surfaces": [%s]}, {"name": "b", "surfaces": [%s]},
        {"name": "far", "surfaces": [{"type": "sphere", "center": [9,0,0]}]}], "time": [0,1]}' \
        "$(formula 1)" "$(formula 0.99)" | tr -d '\n' >nested.json
    limits=(--gamma 1e-3 --max-pairs 300)
    run -3 "$IMPINGE" solve nested.json --each --json "${limits[@]}"
    jq -se '(.[0].advice | length > 20) and (.[1:] | all(has("advice") | not))' <<<"$output"
    run -3 "$IMPINGE" solve nested.json --each "${limits[@]}"
    [[ ${lines[0]} == undecided* && ${lines[1]} == "  advice   "* && ${lines[2]} == clear* ]]
    run -3 "$IMPINGE" batch - "${limits[@]}" <nested.json
    valid result
    json '.advice | length > 20'
}

@test "--explain is of one search by models" {
    fails 2 '--explain belongs to --method models' \
        "$IMPINGE" pair "$left" "$right" --explain --method paper
    scene >two.json
    fails 2 '--each and --explain exclude each other' "$IMPINGE" solve two.json --explain --each
    fails 2 '--refine and --explain exclude each other' \
        "$IMPINGE" solve two.json --explain --refine 1e-3,1e-4
}
