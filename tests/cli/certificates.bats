#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# --proof writes certificates, and impinge-verify proves them again.

load ../support/cli_helper

verify() { "$top_builddir"/tools/impinge-verify "$@"; }

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    [ -x "$top_builddir"/tools/impinge-verify ] || skip "impinge-verify needs MPFI"
}

near='sphere center=2.01,0.1,0.2'

@test "a certificate of contact holds, of the whole time before it and of its points" {
    run -0 "$IMPINGE" pair "$left" "$right" --gamma 1e-2 --proof contact.proof
    [[ $output == contact* ]]
    run -0 verify contact.proof
    [ "${lines[0]}" = holds ]
    [[ ${lines[1]} == "contact: no two points nearer than 0.005 from t = 0 to 0.49"* ]]
    [[ ${lines[2]} == "two points within 0.01 at t = 0.49"* ]]
}

@test "a certificate of a contact at the start claims its points alone" {
    for other in 'sphere center=1.9,0,0' 'sphere center=2,0,0'; do
        run -0 "$IMPINGE" pair sphere "$other" --proof start.proof
        [ "${lines[0]}" = 'contact at t = 0' ]
        run -0 verify start.proof
        [[ $output == holds*"no two points nearer than 0 from t = 0 to 0"*"two points within 1e-06 at t = 0"* ]]
    done
    run -1 "$IMPINGE" clearance sphere 'sphere center=2.1,0,0 ! translate velocity=1,0,0' --require 0.2 \
        --proof violated.proof
    run -0 verify violated.proof
    run -3 "$IMPINGE" pair sphere 'sphere center=2,0,0' --max-pairs 1 --proof open.proof
    run -0 verify open.proof --quiet
    local apart=('ellipsoid radii=1,2,3 ! rotate rate=3' 'torus center=4,0,0 minor_radius=0.3')
    run -3 "$IMPINGE" clearance "${apart[@]}" --max-pairs 60 --json --proof open.proof
    local lower=$(jq '.lower * 0.9' <<<"$output")
    run -0 verify open.proof
    local claimed=$(grep -oP 'nearer than \K\S+' <<<"$output")
    jq -en "$lower > 0 and $claimed > $lower and $claimed <= $lower / 0.9"
    run -3 "$IMPINGE" clearance "${apart[@]}" --max-pairs 1 --require 0.69 --proof open.proof
    run -0 verify open.proof
    [[ $output == *"no two points nearer than 0 from t = 0 to 1"* ]]
    local verb
    for verb in pair clearance; do
        run -3 --separate-stderr "$IMPINGE" $verb "${apart[@]}" --max-seconds 1e-9 --json --proof none.proof
        json '.reason == "max-seconds"'
        [[ $stderr == *"$verb: proof: this query "* ]]
        [ ! -e none.proof ]
    done
}

@test "certificates of clear, of a distance and of one that is required hold" {
    "$IMPINGE" pair sphere "$near" --gamma 1e-2 --proof clear.proof
    "$IMPINGE" clearance sphere "$near" --tolerance 0.1 --proof distance.proof
    "$IMPINGE" clearance sphere "$near" --require 0.015 --proof required.proof
    for kind in clear distance required; do
        run -0 verify "$kind.proof" --threads 2 --quiet
        [ "$output" = holds ]
    done
}

@test "a certificate states a motion by formulas, whatever its constants are called" {
    local bore='cylinder radius=0.5 height=3 center=0,0,1' piston='cylinder radius=0.49 height=0.6 ends=true'
    local crank='motion-formula offset=["0","0","r*cos(9*t)+sqrt(1.44-(r*sin(9*t))^2)"] constants={"r":0.4}'
    run -0 "$IMPINGE" pair "$bore" "$piston ! $crank" --gamma 1e-3 --proof clear.proof
    [[ $output == clear* ]]
    run -0 verify clear.proof
    [ "${lines[0]}" = holds ]
    run -0 "$IMPINGE" pair sphere 'sphere center=3,0,0 ! motion-formula angle=m_A*t axis=0,0,1
        center=1,0,0 offset=["l-1","0","0"] constants={"m_A":4,"l":1,"k0":9}' --gamma 1e-3 --proof meets.proof
    [[ $output == contact* ]]
    run -0 verify meets.proof
    [[ ${lines[0]} == holds && ${lines[1]} == contact* ]]
}

@test "a certificate states the sides and ends of a straight extrusion by exact numbers" {
    local nut='extrusion profile=[[1,0.1],[0.3,0.9],[-1,0.7],[-0.9,-1],[1,0.1]] degree=1 vector=0.1,0,1 ends=true'
    run -0 "$IMPINGE" pair "$nut" 'sphere center=0.1,0.2,2.11' --gamma 1e-3 --proof side.proof
    run -0 verify side.proof
    [ "${lines[0]}" = holds ]
    "$IMPINGE" pair "$nut" 'sphere center=3,0.2,0.5 ! translate velocity=-2,0,0' --gamma 1e-3 --proof meets.proof
    run -0 verify meets.proof
    [[ ${lines[0]} == holds && ${lines[1]} == contact* ]]
}

@test "motions that both surfaces share are left out" {
    local turn='rotate axis=0,0,1 rate=2'
    "$IMPINGE" pair "sphere ! $turn" "sphere center=4,0,0 ! $turn" --proof shared.proof
    run -0 verify shared.proof
    [ "${lines[0]}" = holds ]
    [[ ${lines[2]} == "2 bodies, 1 pair of surfaces, 1 leaf,"* ]]
}

@test "a ball that turns in its socket is proved by parts, none of which stands for others" {
    run -0 "$IMPINGE" pair 'sphere radius=.9 ! rotate axis=1,2,3 rate=2' sphere --gamma 0.01 --proof socket.proof --json
    json '.verdict == "clear" and .stats.pairs > 1'
    run -0 verify socket.proof
    one=$output
    run -0 verify socket.proof --threads 3
    [ "$output" = "$one" ]
    run -0 "$IMPINGE" pair 'sphere radius=.9 ! rotate axis=1,2,3 rate=2' sphere --gamma 0.01 --json
    json '.verdict == "clear" and .stats.pairs == 1'
}

# For a turn by more than pi within a cell, bounds by axes are as wide as the bore.
@test "balls, cans and boxes that turn often in a bore are proved about one centre" {
    local turn='rotate axis=0,0,1 rate' rate
    for rate in 6 30; do
        "$IMPINGE" pair "sphere ! rotate rate=$rate" 'cylinder radius=1.01 height=0.5' --proof ball
        "$IMPINGE" pair "cylinder radius=0.99 height=0.5 ends=true ! $turn=$rate" \
            'cylinder height=2' --proof can
        "$IMPINGE" pair "box size=1,1,1 ! $turn=$rate" 'cylinder radius=0.75 height=3' --proof box
        for pair in ball can box; do
            run -0 verify "$pair"
            [[ $output =~ ([0-9]+)" tests" ]]
            [ "${BASH_REMATCH[1]}" -lt 600 ]
        done
    done
}

@test "a proof that is not finished is refused in these words, with the option that allows more" {
    "$IMPINGE" pair 'sphere ! rotate rate=10' 'cylinder radius=1.01 height=0.5' --proof ball
    run -1 verify ball --effort 1
    [[ $output == *'its effort ran out; not finished, not found false: try --effort above 1' ]]
    run -0 verify ball
    "$IMPINGE" pair sphere 'sphere center=3,0,0' --proof balls
    sed 's/^apart .*/apart 1.5/' balls > false
    run -1 verify false
    [[ $output != *--effort* ]]
}

# Each flank is nearer to the other's axis than the other's crests: no distance from the axis parts
# them, and leaves that were cut for a bolt at rest would have to be cut again in time.
@test "a nut on its bolt is proved by parts, each for some of the time" {
    local bolt='thread pitch=2 height=0.5 ! screw pitch=2 rate=1'
    local nut='thread radius=1.1 pitch=2 height=1'
    "$IMPINGE" pair "$bolt" "$nut" --gamma 0.04 --proof thread.proof
    run -0 timeout 60 "$top_builddir"/tools/impinge-verify thread.proof
    [[ $output =~ ([0-9]+)" tests" ]]
    [ "${BASH_REMATCH[1]}" -lt 4000 ]
}

@test "what a changed file states is not believed" {
    "$IMPINGE" clearance sphere "$near" --tolerance 0.1 --proof distance.proof
    sed 's/^apart .*/apart 1/' distance.proof >larger.proof
    run -1 verify larger.proof
    [[ $output == "refused at byte "*": "*"'a' piece 0, u ["*"claimed apart by 1: "* ]]
    head -c -5 distance.proof >shorter.proof
    run -1 verify shorter.proof
    [[ $output == "refused at byte "*": it ends too early" ]]
    printf x >>distance.proof
    run -1 verify distance.proof
    [[ $output == "refused at byte "*": bytes follow the checksum" ]]
}

@test "a type whose bounds lie makes no certificate that holds" {
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/include_sinks.so plugins
    run -0 "$IMPINGE" pair include_sinks 'sphere radius=0.1 center=0,0,0.5' --gamma 1e-3 \
        --plugin-path plugins --proof lie.proof
    [[ $output == clear* ]]
    run -1 verify lie.proof
    [[ $output == "refused at byte "*": 'a' piece 0, "*"claimed apart by 0.0005: "* ]]
}

# sealed OLD NEW SED-EXPRESSION: a copy with other lines, and the checksum that belongs to them.
sealed() {
    head -c -32 "$1" | sed "$3" >"$2"
    # shellcheck disable=SC2059 # the digest becomes escapes
    printf "$(sha256sum "$2" | cut -c 1-64 | sed 's/../\\x&/g')" >>"$2"
}

@test "a certificate is a receipt for its scene, version and plugins" {
    mkdir plugins
    cp "$top_builddir"/plugins/.libs/{sphere,translate}.so plugins
    scene >scene.json
    "$IMPINGE" solve scene.json --gamma 1e-2 --plugin-path plugins --proof receipt
    [ "$(grep -ac '^type \(sphere\|translate\) [0-9a-f]\{64\} \(sphere\|translate\).so$' receipt)" -eq 2 ]
    run -0 verify receipt scene.json --quiet --plugin-path plugins
    [ "$output" = holds ]
    run -0 verify receipt scene.json --quiet # the build's own, of the same bytes
    printf x >>plugins/translate.so
    run -3 verify receipt scene.json --plugin-path plugins
    [ "$output" = "stale: the type translate has changed: plugins/translate.so" ]
    run -0 verify receipt --quiet # it still holds
    sealed receipt older 's/^program impinge .*/program impinge 0.0.1/'
    run -3 verify older scene.json
    [[ $output == "stale: the version has changed: "*", not 0.0.1" ]]
    sealed receipt gone 's/^\(type sphere .*\) sphere.so/\1 globe.so/'
    run -3 verify gone scene.json
    [ "$output" = "stale: the type sphere: its plugin globe.so is not found; name its folder by --plugin-path" ]
    sealed receipt unnamed '/^scene /d'
    run -3 verify unnamed scene.json
    [ "$output" = "stale: the certificate names no scene" ]
    scene '"id": 7,' >scene.json
    run -3 verify receipt scene.json
    [ "$output" = "stale: the scene has changed" ]
    run -2 verify receipt none.json
}

@test "a receipt is of the files that its scene names, wherever the folder is" {
    mkdir one two two/parts
    printf '0,0,0,0\n1,0.5,0,0\n' >'one/100% moves.csv'
    printf 'v 0 0 3\nv 1 0 3\nv 0 1 3\nf 1 2 3\n' >one/roof.obj
    jq -n '{bodies: [{surfaces: [{type: "sphere"}],
                      maps: [{type: "translate", file: "100% moves.csv"}]},
                     {surfaces: [{type: "mesh", file: "roof.obj"}]},
                     {surfaces: [{type: "mesh", file: "roof.obj", scale: 2}],
                      maps: [{type: "translate", velocity: [0, 0, 1]}]}]}' >one/scene.json
    run -0 "$IMPINGE" solve one/scene.json --gamma 1e-2 --proof receipt
    [ "$(grep -ac '^file ' receipt)" -eq 2 ]
    grep -aqx "file $(sha256sum <'one/100% moves.csv' | cut -c 1-64) 100%25 moves.csv" receipt
    grep -aqx "file $(sha256sum <one/roof.obj | cut -c 1-64) roof.obj" receipt
    cp one/* two
    for scene in one/scene.json two/scene.json; do run -0 verify receipt "$scene" --quiet; done
    (cd one && verify ../receipt scene.json --quiet)
    echo >>two/roof.obj
    run -3 verify receipt two/scene.json
    [ "$output" = "stale: the file roof.obj has changed" ]
    cp one/roof.obj two
    rm 'two/100% moves.csv'
    run -3 verify receipt two/scene.json
    [ "$output" = "stale: the file 100%25 moves.csv cannot be read" ]
    run -0 verify receipt one/scene.json --tighten short
    [ "$(grep -ac '^file ' short)" -eq 2 ]
    sealed receipt bad 's/^file .* roof.obj/file 12/'
    run -1 verify bad
    [[ $output == "refused at byte "*"names no file"* ]]
}

@test "a receipt is of the files that a file of a scene names" {
    printf '%36s' '' | tr ' ' '\0' >corners.bin
    printf '\0\0\200\77' | dd of=corners.bin bs=1 seek=12 conv=notrunc status=none
    printf '\0\0\200\77' | dd of=corners.bin bs=1 seek=28 conv=notrunc status=none
    cat >roof.gltf <<'END'
{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "corners.bin"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]}
END
    jq -n '{bodies: [{surfaces: [{type: "sphere"}], maps: [{type: "translate", velocity: [1, 0, 0]}]},
                     {surfaces: [{type: "mesh", file: "roof.gltf"}],
                      maps: [{type: "translate", offset: [[0, 0, 3]]}]}]}' >scene.json
    run -0 "$IMPINGE" solve scene.json --gamma 1e-2 --proof receipt
    grep -aqx "file $(sha256sum <corners.bin | cut -c 1-64) corners.bin" receipt
    run -0 "$IMPINGE" solve scene.json --gamma 1e-2 --proof isolated --isolate all
    diff <(grep -a '^file ' receipt) <(grep -a '^file ' isolated)
    run -0 verify receipt scene.json --quiet
    printf x >>corners.bin
    run -3 verify receipt scene.json
    [ "$output" = "stale: the file corners.bin has changed" ]
}

@test "what cannot be read again is no receipt" {
    printf 'v 0 0 3\nv 1 0 3\nv 0 1 3\nf 1 2 3\n' >roof.obj
    echo '{"bodies": [{"surfaces": [{"type": "sphere"}]},
                      {"surfaces": [{"type": "mesh", "file": "roof.obj"}]}]}' >scene.json
    "$IMPINGE" solve scene.json --gamma 1e-2 --proof receipt
    sealed receipt lost 's/^file [0-9a-f]* /file - /'
    run -3 verify lost scene.json
    [ "$output" = "stale: the file roof.obj could not be read again when it was written" ]
    rm roof.obj
    mkfifo roof.obj # is not waited for
    run -3 timeout 60 "$top_builddir"/tools/impinge-verify receipt scene.json
    [ "$output" = "stale: the file roof.obj cannot be read" ]
}

@test "a receipt names a type once, and files without a folder" {
    "$IMPINGE" pair sphere "$near" --gamma 1e-2 --proof clear.proof
    [ "$(grep -ac '^type ' clear.proof)" -eq 1 ]
    for line in 'type sphere 0' 'type sphere 0 ../sphere.so' 'type sphere'; do
        sealed clear.proof bad "s|^type .*|$line|"
        run -1 verify bad
        [[ $output == "refused at byte "* ]]
    done
}

@test "--tighten writes a shorter certificate of the same claim, which takes fewer tests" {
    "$IMPINGE" solve "$top_srcdir"/tools/data/teapot.json --proof teapot.proof
    run -0 verify teapot.proof
    claim=("${lines[@]:0:3}")
    run -0 verify teapot.proof --tighten short.proof
    [[ $output == *"tightened: "*" leaves to "*" tests to "*" bytes to $(stat -c %s short.proof)" ]]
    read -r _ leaves _ _ fewer_leaves tests _ _ fewer_tests _ <<<"${lines[-1]//,/}"
    [ $((3 * fewer_leaves)) -lt $((2 * leaves)) ]
    [ "$fewer_tests" -lt "$tests" ]
    [ "$(stat -c %s short.proof)" -lt "$(stat -c %s teapot.proof)" ]
    run -0 verify short.proof --threads 2
    [ "${lines[*]:0:3}" = "${claim[*]}" ]
    [[ ${lines[3]} == *" surfaces, $fewer_leaves leaves, $fewer_tests tests" ]]
    run -0 verify - --quiet --tighten again.proof <short.proof
    [ "$output" = holds ]
    [ "$(stat -c %s again.proof)" -le "$(stat -c %s short.proof)" ]
}

@test "--tighten keeps what is assumed, and all pieces" {
    local some
    some=$("$IMPINGE" info subdivision --json | jq -r '.types[0].example')
    "$IMPINGE" pair "$some" 'sphere center=9,0,0' --gamma 1e-2 --proof said.proof
    run -0 verify said.proof --tighten said.short
    [ "${lines[0]}" = "holds assuming subdivision" ]
    run -0 verify said.short --quiet
    [ "$output" = "holds assuming subdivision" ]
    "$IMPINGE" pair 'box ! rotate axis=1,2,3 rate=2' 'box center=1.9,0,0' --gamma 1e-2 --proof box.proof
    run -0 verify box.proof --tighten box.short --quiet
    [ "$output" = holds ]
    run -0 verify box.short --quiet
    [ "$output" = holds ]
}

@test "--tighten leaves no part of a file, and writes over no certificate that is read" {
    "$IMPINGE" pair sphere "$near" --gamma 1e-2 --proof clear.proof
    cp clear.proof kept
    run -2 verify clear.proof --tighten clear.proof
    [ "$output" = "impinge-verify: clear.proof: is the certificate that is read; name another file" ]
    ln -s clear.proof link
    run -2 verify clear.proof --tighten link
    cmp clear.proof kept
    run -2 verify clear.proof --tighten -
    [[ $output == *"name a file" ]]
    run -2 verify clear.proof --tighten none/out
    [[ $output == *"none/out: No such file or directory" ]]
    sealed clear.proof false 's/^apart .*/apart 1/'
    echo mine >out
    run -1 verify false --tighten out
    [ "$(cat out)" = mine ]
    run -2 verify missing --tighten out
    [ "$(cat out)" = mine ]
    run -3 verify clear.proof "$top_srcdir"/tools/data/teapot.json --tighten out
    [ "$(cat out)" = mine ]
    [ ! -e out.part ]
    ln -s elsewhere planted.part
    run -2 verify clear.proof --tighten planted
    [[ $output == *"planted.part: is in the way, and not a file of ours; remove it" ]]
    run -2 verify clear.proof --tighten /dev/full
    [[ $output == *"/dev/full: No space left on device"* ]]
}

# A bicubic patch and a torus that turns, of some ninety leaves.
patch_certificate() {
    "$IMPINGE" clearance 'bezier degree=3,3 points=[[0,0,0],[0,1,0.3],[0,2,0],[0,3,0],[1,0,0],[1,1,0.5],[1,2,0],[1,3,0],[2,0,0],[2,1,0.2],[2,2,0],[2,3,0],[3,0,0],[3,1,0],[3,2,0],[3,3,0]]' \
        'torus major_radius=1 minor_radius=.3 center=0,0,2 ! rotate axis=1,0,0 rate=2' \
        --tolerance 0.2 --proof patch.proof
}

@test "--coq draws leaves, the same for one seed" {
    patch_certificate
    run -0 verify patch.proof --coq some.v --goals 5
    [[ ${lines[-1]} == "goals: 5 of the "*" leaves that Coq can be told, of "* ]]
    [ "$(grep -c '^Theorem' some.v)" -eq 5 ]
    [ "$(grep -c '^Lemma leaf' some.v)" -eq 10 ]
    verify patch.proof --coq same.v --goals 5
    cmp some.v same.v
    verify patch.proof --coq other.v --goals 5 --seed 2
    run -1 cmp -s some.v other.v
    run -0 verify patch.proof --coq all.v --goals 1000 --quiet
    [ "$output" = holds ]
    [ "$(grep -c '^Theorem' all.v)" -eq "$(verify --text patch.proof | grep -c '^leaf')" ]
    sealed patch.proof false 's/^apart .*/apart 3/'
    run -1 verify false --coq none.v
    [ ! -e none.v ]
    run -2 verify patch.proof --coq none.v --tighten none.proof
    run -2 verify patch.proof --coq none.v --goals 0
    run -2 verify patch.proof --coq patch.proof
}

@test "Coq proves 20 leaves, and none that was made false" {
    command -v coqc >/dev/null || skip "no coqc (coq, libcoq-interval)"
    echo 'From Interval Require Import Tactic.' >there.v
    coqc there.v || skip "no library Interval of Coq (libcoq-interval)"
    patch_certificate
    verify patch.proof --coq patch.v --goals 20
    [ "$(grep -c '^Theorem' patch.v)" -eq 20 ]
    coqc patch.v
    sed '0,/ <= (\?[0-9/^ ]*)\?\.$/s// <= (-1000000000)./' patch.v >wrong.v
    run -1 cmp -s patch.v wrong.v
    run -1 coqc wrong.v
    [[ $output == *"Numerical evaluation failed to conclude"* ]]
}

@test "--text prints the tree, and bad usage is told" {
    "$IMPINGE" pair sphere "$near" --gamma 1e-2 --proof clear.proof
    run -0 verify --text clear.proof
    [[ $output == "pair 0 1: 'a' and 'b'"*leaf*holds* ]]
    run -2 verify
    run -2 verify missing.proof
    [[ $output == *"missing.proof: No such file or directory" ]]
    run -2 "$IMPINGE" solve missing.json --each --proof f
    [[ $output == *"--proof and --each exclude each other, since a certificate is of one answer; leave --each out"* ]]
    run -2 "$IMPINGE" clearance missing.json --profile 2 --proof f
    [[ $output == *"--proof and --profile exclude each other"*"give the --time of one slice" ]]
    run -2 "$IMPINGE" solve missing.json --refine 1e-2 --proof f
    [[ $output == *"--proof and --refine exclude each other"*"give the last --gamma" ]]
}

@test "certificates of an arm, of a teapot and a torus, and of meshes that roll by hold" {
    "$IMPINGE" clearance "$top_srcdir"/tools/data/arm.json --require 2 --proof arm.proof
    "$IMPINGE" solve "$top_srcdir"/tools/data/teapot.json --proof teapot.proof
    printf 'v %s\n' '1 0 0' '0 1 0' '-1 0 0' '0 -1 0' '0 0 1' '0 0 -1' >gem.obj
    printf 'f %s\n' '1 2 5' '2 3 5' '3 4 5' '4 1 5' '2 1 6' '3 2 6' '4 3 6' '1 4 6' >>gem.obj
    "$IMPINGE" pair 'mesh file=gem.obj ! rotate axis=0,0,1 rate=2' \
        'mesh file=gem.obj ! rotate axis=1,2,3 rate=1 ! translate offset=[[2.5,0.2,0.1],[-1,0,0]]' \
        --gamma 1e-3 --proof gems.proof
    for name in arm teapot gems; do
        run -0 verify "$name.proof" --quiet
        [ "$output" = holds ]
    done
}

# Each type beside, or each map under, a ball that passes by.
@test "certificates of every type and map hold, or say whose formula is missing" {
    local kind name example a
    "$IMPINGE" list --json | jq -r '.types[] | "\(.kind) \(.name)"' >types
    [ "$(wc -l <types)" -ge 38 ]
    while read -r kind name; do
        example=$("$IMPINGE" info "$name" --json |
            jq -r --arg kind "$kind" '.types[] | select(.kind == $kind).example')
        a=$example
        [ "$kind" = surface ] || a="cylinder radius=0.5 height=1 ! $example"
        "$IMPINGE" pair "$a" 'sphere radius=0.4 center=3.5,3,7 ! translate velocity=0.2,0,-1' \
            --time 0,1 --gamma 1e-3 --proof "$name.proof" >/dev/null
        run verify "$name.proof" --quiet
        echo "$kind $name: $output" | tee -a verdicts
    done <types
    [ "$(grep -v ': holds$' verdicts | sort)" = 'map bend: holds assuming bend
surface subdivision: holds assuming subdivision' ]
}

@test "certificates of rollers that spin beside each other hold" {
    local ends
    for ends in false true; do
        run -0 "$IMPINGE" pair "cylinder radius=.4 ends=$ends ! rotate rate=5" \
            "cylinder radius=.7 height=1.1 center=1.101,0,.1 ends=$ends" --gamma 1e-3 --proof rollers
        [[ $output == clear* ]]
        run -0 verify rollers --quiet
    done
}

# An axis parts a strip of a cone, and turns with it. In a half plane about their line, one parts all.
@test "a cone that turns in a cone, and a vase of straight sides, are proved by few tests" {
    local turn='rotate axis=0,0,1 rate=3' line='revolution profile=[[1,-0.1],[0.5,0.4]]'
    "$IMPINGE" pair cone "cone center=0,0,-0.1 ! $turn" --gamma 1e-2 --proof cones
    "$IMPINGE" pair 'revolution profile=[[1,0],[0.5,0.5]]' "$line ! $turn" --gamma 1e-2 --proof turned
    "$IMPINGE" pair 'revolution profile=[[1,0],[0,1]] ! rotate axis=0,0,1 rate=-7' \
        'revolution profile=[[0.9,0],[0,0.9]] ! rotate axis=0,0,1 rate=20' --gamma 1e-2 --proof both
    for pair in cones turned both; do
        run -0 verify "$pair"
        [[ $output =~ ([0-9]+)" tests" ]]
        [ "${BASH_REMATCH[1]}" -lt 400 ]
    done
}

@test "a box that slides or turns on the face of another is parted by the face's normal" {
    local table='box size=6,1,1 center=0,-1.5,0'
    for moves in 'translate velocity=1,0,0' 'rotate axis=0,1,0 rate=2'; do
        run -0 "$IMPINGE" clearance "$table" "box size=1,1.9998,1 center=0.9,0,0 ! $moves" --proof face.proof
        run -0 verify face.proof --quiet --effort 20
        [ "$output" = holds ]
    done
}
