#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge view: pictures of a scene, and what becomes of a file that cannot be written.

load ../support/cli_helper

view() { "$IMPINGE" view "$left" "$right" "$@"; }
has_png() { grep -q '^#define HAVE_LIBPNG 1' "$top_builddir/config.h"; }

# --- Pictures ---------------------------------------------------------------------------------

@test "a picture as lines shows start, contact and end, both bodies and the error" {
    run -0 view -o picture.svg
    [[ $output =~ ^picture\.svg:\ 1200x960\ pixels,\ surfaces\ to\ within\ (0\.00[0-9]+)$ ]]
    local word
    for word in 'start: t = 0<' 'contact: t = 0.4999999, a and b<' 'end: t = 1<' 'times nearer<' \
        '>a<' '>b<' '>surfaces drawn to within 0.00'; do
        grep -qF "$word" picture.svg
    done
    [ "$(head -c 5 picture.svg)" = '<?xml' ]
    [ "$(tail -n 1 picture.svg)" = '</svg>' ]
    [ "$(grep -c '^<polyline' picture.svg)" -gt 1000 ]
    # Twice the dot and the arrow of the contact.
    [ "$(grep -c '^<polygon.*#d61a1c' picture.svg)" -eq 4 ]
}

@test "a picture in pixels is of the size asked for, and the same each time" {
    has_png || skip 'built without libpng'
    view -o one.png --width 300 --height 200
    view -o two.png --width 300 --height 200
    cmp one.png two.png
    [ "$(od -An -tx1 -N 24 one.png | tr -d ' \n')" = \
        89504e470d0a1a0a0000000d49484452"$(printf %08x%08x 300 200)" ]
}

@test "without libpng .png is refused with the cure" {
    ! has_png || skip 'built with libpng'
    fails 2 'install libpng-dev' view -o one.png
}

# Two balls of radius 1 whose centres pass each other 3 apart, at t = 0.5.
passing=('sphere ! translate velocity=2,0,0' 'sphere center=1,3,0')

@test "a scene without a contact is shown at its nearest approach, and one moment alone with --at" {
    run -0 "$IMPINGE" view "${passing[@]}" -o clear.svg
    [ "$(grep -o '>[a-z]*: t = [0-9.]*' clear.svg | tr -d '\n')" = '>start: t = 0>nearest: t = 0.5>end: t = 1' ]
    grep -qE '>nearest: t = 0\.5[0-9]*, a and b 1 apart<' clear.svg && grep -q 'nearest, .* times nearer' clear.svg
    # Twice, the line between two dots, which are discs in front of larger ones, and its length.
    [ "$(grep -c '^<polyline.*stroke="#d61a1c"' clear.svg)" -eq 2 ]
    [ "$(grep -c '^<polygon.*#d61a1c' clear.svg)" -eq 4 ]
    [ "$(grep -cE '^<text.*#d61a1c.*>1(\.00[0-9]*)?<' clear.svg)" -eq 2 ]
    run -0 "$IMPINGE" view "${passing[@]}" -o clear.svg --at 0.25
    [ "$(grep -o '>[a-z: ]*t = [0-9.]*' clear.svg)" = '>t = 0.25' ]
    run ! grep -q '#d61a1c' clear.svg
    run -0 "$IMPINGE" view "${passing[@]}" -o clear.svg --at nearest
    [ "$(grep -o '>[a-z: ]*t = [0-9.]*' clear.svg)" = '>nearest: t = 0.5' ]
    run -0 view -o contact.svg --at nearest
    [ "$(grep -o '>[a-z: ]*t = [0-9.]*' contact.svg)" = '>contact: t = 0.4999999' ]
    fails 2 "--at must be a finite number, or 'nearest', not 'soon'" view -o x.svg --at soon
}

@test "what comes near nothing is shown at four moments" {
    echo '{"bodies": [{"name": "only", "surfaces": [{"type": "sphere"}]}]}' >only.json
    run -0 "$IMPINGE" view only.json -o only.svg
    [ "$(grep -c '>[a-z: ]*t = ' only.svg)" -eq 4 ]
    run ! grep -q '#d61a1c' only.svg
}

@test "a finer picture is more exact" {
    view -o fine.svg --tolerance 1e-4 --at 0 >fine
    view -o coarse.svg --tolerance 1e-1 --at 0 >coarse
    awk '{ e[NR] = $NF } END { exit !(e[1] <= 1e-4 && e[2] <= 1e-1 && e[2] > 1e-3) }' fine coarse
}

@test "points, segments and thin things are drawn too" {
    run -0 "$IMPINGE" view 'point ! translate velocity=1,0,0' segment -o thin.svg
    run -0 "$IMPINGE" view 'spike' 'triangle' -o spike.svg --at 0
}

# --- What is shown ------------------------------------------------------------------------------

@test "a result is shown as its scene is, and not solved again" {
    scene >scene.json
    "$IMPINGE" solve scene.json --json >result.json
    "$IMPINGE" view scene.json -o scene.svg
    "$IMPINGE" view result.json -o result.svg --max-pairs 1
    cmp scene.svg result.svg
    "$IMPINGE" pair "$left" "$right" --json | "$IMPINGE" view - -o pair.svg
    view -o both.svg
    cmp pair.svg both.svg
}

@test "the answer of clearance is shown at its nearest approach, whole, by pairs and by slices" {
    scene >scene.json
    local form
    for form in '' --each '--profile 2'; do
        # shellcheck disable=SC2086 # words
        "$IMPINGE" clearance scene.json --time 0,0.25 --json $form | tail -n 1 >answer.json
        "$IMPINGE" view answer.json -o answer.svg --max-pairs 1
        grep -q 'nearest: t = 0.25, left and right' answer.svg
    done
}

@test "a result without its scene, or of another, is refused" {
    scene | "$IMPINGE" solve - --json >result.json
    fails 4 'result.json: /scene: this result does not name its scene' \
        "$IMPINGE" view result.json -o x.svg
    "$IMPINGE" pair "$left" "$right" --json | jq -c '.a.body = "nobody"' >other.json
    fails 4 'other.json: not a result of the scene that it names' "$IMPINGE" view other.json -o x.svg
    [ ! -e x.svg ]
}

@test "a scene that is wrong is told of as solve tells it" {
    echo '{"bodies": [{"name": "a", "surfaces": [{"type": "spere"}]}]}' >wrong.json
    fails 4 "did you mean 'sphere'?" "$IMPINGE" view wrong.json -o x.svg
    echo '{' >broken.json
    fails 4 'broken.json' "$IMPINGE" view broken.json -o x.svg
    fails 4 'nowhere.json: No such file' "$IMPINGE" view nowhere.json -o x.svg
}

# --- Files -----------------------------------------------------------------------------------------

@test "the file and its ending are asked for before anything is solved" {
    fails 2 'where to? -o FILE is missing' "$IMPINGE" view "${endless[@]}"
    fails 2 "--output must end with one of .png, .svg" "$IMPINGE" view "${endless[@]}" -o x.jpeg
    fails 2 "--output must end with one of .png, .svg" "$IMPINGE" view "${endless[@]}" -o png
    fails 2 '--width must be from 64 to 8192' view -o x.svg --width 3
    fails 2 '--zoom must be a finite number greater than 0' view -o x.svg --zoom 0
}

@test "where the file cannot be written nothing is left, and an older one stays" {
    fails 4 'no/x.svg: No such file' view -o no/x.svg
    mkdir dir.svg
    fails 4 'dir.svg: Is a directory' view -o dir.svg
    rmdir dir.svg
    echo old >x.svg
    run -4 --separate-stderr bash -c 'trap "" XFSZ; ulimit -f 4; "$IMPINGE" view "$0" "$1" -o x.svg' \
        "$left" "$right"
    [[ $stderr == 'impinge: view: x.svg: '* ]]
    [ "$(cat x.svg)" = old ]
    [ "$(echo x.svg*)" = x.svg ]
}

@test "endings may be in capitals" {
    run -0 view -o X.SVG --at 0
    [[ $output == 'X.SVG: 1200x960 pixels'* ]]
    [ "$(tail -n 1 X.SVG)" = '</svg>' ]
}

@test "names and numbers of any kind leave an SVG that is well formed, or a reason" {
    jq -nc '{bodies: [{name: "]]><&\uFFFE", surfaces: [{type: "sphere"}]},
        {name: "b", surfaces: [{type: "sphere", center: [3,0,0]}]}]}' >names.json
    "$IMPINGE" view names.json -o names.svg
    "$PYTHON3" -c 'import sys, xml.dom.minidom as x; x.parse(sys.argv[1])' names.svg
    fails 2 'too large for a picture' "$IMPINGE" view 'sphere radius=1e160' sphere -o huge.svg
    fails 2 'glTF holds numbers of 32 bits' "$IMPINGE" view 'sphere radius=1e100' sphere -o huge.glb --at 0
    [ ! -e huge.svg ] && [ ! -e huge.glb ]
}

@test "limits hold while triangles are made, and nothing is left" {
    fails 3 '--max-bytes 20971520 is not enough' view -o x.png --width 4000 --height 4000 --max-bytes 20M
    [ ! -e x.png ] && [ ! -e x.png.part ]
    run -3 --separate-stderr view -o x.png --width 4000 --height 4000 --max-bytes 20M --json
    json '.error | test("--max-bytes")'
    run -0 view -o x.svg --at 0 --json
    json '.file == "x.svg" and .width == 1200 and .surfaces_within > 0'
    # 2,000 balls: some 9 seconds to draw.
    jq -nc '{bodies: [range(2000) | {name: "b\(.)", group: "all", surfaces: [{type: "sphere",
        radius: 0.4, center: [. % 50, (. / 50 | floor), 0]}]}], ignore: [["all", "all"]]}' >balls.json
    run -3 --separate-stderr bash -c 'ulimit -t 4; exec "$IMPINGE" view balls.json -o balls.html --max-seconds 1'
    [[ $stderr == 'impinge: view: --max-seconds 1 was over while '*'; nothing was written' ]]
    [ ! -e balls.html ]
}

@test "every body has its own entry in the legend, and none overlaps another" {
    jq -nc '{bodies: [range(14) | {name: "a long name of link \(.)", group: "all", surfaces: [{type: "sphere",
        radius: 0.4, center: [., 0, 0]}]}], ignore: [["all", "all"]]}' >many.json
    "$IMPINGE" view many.json -o many.svg --at 0
    [ "$(grep -c 'textLength.*>a long name of link' many.svg)" -eq 14 ]
    # In each row an entry begins behind the end of the one before.
    sed -n 's/^<text x="\([0-9.]*\)" y="\([0-9.]*\)".* textLength="\([0-9.]*\)".*>a long.*/\2 \1 \3/p' many.svg |
        awk '{ if ($1 == y && $2 < end + 10) exit 1; if ($2 + $3 > 1200) exit 1; y = $1; end = $2 + $3 }'
}

# --- For other programs ------------------------------------------------------------------------------

spin=('torus ! rotate axis=1,0,0 rate=2' 'ripple speed=1 center=3,0,0')

# The JSON of a .glb: glb FILE.
glb() { tail -c +21 "$1" | head -c "$(od -An -tu4 -j 12 -N 4 "$1")"; }

@test "a .glb moves what is rigid by tracks, and what deforms by morph targets" {
    run -0 "$IMPINGE" view "${spin[@]}" -o spin.glb --frames 5 --tolerance 0.1
    [[ $output =~ ^spin\.glb:\ 5\ moments,\ [0-9]+\ triangles,\ surfaces\ to\ within\ 0\.0 ]]
    [ "$(head -c 4 spin.glb)" = glTF ]
    [ "$(od -An -tu4 -j 8 -N 4 spin.glb)" -eq "$(wc -c <spin.glb)" ]
    output=$(glb spin.glb)
    json '.asset.version == "2.0" and (.meshes | length) == 2'
    json '[.animations[0].channels[] | [.target.node, .target.path]] | sort ==
        [[0, "rotation"], [0, "translation"], [1, "weights"]]'
    json '(.meshes[0].primitives[0] | has("targets") | not) and
        (.meshes[1].primitives[0].targets | length) == 4'
    json '.accessors[.animations[0].samplers[0].input] | .count == 5 and .min == [0] and .max == [1]'
}

@test "the Khronos validator finds nothing wrong with a .glb" {
    node -e 'require("gltf-validator")' 2>/dev/null || skip 'no gltf-validator (npm)'
    "$IMPINGE" view "${spin[@]}" -o spin.glb --frames 5 --tolerance 0.1
    "$IMPINGE" view 'point ! translate velocity=1,0,0' 'segment' -o thin.glb --frames 3
    "$IMPINGE" view sphere 'sphere center=3,0,0' -o still.glb --at 0
    local file
    for file in spin thin still; do
        run -0 node -e '
            require("gltf-validator").validateBytes(new Uint8Array(require("fs").readFileSync(process.argv[1])))
                .then(report => console.log(JSON.stringify(report.issues)))' $file.glb
        json '.numErrors == 0 and .numWarnings == 0'
    done
}

@test "a .obj holds the triangles of one moment, with their points, normals and parameters" {
    run -0 "$IMPINGE" view "$left" "$right" -o balls.obj --tolerance 0.1
    local points faces
    points=$(grep -c '^v ' balls.obj)
    faces=$(grep -c '^f ' balls.obj)
    [[ $output == *" 1 moment, $faces triangles, "* ]]
    [ "$(grep -c '^vn ' balls.obj)" -eq "$points" ] && [ "$(grep -c '^vt ' balls.obj)" -eq "$points" ]
    [ "$(sed -n 's/^o //p' balls.obj | paste -sd' ')" = 'a_0 b_0' ]
    # At the contact: left of the origin ball a, right of it ball b, each point 1 from its centre.
    awk '$1 == "o" { c = $2 == "a_0" ? -1 : 1 }
        $1 == "v" { d = sqrt(($2 - c) ^ 2 + $3 ^ 2 + $4 ^ 2); if (d < 0.999 || d > 1.001) exit 1 }
        $1 == "f" { for (k = 2; k <= 4; ++k) { split($k, n, "/"); if (n[1] > most) most = n[1] } }
        END { exit most != '"$points"' }' balls.obj
}

@test "a .pvd names a .vtu for each moment, and each holds what it counts" {
    run -0 "$IMPINGE" view "$left" "$right" -o balls.pvd --frames 3 --tolerance 0.2
    [[ $output == 'balls.pvd: 4 moments, '* ]]
    local file
    for file in $(sed -n 's/.*file="\([^"]*\)".*/\1/p' balls.pvd); do
        [ "$(sed -n 's/.*NumberOfCells="\([0-9]*\)".*/\1/p' "$file")" -eq "$(grep -c '^5$' "$file")" ]
        [ "$(sed -n 's/.*NumberOfPoints="\([0-9]*\)".*/\1/p' "$file")" -eq \
            "$(sed '1,/Name="Points"/d; /<.DataArray>/,$d' "$file" | wc -l)" ]
    done
    [ "$(echo balls_*.vtu)" = 'balls_0000.vtu balls_0001.vtu balls_0002.vtu balls_0003.vtu' ]
    "$IMPINGE" view "$left" "$right" -o one.vtu --at 0 --tolerance 0.2
    grep -q 'TimeValue.*>0<' one.vtu
}
