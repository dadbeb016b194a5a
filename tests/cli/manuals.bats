#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The manuals as they are installed: whole, without warnings, found by name, and true.

load ../support/cli_helper

setup_file() {
    unset MAKEFLAGS MFLAGS DESTDIR # of the make that runs us
    export prefix=$top_builddir/tests/installed/prefix
    export manuals=$prefix/share/man
    # The command just built, as others are used to call it.
    mkdir "$BATS_FILE_TMPDIR/bin"
    printf '#!/bin/sh\nexec "%s" "$@"\n' "$IMPINGE" >"$BATS_FILE_TMPDIR/bin/impinge"
    chmod +x "$BATS_FILE_TMPDIR/bin/impinge"
    [ "$PYTHON3" = no ] || ln -s "$(command -v "$PYTHON3")" "$BATS_FILE_TMPDIR/bin/python3"
    export PATH=$BATS_FILE_TMPDIR/bin:$PATH PYTHONDONTWRITEBYTECODE=1
    export IMPINGE_LIBRARY=$top_builddir/.libs/libimpinge.so PYTHONPATH=$top_srcdir/sdk/python
    export IMPINGE_PLUGIN_PATH=$top_builddir/plugins/.libs IMPINGE_COMMAND=$BATS_FILE_TMPDIR/bin/impinge
}

# Pages with text of their own; the others lead to them.
pages() { grep -L '^\.so ' "$manuals"/man[1357]/*.[1357]; }

@test "no manual page makes troff warn" {
    command -v groff >/dev/null || skip "no groff"
    [ "$(pages | wc -l)" -ge 13 ]
    pages | xargs groff -man -ww -Tutf8 2>&1 >/dev/null | tee warnings
    [ ! -s warnings ]
}

@test "man -k finds each page by its name, and has a phrase for it" {
    command -v lexgrog >/dev/null || skip "no man-db"
    cp -R "$manuals" man
    mandb --quiet --create "$PWD/man" >log 2>&1 || { cat log; false; }
    apropos -M "$PWD/man" imp >found # what man -k runs
    [ "$(wc -l <found)" -ge 90 ]
    local name
    for name in 'impinge (1)' 'impinge (7)' 'impinge-scene (5)' 'impinge-plugin (7)' 'libimpinge (3)' \
        'imp_query_step (3)' 'imp_options (3)' 'imp_result (3)'; do
        grep -qE "^$(sed 's/[()]/\\&/g; s/ / +/' <<<"$name") +- .+" found || { echo "$name"; false; }
    done
}

# Names that a program may use: functions, structs, enums and callbacks of the public headers.
public_names() { # FOLDER
    grep -hoE '^(IMP_EXPORT|static inline) .*' "$1"/impinge/{impinge,examine}.h |
        grep -oE '\bimp_[a-z_]+\(' | tr -d '('
    grep -hoE '^typedef .*;|^\} imp_[a-z_]+;' "$1"/impinge/{impinge,examine}.h |
        grep -oE '(\(\*imp_[a-z_]+|imp_[a-z_]+;)' | tr -d '(*;'
}

@test "each name of the public headers has a manual page, which tells of it" {
    local name page count=0
    for name in $(public_names "$top_srcdir/core" | sort -u); do
        page=$manuals/man3/$name.3
        [ -f "$page" ] || { echo "$name"; false; }
        ! grep -q '^\.so ' "$page" || page=$manuals/$(sed -n 's/^\.so //p' "$page")
        grep -q "$name" "$page"
        count=$((count + 1))
    done
    [ "$count" -ge 80 ]
}

@test "a function that is new in a header gets its place in a page, and keeps its comment" {
    cat >impinge.h <<'END'
/* --- Thing: what it is ---- */

/* Answers twice `x`, which
 * is a length.
 *   (a) kept as it stands
 */
IMP_EXPORT double imp_thing_twice(double x,
                                  int n);

typedef struct imp_thing {
    double size; /* a length, which
                    is long */
    int n;
} imp_thing;
END
    mkdir out
    awk -v to=out -v version=1 -f "$top_srcdir/tools/manual/header_pages.awk" impinge.h
    [ "$(cat out/imp_thing_twice.3)" = '.so man3/imp_thing.3' ]
    grep -qFx 'imp_thing, imp_thing_twice \- what it is' out/imp_thing.3
    grep -qFx '.B "double imp_thing_twice(double x, int n);"' out/imp_thing.3
    grep -qFx 'Answers twice \(gax\(ga, which' out/imp_thing.3
    grep -A1 -Fx '.B "double size;"' out/imp_thing.3 | grep -qFx 'a length, which is long'
    grep -B1 -Fx '  (a) kept as it stands' out/imp_thing.3 | grep -qFx .nf
}

# The keys of the schema of scenes, but for those of what a surface or map holds.
scene_keys() {
    jq -r '(.properties, .["$defs"].body.properties) | keys[]' "$top_srcdir/tools/schema/scene.schema.json"
}

@test "the page of scene files tells of each key, and shows it in an example" {
    local key page=$top_srcdir/tools/manual/impinge-scene.5
    sed -n '/^\.EX/,/^\.EE/p' "$page" >examples
    for key in $(scene_keys); do
        grep -qE "^\.BR? \"?$key\b" "$page" || { echo "no $key"; false; }
        # Events are written, not read.
        [ "$key" = events ] || grep -q "\"$key\": " examples || { echo "no example of $key"; false; }
    done
}

# example N: the N-th example of the page of scene files, as scene.json; sets `run_by`.
example() {
    awk -v n="$1" '
        /^\.\\" run: / && --n == 0 { sub(/.* run: /, ""); print >"run_by" }
        /^\.EE/ { shown = 0 }
        shown { print >"scene.json" }
        n == 0 && /^\.EX/ && !done { shown = done = 1 }' "$top_srcdir/tools/manual/impinge-scene.5"
}

@test "the examples of the page of scene files answer what it says" {
    local count n verb verdict
    count=$(grep -c '^\.\\" run: ' "$top_srcdir/tools/manual/impinge-scene.5")
    [ "$count" -ge 10 ]
    for ((n = 1; n <= count; ++n)); do
        example "$n"
        read -r verb verdict <run_by || true
        case $verb in
        solve) run -0 impinge solve scene.json --json ;;
        batch) run -0 impinge batch - <<<"$(tr -d '\n' <scene.json)" ;;
        simulate) run -0 impinge simulate scene.json -o motion.json --json && verdict= ;;
        *) false ;;
        esac
        echo "$n: $output"
        [ -z "$verdict" ] || json --arg verdict "$verdict" '.verdict == $verdict'
    done
}

@test "the plugin of its manual page is built, checked, proved and used" {
    local page=$top_srcdir/tools/manual/impinge-plugin.7
    sed -n '/^\.\\" file: /,/^\.EE/{/^\./d;s/\\-/-/g;s/\\(ha/^/g;p}' "$page" >saddle.c
    sed -n '/^\.\\" commands/,/^\.EE/{/^\./d;s/\\-/-/g;s/\\(aq/'"'"'/g;p}' "$page" >commands
    [ "$(wc -l <commands)" -eq 3 ]
    run -0 bash -ex commands
    [[ $output == *proved* && $output == *clear* ]]
}

@test "the tutorial's commands print what it says, and draw its pictures" {
    grep -q '^#define HAVE_LIBPNG 1' "$top_builddir/config.h" || skip 'built without libpng'
    [ "$PYTHON3" != no ] || skip "no python3 with numpy"
    run -0 "$top_srcdir/tools/manual/walk_tutorial" "$top_srcdir/tools/manual/tutorial.md" work
    [ "${lines[-1]}" = "15 commands" ]
    local picture
    for picture in $(sed -n 's/^!\[.*(\(.*\))$/\1/p' "$top_srcdir/tools/manual/tutorial.md"); do
        [ "$(head -c 4 "work/$picture" | tail -c 3)" = PNG ]
    done
}

@test "a command of a tutorial that prints something else, or fails, is found" {
    local walk=$top_srcdir/tools/manual/walk_tutorial fence='```'
    printf '%s\n' "$fence" '$ echo one two' 'one...' "$fence" 'File a.txt:' "$fence" '(x)' "$fence" \
        "$fence" '$ cat a.txt' '(x)' "$fence" >good.md
    run -0 "$walk" good.md work
    [ "${lines[-1]}" = '2 commands' ]
    sed 's/one\.\.\./two.../' good.md >other.md
    run -1 "$walk" other.md work
    sed 's/cat a/false a/' good.md >failing.md
    run -1 "$walk" failing.md work
}
