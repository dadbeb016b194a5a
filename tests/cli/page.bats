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
    json '.contact.t > 0.499 and .contact.t < 0.5 and (.contact.point | map(. * .) | add) < 1e-6'
    json '(.surfaces | length) == 2 and all(.surfaces[]; (.poses | length) == 6 and .proved != null)'
    # The distance falls from 2 to 0 at t = 0.5, and each slice's bracket holds its end's.
    json '.gap | [range(60)] as $k | . as $g | all($k[]; (2 - 4 * $g.t[. + 1]) as $d |
        $g.lower[.] <= $d + 1e-9 and $g.upper[.] >= $d - 1e-9 and $g.upper[.] - $g.lower[.] < 0.11)'
    json '.searched >= 1'
}

@test "a page of a result, which was not searched for again, and of one moment" {
    needs_three
    "$IMPINGE" pair "$left" "$right" --json | "$IMPINGE" view - --tolerance 0.1 --frames 3 -o page.html
    output=$(data)
    json '.searched == null and .contact != null'
    "$IMPINGE" view "$left" "$right" --at 0.25 --tolerance 0.1 -o page.html
    output=$(data)
    json '.times == [0.25] and .gap == null'
}

@test "a browser shows the page: contact, regions, scrubbing, playing, turning" {
    needs_three
    local browser modules=$top_builddir/tests/node_modules
    browser=$(command -v chromium || command -v chromium-browser) || skip 'no chromium'
    NODE_PATH=$modules node -e 'require("playwright-core")' 2>/dev/null || skip 'no playwright-core (npm)'
    page
    export NODE_PATH=$modules
    run -0 --separate-stderr timeout 120 node "$top_srcdir/tests/support/page.js" "$browser" "$PWD/page.html" "$PWD/profile"
    json '.errors == [] and .asked == 1'
    [ "$(jq -r .state <<<"$output")" = ready ] || skip 'no WebGL in this browser'
    json '.contact.t > 0.499 and .contact.t < 0.5 and .contact.drawn > 5000 and .contact.wanted > 50'
    json '.regions.drawn > 5000 and .regions.blue != .contact.blue'
    json '.scrubbed.t > 0.2499 and .scrubbed.t < 0.2501 and .played > 0.26 and .again == .contact.t and .turned'
    json '.scrubbed.told | test("^t = 0.25.*, distance here 0\\.9[0-9]* to (0\\.9|1\\.)")'
}
