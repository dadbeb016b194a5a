#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The guide of the SDK, other build systems and other languages.

load ../support/sdk_helper

# --- The guide ----------------------------------------------------------------------------------
# Files and commands of the guide, in its order: "file NAME", "command TEXT", or "line TEXT".
parts_of_guide() {
    awk '/^File [^ ]+:$/ { print "file " substr($2, 1, length($2) - 1); inside = 1; next }
         /^    \$ / { print "command " substr($0, 7); inside = 0; next }
         /^[^ ]/ { inside = 0 }
         inside { print "line " substr($0, 5) }' "$prefix/share/doc/impinge/sdk/README"
}

@test "every file and every command of the guide works as it stands, in its order" {
    local kind text file
    parts_of_guide >parts
    [ "$(grep -c '^file ' parts)" -ge 3 ]
    [ "$(grep -c '^command ' parts)" -ge 10 ]
    while IFS= read -r line; do
        kind=${line%% *} text=${line#* }
        case $kind in
        file) file=$text ;;
        line) printf '%s\n' "$text" >>"$file" ;;
        command) run_commands <<<"$text" ;;
        esac
    done <parts
    impinge list --json | jq -e '.refused == []'
}

@test "the guide names every operation of the model headers" {
    local name guide
    guide=$(<"$prefix/share/doc/impinge/sdk/README")
    for name in $(sed -nE 's/^static inline (imp_model|void) imp_([a-z0-9_]*[a-z0-9])\(.*/\2/p' \
        "$prefix"/include/impinge/model*.h | sort -u); do
        case $name in param | between | unbounded | model_*) continue ;; esac
        grep -qwE "(imp_)?$name" <<<"$guide" || { echo "no $name"; false; }
    done
}

@test "impinge-sdk.pc keeps a * b + c as written, and check notes where it is contracted" {
    { [ "$(uname -m)" = x86_64 ] && grep -qw fma /proc/cpuinfo; } || skip 'needs fused operations'
    local source=$prefix/share/doc/impinge/sdk/examples/seashell.c
    # shellcheck disable=SC2046 # flags are words
    $CC -shared -fPIC -O2 -mfma -o seashell.so "$source" $(pkg-config --cflags --libs impinge-sdk)
    run -0 impinge check seashell --plugin-path . --only build
    $CC -shared -fPIC -O2 -mfma -o seashell.so "$source" -I"$prefix/include" -lm
    run -0 impinge check ./seashell.so --only build
    [[ $output == *'note  build        compiled so that a * b + c is rounded once'*'add -ffp-contract=off'* ]]
}

# --- Other builds -------------------------------------------------------------------------------
# The commands for the machines of GitHub or GitLab that check the plugin: as in the project.
ci_check() { grep -o 'impinge check .* --require proved --badge badge.json' "$1"; }

@test "a project in C++ for CMake builds, is checked, installed and proved as its CI demands" {
    command -v cmake >/dev/null || skip 'no cmake'
    new_project drumhead --cxx --cmake
    grep -q '100% tests passed' "$log"
    grep -q '^contact at t = 0\.862' "$log"
    [ "$(ls "$user")" = drumhead.so ]
    [ "$(nm -D --defined-only "$user/drumhead.so" | awk '{ print $3 }')" = impinge_plugin ]
    run -0 bash -c "$(ci_check .github/workflows/check.yml) --effort 0.1"
    jq -e '.message == "proved" and .version == "0.1"' badge.json
    cmp <(ci_check .github/workflows/check.yml) <(ci_check .gitlab-ci.yml)
}

@test "find_package(ImpingeSDK) takes versions that fit, and installs below a prefix" {
    command -v cmake >/dev/null || skip 'no cmake'
    run -0 impinge new sway --map --cmake
    cd sway
    hurry
    cmake -S . -B build -DCMAKE_INSTALL_PREFIX="$PWD/there" >/dev/null
    cmake --build build >/dev/null
    cmake --install build >/dev/null
    [ "$(cd there && find . ! -type d)" = ./lib/impinge/1/sway.so ]
    sed -i 's/find_package(ImpingeSDK /&0.1 /' CMakeLists.txt
    cmake -S . -B build >/dev/null
    sed -i 's/find_package(ImpingeSDK 0.1/find_package(ImpingeSDK 7/' CMakeLists.txt
    run ! cmake -S . -B build
}

@test "a project for Meson builds, is checked and installed" {
    command -v meson >/dev/null || skip 'no meson'
    new_project sway --map --meson
    grep -q '^contact at t = 0\.7' "$log"
    [ "$(ls "$user")" = sway.so ]
}

@test "a project in C++ for autotools builds, and new refuses what does not go together" {
    new_project drumhead --cxx
    grep -q '^# PASS:  1' "$log"
    fails 2 'exclude each other' impinge new a --cmake --meson
    fails 2 'which are written in C' impinge new a --map --cxx
    [ ! -e a ]
}

# --- While it is written ------------------------------------------------------------------------
@test "watch builds, checks and solves again when the file is saved, and says what changed" {
    hurry
    local k
    run -0 impinge new drum folder
    cp folder/drum.c .
    echo '{"gamma": 1e-2, "bodies": [{"surfaces": [{"type": "drum"}]},
        {"surfaces": [{"type": "sphere", "radius": 0.5, "center": [0,0,2]}],
         "maps": [{"type": "translate", "velocity": [0,0,-2]}]}]}' >scene.json
    impinge watch drum.c scene.json --rounds 2 >log 2>&1 &
    for ((k = 0; k < 600; ++k)); do
        grep -q '^  answer ' log && break
        sleep 0.05
    done
    sed -i 's/, free),/&\n    .include = NULL,/' drum.c
    wait $!
    cat log
    grep -q '^  check    passed' log
    grep -q '^  answer   contact at t = 0\.8.*; before: .*pairs (+' log
    fails 4 'nowhere/: No such file' impinge watch nowhere/a.c scene.json
    fails 2 'a source file is wanted' impinge watch a.txt scene.json
}

@test "the guide is a page, too, with every section and every line of code" {
    local page=$prefix/share/doc/impinge/sdk/guide.html
    [ "$(grep -c '<h2 ' "$page")" -eq "$(grep -cxE -- '-{3,}' "${page%/*}/README")" ]
    [ "$(sed -n '/<pre>/,/<\/pre>/p' "$page" | grep -c IMPINGE_SURFACE_PLUGIN)" -eq \
        "$(grep -c '^    .*IMPINGE_SURFACE_PLUGIN' "${page%/*}/README")" ]
    [ "$(grep -o '<pre>' "$page" | wc -l)" -eq "$(grep -c '</pre>' "$page")" ]
}

# --- Other languages ----------------------------------------------------------------------------
@test "the page of the layout tells what this build has, and the smallest sizes that hosts take" {
    local page=$prefix/share/doc/impinge/sdk/layout.txt line
    cc -o layout -I"$prefix/include" "$top_srcdir/tests/abi/layout.c"
    ./layout >now
    sed -n '/^number IMP_ABI_MAJOR/,$p' "$page" >told
    [ "$(wc -l <told)" -gt 150 ]
    while read -r line; do
        # What may grow is at least as large as when it was frozen.
        [[ $line == *"may grow" ]] || grep -qxF "$line" now || { echo "no: $line"; false; }
    done <told
    [ "$(tr '\n' ' ' <"$page" | grep -oE 'imp_surface_type [0-9]+ bytes' | grep -oE '[0-9]+')" -eq \
        "$(awk '$2 == "imp_surface_type.piece_count" && $1 == "field" { print $4 }' now)" ]
    [ "$(tr '\n' ' ' <"$page" | grep -oE 'imp_map_type [0-9]+ \(up' | grep -oE '[0-9]+')" -eq \
        "$(awk '$2 == "imp_map_type.rigid" && $1 == "field" { print $4 }' now)" ]
}

@test "the linkable operations are the inline ones, to the last bit, and none is missing" {
    local name
    hurry
    for name in $(sed -nE 's/^static inline (imp_model|void) imp_([a-z0-9_]*[a-z0-9])\(.*/\2/p' \
        "$prefix"/include/impinge/model*.h | sort -u); do
        case $name in model_zero | model_collapse | model_within | model_box | series_* | compose | \
            point_within) continue ;; esac
        grep -q "impinge_$name(" "$prefix/include/impinge/model_link.h" || { echo "no $name"; false; }
    done
    cat >same.c <<'END'
#include <impinge/model_link.h>
#include <stdio.h>
#include <string.h>
static int wrong;
#define SAME(NAME, ...) do { imp_model x = imp_##NAME(__VA_ARGS__), y = impinge_##NAME(__VA_ARGS__); \
    if (memcmp(&x, &y, sizeof x) != 0) wrong = 1, puts(#NAME); } while (0)
int main(void)
{
    imp_region r = imp_region_between((double[3]){0.2, 0.3, 0.1}, (double[3]){0.5, 0.4, 0.7});
    imp_model u = imp_param(&r, 0), v = imp_param(&r, 1), t = imp_param(&r, 2);
    SAME(add, u, v); SAME(sub, u, t); SAME(mul, u, v); SAME(div, u, v); SAME(sqr, t); SAME(sqrt, t);
    SAME(exp, u); SAME(log, u); SAME(sin, t); SAME(cos, t); SAME(tan, t); SAME(asin, u); SAME(acos, u);
    SAME(atan, t); SAME(atan2, u, v); SAME(sinh, u); SAME(cosh, u); SAME(tanh, u); SAME(pow, u, 1.5);
    SAME(powi, u, 3); SAME(min, u, v); SAME(max, u, t); SAME(lerp, u, v, t); SAME(scale, u, 3);
    return wrong;
}
END
    # shellcheck disable=SC2046 # flags are several words
    cc -O2 same.c -o same $(pkg-config --cflags impinge-sdk) -L"$prefix/lib" -limpinge-model -lm
    ./same
}

@test "the gear of two classes in C++ answers as the gear in C does" {
    g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" \
        "$prefix/$examples/gear_pieces.cc"
    impinge build "$prefix/$examples/gear_pieces.cc"
    impinge build "$prefix/$examples/gear.c"
    impinge check ./gear_pieces.so --effort 0.05 --require tested
    answer() {
        impinge pair "$1 teeth=20 roll=0.5 ! rotate rate=1" --plugin-path . --json \
            'sphere radius=0.2 center=2,0,0 ! translate velocity=-1,0,0' |
            jq -c '[.verdict, .t, .a.piece]'
    }
    [ "$(answer gear-pieces)" = "$(answer involute-flanks)" ]
    [[ $(answer gear-pieces) == '["contact",'* ]]
    run -4 impinge pair 'gear-pieces roll=2' sphere --plugin-path .
    [[ $output == *"roll: the flanks of a tooth meet before that"* ]]
}

@test "the gear in Rust answers as the gear in C does, to the last bit" {
    rustc --version >/dev/null 2>&1 || skip 'no rustc'
    local crate=$prefix/share/doc/impinge/sdk/gear-rs
    rustc --edition 2021 --crate-type cdylib -C opt-level=1 -C panic=abort -L "$prefix/lib" \
        -o gear_rs.so "$crate/src/lib.rs"
    impinge build "$prefix/$examples/gear.c"
    impinge check ./gear_rs.so --effort 0.05 --require tested
    answer() {
        impinge pair "$1 teeth=20 roll=0.5 ! rotate rate=1" --plugin-path . --json \
            'sphere radius=0.2 center=2,0,0 ! translate velocity=-1,0,0' |
            jq -c 'del(.scene, .stats.seconds, .stats.bytes)'
    }
    [ "$(answer gear-rs)" = "$(answer involute-flanks)" ]
    [ "$(answer gear-rs | jq -r .verdict)" = contact ]
    run -4 impinge pair 'gear-rs roll=2' sphere --plugin-path .
    [[ $output == *"the flanks of a tooth meet before that"* ]]
}
