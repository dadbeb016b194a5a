#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the host remembers of a plugin file, and when it tries the file again.

load ../support/host_helper

# --- What is remembered -------------------------------------------------------------------------
own_cache() { export XDG_CACHE_HOME=$PWD/cache; }

# counting TEXT: builds plugins/counting.so, the TEXT plugin whose constructor notes that it ran.
counting() {
    mkdir -p plugins
    cat >counting.c <<END
#include "tiny.h"
#include <stdio.h>
__attribute__((constructor)) static void note_it(void)
{
    FILE *notes = fopen("$PWD/notes", "a");
    if (notes != NULL) fputs("$1\n", notes), fclose(notes);
}
static const imp_surface_type type = TINY_TYPE("counting", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("counting", type);
END
    # shellcheck disable=SC2086 # CC may hold flags
    $CC -shared -fPIC -I"$top_srcdir/sdk" -I"$top_srcdir/tests/plugins" -o fresh.so counting.c -lm
    mv fresh.so plugins/counting.so
}

@test "a file is tried in a child once, and again when it has changed" {
    own_cache
    counting first
    run -0 list
    [ "$(wc -l <notes)" -eq 2 ]
    run -0 list
    [ "$(wc -l <notes)" -eq 3 ]
    counting second
    run -0 list
    [ "$(grep -c second notes)" -eq 2 ]
    grep -q "$PWD/plugins/counting.so" cache/impinge/trials
}

@test "a file overwritten by one of its size and age is tried again" {
    own_cache
    counting first
    run -0 list
    cp -p plugins/counting.so old.so
    counting later
    cp plugins/counting.so new.so
    [ "$(stat -c %s old.so)" -eq "$(stat -c %s new.so)" ]
    cp -p old.so plugins/counting.so
    run -0 list
    : >notes
    cat new.so >plugins/counting.so
    touch -r old.so plugins/counting.so
    run -0 list
    [ "$(grep -c later notes)" -eq 2 ]
}

@test "a file replaced by a worse one is refused, and by a better one taken" {
    own_cache
    takes kit
    run -0 list --json
    json 'any(.types[]; .name == "kit")'
    cp "$built/constructor_crashes.so" plugins/kit.so
    run -0 list --json
    left_out kit.so 'trial: loading it crashes'
    run -0 list --json
    left_out kit.so 'trial: loading it crashes'
    cp "$built/kit.so" plugins/kit.so
    run -0 list --json
    json '.refused == [] and any(.types[]; .name == "kit")'
}

@test "a plugin refused for want of a library is taken when the library is there" {
    own_cache
    mkdir -p plugins lib
    echo 'double helper(void) { return 1; }' >helper.c
    cat >needy.c <<'END'
#include "tiny.h"
double helper(void);
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    return helper() > 0 ? tiny_create(values, self, why) : IMP_STATUS_INTERNAL;
}
static const imp_surface_type type = TINY_TYPE("needy", create, tiny_eval, 0, NULL);
TINY_PLUGIN("needy", type);
END
    # shellcheck disable=SC2086 # CC may hold flags
    $CC -shared -fPIC -o lib/libhelper.so helper.c
    # shellcheck disable=SC2086
    $CC -shared -fPIC -I"$top_srcdir/sdk" -I"$top_srcdir/tests/plugins" -o plugins/needy.so needy.c \
        -Llib -lhelper -Wl,-rpath,"$PWD/lib" -lm
    mv lib/libhelper.so elsewhere.so
    run -0 list --json
    left_out needy.so 'libhelper.so'
    mv elsewhere.so lib/libhelper.so
    run -0 list --json
    json '.refused == [] and any(.types[]; .name == "needy")'
}

@test "a plugin refused because too many files were open is taken when they are not" {
    own_cache
    takes kit
    local most
    for most in 4 5 6 7 8; do
        "$top_builddir"/libtool --mode=execute bash -c "ulimit -n $most; exec \"\$0\" list \"\$@\"" \
            "$IMPINGE" --plugin-path "$PWD/plugins" &>>said || true
    done
    grep -q 'rejected' said
    run -0 list --json
    json '.refused == [] and any(.types[]; .name == "kit")'
}

@test "what why finds anew is what list remembers" {
    own_cache
    takes kit
    takes constructor_exits
    run -0 list
    refused=$(grep constructor_exits cache/impinge/trials | cut -f1)
    sed -i "s|^[0-9]*\(.*/plugins/kit.so\t\).*|$refused\1trial: it was a bad day|" \
        cache/impinge/trials
    run -0 list --json
    left_out kit.so 'a bad day'
    run -0 "$IMPINGE" why plugins/kit.so
    run -0 list --json
    json 'any(.types[]; .name == "kit")'
}

@test "a cache that is garbage, a folder, a pipe or out of reach costs time only" {
    own_cache
    takes kit constructor_exits
    good() {
        run -0 timeout 60 "$IMPINGE" list --plugin-path "$PWD/plugins" --json
        left_out constructor_exits.so 'trial: loading it ends the process'
        json '.refused | length == 1'
        json 'any(.types[]; .name == "kit")'
    }
    good
    cp cache/impinge/trials trials
    head -c 100000 /dev/urandom >cache/impinge/trials
    good
    { head -n 1 trials && head -c 100000 /dev/urandom; } >cache/impinge/trials
    good
    { head -n 1 trials && sed -e 1d -e 's/\t/\t-/g' trials; } >cache/impinge/trials
    good
    head -c 300 trials >cache/impinge/trials
    good
    rm cache/impinge/trials && mkdir cache/impinge/trials
    good
    rmdir cache/impinge/trials && mkfifo cache/impinge/trials
    good
    rm cache/impinge/trials && ln -s /dev/zero cache/impinge/trials
    good
    rm -r cache && : >cache
    good
    export XDG_CACHE_HOME=/nonexistent/cache
    good
    unset XDG_CACHE_HOME
    HOME='' good
}

# --- What is remembered of a bad moment ---------------------------------------------------------
@test "a refusal that is remembered says so, and how to try again" {
    own_cache
    takes constructor_exits
    run -0 list --json
    json '.refused[0].reason | contains("remembered") | not'
    run -0 list --json
    json '.refused[0].reason | endswith("(remembered; `impinge why FILE` tries again)")'
}

# lingering: builds plugins/lingering.so, whose constructor sends its process the signal $LINGER.
lingering() {
    mkdir -p plugins
    cat >lingering.c <<'END'
#include "tiny.h"
#include <signal.h>
#include <stdlib.h>
__attribute__((constructor)) static void linger(void)
{
    const char *number = getenv("LINGER");
    if (number != NULL) raise(atoi(number));
}
static const imp_surface_type type = TINY_TYPE("lingering", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("lingering", type);
END
    # shellcheck disable=SC2086 # CC may hold flags
    $CC -shared -fPIC -I"$top_srcdir/sdk" -I"$top_srcdir/tests/plugins" -o plugins/lingering.so lingering.c -lm
}

@test "a child killed or stopped from outside says nothing about the file" {
    own_cache
    lingering
    LINGER=9 run -0 list --json
    left_out lingering.so 'trial: the process that loaded it was ended from outside: signal 9'
    LINGER=19 run -0 list --json
    left_out lingering.so 'trial: the process that loaded it was stopped from outside: signal 19'
    run -0 list --json
    json '.refused == [] and any(.types[]; .name == "lingering")'
}

@test "the cache has a limit, and a book beyond it is not read" {
    own_cache
    takes kit constructor_exits
    run -0 list
    { head -n 1 cache/impinge/trials && yes "$(sed -n 2p cache/impinge/trials)" | head -n 5000; } >long
    cp long cache/impinge/trials
    rm plugins/constructor_exits.so
    takes no_entry
    run -0 list --json
    [ "$(wc -l <cache/impinge/trials)" -le 4097 ]
    yes "$(sed -n 2p long)" | head -c 9000000 >>cache/impinge/trials
    run -0 list --json
    left_out no_entry.so 'entry: does not export'
    json '.refused[0].reason | contains("remembered") | not'
}

@test "a limit of file sizes costs the cache, not the answer" {
    own_cache
    takes kit
    run -0 bash -c 'ulimit -f 0; "$@"' - "$IMPINGE" list --plugin-path "$PWD/plugins" --json
    json 'any(.types[]; .name == "kit")'
    [ ! -e cache/impinge/trials ]
}

@test "a file that is replaced while it is loaded is refused" {
    own_cache
    mkdir -p plugins
    cat >changing.c <<END
#include "tiny.h"
#include <stdio.h>
#include <sys/stat.h>
__attribute__((constructor)) static void change(void) { chmod("$PWD/plugins/changing.so", 0700), chmod("$PWD/plugins/changing.so", 0755); }
static const imp_surface_type type = TINY_TYPE("changing", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("changing", type);
END
    # shellcheck disable=SC2086 # CC may hold flags
    $CC -shared -fPIC -I"$top_srcdir/sdk" -I"$top_srcdir/tests/plugins" -o plugins/changing.so changing.c -lm
    run -0 list --json
    left_out changing.so 'load: the file was changed while it was being loaded; try again'
}
