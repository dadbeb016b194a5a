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
    printf 'v 0 0 0\nv 2 0 0\nv .1 .1 0\nv 0 2 0\n\nf 1 2 3 4\n' >dent.obj
    refused dent.obj "', line 6: face 0 of 4 corners is not convex; divide it into triangles"
    printf 'v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n' >bent.obj
    refused bent.obj 'is not plane; divide it into triangles'
    printf 'v 0 0 0\nv 1 0 0\nl 1 2\n' >line.obj
    refused line.obj "statement 'l'; of OBJ only points and faces are read"
    printf 'OFF\n999999999999999 1 0\n0 0 0\n' >huge.off
    refused huge.off 'the file ends before point 1 of 999999999999999'
    head -n 7 parts/square.stl >cut.stl
    refused cut.stl "the file ends before 'endfacet'"
    head -c 90 /dev/zero >binary.stl
    refused binary.stl 'neither text'
    : >empty.obj
    refused empty.obj 'no faces in it'
}

@test "what is no file, or of another kind, is refused at once" {
    mkdir folder.obj
    refused folder.obj 'cannot be read'
    refused nowhere.off 'cannot be read'
    ln -s /dev/zero endless.stl
    refused endless.stl 'cannot be read'
    echo >cube.ply
    refused cube.ply 'ends in none of .obj, .off, .stl'
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
