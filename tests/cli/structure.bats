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

# --- Public functions and the caller's floating-point mode ---------------------------------------

# Public functions of core without fp_environment_enter. Those that neither compute nor run a
# plugin's code, or do so through another public function only, stand in the list.
unguarded_functions() { # FOLDER
    local plain=" imp_version imp_code_text imp_call_in_progress imp_registry_new
        imp_registry_open imp_registry_free imp_registry_limit_reading imp_registry_isolate imp_registry_type
        imp_registry_refusal imp_registry_warning imp_registry_fault imp_call_of_thread imp_call_read
        imp_instance_free
        imp_scene_free imp_scene_remark imp_scene_body_count imp_scene_body_name imp_scene_surface_count
        imp_scene_domain imp_options_get_default imp_query_free imp_query_get_result imp_query_pending
        imp_query_cancel imp_query_explain imp_query_keep_proof imp_query_exclude_pair imp_query_part_bodies imp_scene_ignores imp_scene_solve imp_scene_sources imp_clearance_options_get_default imp_clearance_count
        imp_builder_new imp_builder_time imp_builder_gamma imp_builder_body imp_builder_parent
        imp_builder_group imp_builder_solid imp_builder_ignore imp_builder_surface_of imp_builder_bodies_of imp_scene_is_solid imp_scene_pair_count imp_scene_piece_count imp_scene_eval imp_scene_include
        imp_scene_follows imp_scene_parameter imp_scene_parameter_count imp_survey_options_get_default imp_survey_free
        imp_survey_cancel imp_survey_cuts imp_survey_get_cost imp_survey_keep_proof imp_survey_values imp_survey_worst
        imp_piece_domain imp_piece_stage_count imp_piece_stage "
    local name
    for name in $(grep -h -A1 '^IMP_EXPORT' "$1"/core/impinge/*.h |
        grep -o 'imp_[a-z_]*(' | tr -d '('); do
        [[ " ${plain//$'\n'/ } " == *" $name "* ]] ||
            cat "$1"/core/*/*.c | awk -v name="$name" '
                index($0, " " name "(") || index($0, "*" name "(") { inside = /^[a-z]/ }
                inside && /fp_environment_enter/ { found = 1 }
                /^}/ { inside = 0 }
                END { if (!found) print name }'
    done
}

@test "public functions that compute set the floating-point environment" {
    run unguarded_functions "$top_srcdir"
    [ -z "$output" ]
}

@test "a public function that leaves the caller's environment is found" {
    copy_sources
    echo 'IMP_EXPORT double imp_sum(double x, double y);' >>"$copy/core/impinge/impinge.h"
    echo 'double imp_sum(double x, double y) { return x + y; }' >>"$copy/core/base/status.c"
    sed -i '/fp_environment_enter/d' "$copy/core/scene/scene_pieces.c"
    run unguarded_functions "$copy"
    [[ $output == *imp_piece_eval*imp_sum* ]]
}

# --- Direction of includes -----------------------------------------------------------------

@test "files include only their own room and rooms below" {
    "$top_srcdir"/tests/support/include_order "$top_srcdir"
}

broken_copy_is_refused() { # FILE LINE COMPLAINT
    copy_sources
    echo "$2" >>"$copy/$1"
    run ! "$top_srcdir"/tests/support/include_order "$copy"
    [[ $output == *"$3"* ]]
}

@test "an include of a room above is found" {
    broken_copy_is_refused core/base/status.h '#include "core/scene/scene.h"' \
        'core/base/status.h includes "core/scene/scene.h"'
}

@test "an include of a room above is found also in angle brackets" {
    broken_copy_is_refused core/base/status.h '#include <core/scene/scene.h>' \
        'core/base/status.h includes <core/scene/scene.h>'
}

@test "an include of the solver in the plugin host is found" {
    broken_copy_is_refused core/plugin/registry.c '#include "core/tree/node.h"' \
        'core/plugin/registry.c includes "core/tree/node.h"'
}

@test "an include of the plugin host in the solver is found" {
    broken_copy_is_refused core/solver/query.c '#include "core/plugin/registry.h"' \
        'core/solver/query.c includes "core/plugin/registry.h"'
}

@test "an include of the search in what bounds pairs is found" {
    broken_copy_is_refused core/bounds/distance.h '#include "core/solver/pair_heap.h"' \
        'core/bounds/distance.h includes "core/solver/pair_heap.h"'
}

@test "an include of witnesses in what bounds pairs is found" {
    broken_copy_is_refused core/bounds/distance.h '#include "core/witness/witness.h"' \
        'core/bounds/distance.h includes "core/witness/witness.h"'
}

@test "an include of the search in the broad phase is found" {
    broken_copy_is_refused core/broad_phase/candidates.h '#include "core/solver/impact.h"' \
        'core/broad_phase/candidates.h includes "core/solver/impact.h"'
}

@test "an include of core in the SDK is found" {
    broken_copy_is_refused sdk/impinge/surface.h '#include <impinge/impinge.h>' \
        'sdk/impinge/surface.h includes <impinge/impinge.h>'
}

@test "an include of core in a plugin is found" {
    broken_copy_is_refused plugins/surfaces/sphere.c '#include "core/surface/surface.h"' \
        'plugins/surfaces/sphere.c includes'
}

@test "an include of the command in what it shares with the library is found" {
    broken_copy_is_refused core/common/child.h '#include "tools/cli/message.h"' \
        'core/common/child.h includes "tools/cli/message.h"'
}

@test "an include of core in a tool is found" {
    broken_copy_is_refused tools/cli/main.c '#include "core/base/text.h"' 'tools/cli/main.c includes'
}

@test "a file or a folder outside the rooms is found" {
    broken_copy_is_refused core/loose.c '' 'core/loose.c is in no room'
    rm -r "$copy"
    copy_sources
    mkdir "$copy/core/attic"
    touch "$copy/core/attic/old.c"
    run ! "$top_srcdir"/tests/support/include_order "$copy"
    [[ $output == *'core/attic/old.c is in a room without a rule'* ]]
}

# --- No type is known by name ----------------------------------------------------------------

plugin_names() {
    basename -a -s .c "$top_srcdir"/plugins/{surfaces,maps}/*.c
    "$IMPINGE" list | awk '$1 == "surface" || $1 == "map" { print $2 }'
}

without_comments() { gcc -fpreprocessed -dD -E -P -x c "$1" 2>/dev/null; }

# Strings of core (comments do not count) that are a type's name, or hold one as a pipeline
# would: name, blank, parameter, equals sign. "formula" is a capability's name, too.
named_in_core() {
    local file names
    names=$(plugin_names | sort -u | paste -sd'|')
    for file in $(grep -lE "\"($names)\"|\<($names) +[a-z_]+=" "$1"/core/*/*.[ch]); do
        without_comments "$file" | grep -v '^#include' |
            grep -oE '"([^"\\]|\\.)*"' | grep -vx '"formula"' | grep -E "^\"($names)\"$|\<($names) +[a-z_]+=" |
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
    cat >>"$copy/core/base/status.c" <<'END'
static const char *const favourites[] = {"torus", "sphere radius=2"}; /* "rotate" */
static const char harmless[] = "a bezier of a bullet";
END
    run named_in_core "$copy"
    [ "$output" = 'core/base/status.c: "torus"
core/base/status.c: "sphere radius=2"' ]
}

# --- The SDK that we use ourselves -----------------------------------------------------------------

# Names that end in '_' are the SDK's own, and config.h is not installed (comments do not count).
beyond_the_sdk() {
    local file names='\b(imp|IMP)_[A-Za-z0-9_]*_\b|<config.h>'
    for file in $(grep -lE "$names" "$1"/plugins/*/*.[ch]); do
        without_comments "$file" | grep -oE "$names" | sed "s|^|${file#"$1"/}: |"
    done
}

@test "plugins use nothing that the installed SDK lacks or keeps to itself" {
    run beyond_the_sdk "$top_srcdir"
    [ -z "$output" ]
}

@test "a plugin that does is found" {
    copy_sources
    sed -i '1i #include <config.h>' "$copy/plugins/surfaces/torus.c"
    echo 'static int n = sizeof(imp_terms_); /* imp_cubic_add_ */' >>"$copy/plugins/surfaces/cone.c"
    run beyond_the_sdk "$copy"
    [ "$output" = $'plugins/surfaces/cone.c: imp_terms_\nplugins/surfaces/torus.c: <config.h>' ]
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
    for header in "$top_srcdir"/sdk/impinge/*.h "$top_srcdir"/core/impinge/*.h; do
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

# What only MPI's users need from a compiler; without it their files are not read.
mpi_flags=$(pkg-config --cflags ompi-c 2>/dev/null | sed 's/-I/-isystem/g')
is_readable() { [[ $1 != */tools/mpi/* ]] || [ -n "$mpi_flags" ]; }

# A header that its own source includes before any other compiles alone where that source compiles.
is_first_in_source() { # HEADER
    [ -f "${1%.h}.c" ] && [ "$(grep '^#include' "${1%.h}.c" | grep -v -m 1 '<config\.h>')" = \
        "#include \"${1#"$top_srcdir"/}\"" ]
}

@test "each private header compiles alone" {
    local header before
    for header in "$top_srcdir"/{core,plugins,tools}/*/*.h; do
        is_readable "$header" && ! is_first_in_source "$header" || continue
        before=$'#include <config.h>\n' # but not in plugins
        [[ $header != */plugins/*/* ]] || before=
        # shellcheck disable=SC2086 # words on purpose
        gcc -x c -std=c11 -Wno-psabi -Wall -Wextra -Werror -fsyntax-only -Wno-unused-function \
            $mpi_flags -I"$top_builddir" -I"$top_srcdir" -I"$top_srcdir/sdk" -I"$top_srcdir/core" - \
            <<<"$before#include \"${header#"$top_srcdir"/}\""
    done
}

# Feature macros must be set before the first header of the system. Plugins include nothing of the
# build: third parties could build them.
first_includes() { # SOURCES
    cd "$1" && awk '
        FNR == 1 { if (file && first != "#include <config.h>") print file; file = FILENAME; first = "" }
        /^#include/ && !first { first = $0 }
        END { if (first != "#include <config.h>") print file }
    ' {core,tools}/*/*.c tests/{unit,support,fuzz}/*.c
}

@test "every source of core, tools and tests begins with config.h" {
    run first_includes "$top_srcdir"
    [ -z "$output" ]
}

@test "a source that begins with another header is found" {
    copy_sources
    sed -i '/<config.h>/d' "$copy/core/base/status.c"
    run first_includes "$copy"
    [ "$output" = core/base/status.c ]
}

# --- Form of the sources ---------------------------------------------------------------------------

# C and C++ sources below a folder, without those that a build makes there.
c_sources() { # FOLDER
    (cd "$1" && find core plugins sdk tests tools -name '*.[ch]' ! -name api_table.h \
        -o -name '*.cc' -o -name '*.hpp' | sort)
}

# Other versions format otherwise, so one is pinned: that of Debian 12.
clang_format_14() {
    local name
    for name in clang-format-14 clang-format; do
        [[ $("$name" --version 2>/dev/null) == *"version 14."* ]] && echo "$name" && return
    done
    return 1
}

unformatted() { # FOLDER [PART]
    local format
    format=$(clang_format_14)
    (cd "$1" && c_sources . | grep "^${2-}" | xargs "$format" --style=file:"$top_srcdir/.clang-format" -n 2>&1 |
        sed -n 's/^\(\.\/\)\{0,1\}\([^:]*\):.*clang-format-violations.*/\2/p' | sort -u)
}

@test "clang-format would change no source" {
    clang_format_14 || skip "clang-format 14 not found"
    run unformatted "$top_srcdir"
    [ -z "$output" ]
}

@test "a source that clang-format would change is found" {
    clang_format_14 || skip "clang-format 14 not found"
    copy_sources
    echo 'static int  spread ( void )  { return 0;}' >>"$copy/core/base/status.c"
    run unformatted "$copy" core/base/
    [ "$output" = core/base/status.c ]
}

long_lines() { # FOLDER
    (cd "$1" && c_sources . | xargs awk 'length > 100 { print FILENAME ":" FNR }')
}

@test "no line of a source is longer than 100 columns" {
    [ "$(c_sources "$top_srcdir" | wc -l)" -ge 500 ]
    run long_lines "$top_srcdir"
    [ -z "$output" ]
}

@test "a line longer than 100 columns is found" {
    copy_sources
    printf '/* %098d */\n' 0 >>"$copy/sdk/examples/puddle.cc"
    run long_lines "$copy"
    [[ $output == sdk/examples/puddle.cc:* ]]
}

# A comment that begins so sends the reader back to the one before it, and has no subject.
dangling_comments() { # FOLDER
    (cd "$1" && c_sources . | xargs grep -nE '(/\*|//) *(The same|As|Of|But|Also)\b' |
        cut -d: -f1,2)
}

@test "no comment begins with a word that needs the comment before" {
    run dangling_comments "$top_srcdir"
    [ -z "$output" ]
}

@test "such a comment is found" {
    copy_sources
    printf '%s\n' '/* The same for a cone. */' '/* A cone. */' 'int x; /* As above. */' >"$copy/core/base/status.h"
    run dangling_comments "$copy"
    [ "$output" = $'core/base/status.h:1\ncore/base/status.h:3' ]
}

# --- Arithmetic as written ------------------------------------------------------------------------

# A plugin's author may contract products and sums: bounds leave room for either rounding.
@test "bounds of nested maps hold in plugins that clang contracted for this processor" {
    command -v clang >/dev/null || skip "clang not found"
    local nested=$top_builddir/tests/unit/test_nested plugins=$BATS_TEST_TMPDIR/plugins/.libs
    [ -x "$nested" ] || skip "tests/unit/test_nested is not built (MPFI not found)"
    mkdir -p "$plugins"
    for source in surfaces/sphere maps/{twist,wave}; do
        clang -std=c11 -march=native -O3 -ffp-contract=fast -fvisibility=hidden -fPIC -shared -Wno-psabi \
            -I"$top_builddir" -I"$top_srcdir" -I"$top_srcdir/sdk" -ffunction-sections \
            "$top_srcdir/plugins/$source.c" "$top_srcdir"/plugins/common/*.c \
            -Wl,--gc-sections -Wl,--version-script="$top_srcdir/plugins/plugin.map" \
            -ljansson -lm -o "$plugins/${source#*/}.so"
    done
    top_builddir=$BATS_TEST_TMPDIR "$nested"
}

# A quad that takes a detour over the stack waits there for the stores of its halves.
@test "quads are loaded and stored whole, for old and for new processors" {
    [ "$(uname -m)" = x86_64 ] || skip "not an x86-64 processor"
    local compiler level tried=0
    cat >"$BATS_TEST_TMPDIR/sum.c" <<-'EOF'
	#include <impinge/quad.h>
	IMP_QUAD_INLINE void sum(const double *x, double *y)
	{
	    const imp_quad a = imp_quad_load(x), b = imp_quad_load(x + 4);
	    imp_quad_store(y, a + b);
	    imp_quad_store(y + 4, a - b);
	}
	IMP_QUAD_WIDE void sum_wide(const double *x, double *y) { sum(x, y); }
	EOF
    for compiler in gcc clang; do
        command -v "$compiler" || continue
        for level in x86-64 haswell; do
            "$compiler" -std=c11 -O2 -march=$level -Wno-psabi -fomit-frame-pointer \
                -I"$top_srcdir/sdk" -S -o "$BATS_TEST_TMPDIR/sum.s" "$BATS_TEST_TMPDIR/sum.c"
            grep -q %ymm "$BATS_TEST_TMPDIR/sum.s"
            run ! grep -E '%xmm|\(%r[bs]p' "$BATS_TEST_TMPDIR/sum.s"
            tried=$((tried + 1))
        done
    done
    [ "$tried" -gt 0 ] || skip "neither gcc nor clang found"
}

@test "configure refuses flags that change floating-point arithmetic" {
    local flag
    cd "$BATS_TEST_TMPDIR"
    for flag in -ffast-math -Ofast -funsafe-math-optimizations -ffp-contract=fast; do
        run ! "$top_srcdir"/configure CFLAGS="-O2 $flag"
        [[ $output == *"and $flag breaks them"* ]]
    done
}

@test "configure refuses them in LDFLAGS, where they switch subnormals off" {
    cd "$BATS_TEST_TMPDIR"
    for flag in -ffast-math -Ofast -funsafe-math-optimizations; do
        run ! "$top_srcdir"/configure LDFLAGS="$flag"
        [[ $output == *"$flag breaks them."*LDFLAGS* ]]
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

# --- Capabilities ----------------------------------------------------------------------------------

@test "the schema and the headers name each capability" {
    local table name
    table=$(sed -n 's/^ *\[CAPABILITY_[A-Z_0-9]*\] = {"\([a-z0-9-]*\)".*/\1/p' \
        "$top_srcdir"/core/common/capabilities.c)
    [ "$(jq -r '.. | .capabilities? // empty | .items.enum[]' \
        "$top_srcdir"/tools/schema/types.schema.json)" = "$table" ]
    for name in $table; do
        grep -q "\"$name\"" "$top_srcdir"/core/impinge/impinge.h
        [ "$name" = core ] || grep -q "[Cc]apability \`$name\`" "$top_srcdir"/sdk/impinge/surface.h
    done
}

# --- Exports ---------------------------------------------------------------------------------------

exports_of() { nm -D --defined-only "$1" | awk '{ print $3 }'; }

# Functions that the public headers declare, and those that the Debian package names.
declared_functions() { sed -n 's/^IMP_EXPORT.*[ *]\(imp_[a-z_0-9]*\)(.*/\1/p' "$1"/core/impinge/*.h | sort; }
packaged_symbols() { sed -n 's/^ \([^ @]*\)@Base .*/\1/p' "$1/tools/debian/libimpinge0.symbols" | sort; }

@test "libimpinge exports what its headers declare and nothing else" {
    [ "$(exports_of "$top_builddir"/.libs/libimpinge.so | sort)" = "$(declared_functions "$top_srcdir")" ]
}

@test "the symbols file of the Debian package names each public function and nothing else" {
    [ "$(packaged_symbols "$top_srcdir" | wc -l)" -ge 70 ]
    diff <(declared_functions "$top_srcdir") <(packaged_symbols "$top_srcdir")
}

@test "a public function that the symbols file lacks is found" {
    copy_sources
    echo 'IMP_EXPORT double imp_sum(double x, double y);' >>"$copy/core/impinge/examine.h"
    run diff <(declared_functions "$copy") <(packaged_symbols "$copy")
    [[ $output == *'< imp_sum'* ]]
}

# The programs of tests/fuzz link the library and the command as archives.
@test "no function of the command has the name of one of the library" {
    functions_of() { nm -g --defined-only "$@" | awk '$2 == "T" { print $3 }' | sort; }
    [ "$(functions_of "$top_builddir"/tools/libtools.a | wc -l)" -ge 100 ]
    run comm -12 <(functions_of "$top_builddir"/core/.libs/libcore.a) \
        <(functions_of "$top_builddir"/tools/libtools.a "$top_builddir"/tools/.libs/libproof.a)
    [ -z "$output" ]
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
    # The owner in sdk/template, that is, of what `impinge new` writes, is a parameter.
    (cd "$1" && source_files . | xargs awk '
        function judge() {
            owner = file ~ "^sdk/template/" ? "@author@" : "The Impinge authors"
            licence = file ~ "^sdk/" ? "MIT" : "Apache-2.0"
            if (!index(first, "SPDX-FileCopyrightText: " owner) ||
                !index(second, "SPDX-License-Identifier: " licence)) print file
        }
        FNR == 1 { if (file) judge(); file = FILENAME; first = second = "" }
        FNR <= 3 && !/^#!|^# shellcheck/ { if (!first) first = $0; else if (!second) second = $0 }
        FNR > 3 { nextfile }
        END { judge() }')
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
    sed -i 1,2d "$copy/core/base/status.c"
    run headless "$copy"
    [ "$(sort <<<"$output")" = $'core/base/status.c\nsdk/local.mk\ntools/test' ]
}

# What is not listed is not built, not run, and missing from `make dist`.
@test "every plugin, every suite and every header is listed in its local.mk" {
    local word name
    declare -A listed
    cd "$top_srcdir"
    for word in $(cat {core,plugins,sdk,tests,tools}/local.mk); do listed[$word]=1; done
    for name in {plugins,tests,tools,core}/*/*.[ch] sdk/impinge/*.h tests/cli/*.bats; do
        [ -n "${listed[$name]-}${listed[${name%.c}.la]-}" ] ||
            { [[ $name == tests/*.c ]] && [ -n "${listed[${name%.c}]-}" ]; } ||
            { echo "$name"; false; }
    done
}
