#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge bench: what it prints, and what the default method may cost. Counts are the same on
# every machine, so they are held to limits; times are not.

load ../support/cli_helper

setup_file() {
    export bench=$BATS_FILE_TMPDIR/bench.json
    "$IMPINGE" bench figure7 bicubic spikes tori rates moving clearance conformal saddles bodies surfaces batch \
        --method models --repeat 1 --up-to 1000 --json >"$bench"
}

# measured FILTER: jq -e over all sets; `row(SET; CASE)` is the default method's row of that case.
measured() {
    jq -e 'def row($set; $case):
        .sets[] | select(.set == $set).cases[] | select(.case == $case).methods[0];
        '"$1" "$bench"
}

# --- What it costs ------------------------------------------------------------------------------

@test "spheres 1e-6 apart are proved clear within 1500 pairs in every direction" {
    measured 'row("figure7"; "oblique, S = 1e-06") |
        .verdicts == {contact: 0, clear: 20, undecided: 0} and .pairs.max <= 1500'
    measured 'row("figure7"; "axis, S = 1e-08") | .verdicts.clear == 1 and .pairs.max <= 1500'
}

@test "the pairs that clear two spheres grow like the logarithm of the gap" {
    measured '.sets[] | select(.set == "figure7").findings |
        .["growth_to_1e-6"] <= 1.6 and .["growth_to_1e-8"] <= 1.6'
}

@test "a least distance takes at most three times the pairs of proving 0.99 of it, of patches six times" {
    measured '[.sets[] | select(.set == "clearance").cases[] |
        .methods[0].ratio.pairs * (if .case | startswith("patches") then 2 else 1 end)] |
        length == 5 and all(. >= 1/3)'
}

@test "the 100 scenes of moving patches have the answers of the reference" {
    measured 'row("bicubic"; "gamma 1e-06") | .reference |
        .scenes == 100 and .agreed == 100 and .latest <= 3e-6 and .earliest >= -6e-6'
    measured 'row("bicubic"; "gamma 0.001") | .verdicts.undecided == 0 and .reference.latest <= 3e-6'
}

@test "moving bicubic patches take at most 45 pairs in the mean, biquadratic ones 50" {
    measured 'row("bicubic"; "gamma 1e-06").pairs.mean <= 45'
    measured 'row("saddles"; "random") | .verdicts.undecided == 0 and .pairs.mean <= 50'
}

@test "saddles in one another are decided, and take at most 20000 pairs where 1e-4 apart" {
    measured '[.sets[] | select(.set == "saddles").cases[].methods[].verdicts.undecided] |
        length == 5 and all(. == 0)'
    measured 'row("saddles"; "saddles, 0.001 apart").pairs.max <= 7000'
    measured 'row("saddles"; "saddles, 0.0001 apart").pairs.max <= 20000'
}

@test "moving spheres take less than 1500 pairs at gamma 1e-10, and meet when the formula says" {
    measured 'row("moving"; "gamma 1e-10") | .pairs.max < 1500 and .reference.agreed == 20 and
        .reference.latest <= 1e-15 and .reference.earliest >= -1e-10'
}

@test "rotating tori take less than 3000 pairs at gamma 1e-6" {
    measured 'row("tori"; "flight, gamma 1e-06") | .verdicts.contact == 1 and .pairs.max < 3000'
    measured 'row("tori"; "tumble, gamma 1e-06") | .verdicts.contact == 1 and .pairs.max < 3000'
    measured 'row("tori"; "chain, gamma 1e-06") | .verdicts.contact == 1 and .pairs.max < 3000'
}

@test "narrow spikes are found, for less than 3000 pairs and no more than wide ones" {
    measured '[.sets[] | select(.set == "spikes").cases[] | select(.case | startswith("head-on")) |
        .methods[0]] | length == 8 and
        all(.verdicts.contact == 1 and .pairs.max < 3000 and .reference.latest <= 0)'
    measured '.sets[] | select(.set == "spikes").findings.narrowest_over_widest_head_on <= 1'
}

@test "needles two hundred times narrower hit each other's flanks for less than ten times the pairs" {
    measured '[.sets[] | select(.set == "spikes").cases[] | select(.case | startswith("swing")) |
        .methods[0]] | length == 8 and all(.verdicts.contact == 1 and .pairs.max < 12000)'
    measured 'row("spikes"; "swing, width 0.01").pairs.max < 4000'
    measured '.sets[] | select(.set == "spikes").findings.narrowest_over_widest_swing < 10'
}

@test "parts that slide are proved clear for a few thousand pairs" {
    measured '[.sets[] | select(.set == "conformal").cases[] | select(.case | test("c = 0.1$")) |
        .methods[0]] | length == 7 and all(.verdicts.clear == 1 and .pairs.max <= 10000)'
    measured 'row("conformal"; "shaft, c = 0.01") | .verdicts.clear == 1 and .pairs.max <= 8000'
    measured 'row("conformal"; "shaft, c = 0.001") | .verdicts.clear == 1 and .pairs.max <= 80000'
    measured 'row("conformal"; "piston, c = 1e-06") | .verdicts.clear == 1 and .pairs.max <= 20000'
    measured 'row("conformal"; "race, c = 0.001") | .verdicts.clear == 1'
    measured 'row("conformal"; "ellipsoid, c = 0.01") | .verdicts.clear == 1 and .pairs.max <= 10000'
    measured 'row("conformal"; "thread, c = 0.01") | .verdicts.clear == 1 and .pairs.max <= 20000'
    measured '[.sets[] | select(.set == "conformal").cases[] | select(.case | test("(placed|carried), ")) |
        select(.case | test("formula") | not).methods[0]] |
        length == 12 and all(.verdicts.clear == 1 and .pairs.max <= 40000)'
}

@test "threads that come to touch all along are found for a few ten thousand pairs" {
    run -0 "$IMPINGE" pair 'thread radius=0.95' 'thread height=0.5 ! translate velocity=0,0,0.2' \
        --gamma 1e-4 --json
    json '.verdict == "contact" and (.t_lower - 0.2004 | fabs) < 1e-3 and .stats.pairs < 30000'
}

# A ball beside a quarter of a torus of NURBS, which turns about its axis. The distance from the whole
# torus says nothing about an edge, nor about a bump.
torus_of_nurbs() { # BUMPED_POINT RATE OFFSET
    jq -cn --argjson bumped "$1" --argjson rate "$2" --argjson offset "$3" '(1 / 2 | sqrt) as $c |
        [1, $c, 1] as $w | [0, 0, 0, 1, 1, 1] as $k | {gamma: 1e-6, bodies: [{surfaces: [{type: "nurbs",
        degree: [2, 2], knots: [$k, $k], weights: [$w[] as $a | $w[] | . * $a],
        points: [[1.6, 0, 0], [1.6, 0, 0.4], [1.2, 0, 0.4], [1.6, 1.6, 0], [1.6, 1.6, 0.4], $bumped,
            [0, 1.6, 0], [0, 1.6, 0.4], [0, 1.2, 0.4]]}], maps: [{type: "rotate", rate: $rate}]},
        {surfaces: [{type: "sphere", radius: 0.19}], maps: [{type: "translate", offset: $offset}]}]}'
}

@test "a ball that passes the edge of a torus of NURBS, or reaches a bump, takes some hundred pairs" {
    torus_of_nurbs '[1.2, 1.2, 0.4]' 0.3 '[[0.73, 1.04, 0.16], [0.09, -0.5, -0.16]]' >edge.json
    run -0 "$IMPINGE" solve edge.json --json
    json '.verdict == "clear" and .stats.pairs < 400'
    torus_of_nurbs '[1.2, 1.2, 0.4002]' 0.06 '[[1.07, 0.79, 0.14], [0.44, 0.76, 0.26]]' >bump.json
    run -0 "$IMPINGE" solve bump.json --json
    json '.verdict == "contact" and .stats.pairs < 900'
}

@test "no scene of any other set is left open, and none takes 64 megabytes" {
    measured '[.sets[] | select(.set != "conformal").cases[].methods[]] | length >= 50 and
        all(.verdicts.undecided == 0 and .bytes.max < 64 * 1024 * 1024)'
}

# --- What it prints -------------------------------------------------------------------------------

# small [OPTION]...: the set that takes the least time.
small() { "$IMPINGE" bench moving --repeat 1 --max-pairs 100 "$@"; }

counts() { jq 'del(.. | .seconds?)' <<<"$output"; }

@test "JSON is as its schema says, with and without the paper's method" {
    output=$(<"$bench")
    valid bench
    json '[.sets[].set] == ["figure7", "bicubic", "spikes", "tori", "rates", "moving", "clearance",
        "conformal", "saddles", "bodies", "surfaces", "batch"]'
    json 'all(.sets[] | select(.set != "clearance" and .set != "batch").cases[].methods[];
        .method == "models" and .ratio == null)'
    run -0 small --json
    valid bench
    json '.max_pairs == 100 and (.sets | length == 1)'
    json 'all(.sets[].cases[].methods[]; .ratio.pairs > 0)'
    json '[.sets[0].cases[0].methods[].method] == ["models", "paper", "paper, spheres"]'
}

@test "the paper's method ends at its budget, which is told, and the default method does not" {
    run -0 small --json
    json 'all(.sets[].cases[].methods[]; if .method == "models" then .ended == 0
        else .ended == 20 and .verdicts.undecided == 20 and .pairs.max <= 102 end)'
    run -0 small
    [[ $output == *'ends at 100 pairs a scene'*'  paper  '*'>10'* ]]
    run -0 "$IMPINGE" bench moving --repeat 1 --max-pairs 100 --method models
    [[ $output != *'paper'* ]]
}

@test "parts that slide are given the budget" {
    run -0 "$IMPINGE" bench conformal --repeat 1 --max-pairs 30 --json
    valid bench
    json '[.sets[0].cases[].case] == [
        ("shaft", "socket", "piston", "race", "ellipsoid", "thread", "thread by formula") as $part |
        ("c = " + ("0.1", "0.01", "0.001", ("1e-06" | select($part == "piston"))),
         ("placed", "carried") + ", c = 0.01") | "\($part), \(.)"]'
    json 'all(.sets[0].cases[].methods[]; .method == "models" and .verdicts.contact == 0 and
        (.ended == 1) == (.pairs.max >= 30) and .pairs.max <= 32)'
    json '[.sets[0].cases[].methods[0].ended] | add | . > 4 and . < 32'
}

@test "everyday scenes keep the goals that were reached, as far as the budget lets see" {
    run -0 "$IMPINGE" bench everyday --repeat 1 --max-pairs 500 --json
    valid bench
    json '[.sets[0].cases[].methods[].goal.outcome] | length >= 300 and
        ([.[] | select(. == "reached")] | length >= 100) and all(. != "missed")'
    json '[.sets[0].cases[].methods[] | select(.goal.pairs > 500).goal.outcome] | unique == ["not measured"]'
    json 'all(.sets[0].cases[].methods[]; .goal.pairs > 500 or (.goal.outcome | startswith("reached")) ==
        (.pairs.max <= .goal.pairs and .reference.agreed == 1))'
    json '.sets[0].findings | .reached >= 100 and .goals >= .reached'
    run -0 "$IMPINGE" bench everyday --repeat 1 --max-pairs 100
    [[ $output == *'  contact  '*'goal 100'*' goals are reached'*' goals are marked as open'* ]]
}

@test "bodies, triangles and scenes grow up to the number asked for" {
    output=$(<"$bench")
    json '[.sets[-3:][].cases[].case] == ["100 bodies", "1000 bodies", "100 triangles each",
        "1000 triangles each", "100 pairs of spheres", "100 pairs of patches",
        "1000 pairs of spheres", "1000 pairs of patches"]'
    run -0 "$IMPINGE" bench bodies surfaces --up-to 999 --repeat 1 --json
    valid bench
    json '[.sets[].cases[].case] == ["100 bodies", "100 triangles each"]'
    json 'all(.sets[].cases[].methods[]; .verdicts.contact == 1 and .bytes.max > 0)'
}

@test "the crowd's first contact and the meshes' are found for little more than the candidates" {
    measured 'row("bodies"; "1000 bodies") | .verdicts.contact == 1 and .pairs.max < 20000'
    measured 'row("surfaces"; "1000 triangles each") | .verdicts.contact == 1 and .pairs.max < 20000'
}

@test "a batch gives the answers of its scenes one by one, by any number of threads" {
    measured '.sets[] | select(.set == "batch") | .cases[] | [.methods[] |
        {method, verdicts, pairs, nodes, witness_searches, peak_heap, bytes}] |
        [.[].method] == ["solve, one by one", "batch, 1 thread", "batch, 2 threads"] and
        (map(del(.method)) | unique | length == 1)'
    measured '.sets[] | select(.set == "batch") |
        .findings.two_threads_faster > 0 and .findings.two_threads_processor > 0 and
        (.findings | has("overhead_us")) and all(.cases[].methods[]; .processor_seconds > 0)'
    run -0 "$IMPINGE" bench batch --up-to 100 --repeat 1
    [[ $output == *'100 pairs of patches (100 scenes)'*'  batch, 2 threads  '*'us a scene beyond'* ]]
}

@test "a set that the paper's method is not for is refused where named, and else left out" {
    fails 2 "set 'conformal' is for the default method only: leave out --method, or the set" \
        "$IMPINGE" bench moving conformal --method paper
    run -0 --separate-stderr "$IMPINGE" bench --method paper --max-pairs 1 --repeat 1 --json
    valid bench
    json '[.sets[].set] == ["figure7", "bicubic", "spikes", "tori", "rates", "moving"]'
    [ "$(grep -c 'is for the default method only, and left out' <<<"$stderr")" -eq 10 ]
    [[ $stderr == *"set 'bodies'"* ]]
}

@test "certificates hold, and are counted in bytes and by what it takes to verify them" {
    [ -x "$top_builddir"/tools/impinge-verify ] || skip "impinge-verify needs MPFI"
    run -0 "$IMPINGE" bench certificates --up-to 100 --repeat 1 --json
    valid bench
    json '[.sets[0].cases[].case] == ["patches, gamma 1e-06", "shaft, c = 0.001", "socket, c = 0.1",
        "teapot and torus, gamma 0.01", "arm beside a fixture, 2 required",
        "door, all places of its hinge", "spindle, all angles"] and .sets[0].findings.refused == 0'
    json '[.sets[0].cases[].methods[].verdicts.undecided] | add == 0'
    json 'all(.sets[0].cases[]; (.methods[0] | has("certificates") | not) and .scenes as $n |
        .methods[1].certificates | .count == $n and .hold == $n and .bytes.mean > 1000 and
        .verify_seconds.mean > 0 and .verify_over_solve > 1)'
    json '[.sets[0].cases[].methods[1].certificates.kernel] | all(.elaborated == .proved) and
        .[0].elaborated >= 1 and .[0].seconds.mean > 0 and .[5].proved == 1'
}

@test "a scene that changes has the answers and pairs of scenes built anew" {
    run -0 "$IMPINGE" bench changes --repeat 1 --json
    valid bench
    json '.sets[0].cases | length == 6 and all(.[]; .scenes == 200 and (.methods | length == 2 and
        .[0].verdicts == .[1].verdicts and .[0].pairs == .[1].pairs and .[0].ratio.seconds > 0))'
    json '[.sets[0].cases[:3][].methods[0] | .verdicts.contact, .pairs.max] | min == 0 and max > 5'
    json 'all(.sets[0].cases[3:][].methods[0]; .verdicts.contact == 200 and .pairs.max == 1)'
    json '.sets[0].findings | keys == ["ball_over_built", "edge_over_built", "motion_over_built",
        "points_over_built", "vertex_of_cloth_over_built", "vertex_over_built"]'
}

@test "certificates are not measured where no verifier is" {
    mkdir bare
    cp "$top_builddir"/tools/.libs/impinge bare 2>/dev/null || skip 'linked statically'
    export LD_LIBRARY_PATH=$top_builddir/.libs
    fails 2 "set 'certificates' needs impinge-verify" env PATH=/nowhere bare/impinge bench certificates
}

@test "counts are the same in every run" {
    run -0 small --json
    local first
    first=$(counts)
    run -0 small --json --repeat 3
    [ "$first" = "$(counts)" ]
}

@test "random patches follow from their seed" {
    local first
    bicubic() { "$IMPINGE" bench bicubic --method models --repeat 1 --json --count 5 "$@"; }
    run -0 bicubic --seed 7
    json '[.sets[].cases[].case] == ["gamma 0.001", "seed 7, gamma 0.001", "gamma 1e-06",
        "seed 7, gamma 1e-06"]'
    json '.sets[].cases[1] | .scenes == 5 and .methods[0].verdicts.undecided == 0'
    first=$(counts)
    run -0 bicubic --seed 7
    [ "$first" = "$(counts)" ]
    run -0 bicubic
    json '.sets[].cases[1].case == "seed 1, gamma 0.001"'
    [ "$first" != "$(counts)" ]
}

@test "sets are done in the order named" {
    run -0 "$IMPINGE" bench tori moving --method models --repeat 1
    [[ $output == *$'\ntori\n'*$'\nmoving\n'* ]]
}

@test "the scenes of the file are scenes, each with its reference" {
    local file=$top_srcdir/tools/data/bicubic_moving_100.jsonl
    [ "$(jq -s 'length' "$file")" = 100 ]
    output=$(head -n 3 "$file")
    valid scene
    jq -es 'all(.[]; .reference.verdict == "clear" or .reference.t >= 0)' "$file"
    cmp "$file" "$top_builddir/tools/built-data/bicubic_moving_100.jsonl"
}

# --- What is wrong ----------------------------------------------------------------------------------

@test "an unknown set is answered with the nearest, before anything is measured" {
    fails 2 "bench: unknown set 'tory', did you mean 'tori'? There are figure7, bicubic" \
        "$IMPINGE" bench moving tory
    fails 2 "unknown set 'xxxxxxxxxxxx'; there are figure7" "$IMPINGE" bench xxxxxxxxxxxx
}

@test "repeats are one or more, and a seed belongs to a count" {
    fails 2 "--repeat must be at least 1, not '0'" "$IMPINGE" bench --repeat 0
    fails 2 '`make tools/impinge-tunable` builds' "$IMPINGE" bench --tune TUNING_GJK_GAP
    fails 2 'leave out --method and --json' "$IMPINGE" bench --tune TUNING_GJK_GAP --method models
    fails 2 '--seed belongs to --count' "$IMPINGE" bench bicubic --seed 7
    fails 2 "--up-to must be at least 100, not '99'" "$IMPINGE" bench bodies --up-to 99
}

@test "a set whose types are missing is told so" {
    mkdir empty
    cp "$top_builddir"/tools/.libs/impinge . 2>/dev/null || skip 'linked statically'
    LD_LIBRARY_PATH=$top_builddir/.libs run -4 --separate-stderr ./impinge bench moving --json
    [[ $stderr == "impinge: "*"unknown surface type 'sphere'"* ]]
    json '.error | contains("unknown surface type")'
}
