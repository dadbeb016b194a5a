#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The type bezier-triangle: many triangles as one surface.

load ../support/cli_helper

@test "bezier-triangle has nets and pieces, and its example is drawn" {
    run -0 "$IMPINGE" info bezier-triangle --json
    json '.types[0].capabilities == ["core", "order-2", "net", "pieces", "formula"]'
    run -0 "$IMPINGE" info bezier-triangle --view triangle.svg
    [ "$(grep -c '^<polyline' triangle.svg)" -gt 50 ]
}

# face K of the pebble as a surface of its own.
faces_as_surfaces='.bodies[0].surfaces[0] as $all | .bodies[0].surfaces =
    [$all.faces[] | {type: $all.type, degree: $all.degree, points: [$all.points[.[]]]}]'

@test "a pebble of PN triangles meets the ring where its triangles one by one do" {
    local scene=$top_srcdir/tools/data/pebble.json whole
    run -0 "$IMPINGE" solve "$scene" --json
    valid result
    json '.verdict == "contact" and .t > 0.5 and .gap <= .gamma'
    whole=$output
    jq "$faces_as_surfaces" "$scene" >parts.json
    run -0 "$IMPINGE" solve parts.json --json
    json --argjson whole "$whole" '.verdict == "contact" and (.t - $whole.t | fabs) < 1e-5'
    run -0 "$IMPINGE" view "$scene" -o pebble.svg
    [ "$(grep -c '^<polyline' pebble.svg)" -gt 50 ]
}
