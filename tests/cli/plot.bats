#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge plot: distance over time with its proved band, and benchmarks.

load ../support/cli_helper

has_png() { grep -q '^#define HAVE_LIBPNG 1' "$top_builddir/config.h"; }

@test "distance over time falls from 2 to 0, with the contact in the middle" {
    run -0 "$IMPINGE" plot "$left" "$right" --gamma 1e-3 --slices 34
    [[ ${lines[0]} == 'Distance between bodies over time, sphere radius=1'* ]]
    [[ $output == *'|  contact, t = 0.4995'* || $output == *'|  contact, t = 0.49'* ]]
    awk '{ if (length($0) > 79) exit 1 }' <<<"$output"
    # Between the axis's bars: the band's row in the first column, then, and behind the contact.
    band() { awk -F'|' -v c="$1" 'NF > 1 && ++r && substr($2, c, 1) == "#" { print r; exit }' <<<"$plot"; }
    plot=$(sed -n '3,22p' <<<"$output")
    [ "$(band 1)" -le 3 ] && [ "$(band 17)" -gt "$(band 1)" ] && [ "$(band 60)" -gt "$(band 17)" ]
}

@test "the band of every slice holds the exact distance" {
    # Centres 4 - 4 t apart, radii 1 and 1: the least of a slice is at its end, until they touch.
    "$IMPINGE" plot "$left" "$right" --time 0,0.4 --gamma 1e-3 --slices 10 -o gap.svg
    grep '^<polygon' gap.svg | head -n 10 >bands
    [ "$(wc -l <bands)" -eq 10 ]
    # The frame's top is 2 and its bottom 0: 74 pixels from above, 62 from below, 480 in all.
    sed 's/.*points="\([^"]*\)".*/\1/' bands | awk -F'[ ,]' '{
        exact = 2 - 4 * 0.04 * NR
        low = 2 * (418 - $2) / 344; high = 2 * (418 - $6) / 344
        if (!(low <= exact + 0.006 && exact <= high + 0.006 && high - low < 0.25)) bad = 1
    } END { exit bad }'
}

@test "plots are written as SVG and PNG" {
    run -0 "$IMPINGE" plot "$left" "$right" --slices 4 -o gap.svg
    [ "$output" = 'gap.svg: 960x480 pixels' ]
    grep -q '>Distance between bodies over time, sphere' gap.svg
    has_png || skip 'built without libpng'
    run -0 "$IMPINGE" plot "$left" "$right" --slices 4 -o gap.png
    [ "$(od -An -tx1 -N 8 gap.png | tr -d ' ')" = 89504e470d0a1a0a ]
}

@test "the least distance is marked with the bodies' names, and what is required as a line" {
    local passing=('sphere ! translate velocity=2,0,0' 'sphere center=1,3,0')
    run -0 "$IMPINGE" plot "${passing[@]}" --require 1.1
    [[ $output == *'  *  least 1 at t = 0.5, a and b'* && $output == *'  -  required 1.1'* ]]
    # The star is in the middle of the row below the line's.
    local star line
    star=$(grep -n '|.*\*' <<<"$output" | head -n 1)
    line=$(grep -n '|.*---' <<<"$output" | head -n 1)
    [ "${star%%:*}" -gt "${line%%:*}" ]
    run -0 "$IMPINGE" plot "${passing[@]}" --require 1.1 -o gap.svg
    grep -q '>least 1 at t = 0.5, a and b<' gap.svg && grep -q '>required 1.1<' gap.svg
    # A low line has its words in the margin, where they hide nothing; a high one has the legend there.
    run -0 "$IMPINGE" plot "${passing[@]}" --require 0.1 -o low.svg
    run -0 "$IMPINGE" plot "${passing[@]}" --require 1e9 -o high.svg
    [ "$(sed -n 's/.* x="\([0-9]*\).*>required 0.1<.*/\1/p' low.svg)" -gt 800 ]
    [ "$(sed -n 's/.* x="\([0-9]*\).*>required 1e+09<.*/\1/p' high.svg)" -lt 750 ]
    run -0 "$IMPINGE" plot "$left" "$right" --slices 4 -o gap.svg
    run ! grep -q 'least ' gap.svg
    fails 2 '--require must be a finite number greater than 0' "$IMPINGE" plot "$left" "$right" --require 0
}

@test "endings may be in capitals" {
    run -0 "$IMPINGE" plot "$left" "$right" --slices 2 -o GAP.SVG
    [ "$output" = 'GAP.SVG: 960x480 pixels' ]
    grep -q '</svg>' GAP.SVG
}

@test "distances too large for a sum, and times, have a place" {
    run -0 "$IMPINGE" plot 'sphere radius=1e307' 'sphere radius=1e307 center=9e307,0,0' --slices 2 --max-seconds 3 -o far.svg
    run ! grep -qE 'nan|inf' far.svg
}

@test "figure 7 is plotted from a run of the benchmark, or from what it printed" {
    local budget
    budget=$(scaled 100000) # of pairs, for the paper's method
    run -0 "$IMPINGE" plot figure7 --max-pairs "$budget"
    [[ $output == 'impinge bench figure7'*'S'*'axis, models'*'oblique, paper, spheres'* ]]
    "$IMPINGE" bench figure7 --max-pairs "$budget" --json >bench.json
    run -0 "$IMPINGE" plot bench.json -o bench.svg
    [ "$(grep -c '>oblique, ' bench.svg)" -eq 3 ]
    # A dot for each mean above 0, and one for each of six methods in the legend.
    [ "$(jq '[.sets[].cases[].methods[] | select(.pairs.mean > 0)] | length' bench.json)" -eq \
        "$(($(grep -c '^<polygon' bench.svg) - 6))" ]
}

@test "what cannot be plotted is refused, before anything is solved" {
    fails 2 "unknown set 'figure8', did you mean 'figure7'?" "$IMPINGE" plot figure8
    fails 2 '--output must end with one of .png, .svg' "$IMPINGE" plot "${endless[@]}" -o gap.pdf
    fails 2 '--slices must be from 1 to 10000' "$IMPINGE" plot "$left" "$right" --slices 0
    echo '{"sets": []}' >none.json
    fails 4 'none.json: not one set that' "$IMPINGE" plot none.json
    echo '{"sets": [{"set": "x", "cases": [{}]}]}' >odd.json
    fails 4 'odd.json: not what `impinge bench --json` prints' "$IMPINGE" plot odd.json
    fails 4 'nowhere.json' "$IMPINGE" plot nowhere.json
}
