#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the design says of the sources themselves. Each rule is also tried on a copy that breaks
# it, because a check that cannot fail checks nothing.

bats_require_minimum_version 1.5.0

copy_sources() {
    copy=$BATS_TEST_TMPDIR/copy
    mkdir "$copy"
    (cd "$top_srcdir" && cp -R core plugins sdk tools tests "$copy")
    chmod -R u+w "$copy"
}

# --- Direction of includes -----------------------------------------------------------------

@test "modules include only what stands above them in core/local.mk" {
    "$top_srcdir"/tests/include_order "$top_srcdir"
}

broken_copy_is_refused() { # FILE LINE COMPLAINT
    copy_sources
    echo "$2" >>"$copy/$1"
    run ! "$top_srcdir"/tests/include_order "$copy"
    [[ $output == *"$3"* ]]
}

@test "an include of a module below is found" {
    broken_copy_is_refused core/status.h '#include "scene.h"' 'core/status.h includes core/scene.h'
}

@test "an include of a module below is found also in angle brackets" {
    broken_copy_is_refused core/status.h '#include <scene.h>' 'core/status.h includes core/scene.h'
}

@test "an include of the solver in the registry is found" {
    broken_copy_is_refused core/registry.c '#include "node.h"' 'core/registry.c (registry)'
}

@test "an include of the registry in the solver is found" {
    broken_copy_is_refused core/node.c '#include "registry.h"' 'core/node.c (solver)'
}

@test "an include of core in the SDK is found" {
    broken_copy_is_refused sdk/impinge/surface.h '#include <impinge/impinge.h>' \
        'sdk/impinge/surface.h includes <impinge/impinge.h>'
}

@test "an include of core in a plugin is found" {
    broken_copy_is_refused plugins/sphere.c '#include "surface.h"' 'plugins/sphere.c includes'
}

@test "a module that is not listed is found" {
    broken_copy_is_refused core/unlisted.c '' 'does not list core/unlisted.c'
}

# --- No type is known by name ----------------------------------------------------------------

plugin_names() {
    basename -a -s .c "$top_srcdir"/plugins/*.c
    "$IMPINGE" list | awk '$1 == "surface" || $1 == "map" { print $2 }'
}

# Strings of core (comments do not count) that are a type's name, or hold one as a pipeline
# would: name, blank, parameter, equals sign.
named_in_core() {
    local file names
    names=$(plugin_names | sort -u | paste -sd'|')
    for file in "$1"/core/*.[ch]; do
        gcc -fpreprocessed -dD -E -P -x c "$file" 2>/dev/null | grep -v '^#include' |
            grep -oE '"([^"\\]|\\.)*"' | grep -E "^\"($names)\"$|\<($names) +[a-z_]+=" |
            sed "s|^|${file#"$1"/}: |"
    done
}

@test "no string in core names a plugin's type" {
    [ "$("$IMPINGE" list | grep -cE '^(surface|map) ')" -ge 6 ]
    run named_in_core "$top_srcdir"
    [ -z "$output" ]
}

@test "a type's name in core is found" {
    copy_sources
    cat >>"$copy/core/status.c" <<'END'
static const char *const favourites[] = {"torus", "sphere radius=2"}; /* "rotate" */
static const char harmless[] = "a bezier of a bullet";
END
    run named_in_core "$copy"
    [ "$output" = 'core/status.c: "torus"
core/status.c: "sphere radius=2"' ]
}

# --- Headers -----------------------------------------------------------------------------------

# compiles COMPILER TEXT: as C11, C17 and C++17, without a warning.
compiles() {
    local standard language
    for standard in c11 c17 c++17; do
        language=c
        [ $standard != c++17 ] || language=c++
        "$1" -x $language -std=$standard -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
            -I"$top_srcdir/sdk" -I"$top_srcdir/core" - <<<"$2" || return 1
    done
}

public_headers_compile() {
    local header
    for header in "$top_srcdir"/sdk/impinge/*.h "$top_srcdir"/core/impinge/impinge.h; do
        compiles "$1" "#include <impinge/${header##*/}>" || return 1
    done
}

smallest_plugin='#include <impinge/surface.h>
static const void *get_factory(const char *id) { return *id ? NULL : id; }
IMPINGE_PLUGIN("smallest", "1", "MIT", "nobody", get_factory);'

@test "each public header compiles alone as C11, C17 and C++17 with gcc" {
    public_headers_compile gcc
    compiles gcc "$smallest_plugin"
}

@test "each public header compiles alone as C11, C17 and C++17 with clang" {
    command -v clang >/dev/null || skip "clang not found"
    public_headers_compile clang
    compiles clang "$smallest_plugin"
}

@test "each header of core compiles alone" {
    local header
    for header in "$top_srcdir"/core/*.h; do
        gcc -x c -std=c11 -Wno-psabi -Wall -Wextra -Werror -fsyntax-only -I"$top_builddir" \
            -I"$top_srcdir/sdk" -I"$top_srcdir/core" - <<<"#include <${header##*/}>"
    done
}

@test "clang finds nothing to warn of in any source" {
    command -v clang >/dev/null || skip "clang not found"
    local file
    for file in "$top_srcdir"/{core,plugins,tools,tests}/*.c; do
        clang -std=c11 -O2 -ffp-contract=off -Wall -Wextra -Werror -fsyntax-only \
            -DPLUGINDIR='""' -DPKGDATADIR='""' -DPKGCONFIGDIR='""' -DINCLUDEDIR='""' \
            -DSDKDOCDIR='""' -I"$top_builddir" -I"$top_srcdir/sdk" \
            -I"$top_srcdir/core" "$file"
    done
}

# --- Arithmetic as written ------------------------------------------------------------------------

@test "configure refuses flags that change floating-point arithmetic" {
    local flag
    cd "$BATS_TEST_TMPDIR"
    for flag in -ffast-math -Ofast -funsafe-math-optimizations -ffp-contract=fast; do
        run ! "$top_srcdir"/configure CFLAGS="-O2 $flag"
        [[ $output == *"and $flag breaks them"* ]]
    done
}

@test "configure refuses them also when the compiler's name hides them" {
    cd "$BATS_TEST_TMPDIR"
    printf '#!/bin/sh\nexec gcc -ffast-math "$@"\n' >cc-fast
    chmod +x cc-fast
    run ! "$top_srcdir"/configure CC="$PWD/cc-fast"
    [[ $output == *"a flag like -ffast-math"* ]]
}

@test "the ABI header refuses -ffast-math" {
    run ! gcc -ffast-math -x c -std=c11 -fsyntax-only -I"$top_srcdir/sdk" - \
        <<<'#include <impinge/surface.h>'
    [[ $output == *"-ffast-math"* ]]
}

# --- Exports ---------------------------------------------------------------------------------------

exports_of() { nm -D --defined-only "$1" | awk '{ print $3 }'; }

@test "libimpinge exports what impinge.h declares and nothing else" {
    declared=$(sed -n 's/^IMP_EXPORT.*[ *]\(imp_[a-z_]*\)(.*/\1/p' \
        "$top_srcdir"/core/impinge/impinge.h | sort)
    [ "$(exports_of "$top_builddir"/.libs/libimpinge.so | sort)" = "$declared" ]
}

@test "each plugin exports one symbol and needs nothing of core" {
    local so count=0
    for so in "$top_builddir"/plugins/.libs/*.so; do
        [ "$(exports_of "$so")" = impinge_plugin ]
        run ! grep -q impinge <<<"$(objdump -p "$so" | grep NEEDED)"
        count=$((count + 1))
    done
    [ "$count" -ge 6 ]
}

# --- Upkeep ------------------------------------------------------------------------------------------

# Known by their suffix or, scripts, by their first line; nothing that a build in the
# source folder leaves there.
source_files() {
    cd "$1" && ls configure.ac Makefile.am NEWS .clang-format .editorconfig .ci/run &&
        find core plugins sdk tests tools -name '*.[ch]' -o -name '*.mk' -o -name '*.in' \
            -o -name '*.bats' -o -name '*.m4' &&
        find tools tests -type f ! -name '*.*' -exec grep -lE '^#!/usr/bin/env|^# shellcheck' {} +
}

# Sources without their two-line head; a first line of #! or for shellcheck may stand above it.
headless() {
    local file licence head owner
    for file in $(source_files "$1"); do
        owner='The Impinge authors'
        [[ $file != sdk/template/* ]] || owner=@author@ # of what `impinge new` writes
        licence=Apache-2.0
        [[ $file != sdk/* ]] || licence=MIT
        head=$(head -n 3 "$1/$file" | grep -vE '^#!|^# shellcheck' | head -n 2)
        [[ $head == *"SPDX-FileCopyrightText: $owner"*"SPDX-License-Identifier: $licence"* ]] ||
            echo "$file"
    done
}

@test "every source begins with its licence, MIT in sdk and Apache-2.0 elsewhere" {
    [ "$(source_files "$top_srcdir" | wc -l)" -ge 50 ]
    run headless "$top_srcdir"
    [ -z "$output" ]
}

@test "a source without its licence is found" {
    copy_sources
    (cd "$top_srcdir" && cp configure.ac Makefile.am NEWS .clang-format .editorconfig "$copy")
    mkdir "$copy/.ci" && cp "$top_srcdir/.ci/run" "$copy/.ci"
    sed -i 's/MIT/Apache-2.0/' "$copy/sdk/local.mk"
    sed -i /SPDX-License/d "$copy/tools/test"
    sed -i 1,2d "$copy/core/status.c"
    run headless "$copy"
    [ "$(sort <<<"$output")" = $'core/status.c\nsdk/local.mk\ntools/test' ]
}

# What is not listed is not built, not run, and missing from `make dist`.
@test "every plugin, every suite and every header is listed in its local.mk" {
    local file name
    for file in "$top_srcdir"/{plugins,tests,tools,core,sdk/impinge}/*.[ch] \
        "$top_srcdir"/tests/*.bats; do
        [ -e "$file" ] || continue
        name=${file#"$top_srcdir"/}
        grep -qwF "$name" "$top_srcdir/${name%%/*}/local.mk" ||
            grep -qwF "${name%.c}.la" "$top_srcdir/${name%%/*}/local.mk" ||
            { [[ $name == tests/*.c ]] && grep -qwF "${name%.c}" "$top_srcdir/tests/local.mk"; } ||
            { echo "$name"; false; }
    done
}
