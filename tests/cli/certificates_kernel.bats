#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge-verify --elaborate writes certificates that impinge-verify-kernel proves.

load ../support/cli_helper

verify() { "$top_builddir"/tools/impinge-verify "$@"; }
kernel() { "$top_builddir"/tools/impinge-verify-kernel "$@"; }

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    [ -x "$top_builddir"/tools/impinge-verify-kernel ] || skip "impinge-verify-kernel needs MPFI"
}

# elaborated PROOF: the kernel proves what is elaborated of it, and says the same claim.
elaborated() {
    run -0 verify "$1" --elaborate "$1.long"
    [[ $output == "elaborated: "*" leaves to "* ]]
    run -0 kernel "$1.long"
    [ "${lines[0]}" = holds ]
    run -0 verify "$1.long" --quiet
    [ "$output" = holds ]
}

@test "the kernel has at most 1,500 lines, and uses no others" {
    count=$(cat "$top_srcdir"/tools/kernel/*.[ch] | wc -l)
    [ "$count" -gt 500 ]
    [ "$count" -le 1500 ]
    grep -q '^tools/kernel:$' "$top_srcdir/tests/support/include_order"
    run nm -u "$top_builddir"/tools/.libs/libkernel.a
    ! grep -E ' (imp_|sha256_|formula_|statement_|input_|walk_)' <<<"$output"
}

@test "a sphere and a torus, two Bezier patches and two meshes are proved by the kernel" {
    "$IMPINGE" pair 'sphere ! translate velocity=1,0,0' 'torus major_radius=1 minor_radius=0.3 center=3,0.2,0' \
        --gamma 0.05 --proof torus.proof
    elaborated torus.proof
    "$IMPINGE" pair "$left" "$right" --gamma 0.02 --proof spheres.proof
    elaborated spheres.proof
    head -n 1 "$top_srcdir/tools/data/bicubic_moving_100.jsonl" >patches.json
    "$IMPINGE" solve patches.json --gamma 0.1 --proof patches.proof
    elaborated patches.proof
    run -0 kernel patches.proof.long
    [[ $output == *"2 bodies, 1 pair of surfaces, "*" leaves" ]]
    printf 'v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 1\nf 1 2 3\nf 2 4 3\n' >below.obj
    printf 'v 0 0 1.5\nv 2 0 1.5\nv 0 2 1.5\nv 2 2 2.5\nf 1 2 3\nf 2 4 3\n' >above.obj
    "$IMPINGE" pair 'mesh file=below.obj' 'mesh file=above.obj ! rotate axis=0,0,1 rate=1' --gamma 0.1 --proof meshes.proof
    grep -q '^file ' meshes.proof # files that the scene names, which the kernel passes over
    elaborated meshes.proof
}

@test "a shaft in its bore is proved by the kernel, whose axes hold for strips of it" {
    without_sanitizers
    "$IMPINGE" pair 'cylinder radius=0.97 height=2 ! rotate rate=1' 'cylinder height=2' --gamma 0.003 \
        --proof shaft.proof
    elaborated shaft.proof
    run -0 verify shaft.proof --elaborate again
    [[ $output == "elaborated: 8 leaves to "* ]]
    [ "$(sed 's/.* //' <<<"$output")" -lt 5000 ] # 2,290 on the day that this was written
}

@test "a door with two parameters is proved by the kernel, which says their ranges" {
    "$IMPINGE" solve "$top_srcdir/tools/data/door.json" --proof door.proof
    elaborated door.proof
    run -0 kernel door.proof.long
    [[ ${lines[1]} == "clear: no two points nearer than "*", t from 0 to 1, 'dx' from -1 to 1, 'dy' from -1 to 1" ]]
    [ "${lines[2]}" = "ignored: 'cupboard' and 'frame'" ]
}

@test "names are told in quotes that they cannot end" {
    "$IMPINGE" solve "$top_srcdir/tools/data/door.json" --proof door.proof
    verify door.proof --elaborate long --quiet
    sed "s/^\(parameter .*\) dx\$/\1 t from 0 to 9, 'x\\\\/;s/^body frame/body frame'/" long >other
    run -0 kernel other
    [[ ${lines[1]} == *", t from 0 to 1, 't from 0 to 9, \\'x\\\\' from -1 to 1, 'dy' from -1 to 1" ]]
    [ "${lines[2]}" = "ignored: 'cupboard' and 'frame\\''" ]
    [[ ${lines[3]} == "3 bodies, "*" pairs of surfaces, "* ]]
    head -c -32 other >told
    # shellcheck disable=SC2059 # the digest becomes escapes
    printf "$(sha256sum told | cut -c 1-64 | sed 's/../\\x&/g')" >>told
    run -0 verify told
    [[ ${lines[1]} == *" from t = 0 to 1, 't from 0 to 9, \\'x\\\\' from -1 to 1, 'dy' from -1 to 1" ]]
    [[ ${lines[3]} == "3 bodies, "* ]]
}

@test "motions that both surfaces share are put back" {
    local turn='rotate axis=0,0,1 rate=2'
    "$IMPINGE" pair "sphere ! $turn" "sphere center=4,0,0 ! $turn" --proof shared.proof
    run -1 kernel shared.proof
    [[ $output == "refused at byte "*": maps are left out: impinge-verify --elaborate puts them back" ]]
    elaborated shared.proof
}

@test "the kernel does not believe what a changed file states, or a type whose bounds lie" {
    "$IMPINGE" clearance sphere 'sphere center=2.01,0.1,0.2' --tolerance 0.1 --proof distance.proof
    elaborated distance.proof
    sed 's/^apart .*/apart 1/' distance.proof.long >larger
    run -1 kernel larger
    [[ $output == "refused at byte "*": 'a' u ["*": its axis does not part them; was it written by "* ]]
    run -1 verify larger --elaborate out --effort 1000
    [[ $output == "not elaborated: at byte "* ]]
    [ ! -e out ]
    head -c -5 distance.proof.long >shorter
    run -1 kernel shorter
    [[ $output == "refused at byte "*": it ends too early, or cannot be read" ]]
    mkdir plugins
    cp "$top_builddir"/tests/plugins/.libs/include_sinks.so plugins
    "$IMPINGE" pair include_sinks 'sphere radius=0.1 center=0,0,0.5' --gamma 1e-3 \
        --plugin-path plugins --proof lie.proof
    run -1 kernel lie.proof
    [[ $output == "refused at byte "* ]]
    run -1 verify lie.proof --elaborate out --effort 20000
    [[ $output == "not elaborated: at byte "* ]]
}

@test "what the kernel does not know it refuses, and says so" {
    "$IMPINGE" pair 'formula x=u y=v z=atan(u)' 'sphere center=0,0,3' --gamma 0.1 --proof atan.proof
    run -1 kernel atan.proof
    [[ $output == "refused at byte "*": a formula has a function that is not known here" ]]
    run -2 kernel
    run -2 kernel none.proof
    run -2 kernel --all
}

@test "on a terminal --elaborate tells how far it has read, unless it is to be quiet" {
    script -qec true /dev/null >/dev/null 2>&1 || skip 'no pseudo-terminal here'
    "$IMPINGE" solve "$top_srcdir/tools/data/door.json" --proof door.proof
    on_terminal() { script -qec "'$top_builddir/tools/impinge-verify' door.proof --elaborate long $1" /dev/null; }
    run on_terminal ''
    [[ $output == *$'\r'*" bytes "*"elaborated: 47 leaves to "* ]]
    run on_terminal --quiet
    [ "$output" = '' ]
}
