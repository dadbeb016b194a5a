#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Impinge as its users have it: configured for a prefix of its own, built, installed, by tests/local.mk.

bats_require_minimum_version 1.5.0

setup_file() {
    unset MAKEFLAGS MFLAGS DESTDIR # of the make that runs us
    export prefix=$top_builddir/tests/installed/prefix build=$top_builddir/tests/installed/build
}

setup() {
    cd "$BATS_TEST_TMPDIR"
    export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    unset LD_LIBRARY_PATH
    impinge=$prefix/bin/impinge
}

sdk() { pkg-config --variable="$1" impinge-sdk; }

# A surface type that Impinge does not come with, in the file $1.c.
write_plugin() {
    cat >"$1.c" <<END
#include <impinge/surface.h>
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    static char instance;
    (void)values, (void)why;
    *self = &instance;
    return IMP_STATUS_OK;
}
static void destroy(void *self) { (void)self; }
static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    lo[0] = lo[1] = 0, hi[0] = hi[1] = 1, lo[2] = -INFINITY, hi[2] = INFINITY;
}
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self;
    for (size_t k = 0; k < n; ++k) x[3 * k] = p[3 * k], x[3 * k + 1] = p[3 * k + 1], x[3 * k + 2] = 0;
    for (size_t k = 0; error && k < 3 * n; ++k) error[k] = 0;
    return IMP_STATUS_OK;
}
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    (void)self, (void)region;
    *rates = (imp_rate_matrix){{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}};
    return IMP_STATUS_OK;
}
static const imp_surface_type type = {
    .struct_size = sizeof type, .parameter_size = sizeof(imp_parameter), .name = "$1",
    .summary = "unit square", .equation = "(u, v, 0)", .example = "$1",
    .create = create, .destroy = destroy, .domain = domain, .eval = eval, .rate = rate};
IMPINGE_SURFACE_PLUGIN("$1", "1", "MIT", "somebody else", type);
END
}

build_plugin() {
    write_plugin "$1"
    # shellcheck disable=SC2046 # flags are words
    $CC -shared -fPIC -fvisibility=hidden -o "$1.so" "$1.c" $(pkg-config --cflags impinge-sdk)
}

# --- What is installed ------------------------------------------------------------------------

@test "every plugin of the sources is installed, and no libtool archive beside it" {
    local name
    for name in $(sed -nE 's|^ *plugins/(.*)\.la.*|\1|p' "$top_srcdir/plugins/local.mk"); do
        [ -f "$(sdk plugindir)/$name.so" ]
    done
    run ! ls "$(sdk plugindir)"/*.la
}

@test "list shows a type from each of at least six files" {
    run -0 "$impinge" list
    local so count=0
    for so in "$(sdk plugindir)"/*.so; do
        [[ $output == *"$(basename "$so" .so)"* ]]
        count=$((count + 1))
    done
    [ "$count" -ge 6 ]
}

@test "the installed command answers the pair of the README within its proof" {
    run -0 "$impinge" pair 'sphere radius=1 center=-2,0,0 ! translate velocity=2,0,0' \
        'sphere radius=1 center=2,0,0 ! translate velocity=-2,0,0' --gamma 1e-4 --json
    [[ $output =~ \"verdict\":\ *\"contact\" ]]
    [[ $output =~ \"t\":\ *([0-9.e-]+) ]]
    awk -v t="${BASH_REMATCH[1]}" 'BEGIN { exit !(t >= 0.4999 && t <= 0.5) }'
}

@test "the installed command finds the scene of its demo, and its manual page is there" {
    run -0 "$impinge" demo teapot
    [[ $output == *"contact at t = "*"impinge solve $prefix/share/impinge/teapot.json" ]]
    [ -f "$prefix/share/man/man1/impinge.1" ]
}

@test "impinge-sdk.pc tells the ABI and the plugin directory" {
    [ "$(sdk abi_major)" = "$(sed -n 's/#define IMP_ABI_MAJOR \([0-9]*\).*/\1/p' \
        "$prefix"/include/impinge/surface.h)" ]
    [ "$(sdk abi_minor)" = "$(sed -n 's/#define IMP_ABI_MINOR \([0-9]*\).*/\1/p' \
        "$prefix"/include/impinge/surface.h)" ]
    [ "$(sdk plugindir)" = "$prefix/lib/impinge/$(sdk abi_major)" ]
}

@test "the plugin directory follows a prefix that the asker overrides" {
    [ "$(pkg-config --define-variable=prefix=/elsewhere --variable=plugindir impinge-sdk)" = \
        "/elsewhere/lib/impinge/$(sdk abi_major)" ]
}

@test "--with-plugindir is where plugins go" {
    unset PKG_CONFIG_PATH
    cp "$build/config.cache" .
    "$top_srcdir"/configure -q -C --prefix="$prefix" --with-plugindir="$PWD/elsewhere" CC="$CC" \
        CFLAGS=-O0
    [ "$(PKG_CONFIG_PATH=sdk sdk plugindir)" = "$PWD/elsewhere" ]
    make -s -n install-pluginLTLIBRARIES | grep -q "$PWD/elsewhere"
    grep -q "elsewhere" <<<"$(make -n V=1 core/plugin/registry.lo)"
}

@test "configure refuses machines of 32 bits or of the other order of bytes, with the reason" {
    unset PKG_CONFIG_PATH
    local answer
    for answer in impinge_cv_64_bits=no ac_cv_c_bigendian=yes; do
        grep -v "^${answer%=*}=" "$build/config.cache" >config.cache
        run ! "$top_srcdir"/configure -q -C CC="$CC" CFLAGS=-O0 "$answer"
        [[ $output == *"Impinge needs a "*processor* ]]
    done
}

# --- Programs and plugins of others -------------------------------------------------------------

@test "a program builds with impinge.pc and finds the installed types" {
    cat >program.c <<'END'
#include <impinge/impinge.h>
#include <stdio.h>
int main(void)
{
    imp_registry *registry = imp_registry_new(NULL);
    imp_type_info info;
    size_t count = 0;
    while (imp_registry_type(registry, count, &info)) ++count;
    printf("%s, %zu types\n", imp_version(), count);
    imp_registry_free(registry);
    return 0;
}
END
    # shellcheck disable=SC2046 # flags are words
    $CC -o program program.c $(pkg-config --cflags --libs impinge) -Wl,-rpath,"$prefix/lib"
    run -0 ./program
    [[ $output =~ ^libimpinge\ [0-9.]+,\ ([0-9]+)\ types$ ]]
    [ "${BASH_REMATCH[1]}" -ge 6 ]
}

@test "CMake finds the library by find_package, and refuses another series" {
    command -v cmake >/dev/null || skip "no cmake"
    cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.13)
project(asks C)
find_package(Impinge 0.1 REQUIRED)
add_executable(arm ${Impinge_DIR}/../../../share/doc/impinge/examples/arm.c)
target_link_libraries(arm Impinge::impinge)
add_executable(arm_static ${Impinge_DIR}/../../../share/doc/impinge/examples/arm.c)
target_link_libraries(arm_static Impinge::static)
END
    cmake -S . -B build -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="${CC%% *}" >log 2>&1 &&
        cmake --build build >>log 2>&1 || { cat log; false; }
    local program
    for program in arm arm_static; do
        run -0 "build/$program" "$prefix/share/impinge/arm.json"
        [[ $output == 'holds, tightest 2.88'*' mm at t = 0.5'*' between link5 and fixture' ]]
    done
    run ! grep libimpinge.so <(readelf -d build/arm_static)
    sed -i 's/Impinge 0.1 /Impinge 0.2 /' CMakeLists.txt
    run ! cmake -S . -B other -DCMAKE_PREFIX_PATH="$prefix"
    [[ $output == *0.1.0* ]]
}

# compile_example NAME FLAG...: a program of the installed examples, with the installed library.
compile_example() {
    local name=$1
    shift
    # shellcheck disable=SC2046 # flags are words
    $CC -std=c11 -Wall -Wextra -Werror -o "$name" "$prefix/share/doc/impinge/examples/$name.c" "$@" \
        $(pkg-config --cflags --libs impinge) -Wl,-rpath,"$prefix/lib"
}

@test "the installed examples ask an arm's clearance, and step a ball that never leaves its room" {
    compile_example arm
    run -0 ./arm "$prefix/share/impinge/arm.json"
    [[ $output == 'holds, tightest 2.88'*' mm at t = 0.5'*' between link5 and fixture' ]]
    compile_example steps
    run -0 ./steps # from 0.25, 70 lengths to and fro in a room of 1.8
    [ "$output" = 't = 10, x = -0.0500, 39 bounces, outside at 0 steps' ]
}

@test "a static program with three plugins linked in needs neither files nor folders" {
    local name
    for name in seashell twirl hand_rates; do
        # shellcheck disable=SC2046 # flags are words
        $CC -c -O1 -ffp-contract=off -Wall -Wextra -Werror -DIMPINGE_PLUGIN_SYMBOL="${name}_plugin" \
            "$prefix/share/doc/impinge/sdk/examples/$name.c" $(pkg-config --cflags impinge-sdk)
    done
    # shellcheck disable=SC2046 # flags are words
    $CC -static -Wall -Wextra -Werror "$prefix/share/doc/impinge/examples/linked_in.c" ./*.o \
        $(pkg-config --static --cflags --libs impinge) -o linked_in
    run -0 env -i ./linked_in
    [ "${lines[0]}" = 'surface seashell, linked into the program' ]
    [ "${lines[1]}" = 'map twirl, linked into the program' ]
    [ "${lines[2]}" = 'surface blade, linked into the program' ]
    [ "${lines[3]}" = clear ]
}

@test "the archive has no symbol but the library's that a program's could collide with" {
    nm "$prefix/lib/libimpinge.a" | sed -n 's/.* [TDRBCV] //p' >symbols
    [ "$(wc -l <symbols)" -ge 40 ]
    run ! grep -v '^imp_' symbols
}

@test "the Python module is installed, finds its library, and asks an arm's clearance" {
    [ "$PYTHON3" != no ] || skip "no python3 with numpy"
    local module
    module=$(find "$prefix" -path '*-packages/impinge')
    unset IMPINGE_LIBRARY
    export PYTHONPATH=${module%/impinge} PYTHONDONTWRITEBYTECODE=1
    run -0 "$PYTHON3" "$prefix/share/doc/impinge/examples/arm.py" "$prefix/share/impinge/arm.json"
    [[ ${lines[0]} == 'holds, tightest 2.88'*' mm at t = 0.5'*' between link5 and fixture' ]]
    run -0 "$PYTHON3" "$prefix/share/doc/impinge/examples/profile.py"
    [[ ${lines[-1]} == "tightest in slice "* ]]
}

@test "the module that pip installs finds the library of pkg-config" {
    [ "$PYTHON3" != no ] || skip "no python3 with numpy"
    "$PYTHON3" -c 'import ensurepip, setuptools, wheel' || skip "no venv, setuptools or wheel"
    cp -R "$top_srcdir/sdk/python" source
    chmod -R u+w source
    "$PYTHON3" -m venv --system-site-packages venv
    venv/bin/python -m pip install --quiet --no-index --no-build-isolation ./source
    run -0 env -u PYTHONPATH -u IMPINGE_LIBRARY venv/bin/python -c \
        'import impinge; print(impinge.Scene.from_pair("sphere", "sphere center=4,0,0").clearance())'
    [[ $output == "Clearance(lower=1.99"*"upper=2.0"* ]]
    [ -f venv/lib/python3*/site-packages/impinge/py.typed ]
}

@test "the README and the news are installed" {
    cmp "$prefix/share/doc/impinge/README.md" "$top_srcdir/README.md"
    cmp "$prefix/share/doc/impinge/NEWS" "$top_srcdir/NEWS"
}

@test "a plugin built with impinge-sdk.pc alone is found on the plugin path" {
    build_plugin unit_square
    run -0 env IMPINGE_PLUGIN_PATH="$PWD" "$impinge" list
    [[ $output == *unit_square* ]]
    run -0 "$impinge" list
    [[ $output != *unit_square* ]]
}

@test "a plugin in the user's plugin directory is found, with and without XDG_DATA_HOME" {
    build_plugin unit_square
    local HOME=$PWD/home dir
    export HOME
    for XDG_DATA_HOME in "$PWD/data" ''; do
        dir=$HOME/$(sdk pluginuserdir)
        [ -z "$XDG_DATA_HOME" ] || dir=$XDG_DATA_HOME/impinge/1
        mkdir -p "$dir" && cp unit_square.so "$dir"
        run -0 "$impinge" list
        [[ $output == *unit_square* ]]
        rm "$dir/unit_square.so"
    done
}

# --- Staging and removal --------------------------------------------------------------------------

# stage and unstage FOLDER: as packages are made.
stage() { make -s -C "$build" install DESTDIR="$PWD/$1"; }
unstage() { make -s -C "$build" uninstall DESTDIR="$PWD/$1"; }

@test "DESTDIR stages the very same files, and uninstall leaves neither file nor folder" {
    stage here
    (cd "here$prefix" && find . | sort) | diff "${build%/build}/files" -
    unstage here
    [ "$(find "here$prefix")" = "here$prefix" ]
}

@test "uninstall leaves other people's files alone" {
    local plugins
    plugins=$(sdk plugindir)
    stage here
    touch "here$plugins/of_somebody_else.so"
    unstage here
    [ "$(find here ! -type d)" = "here$plugins/of_somebody_else.so" ]
    [ ! -e "here$prefix/include" ]
}

@test "another prefix than the one built for is refused with the cure, and nothing is installed" {
    run ! make -s -C "$build" install prefix="$PWD/other"
    [[ $output == *"built for the prefix $prefix"*"run configure --prefix=$PWD/other"* ]]
    [ ! -e other ]
}

@test "git ignores what a build in the source folder leaves there" {
    [ "$(git -C "$top_srcdir" rev-parse --show-toplevel 2>/dev/null)" = "$(realpath "$top_srcdir")" ] ||
        skip "not a git repository"
    cd "$build"
    { make -s --eval 'programs:;@printf "%s\n" $(check_PROGRAMS)' programs &&
        find . -name 'impinge-[0-9]*' -prune -o -type f -printf '%P\n'; } >"$BATS_TEST_TMPDIR/made"
    [ "$(wc -l <"$BATS_TEST_TMPDIR/made")" -ge 500 ]
    cd "$top_srcdir"
    git check-ignore --no-index --stdin --verbose --non-matching <"$BATS_TEST_TMPDIR/made" |
        sed -n 's/^::\t//p' | tee "$BATS_TEST_TMPDIR/shown"
    [ ! -s "$BATS_TEST_TMPDIR/shown" ]
    # Nothing of the repository itself is hidden.
    run ! git check-ignore --no-index --stdin <<<"$(git ls-files)"
    [ -z "$output" ]
}
