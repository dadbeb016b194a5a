#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The type subdivision: control meshes from files, and what is wrong with them.

load ../support/cli_helper

# refused SURFACE TEXT: it is refused with that text.
refused() {
    run -4 "$IMPINGE" pair "subdivision $1" sphere
    echo "$output"
    [[ $output == *"$2"* ]]
}

# The cube of the sides -1 and 1 as quads; as OBJ, numbered from 1.
write_cube() {
    printf 'v %s\n' '-1 -1 -1' '1 -1 -1' '-1 1 -1' '1 1 -1' '-1 -1 1' '1 -1 1' '-1 1 1' '1 1 1'
    printf 'f %s\n' '1 3 4 2' '5 6 8 7' '1 2 6 5' '3 7 8 4' '1 5 7 3' '2 4 8 6'
}

@test "a file of polygons is divided into pieces, and answers as lists do" {
    write_cube >cube.obj
    local ball='sphere radius=0.25 center=0.4,0.4,2 ! translate velocity=0,0,-2' lists
    lists=$("$IMPINGE" info subdivision | sed -n 's/^  example *//p')
    "$IMPINGE" pair 'subdivision file=cube.obj' "$ball" --json | jq 'del(.scene, .stats)' >file
    "$IMPINGE" pair "$lists" "$ball" --json | jq 'del(.scene, .stats)' >lists
    diff file lists
    jq -e '.verdict == "contact" and .a.piece < 24' file
    # a pyramid: triangles and a square
    printf 'v %s\n' '-1 -1 0' '1 -1 0' '1 1 0' '-1 1 0' '0 0 1' >pyramid.obj
    printf 'f %s\n' '4 3 2 1' '1 2 5' '2 3 5' '3 4 5' '4 1 5' >>pyramid.obj
    run -0 "$IMPINGE" pair 'subdivision file=pyramid.obj' 'point position=0,0,2 velocity=0,0,-2' --json
    jq -e '.verdict == "contact" and .t < 1' <<<"$output"
}

# An octahedron of the corners 1 and -1 on the axes; as OFF.
write_octahedron() {
    printf 'OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n'
    printf '3 %s\n' '0 2 4' '2 1 4' '1 3 4' '3 0 4' '2 0 5' '1 2 5' '3 1 5' '0 3 5'
}

@test "triangles are subdivided by the scheme that is asked for" {
    write_octahedron >octahedron.off
    local point='point position=2,0,0 velocity=-2,0,0'
    run -0 "$IMPINGE" pair 'subdivision scheme=loop file=octahedron.off' "$point" --gamma 1e-9 --json
    jq -e '.verdict == "contact" and .a.piece < 32 and (.a.point[0] - 24 / 55 | fabs) < 1e-8' <<<"$output"
    run -0 "$IMPINGE" pair 'subdivision file=octahedron.off' "$point" --gamma 1e-9 --json
    jq -e '(.a.point[0] - 24 / 55 | fabs) > 1e-2' <<<"$output"
    [ "$("$IMPINGE" pair 'subdivision scheme=catmull-clark file=octahedron.off' "$point" --gamma 1e-9 --json |
        jq -c .t)" = "$(jq -c .t <<<"$output")" ]
}

@test "a scheme that is not there, and faces that it does not take, are refused with the cure" {
    write_cube >cube.obj
    refused 'scheme=butterfly file=cube.obj' "scheme: 'butterfly' is not a scheme; catmull-clark and loop are"
    refused 'scheme=loop file=cube.obj' "face 0 has 4 corners, Loop's scheme takes triangles; divide it into"
    refused 'scheme=loop points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0]] faces=[[0,1,2,3]]' \
        'faces: face 0 has 4 corners'
    refused 'scheme=loop points=[[0,0,0],[1,0,0],[1,1,0]] faces=[[0,1,2],[2,1,0]]' \
        "faces 0 and 1 are all around point 0, Loop's scheme takes three or more; leave one out"
}

@test "faces that are no surface are named, with the points and the cure" {
    local points='points=[[0,0,0],[1,0,0],[1,1,0],[0,1,0],[2,0,0],[2,1,0]]'
    refused "$points faces=[[0,1,2,1]]" 'face 0 has point 1 twice; leave one out, or divide the face'
    refused "$points faces=[[0,1,2,3],[1,2,5,4]]" \
        'faces 0 and 1 both go from point 1 to point 2; turn one of them round, or separate them'
    refused "$points faces=[[0,1,3],[1,4,5],[1,2,3]]" \
        'faces 1 and 2 meet at point 1 alone, in two fans; give one of the fans a point of its own'
    refused "$points faces=[[0,1,3],[1,0,2],[0,1,4]]" 'faces 0 and 2 both go from point 0 to point 1'
}

@test "what is wrong with a file's faces is said with its name; a file without common points is refused" {
    write_cube >cube.obj
    echo 'f 1 3 4 2' >>cube.obj
    refused file=cube.obj "file: 'cube.obj': faces 0 and 6 both go from point 0 to point 2"
    printf 'solid s\nendsolid s\n' >s.stl
    refused file=s.stl 'triangles of such a file share no points; write it as .obj, .off or .ply'
}

@test "no more than 256 faces meet at a point, and no face has more corners" {
    {
        printf 'OFF\n258 257 0\n0 0 1\n'
        seq 257 | awk '{ print cos($1 / 41), sin($1 / 41), 0 }'
        seq 257 | awk '{ print 3, 0, $1, $1 % 257 + 1 }'
    } >fan.off
    refused file=fan.off '257 faces at point 0 (face 0 is one), may be 256; divide the mesh there'
    {
        printf 'OFF\n257 1 0\n'
        seq 257 | awk '{ print cos($1 / 41), sin($1 / 41), 0 }'
        echo 257 $(seq 0 256)
    } >disk.off
    refused file=disk.off 'face 0 has 257 corners, may have 256; divide it'
}

# falls_into_tray NAME: what falls touches the tray as its clearance says.
falls_into_tray() {
    local scene=$top_srcdir/tools/data/$1.json t
    run -0 "$IMPINGE" solve "$scene" --json
    jq -e '.verdict == "contact" and .t > 0.5 and .t < 0.9' <<<"$output"
    t=$(jq .t <<<"$output")
    run -0 "$IMPINGE" clearance "$scene" --time "0,$(jq -n "$t - 0.01")" --json
    jq -e '.lower > 0 and .upper < 0.1' <<<"$output"
    run -0 "$IMPINGE" view "$scene" -o scene.svg
    [ "$(grep -c '^<polyline' scene.svg)" -gt 100 ]
}

@test "a die that falls into a tray touches it as its clearance says, and both are drawn" {
    falls_into_tray die
}

@test "an egg of triangles that falls into a tray of triangles does so, too" {
    falls_into_tray egg
}
