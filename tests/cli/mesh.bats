#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The type mesh: its files, and what is wrong with them.

load ../support/cli_helper

# A square at z = 0, in each format.
write_squares() {
    mkdir -p parts
    printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 -1\n' >parts/square.obj
    printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' >parts/square.off
    {
        echo 'solid square'
        for corners in '1 0 0/1 1 0' '1 1 0/0 1 0'; do
            printf 'facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex %s\nvertex %s\nendloop\nendfacet\n' \
                "${corners%/*}" "${corners#*/}"
        done
        echo 'endsolid square'
    } >parts/square.stl
}

# refused FILE TEXT: the mesh of that file is refused with that text, which names the file.
refused() {
    run -4 "$IMPINGE" pair "mesh file=$1" sphere
    echo "$output"
    [[ $output == *"file: '$1"*"$2"* ]]
}

@test "files of all formats are read, relative to the scene, and answer alike" {
    write_squares
    mkdir -p scenes
    local format
    for format in obj off stl; do
        cat >scenes/s.json <<END
{"bodies": [{"name": "plate", "surfaces": [{"type": "mesh", "file": "../parts/square.$format"}]},
    {"name": "ball", "surfaces": [{"type": "sphere", "radius": 0.25, "center": [0.25, 0.75, 1]}],
     "maps": [{"type": "translate", "velocity": [0, 0, -1]}]}]}
END
        run -0 "$IMPINGE" solve scenes/s.json --json
        jq -e '.verdict == "contact" and (.t - 0.75 | fabs) < 1e-5 and .a.piece == 1' <<<"$output"
    done
}

@test "what is wrong with a file is named with its line and what may be done" {
    write_squares
    printf 'v 0 0 0\nv 1 0 0\nv 2 x 0\n' >bad.obj
    refused bad.obj "', line 3: 'x' is not a finite number"
    printf 'v 0 0 0\nf 1 2 3\n' >index.obj
    refused index.obj "', line 2: point 2 of a face, but only 1 so far"
    printf 'v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\n\nf 1 2 3 4\n' >crossed.obj
    refused crossed.obj "', line 6: face 0 of 4 corners crosses itself; divide it into triangles"
    printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n' >half.ply
    refused half.ply "', line 4: 'half' is no type of a property"
    printf 'glTF\2\0\0\0\100\0\0\0\100\0\0\0JSON{}' >cut.glb
    refused cut.glb "', byte 12: a chunk of 64 bytes, but only 2 are left"
    printf '{"asset": {"version": "2.0"},\n "nodes": [}' >bad.gltf
    refused bad.gltf "', line 2: JSON: "
    printf 'OFF\n999999999999999 1 0\n0 0 0\n' >huge.off
    refused huge.off 'the file ends before point 1 of 999999999999999'
    head -n 7 parts/square.stl >cut.stl
    refused cut.stl "the file ends before 'endfacet'"
    head -c 90 /dev/zero >binary.stl
    refused binary.stl 'neither text'
    { printf 'solid of %071d' 0; printf '\4\0\0\0cut'; } >cut_binary.stl
    refused cut_binary.stl 'nor binary: 87 bytes, in place of 284 for 4 triangles'
    printf 'ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\nabcd' >cut.ply
    refused cut.ply "', byte 118: the file ends before all elements"
    : >empty.obj
    refused empty.obj 'no faces in it'
}

@test "what a file has beside its faces is left out, counted, and told to programs" {
    printf 'v 0 0 0\nv 2 0 0\nv .1 .1 0\nv 0 2 0\nl 1 2\np 3\nf 1 2 3 4\nf 1 1 2\n' >robot.obj
    run -0 --separate-stderr "$IMPINGE" pair 'mesh file=robot.obj' 'sphere radius=0.1 center=1,1,5' --json
    jq -e '.warnings | length == 1 and .[0].count == 4 and .[0].type == "mesh" and .[0].body == "a"' <<<"$output"
    [[ $stderr == *"warning: body 'a', mesh, file: statements that are no faces, left out: 2, the first in line 5; "* ]]
    [[ $stderr == *"faces not plane and convex, cut into triangles: 1, the first in line 7; triangles without area"* ]]
    # the dent is empty, and the segment is there
    run -0 --separate-stderr "$IMPINGE" pair 'mesh file=robot.obj' 'sphere radius=0.1 center=1,1,0' --json
    json '.verdict == "clear"'
    run -0 --separate-stderr "$IMPINGE" pair 'mesh file=robot.obj' 'sphere radius=0.1 center=1,0,0' --json
    json '.verdict == "contact"'
    local body='{"surfaces": [{"type": "mesh", "file": "robot.obj"}]}'
    echo "{\"bodies\": [$body, {\"surfaces\": [{\"type\": \"mesh\", \"file\": \"robot.obj\"}, {\"type\": \"sphere\"}]}]}" >two.json
    run -0 --separate-stderr "$IMPINGE" solve two.json --json
    jq -e '.warnings | length == 1' <<<"$output"
    run -0 --separate-stderr "$IMPINGE" clearance two.json --json
    jq -e '.warnings[0].count == 4' <<<"$output"
    run -0 --separate-stderr "$IMPINGE" batch two.json
    jq -e '.warnings[0].surface == 0' <<<"$output"
}

@test "PLY and glTF, in all their forms, answer as OBJ does" {
    write_squares
    cat >parts/square.ply <<'END'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
1 1 0
0 1 0
4 0 1 2 3
END
    # points and indices of the square as bytes, beside the document
    {
        for x in 0 0 0 1 0 0 1 1 0 0 1 0; do
            if [ $x = 1 ]; then printf '\0\0\200\77'; else printf '\0\0\0\0'; fi
        done
        printf '\0\1\2\0\2\3'
    } >'parts/a square.bin'
    cat >parts/square.gltf <<'END'
{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 54, "uri": "a%20square.bin"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
               {"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "nodes": [{"mesh": 0}]}
END
    local format
    for format in obj ply gltf; do
        run -0 "$IMPINGE" pair "mesh file=parts/square.$format scale=2,2,1" \
            'sphere radius=0.25 center=0.5,1.5,1 ! translate velocity=0,0,-1' --json
        jq -e '.verdict == "contact" and (.t - 0.75 | fabs) < 1e-5 and .a.piece == 1' <<<"$output"
    done
    rm 'parts/a square.bin'
    refused parts/square.gltf "a square.bin' cannot be read"
    fails 4 'scale: 2 factors, must be 1, or 3 for x, y and z' \
        "$IMPINGE" pair 'mesh file=parts/square.obj scale=1,2' sphere
    fails 4 'scale: a factor of 0, must not be 0' "$IMPINGE" pair 'mesh file=parts/square.obj scale=0' sphere
}

@test "what is no file, or of another kind, is refused at once" {
    mkdir folder.obj
    refused folder.obj 'cannot be read'
    refused nowhere.off 'cannot be read'
    ln -s /dev/zero endless.stl
    refused endless.stl 'cannot be read'
    echo >cube.step
    refused cube.step 'ends in none of .obj, .off, .stl, .ply, .gltf, .glb'
}

@test "points and faces in the scene are checked too" {
    run -4 "$IMPINGE" pair 'mesh points=[[0,0,0],[1,0,0],[0,1,0]] faces=[[0,1,3]]' sphere
    [[ $output == *'faces/0: '*'corner 2 of face 0 is point 3 of 3 (from 0)'* ]]
    run -4 "$IMPINGE" pair 'mesh points=[[0,0,0]]' sphere
    [[ $output == *'faces: must be given, where no file is'* ]]
    run -4 "$IMPINGE" pair 'mesh points=[[0,0,0],[1,0,0],[0,1,0]] faces=[[0,1,2]] velocities=[[0,0,1]]' sphere
    [[ $output == *'1 velocities for 3 points'* ]]
}

@test "a byte order mark before a mesh of text is passed over" {
    local mark=$'\xEF\xBB\xBF'
    printf '%sv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' "$mark" >mark.obj
    printf '%sOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' "$mark" >mark.off
    printf '%ssolid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n' \
        "$mark" >mark.stl
    for format in obj off stl; do
        run -0 "$IMPINGE" pair "mesh file=mark.$format" 'sphere radius=0.1 center=0.2,0.2,0' --json
        json '.verdict == "contact"'
    done
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 2 3\n' >zero.obj
    fails 4 'point 0 does not exist; points are numbered from 1, or backwards from -1' \
        "$IMPINGE" pair 'mesh file=zero.obj' sphere
}

@test "--max-bytes counts what a file holds, and the processes of isolated types" {
    # The estimate for a label grows with the first 120 bytes of values only.
    { printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n#%200s\n' ''; } >small.obj
    { cat small.obj && head -c 999999 /dev/zero | tr '\0' '#' && echo; } >large.obj
    bytes() { "$IMPINGE" pair "mesh file=$1" 'sphere center=0,0,3' "${@:2}" --json | jq '.stats.bytes'; }
    [ $(($(bytes large.obj) - $(bytes small.obj))) -eq 1000000 ]
    [ "$(bytes small.obj --isolate all)" -gt "$(bytes small.obj)" ]
    run -0 "$IMPINGE" pair 'mesh file=small.obj' 'sphere center=0,0,3' --max-bytes 500K --json
    json '.verdict == "clear"'
    run -3 --separate-stderr "$IMPINGE" pair 'mesh file=large.obj' 'sphere center=0,0,3' \
        --max-bytes 500K --json
    json '.error | contains("max_bytes is not enough to read this")'
}

# A scene of that mesh and a ball, on one line.
mesh_scene() {
    printf '{%s"bodies": [{"surfaces": [{"type": "mesh", "file": "%s"}]},' "${2:-}" "$1"
    printf ' {"surfaces": [{"type": "sphere", "center": [0, 0, 9]}]}]}\n'
}

# A file of N points and one face.
points() {
    awk -v n="$1" 'BEGIN { for (k = 0; k < n; ++k) printf "v %d %d 1\n", k, k % 2; print "f 1 2 3" }'
}

@test "a mesh that --max-bytes has no room for is refused from its length, in every verb" {
    truncate -s 900M long.stl # of zeros, which the disk does not hold
    mesh_scene long.stl >scene.json
    local verb
    for verb in 'solve' 'clearance' 'view -o x.svg' 'simulate -o x.json'; do
        # shellcheck disable=SC2086 # words of the command
        run -3 --separate-stderr timeout 20 "$IMPINGE" $verb scene.json --max-bytes 50M --json
        json '.error | contains("scene.json: /bodies/0/surfaces/0: max_bytes is not enough")'
    done
    [ ! -e x.svg ] && [ ! -e x.json ]
    { mesh_scene long.stl '"id": 1, ' && scene '"id": 2,'; } >scenes.jsonl
    run -3 --separate-stderr timeout 20 "$IMPINGE" batch scenes.jsonl --max-bytes 50M
    jq -es '.[0].id == 1 and (.[0].error | contains("line 1: /bodies/0/surfaces/0: max_bytes"))' \
        <<<"$output"
    jq -es '.[1].verdict == "contact"' <<<"$output"
}

@test "a mesh that grows beyond --max-bytes while it is read ends there, isolated or not" {
    points 50000 >many.obj # 590 KB in the file, 1.2 MB of points
    run -3 --separate-stderr "$IMPINGE" pair 'mesh file=many.obj' sphere --max-bytes 1M --json
    json '.error | contains("max_bytes is not enough to read this")'
    run -3 --separate-stderr "$IMPINGE" pair 'mesh file=many.obj' sphere --max-bytes 1M --json \
        --isolate all
    json '.error | contains("max_bytes is not enough to read this")'
    run -0 "$IMPINGE" pair 'mesh file=many.obj' 'sphere center=0,0,-3' --max-bytes 3M --json
}

@test "reading a mesh ends with --max-seconds, and costs a line of a batch, not the others" {
    points 100000 >part.obj
    for _ in {1..75}; do cat part.obj; done >long.obj # 0.36 s; the least limit is 0.1 s
    { mesh_scene long.obj '"id": 1, ' && scene '"id": 2,'; } >scenes.jsonl
    run -3 --separate-stderr "$IMPINGE" batch scenes.jsonl --max-seconds 0.001
    jq -es '.[0].id == 1 and (.[0].error | contains("max_seconds is not enough to read this"))' \
        <<<"$output"
    jq -es '.[1].id == 2 and .[1].verdict != null' <<<"$output"
    run -3 --separate-stderr "$IMPINGE" pair 'mesh file=long.obj' sphere --max-seconds 0.001 \
        --isolate all --json
    json '.error | contains("max_seconds is not enough to read this")'
    mesh_scene part.obj >scene.json
    run -3 --separate-stderr "$IMPINGE" info scene.json --max-seconds 1e-9
    [[ -z $output && $stderr == *"--max-seconds was over before it was known whether "* ]]
    run -0 "$IMPINGE" info scene.json --max-seconds 100
}

@test "the text of a scene counts against --max-bytes, and what is parsed of it" {
    {
        printf '{"bodies": [{"surfaces": [{"type": "mesh", "faces": [[0, 1, 2]], "points": [[0, 0, 0]'
        printf ',[%d,1,0]' {1..20000}
        printf ']}]}, {"surfaces": [{"type": "sphere", "center": [0, 0, 9]}]}]}'
    } >scene.json
    local verb
    for verb in 'solve' 'clearance' 'view -o x.svg' 'simulate -o x.json' 'batch'; do
        # shellcheck disable=SC2086 # words of the command
        run -3 --separate-stderr "$IMPINGE" $verb scene.json --max-bytes 2M
        [[ $output$stderr == *'is not enough to read this'* ]]
    done
    run -0 "$IMPINGE" solve scene.json --max-bytes 20M
    run -4 --separate-stderr "$IMPINGE" solve - --max-bytes 100K <scene.json
    [[ $stderr == *'standard input: it is longer than 102400 bytes' ]]
}
