#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge view -o FILE.html: one page that needs nothing else, tried in a browser where there is one.

load ../support/cli_helper

three=$(sed -n 's/^threejsdir = //p' "$top_builddir/Makefile")
needs_three() { [ -r "$three/build/three.min.js" ] || skip 'no three.js (libjs-three)'; }

page() { "$IMPINGE" view "$left" "$right" --gamma 1e-3 --tolerance 0.05 --frames 5 -o page.html; }

# What the page's script reads.
data() { sed -n 's/.*<script type="application\/json" id="data">\(.*\)<\/script>$/\1/p' page.html; }

@test "without three.js a page is refused with the cure" {
    [ ! -r "$three/build/three.min.js" ] || skip 'three.js is here'
    fails 2 'install libjs-three' "$IMPINGE" view sphere 'sphere center=3,0,0' -o page.html
}

@test "the page holds surfaces, contact, distances and regions, and asks for no other file" {
    needs_three
    run -0 page
    [[ $output == 'page.html: 6 moments, '*' triangles, surfaces to within 0.0'* ]]
    run ! grep -oE '(src|href)=|@import|url\(' <(sed '/^<script>(function\|^<script>\/\*\*/,/<\/script>$/d' page.html)
    grep -q 'The MIT License' page.html && grep -q 'three.js authors' page.html
    run ! grep -q '@[A-Z]*@' <(sed '/^<script>/,$d' page.html)
    output=$(data)
    json '(.times | length) == 6 and .times[0] == 0 and .times[5] == 1 and (.bodies | map(.name)) == ["a", "b"]'
    # The contact is at the middle of the scene, which is the page's origin.
    json '.spot | .contact and .t > 0.499 and .t < 0.5 and ([.a, .b] | map(map(. * .) | add) | add) < 1e-6'
    json '.title == "sphere radius=1 center=-2,0,0 ! translate velocity=2,0,0 and sphere radius=1 center=2,0,0 ! translate velocity=-2,0,0"'
    json '(.surfaces | length) == 2 and all(.surfaces[]; (.poses | length) == 6 and .proved != null)'
    # The distance falls from 2 to 0 at t = 0.5, and each slice's bracket holds its end's.
    json '.gap | [range(60)] as $k | . as $g | all($k[]; (2 - 4 * $g.t[. + 1]) as $d |
        $g.lower[.] <= $d + 1e-9 and $g.upper[.] >= $d - 1e-9 and $g.upper[.] - $g.lower[.] < 0.11)'
    json '.searched >= 1'
    # At each frame the distance then, not the least of a slice.
    json '. as $all | all(range(6); (2 - 4 * $all.times[.]) as $d |
        $d < 0 or ($all.distance.lower[.] <= $d + 1e-9 and $all.distance.upper[.] >= $d - 1e-9 and
        $all.distance.upper[.] - $all.distance.lower[.] <= 0.002 * $d + 1e-3))'
}

@test "a page that sweeps a parameter names it in the place of t" {
    needs_three
    cat >swept.json <<'END'
{"time": [0,0], "parameters": {"lift": [0,1]}, "bodies": [
  {"name": "arm", "surfaces": [{"type": "sphere", "radius": 0.3}],
   "maps": [{"type": "translate", "velocity": [2,0,0], "clock": "lift"}]},
  {"name": "rest", "surfaces": [{"type": "sphere", "radius": 0.3, "center": [1.5,0,0]}]}]}
END
    run -0 --separate-stderr "$IMPINGE" view swept.json --sweep lift --tolerance 0.1 --frames 3 -o page.html
    output=$(data)
    json '.axis == "lift" and (.told | startswith("First contact at lift = 0.4499"))'
    grep -q "data.axis + ' = '" page.html
}

@test "a page of a result, which was not searched for again, and of one moment" {
    needs_three
    "$IMPINGE" pair "$left" "$right" --json | "$IMPINGE" view - --tolerance 0.1 --frames 3 -o page.html
    output=$(data)
    json '.searched == null and .spot.contact'
    "$IMPINGE" view "$left" "$right" --at 0.25 --tolerance 0.1 -o page.html
    output=$(data)
    json '.times == [0.25] and .gap == null and .distance == null'
}

# Has a browser use page.html; what it saw is in output.
browse() {
    local browser
    browser=$(command -v chromium || command -v chromium-browser) || skip 'no chromium'
    node -e 'require("playwright-core")' 2>/dev/null || skip 'no playwright-core (npm)'
    run -0 --separate-stderr timeout 240 node "$top_srcdir/tests/support/page.js" "$browser" "$PWD/page.html" "$PWD/profile"
    json '.errors == [] and .asked == 1'
    [ "$(jq -r .state <<<"$output")" = ready ] || skip 'no WebGL in this browser'
}

@test "a browser shows the page: contact, proof, scrubbing, playing, clicking, turning" {
    needs_three
    page
    browse
    json '.first | .t > 0.499 and .t < 0.5 and .drawn > 5000 and .wanted > 50 and .event == "contact: a and b"'
    json '.regions.drawn > 5000 and .regions.blue != .first.blue'
    # The mark belongs to its time; the distance is that at t; the slider says where it is.
    json '.scrubbed | .t > 0.2499 and .t < 0.2501 and .wanted == 0 and .event == "" and .announced == "t = 0.25000"'
    json '.scrubbed.told | test("^t = 0\\.25000, distance (1\\.00[0-9]*|0\\.999[0-9]*|1\\.000)$")'
    json '.played > 0.25 and .space and .stopped and .again == .first.t and .turned'
    json '.clicked > 0.745 and .clicked < 0.755 and .right > .clicked and .plot.drawn > 500 and .plot.wanted > 20'
    json '.faults == [] and .narrow.faults == [] and .narrow.drawn > 2000'
    json '.first.ground == 765 and .dark.ground < 120 and .dark.drawn > 2000'
    json '.noscript | test("JavaScript")'
}

@test "a page without a contact shows the nearest approach, and what hides it is transparent" {
    needs_three
    echo '{"bodies": [
        {"name": "box", "surfaces": [{"type": "sphere", "radius": 2}]},
        {"name": "inner", "surfaces": [{"type": "sphere", "radius": 0.5}],
         "maps": [{"type": "translate", "offset": [[-1,0,0],[2,0.5,0]]}]}]}' | tr -d '\n' >inside.json
    "$IMPINGE" view inside.json --tolerance 0.05 --frames 5 -o page.html
    output=$(data)
    json '.title == "inside.json" and (.spot.contact | not) and .spot.distance > 0.3'
    browse
    json '.title == "inside.json" and .names == ["box", "inner"]'
    json '.first | (.event | test("^nearest: box and inner, 0\\.3[0-9]* apart$")) and .wanted > 20 and (.veiled | test("0"))'
    json '.scrubbed.wanted == 0 and .scrubbed.veiled == ""'
}

@test "a page of a simulation shows all its events" {
    needs_three
    "$IMPINGE" simulate "$top_srcdir/tools/data/recoil.json" -o recoil.json
    "$IMPINGE" view recoil.json --tolerance 0.1 --frames 13 -o page.html
    local events
    events=$(jq -c '[.events[].t]' recoil.json)
    [ "$(jq length <<<"$events")" -ge 2 ]
    output=$(data)
    json --argjson events "$events" '[.events[].t] == $events and ($events - .times) == []'
    browse
    json --argjson events "$events" '.events | [.[] | .t] as $seen | ($events - $seen) == []'
    json '[.events[] | select(.event | test("impact: left and right"))] | length >= 2 and all(.[]; .wanted > 20)'
}

@test "no name ends the page's data, or its title" {
    needs_three
    local name='<!--<script>]]></script></title>&amp;"'
    jq -nc --arg name "$name" '{bodies: [{name: $name, surfaces: [{type: "sphere"}]},
        {name: "b", surfaces: [{type: "sphere", center: [3,0,0]}]}]}' >"a <b>&.json"
    "$IMPINGE" view "a <b>&.json" --tolerance 0.1 --frames 3 -o page.html
    output=$(data)
    json --arg name "$name" '.bodies[0].name == $name and .title == "a <b>&.json"'
    run ! grep -qF '<!--<script>' page.html
    grep -qF '<title>a &lt;b>&amp;.json</title>' page.html
    browse
    json --arg name "$name" '.names == [$name, "b"] and .title == "a <b>&.json"'
}
