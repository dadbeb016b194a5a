#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The ABI of plugins and the interface of libimpinge are those that others were built against.

load ../support/sdk_helper

# --- The ABI ------------------------------------------------------------------------------------
# layout FOLDER_OF_HEADERS
layout() {
    $CC -std=c11 -I"$1" -o layout "$top_srcdir/tests/abi/layout.c" && ./layout
}

# Is what layout printed, on standard input, an ABI that plugins of 1.0 can live with? Prints what
# they would stumble over.
compare_layout() {
    awk 'NR == FNR { now[$0] = 1; if ($1 == "size") size[$2] = $3; next }
         $0 in now { next }
         $1 == "size" && $4 == "may" && size[$2] > $3 { next }
         { print }' - "$top_srcdir/tests/abi/layout_1.txt"
}

@test "sizes, offsets, callbacks and numbers of the ABI are those of version 1.0" {
    layout "$prefix/include" >now
    run -0 compare_layout <now
    [ -z "$output" ]
}

@test "the table of the ABI leaves no byte of a struct out" {
    awk '$1 == "size" { if (end != size) { print of " ends at " end; bad = 1 }
                        of = $2; size = $3; end = $4 == "fixed" && $3 == 4 ? 4 : 0 }
         $1 == "field" { if ($4 != end) { print $2 " does not begin at " end; bad = 1 }
                         end = $4 + $6 }
         END { exit bad || end != size }' "$top_srcdir/tests/abi/layout_1.txt"
}

# changed SED_SCRIPT LINE...: with the ABI header edited so, the comparison prints these lines.
changed() {
    mkdir -p impinge
    sed -e "$1" -e '/^IMP_LAYOUT(/{:a;/;$/!{N;ba};d}' "$prefix/include/impinge/surface.h" \
        >impinge/surface.h
    shift
    layout . >now
    run -0 compare_layout <now
    echo "$output"
    [ "$output" = "$(printf '%s\n' "$@")" ]
}

@test "a field that moves, a callback that changes and a new number are found; growth is not" {
    changed '/const char \*equation;/{h;d};/const char \*source;/{G}' \
        field\ imp_{surface,map}_type.{'equation at 32','source at 40'}' of 8'
    changed 's/(\*eval)(const void \*self, size_t n/(*eval)(const void *self, uint32_t n/' \
        "$(grep '^call .*\.eval ' "$top_srcdir/tests/abi/layout_1.txt")"
    changed 's/IMP_STATUS_DOMAIN = 1/IMP_STATUS_DOMAIN = 5/' 'number IMP_STATUS_DOMAIN 1'
    changed 's/^} imp_region;/double more; &/' 'size imp_region 96 fixed'
    changed 's/^} imp_surface_type;/void (*more)(void); &/' ''
}

on_x86_64() { [ "$(uname -m)" = x86_64 ] || skip 'the fixture is for x86-64'; }

@test "a plugin built by the first release is loaded, listed and paired" {
    on_x86_64
    run -0 impinge list --plugin-path "$top_srcdir/tests/abi" --json
    jq -e '[.types[] | select(.file | endswith("fixture_1_0.so")) | .name] | sort == ["fixture_bare",
        "fixture_kinds", "fixture_lean", "fixture_rise", "fixture_sheet"]' <<<"$output"
    run -0 impinge pair 'fixture_sheet ! fixture_lean' 'fixture_bare ! fixture_rise' --gamma 1e-4 \
        --plugin-path "$top_srcdir/tests/abi"
    [[ $output == 'contact at t = 0'$'\n'* ]]
    # t (1 - u v) = 0.75 t / (1 + u^2 + v^2) + u v + 2 - 2 t, first at u = 1, v = 0: t = 2/2.625.
    run -0 impinge pair fixture_bare 'fixture_sheet ! translate offset=[[0,0,2],[0,0,-2]]' \
        --plugin-path "$top_srcdir/tests/abi" --json
    jq -e '.verdict == "contact" and .t > 0.761904 and .t < 0.761905' <<<"$output"
}

@test "its types answer as they did then, to the last digit" {
    on_x86_64
    $CC -o ask_fixture "$top_srcdir/tests/abi/ask_fixture.c" $(pkg-config --cflags --libs impinge) \
        -Wl,-rpath,"$prefix/lib" -ldl
    ./ask_fixture "$top_srcdir/tests/abi" >answers
    diff "$top_srcdir/tests/abi/fixture_1_0.txt" answers
}

# --- The interface of libimpinge ----------------------------------------------------------------
with_abidiff() {
    command -v abidiff >/dev/null || skip 'abidiff (abigail-tools) not found'
    readelf -S "$top_builddir/.libs/libimpinge.so" | grep -q debug_info ||
        skip 'libimpinge was built without debug information'
}

@test "programs built against the kept libimpinge can use this one" {
    with_abidiff
    "$top_srcdir/tests/abi/libimpinge" compare "$top_builddir"
}

@test "a function that is gone from libimpinge is found" {
    with_abidiff
    mkdir tests
    cp -R "$top_srcdir/tests/abi" tests
    ln -s "$top_srcdir/core" "$top_srcdir/sdk" .
    chmod -R u+w tests
    sed -i 's/imp_query_step/imp_forgotten/' tests/abi/libimpinge_0.abi
    run ! tests/abi/libimpinge compare "$top_builddir"
    [[ $output == *imp_forgotten* ]]
}

@test "types in C++ are proved by their formulas, and no exception leaves a callback" {
    local file
    for file in waves puddle; do impinge build "$prefix/$examples/$file.cc" >/dev/null; done
    export IMPINGE_PLUGIN_PATH=$PWD
    run -0 impinge check waves --only proof --effort 0.1 --formula 'u; v; height*sin(waves*(u+v/2)-speed*t)'
    [[ $output == *'  proved('* ]]
    fails 4 'size: must be below 1e100' impinge pair 'puddle size=1e101' sphere
    run -0 impinge check puddle
    for std in 17 20; do
        g++ -std=c++$std -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" "$prefix/$examples/puddle.cc"
    done
    g++ -std=c++17 -fno-exceptions -Wall -Wextra -Werror -fsyntax-only -I"$prefix/include" "$prefix/$examples/waves.cc"
}

@test "C++ before C++17 is told so, once" {
    echo '#include <impinge/formula.h>' >old.cc
    run ! g++ -std=c++14 -fsyntax-only -I"$top_srcdir/sdk" old.cc
    [[ $output == *"need C++17: compile with -std=c++17"* ]]
    [ "$(grep -c 'error: #error' <<<"$output")" -eq 1 ]
    [ "${#lines[@]}" -lt 16 ]
    g++ -std=c++17 -fsyntax-only -I"$top_srcdir/sdk" old.cc
}

@test "newer headers build for an older host where the plugin asks for that" {
    hurry
    mkdir headers
    cp -r "$prefix/include/impinge" headers/
    sed -i 's/^#define IMP_ABI_MINOR 0/#define IMP_ABI_MINOR 1/' headers/impinge/surface.h
    cp "$prefix/share/doc/impinge/sdk/examples/seashell.c" .
    newer() { cc -shared -fPIC -O0 -ffp-contract=off -Iheaders "$@" -o seashell.so seashell.c -lm; }
    newer
    run ! impinge why ./seashell.so
    [[ $output == *"abi_minor is 1, the host's is 0"*"-DIMP_ABI_MINOR_TARGET=0"* ]]
    newer -DIMP_ABI_MINOR_TARGET=0
    impinge info seashell --plugin-path .
    run ! newer -DIMP_ABI_MINOR_TARGET=2
    [[ $output == *"beyond what these headers know"* ]]
}
