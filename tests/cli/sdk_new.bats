#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# `impinge new`: a newcomer gets a project that builds, is checked and installed; and its impinge.m4.

load ../support/sdk_helper

# --- impinge new --------------------------------------------------------------------------------
# The project `wobble` of several tests: made once.
make_wobble() {
    [ -f "$wobble/config.status" ] || (cd "$BATS_FILE_TMPDIR" && new_project wobble)
    log=$BATS_FILE_TMPDIR/log
    cd "$wobble"
}

@test "four commands take a newcomer to a checked, paired, installed surface type" {
    make_wobble
    grep -q '^# PASS:  1' "$log"
    grep -q '^contact at t = 0\.862' "$log"
    [ "$(ls "$user")" = wobble.so ]
    run -0 impinge info wobble
    [[ $output == *"file       $user/wobble.so" ]]
    [ "$(nm -D --defined-only "$user/wobble.so" | awk '{ print $3 }')" = impinge_plugin ]
}

@test "what a new project claims follows from the formula that its README tells" {
    local line
    make_wobble
    make -s install >/dev/null
    line=$(sed -n 's/^ *\(impinge check wobble --formula .*\)/\1/p' README)
    run -0 bash -c "$line --only proof --effort 0.1"
    [[ $output == *"  proved("* ]]
}

@test "what new prints needs neither PATH nor other paths to be set" {
    unset PKG_CONFIG_PATH ACLOCAL_PATH
    run -0 env PATH=/usr/bin:/bin "$prefix/bin/impinge" new wobble
    [[ $output == *"./configure --with-user-plugins PKG_CONFIG_PATH=$prefix/lib/pkgconfig"$'\n'* ]]
    [[ $output == *"  $prefix/bin/impinge check wobble"$'\n'* ]]
    [ -f wobble/m4/impinge.m4 ]
}

@test "a generated project is released, built elsewhere, installed and removed by distcheck" {
    make_wobble
    make -s distcheck >distcheck.log 2>&1 || { cat distcheck.log; false; }
    tar tzf wobble-0.1.tar.gz | grep -q wobble-0.1/wobble.c
}

@test "without --with-user-plugins the plugin goes below the prefix, also one given to make" {
    make_wobble
    ./configure -q >/dev/null
    make -s install DESTDIR="$BATS_TEST_TMPDIR/work/stage" >/dev/null
    [ "$(cd "$BATS_TEST_TMPDIR/work/stage" && find . ! -type d)" = ".$prefix/lib/impinge/1/wobble.so" ]
    make -s uninstall DESTDIR="$BATS_TEST_TMPDIR/work/stage"
    [ -z "$(find "$BATS_TEST_TMPDIR/work/stage" ! -type d)" ]
    make -s install prefix="$BATS_TEST_TMPDIR/work/moved" >/dev/null
    [ "$(cd "$BATS_TEST_TMPDIR/work/moved" && find . ! -type d)" = ./lib/impinge/1/wobble.so ]
}

@test "make check of a project says what the loader says of a broken edit" {
    make_wobble
    sed -i.right 's/, free),/&\n    .rate = NULL,/' wobble.c
    run ! make -s check
    grep -q 'wobble.so: .*wobble: rate is NULL' check.sh.log
    mv wobble.c.right wobble.c
}

@test "new --map writes a map, under a name with a dash" {
    new_project sway-2 --map
    grep -q '^# PASS:  1' "$log"
    grep -q '^contact at t = 0\.7' "$log"
    run -0 impinge info sway-2
    [[ $output == 'sway-2 (map): '*"file       $user/sway-2.so" ]]
}

@test "what new writes bears the user's name, and nothing is left to fill in" {
    run -0 impinge new wobble
    run -0 impinge new sway 'a folder' --map
    [[ $output == *"cd 'a folder' && "* ]]
    run ! grep -rE '@[a-z]+@|The Impinge authors' wobble 'a folder' --exclude=impinge.m4
    local who
    who=$(getent passwd "$(id -u)" | cut -d: -f5 | cut -d, -f1)
    head -n 1 wobble/wobble.c | grep -qF "SPDX-FileCopyrightText: ${who:-$(id -un)}"
}

@test "new refuses what cannot be a type's name, and writes nothing" {
    local name
    for name in '' 3d _x a.b a/b 'a b' ü "$(printf 'x%.0s' {1..64})"; do
        fails 2 "cannot be a type's name; must be 1 to 63 letters" impinge new "$name"
    done
    fails 2 "cannot be a type's name" impinge new -- -x
    fails 2 'configure scripts sweep up' impinge new conftest1
    [ -z "$(ls)" ]
    run -0 impinge new "$(printf 'x%.0s' {1..63})"
}

@test "new refuses a name that is taken, of the same sort" {
    fails 4 "there is a surface 'sphere' already, in $prefix/lib/impinge/1/sphere.so; one would shadow" \
        impinge new sphere
    fails 4 "there is a map 'rotate' already" impinge new rotate --map
    [ -z "$(ls)" ]
    run -0 impinge new rotate
}

@test "new writes into a new folder or an empty one, never into another" {
    mkdir empty full
    touch full/.hidden file
    run -0 impinge new wobble empty
    fails 4 'full: the folder is not empty' impinge new wobble full
    [ "$(ls -A full)" = .hidden ]
    fails 4 'file: ' impinge new wobble file
    fails 4 'no/where: No such file' impinge new wobble no/where
    fails 4 'empty: the folder is not empty' impinge new wobble empty
}

@test "where new fails halfway nothing is left behind" {
    mkdir empty
    mv "$prefix/share/impinge/template/check.sh" .
    fails 4 'template/check.sh: No such file' impinge new wobble
    mv check.sh "$prefix/share/impinge/template/"
    [ "$(ls)" = empty ]
    run -4 bash -c 'trap "" XFSZ; ulimit -f 2; impinge new wobble; status=$?; impinge new wobble empty; exit $status'
    [[ $output == *'wobble/wobble.c: File too large'* ]]
    [ "$(find .)" = $'.\n./empty' ]
}

# --- impinge.m4 ---------------------------------------------------------------------------------
# small_project: a configure that only tells where plugins would go.
small_project() {
    cat >configure.ac <<'END'
AC_INIT([small], [1])
IMPINGE_PLUGIN_INIT([0.1])
AC_CONFIG_FILES([where])
AC_OUTPUT
END
    echo '@prefix@ @plugindir@' >where.in
    aclocal && autoconf
}

goes_to() { # PLACE CONFIGURE_ARG...
    local place=$1
    shift
    ./configure -q "$@" >/dev/null
    echo "$* goes to $(cat where)"
    [ "$(cat where)" = "$place" ]
}

@test "plugindir is below any prefix, and that of Impinge unless another is asked for" {
    small_project
    # shellcheck disable=SC2016 # prefix is for make
    {
        goes_to "$prefix"' ${prefix}/lib/impinge/1'
        goes_to '/x ${prefix}/lib/impinge/1' --prefix=/x
    }
    goes_to "$prefix /y" --with-plugindir=/y
    goes_to "/x $user" --prefix=/x --with-user-plugins
    XDG_DATA_HOME=/data goes_to "$prefix /data/impinge/1" --with-user-plugins
    XDG_DATA_HOME=data goes_to "$prefix $user" --with-user-plugins
    run ./configure --prefix=/x
    [[ $output == *"Impinge looks in $prefix/lib/impinge/1 and $user"* ]]
}

@test "plugindir follows an Impinge that keeps its plugins elsewhere" {
    small_project
    mkdir pc
    export PKG_CONFIG_PATH=$PWD/pc
    unset CONFIG_SITE
    # shellcheck disable=SC2016 # prefix and libdir are for make
    {
        sed 's|^libdir=.*|libdir=${prefix}/lib/many|' "$prefix/lib/pkgconfig/impinge-sdk.pc" \
            >pc/impinge-sdk.pc
        goes_to "$prefix"' ${prefix}/lib/many/impinge/1'
        goes_to '/x ${prefix}/lib/many/impinge/1' --prefix=/x
        sed 's|^plugindir=.*|plugindir=/elsewhere|' "$prefix/lib/pkgconfig/impinge-sdk.pc" \
            >pc/impinge-sdk.pc
        goes_to "$prefix /elsewhere"
        goes_to '/x ${libdir}/impinge/1' --prefix=/x
    }
}
