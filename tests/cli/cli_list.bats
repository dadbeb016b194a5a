#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge list and impinge info: what there is, and everything about it.

load ../support/cli_helper

# --- list -----------------------------------------------------------------------------------------

@test "list shows each type's sort, name, summary and file, surfaces first" {
    run -0 "$IMPINGE" list
    [[ $output =~ surface\ +sphere\ +[a-z] && $output =~ map\ +rotate\ +[a-z] ]]
    run -0 "$IMPINGE" list --files
    [[ $output =~ surface\ +sphere\ +/.*/sphere\.so ]]
    [[ $output =~ map\ +rotate\ +/.*/rotate\.so ]]
    [ "$(cut -d' ' -f1 <<<"$output" | sed '/^$/,$d' | uniq)" = $'surface\nmap' ]
    [[ $output =~ [0-9]+\ surface\ types,\ [0-9]+\ maps\. ]]
}

@test "list fits a screen of 80 columns, and no summary is cut" {
    run -0 "$IMPINGE" list
    awk 'length($0) > 79 { exit 1 }' <<<"$output"
    local flat summary
    flat=$(tr -s ' \n' ' ' <<<"$output")
    while read -r summary; do
        [[ $flat == *" $summary "* ]]
    done < <("$IMPINGE" list --json | jq -r '.types[].summary')
}

@test "colour is for terminals alone, and may be refused" {
    needs_terminal
    on_terminal() { TERM=xterm script -qec "$IMPINGE list $1" /dev/null; }
    run -0 "$IMPINGE" list
    [[ $output != *$'\e['* ]]
    unset NO_COLOR
    run -0 on_terminal
    [[ $output == *$'\e[1msphere'* ]]
    run -0 on_terminal --no-color
    [[ $output != *$'\e['* ]]
    NO_COLOR=1 run -0 on_terminal
    [[ $output != *$'\e['* ]]
}

@test "info draws the example of a surface, and of a map on a surface" {
    local name
    for name in torus twist bezier; do
        run -0 "$IMPINGE" info $name --view $name.svg
        [[ $output == *"$name.svg: "*'surfaces to within '* ]]
        [ "$(grep -c '^<polyline' $name.svg)" -gt 100 ]
    done
    fails 2 '--output must end with one of' "$IMPINGE" info torus --view torus.gif
}

@test "list as JSON holds the same types" {
    run -0 "$IMPINGE" list --json
    valid types
    json '.types | map([.kind, .name]) | . == (sort | reverse | group_by(.[0]) | reverse
        | map(sort) | add)'
    json '.types | any(.kind == "surface" and .name == "sphere" and .shadowed_by == null)'
    json '.types[] | select(.name == "sphere") | .plugin == "sphere" and (.version | length > 0)
        and (.capabilities | contains(["core", "order-2", "distance", "symmetry"]))'
    json '.types | all(.file | startswith("/"))'
}

@test "a file that is rejected is counted, and --refused shows why" {
    mkdir plugins
    echo 'no plugin' >plugins/text.so
    run -0 "$IMPINGE" list --plugin-path "$PWD/plugins"
    [[ $output == *'1 file or directory was rejected; `impinge list --refused` shows why.'* ]]
    run -0 "$IMPINGE" list --plugin-path "$PWD/plugins" --refused
    [[ ${lines[0]} == "$PWD/plugins/text.so: "* ]]
    run -0 "$IMPINGE" list --plugin-path "$PWD/plugins" --json
    valid types
    json '.refused | length == 1 and .[0].reason != ""'
}

@test "where nothing is rejected --refused says so" {
    run -0 "$IMPINGE" list --refused
    [ "$output" = 'Nothing was rejected.' ]
}

@test "a second type of the same name is shown as shadowed" {
    mkdir first
    cp "$top_builddir/plugins/.libs/sphere.so" first
    run -0 "$IMPINGE" list --plugin-path "$PWD/first"
    [[ $output == *"shadowed by $PWD/first/sphere.so"* ]]
    [[ $output == *', 1 shadowed.'* ]]
    run -0 "$IMPINGE" list --plugin-path "$PWD/first" --json
    valid types
    json --arg file "$PWD/first/sphere.so" \
        '.types | map(select(.name == "sphere")) | length == 2 and .[0].file == $file
            and .[0].shadowed_by == null and .[1].shadowed_by == $file'
}

@test "plugins on IMPINGE_PLUGIN_PATH come before those of the build tree, behind --plugin-path" {
    mkdir named asked
    cp "$top_builddir/plugins/.libs/sphere.so" named
    cp "$top_builddir/plugins/.libs/sphere.so" asked
    first() { jq -r '[.types[] | select(.name == "sphere" and .shadowed_by == null)][0].file'; }
    export IMPINGE_PLUGIN_PATH=$PWD/named
    [ "$("$IMPINGE" list --json | first)" = "$PWD/named/sphere.so" ]
    [ "$("$IMPINGE" list --json --plugin-path "$PWD/asked" | first)" = "$PWD/asked/sphere.so" ]
}

# --- info -----------------------------------------------------------------------------------------

@test "info tells everything about a surface" {
    run -0 "$IMPINGE" info sphere
    [[ ${lines[0]} == 'sphere (surface): '* ]]
    [[ $output == *'equation '*'parameters'*'radius: number, > 0; default 1; unit length'* ]]
    [[ $output == *'center: vector of 3 numbers; default [0,0,0]; unit length'* ]]
    [[ $output == *'example '*'plugin '*'Apache-2.0'*'file '*'/sphere.so' ]]
}

@test "info lists what the host uses of a type" {
    uses() { "$IMPINGE" info "$1" --json | jq -r '.types[0].capabilities | join(" ")'; }
    [ "$(uses sphere)" = 'core order-2 distance symmetry formula renew' ]
    [ "$(uses torus)" = 'core order-2 distance symmetry formula renew tube' ]
    [ "$(uses superellipsoid)" = 'core order-2 formula renew' ]
    [ "$(uses bezier)" = 'core order-2 net formula renew' ]
    [ "$(uses translate)" = 'core order-2 net rigid span formula renew' ]
    [ "$(uses rotate)" = 'core order-2 rigid span formula renew' ]
    [ "$(uses motion-formula)" = 'core order-2 rigid formula' ]
    [ "$(uses tolerance)" = 'core order-2 formula parts' ]
    run -0 "$IMPINGE" info triangle
    [[ $output == *'uses       core order-2 net formula'* ]]
    run -0 "$IMPINGE" info ellipsoid
    [[ $output == *'formula    u in [0, 2*pi]; v in [-pi/2, pi/2]; center0 + radii0*cos(v)*cos(u); '* ]]
}

@test "info tells shapes of lists, and what is required" {
    run -0 "$IMPINGE" info bezier
    [[ $output == *'degree: vector of 2 integers, each from '*' to '*'; required'* ]]
    [[ $output == *'points: list of vectors of 3 numbers, '*'; required; unit length'* ]]
    [[ $output == *'; optional'* ]]
}

@test "info as JSON is as the schema says, for every type" {
    local name
    for name in $("$IMPINGE" list --json | jq -r '.types[].name' | sort -u); do
        run -0 "$IMPINGE" info "$name" --json
        valid types
        json --arg name "$name" '.types | length > 0 and all(.name == $name)'
        json '.types | all(has("equation") and has("parameters") and has("example"))'
    done
}

@test "the command that info proposes runs, for every type" {
    local name command
    impinge() { "$IMPINGE" "$@"; }
    for name in $("$IMPINGE" list --json | jq -r '.types[].name' | sort -u); do
        while read -r command; do
            run eval "$command --gamma 1e-2 --max-seconds 5"
            [ "$status" -eq 0 ] || [ "$status" -eq 3 ]
        done < <("$IMPINGE" info "$name" | sed -n 's/^  try  *//p')
    done
}

@test "a surface and a map of one name are told of both, and neither shadows the other" {
    build_twin
    run -0 "$IMPINGE" info twin --plugin-path "$PWD"
    [[ $output == 'twin (surface): one of two'*'parameters none'*'twin (map): the other'* ]]
    run -0 "$IMPINGE" info twin --plugin-path "$PWD" --json
    valid types
    json '.types | map(.kind) == ["surface", "map"] and all(.shadowed_by == null)'
}

@test "a plugin that breaks its promises ends the query with status 5, and a batch goes on" {
    build_twin
    fails 5 'twin' "$IMPINGE" pair twin twin --plugin-path "$PWD"
    {
        echo '{"id": 1, "bodies": [{"name": "a", "surfaces": [{"type": "twin"}]}, {"name": "b",' \
            '"surfaces": [{"type": "twin"}]}]}'
        scene '"id": 2,'
    } >scenes.jsonl
    run -5 --separate-stderr "$IMPINGE" batch scenes.jsonl --plugin-path "$PWD"
    valid result
    jq -es 'map(has("error")) == [true, false]' <<<"$output"
}

@test "info of an unknown type names the nearest" {
    fails 4 "info: unknown type 'torsu', did you mean 'torus'?" "$IMPINGE" info torsu
    fails 4 'impinge list' "$IMPINGE" info zzzzzzzz
    fails 4 --plugin-path "$IMPINGE" info ./wobble.so
}
