#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Whatever lies in a plugin directory, and whatever a plugin does: the host answers, says why, and
# goes on with the rest.

load ../support/cli_helper

# shellcheck disable=SC2154 # top_builddir comes from the environment
built=$top_builddir/tests/plugins/.libs

# takes NAME...: puts these test plugins into ./plugins.
takes() {
    local name
    mkdir -p plugins
    for name; do cp "$built/$name.so" plugins; done
}

list() { "$IMPINGE" list --plugin-path "$PWD/plugins" "$@"; }
pair() { "$IMPINGE" pair --plugin-path "$PWD/plugins" "$@"; }

# Any slab meets it at t = 0.9.
ball='sphere radius=.5 center=.3,.2,1.4'

# left_out FILE TEXT: the list that ran last with --json gives that reason for plugins/FILE.
left_out() {
    json --arg file "$PWD/plugins/$1" --arg text "$2" \
        '[.refused[] | select(.file == $file) | .reason] | length == 1 and (.[0] | contains($text))' ||
        { echo "$1: no refusal with: $2" && jq .refused <<<"$output" && return 1; }
}

# still_works: the types of good plugins answer as ever.
still_works() {
    run -0 pair "$left" "$right" --json
    json '.verdict == "contact"'
}

# --- Loading ------------------------------------------------------------------------------------

sins_of_loading='bad_name: types: a type'"'"'s name is '"'"'bad name!'"'"'; must be
bad_parameter_table: types: bad_parameter_table: radius: default_value: got -1, must be > 0
constructor_aborts: trial: loading it crashes: signal 6
constructor_crashes: trial: loading it crashes: signal 11
constructor_exits: trial: loading it ends the process with status 0; a plugin must not exit
fp_mode: load: loading it changes the mode of arithmetic
half_bad: types: half_bad: create is NULL; only include, apply, net, rigid, span, distance, symmetry, formula and write_formula may be
newer_minor: abi: abi_minor is 77, the host'"'"'s is 0 and may not be less; use a newer host, or
no_entry: entry: does not export the symbol impinge_plugin; define it by the macro IMPINGE_PLUGIN
no_factory: types: get_factory knows neither impinge.surface/1 nor impinge.map/1
no_note: note: has no Impinge note: it is not a plugin, or was built without the macro
note_disagrees: entry: impinge_plugin says note_disagrees 2.0, ABI 1.0, but the note
null_callback: types: null_callback: eval is NULL; only include, apply, net, rigid, span, distance, symmetry, formula and write_formula may be
null_string: entry: impinge_plugin: author is NULL; must be a line of text
symmetry_alone: types: symmetry_alone: distance is NULL, but symmetry is given
undefined_symbol: nobody_defines_this; link it with every library it uses
wrong_abi_major: abi: abi_major is 9, the host'"'"'s is 1; rebuild the plugin'

@test "each sin of loading is refused by its name, and why agrees with list" {
    local name reason check
    while IFS=: read -r name reason; do takes "$name"; done <<<"$sins_of_loading"
    run -0 list
    [[ $output == *'17 files or directories were rejected; `impinge list --refused` shows why.'* ]]
    run -0 list --json
    valid types
    json '.refused | length == 17'
    while IFS=: read -r name reason; do
        left_out "$name.so" "${reason# }"
    done <<<"$sins_of_loading"
    jq -r '.refused[] | [.file, .reason] | @tsv' <<<"$output" >refused
    while IFS=$'\t' read -r name reason; do
        check=${reason%%:*}
        reason=${reason% (remembered; \`impinge why FILE\` tries again)}
        run -5 "$IMPINGE" why "$name"
        [[ $output == *"  $check "*" refused "*"${reason#*: }"*'This file is rejected.' ]]
    done <refused
    still_works
}

@test "a type of a plugin that was rejected is unknown" {
    takes null_callback
    fails 4 "a: unknown surface type 'null_callback'" pair null_callback sphere
}

@test "a constructor that hangs is ended at the deadline, once" {
    takes constructor_hangs
    run -5 timeout 60 "$IMPINGE" why plugins/constructor_hangs.so
    [[ $output == *'trial     refused     loading it does not finish within 5 s; look at'* ]]
    SECONDS=0
    run -0 list --json
    left_out constructor_hangs.so 'trial: loading it does not finish within 5 s'
    [ "$SECONDS" -lt 5 ]
}

@test "what was linked with -ffast-math leaves the host's arithmetic as it was" {
    takes fast_math
    run -0 list --json
    json '.refused | length < 2'
    "$IMPINGE" pair 'sphere' "$ball" --json >alone
    pair 'sphere' "$ball" --json >beside
    [ "$(jq -c 'del(.stats)' alone)" = "$(jq -c 'del(.stats)' beside)" ]
}

# --- What is no plugin ------------------------------------------------------------------------------

# patched BYTE VALUE FILE: kit.so with one byte replaced.
patched() {
    cp "$built/kit.so" "plugins/$3"
    # shellcheck disable=SC2059 # the value is an escape sequence
    printf "$2" | dd of="plugins/$3" bs=1 seek="$1" conv=notrunc status=none
}

@test "files that are no plugins are refused, and none holds the host up" {
    mkdir -p plugins/directory.so
    cd plugins
    : >empty.so
    echo 'no plugin' >text.so
    mkfifo pipe.so
    ln -s loop.so loop.so
    ln -s /nonexistent gone.so
    ln -s /dev/zero zero.so
    cd ..
    patched 4 '\001' class.so
    patched 18 '\010' machine.so
    run -0 timeout 60 "$IMPINGE" list --plugin-path "$PWD/plugins" --json
    valid types
    json '.refused | length == 9'
    left_out directory.so 'file: '
    left_out empty.so 'format: is not an ELF file'
    left_out text.so 'format: is not an ELF file'
    left_out pipe.so 'pipe'
    left_out loop.so 'symbolic links'
    left_out gone.so 'No such file'
    left_out zero.so 'device'
    left_out class.so 'class: '
    left_out machine.so 'machine: '
    local file
    for file in plugins/*.so; do
        run -5 timeout 60 "$IMPINGE" why "$file"
        [[ $output == *' refused '*'This file is rejected.' ]]
    done
    still_works
}

@test "a file nobody may read is refused" {
    [ "$(id -u)" -ne 0 ] || skip 'root may read everything'
    takes kit
    chmod 0 plugins/kit.so
    run -0 list --json
    left_out kit.so 'Permission denied'
    run -5 "$IMPINGE" why plugins/kit.so
    [[ $output == *'Permission denied'* ]]
}

@test "a plugin cut short at every percent of its length is refused, with a reason" {
    local size percent
    mkdir plugins
    size=$(stat -L -c %s "$built/eval_nan_late.so")
    for percent in $(seq -w 0 99); do
        head -c $((size * 10#$percent / 100)) "$built/eval_nan_late.so" >"plugins/$percent.so"
    done
    head -c $((size - 1)) "$built/eval_nan_late.so" >plugins/last.so
    run -0 list --json
    json '.refused | length == 101 and all(.reason | test("^(format|headers|segments|note): ."))'
    for percent in 00 01 50 99; do run -5 "$IMPINGE" why "plugins/$percent.so"; done
    still_works
}

@test "an unknown type is answered with the plugins that were left out, and why" {
    takes kit
    truncate -s 1000 plugins/kit.so
    fails 4 "unknown surface type 'kit'" pair kit sphere
    [[ $stderr == *"; '$PWD/plugins/kit.so' was left out: headers: "* ]]
    printf x >plugins/another.so
    fails 4 "; 2 files were left out, such as '$PWD/plugins/kit.so': headers: " pair kit sphere
}

@test "where the limit on open files is reached, the message says so" {
    local limit
    ! has_sanitizers || skip 'AddressSanitizer needs descriptors of its own'
    for limit in 4 5; do
        rm -rf cache
        XDG_CACHE_HOME=$PWD/cache LD_LIBRARY_PATH=$top_builddir/.libs \
            run -4 --separate-stderr bash -c 'exec 3>&- 4>&- 5>&- 6>&- 7>&-; exec "$@"' - \
            prlimit --nofile=$limit "$top_builddir/tools/.libs/impinge" pair sphere 'sphere center=3,0,0' \
            --plugin-path "$top_builddir/plugins/.libs"
        echo "$limit: $stderr"
        [[ $stderr == *"unknown surface type 'sphere'"*'left out'*'the limit on open files'*'(ulimit -n)'* ]]
    done
}

# --- Directories ---------------------------------------------------------------------------------------

@test "a directory that anyone may write to is warned of, and refused with --secure" {
    takes kit
    chmod 777 plugins
    run -0 --separate-stderr list
    [[ $output != *'rejected'* && $stderr == "impinge: list: warning: $PWD/plugins: anyone may write"* ]]
    run -0 --separate-stderr list --json
    json --arg file "$PWD/plugins" '.refused == [] and (.warnings | length == 1)
        and .warnings[0].file == $file and (.warnings[0].reason | startswith("anyone may write"))'
    json '.types | any(.name == "kit")'
    run -0 list --json --secure
    json '.warnings == [] and (.refused | length == 1)
        and (.refused[0].reason | endswith("is a directory that anyone may write to; chmod o-w it"))'
    json '.types | all(.name != "kit")'
    fails 4 "unknown surface type 'kit'" pair 'kit radius=1' sphere --secure
    run -0 --separate-stderr pair "$left" "$right" --json
    [[ $stderr == 'impinge: pair: warning: '* ]]
    json '.verdict == "contact"'
    chmod 755 plugins
    run -0 list --json --secure
    json '.refused == [] and any(.types[]; .name == "kit")'
}

# distrusted FILE PATH TEXT: list --secure gives that reason for plugins/FILE (or plugins, where FILE is
# empty), which names the path; the type kit is not taken.
distrusted() {
    run -0 list --json --secure
    json --arg file "$PWD/plugins${1:+/$1}" --arg start "'$2' $3" \
        '[.refused[] | select(.file == $file) | .reason] | length == 1 and (.[0] | startswith($start))' ||
        { jq .refused <<<"$output" && return 1; }
    json '.types | all(.name != "kit")'
}

@test "--secure takes no file that others could change or replace, on the whole way to it" {
    takes kit
    chmod 666 plugins/kit.so
    distrusted kit.so "$PWD/plugins/kit.so" 'is a file that anyone may write to; chmod o-w it'
    chmod 644 plugins/kit.so
    mkdir -p elsewhere/deep
    mv plugins/kit.so elsewhere/deep
    ln -s ../between plugins/kit.so
    ln -s elsewhere/deep/kit.so between
    run -0 list --json --secure
    json '.refused == [] and any(.types[]; .name == "kit")'
    chmod 777 elsewhere
    distrusted kit.so "$PWD/elsewhere" 'is a directory that anyone may write to; chmod o-w it'
    chmod 1777 elsewhere # others cannot replace what is in it
    run -0 list --json --secure
    json '.refused == [] and any(.types[]; .name == "kit")'
    chmod 1777 elsewhere/deep plugins # nor here, but add to it
    distrusted '' "$PWD/plugins" 'is a directory that anyone may write to; chmod o-w it'
    chmod 755 elsewhere elsewhere/deep plugins
    chmod 646 elsewhere/deep/kit.so
    distrusted kit.so "$PWD/elsewhere/deep/kit.so" 'is a file that anyone may write to'
    chmod 644 elsewhere/deep/kit.so
    chmod 777 .
    distrusted '' "$PWD" 'is a directory that anyone may write to'
    chmod 755 .
    run -0 list --json --secure
    json '.refused == [] and any(.types[]; .name == "kit")'
}

@test "--secure takes nothing that belongs to others than root and the user" {
    [ "$(id -u)" -eq 0 ] || skip 'only root can give files away'
    takes kit
    local at
    for at in plugins/kit.so plugins .; do
        chown 12345 $at
        distrusted "$(basename $at | grep so || :)" "$(realpath "$at")" \
            'belongs to user 12345, who is neither root nor the one running this; chown it, or copy'
        chown 0 $at
    done
    mv plugins/kit.so real.so
    ln -s ../real.so plugins/kit.so
    chown -h 12345 plugins/kit.so
    distrusted kit.so "$PWD/plugins/kit.so" 'belongs to user 12345'
    chown -h 0 plugins/kit.so
    run -0 list --json --secure
    json '.refused == [] and any(.types[]; .name == "kit")'
}

# A program that says whether it is privileged, and which directories it would load from.
build_privileged() {
    cat >privileged.c <<'END'
#include "core/plugin/search_path.h"
#include <stdio.h>
#include <sys/auxv.h>
int main(void)
{
    search_path path = {.count = 0};
    if (!search_path_add_defaults(&path, NULL)) return 1;
    printf("%s\n", getauxval(AT_SECURE) ? "privileged" : "ordinary");
    for (size_t i = 0; i < path.count; ++i) puts(path.directory[i].path);
    return 0;
}
END
    # shellcheck disable=SC2086,SC2154 # CC may hold flags; top_srcdir comes from the environment
    $CC -std=gnu11 -I"$top_srcdir" -I"$top_srcdir/core" -I"$top_srcdir/sdk" -I"$top_builddir" -DHAVE_CONFIG_H \
        -DPLUGINDIR='"/installed"' -o privileged privileged.c "$top_srcdir"/core/plugin/search_path.c \
        ${CORE_ARRAY-}
}

@test "a privileged process ignores what the environment says of plugins" {
    local group
    build_privileged
    export IMPINGE_PLUGIN_PATH=/named XDG_DATA_HOME=/data HOME=/home/somebody
    run -0 ./privileged
    [ "$output" = $'ordinary\n/named\n/data/impinge/1\n/installed' ]
    if [ "$(id -u)" -eq 0 ]; then
        group=65534
    else
        group=$(id -G | tr ' ' '\n' | grep -vxF "$(id -g)" | head -n 1) || true
    fi
    [ -n "$group" ] || skip 'no second group to run as'
    chgrp "$group" privileged && chmod g+s privileged || skip 'the group cannot be set'
    run -0 ./privileged
    [ "${lines[0]}" = privileged ] || skip 'this file system or process grants no privileges'
    [ "$output" = $'privileged\n/installed' ]
}

# --- What is remembered ------------------------------------------------------------------------------------

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

# --- Crashes -----------------------------------------------------------------------------------------------

# blames TYPE TEXT [OPTION]...: the pair of TYPE and the ball ends with status 5 and this message.
blames() { fails 5 "$2" pair "$1" "$ball" "${@:3}"; }

@test "a crash, an exit or a stack used up is laid at the door of type and callback" {
    takes create_crashes domain_crashes eval_crashes eval_aborts eval_exits eval_overflows_stack
    blames create_crashes "crashed in the create of type 'create_crashes';"
    blames domain_crashes "crashed in the domain of type 'domain_crashes';"
    blames eval_crashes "crashed in the eval of type 'eval_crashes';"
    blames eval_aborts "crashed in the eval of type 'eval_aborts';"
    blames eval_exits "type 'eval_exits' ends the process in its eval;"
    blames eval_overflows_stack "crashed in the eval of type 'eval_overflows_stack';"
    run -5 --separate-stderr pair eval_crashes "$ball" --json
    [[ $stderr == "impinge: crashed in the eval of type 'eval_crashes';"* ]]
    valid result
    json --arg said "${stderr#impinge: }" '.error == $said'
    still_works
}

@test "isolated, the same cost an error that names the point, and so does a hang" {
    takes create_crashes domain_crashes eval_crashes eval_exits eval_hangs eval_overflows_stack
    blames create_crashes "a: create of 'create_crashes' ($PWD/plugins/create_crashes.so) crashes" \
        --isolate all
    blames domain_crashes "domain_crashes.so) crashes or ends its process" --isolate all
    blames 'eval_crashes height=.25' \
        "type 'eval_crashes height=0.25' at u = 0, v = 0, t = 0: crashes or ends" --isolate all
    blames eval_exits "type 'eval_exits' at u = 0, v = 0, t = 0: crashes or ends" --isolate eval_exits
    blames eval_overflows_stack "type 'eval_overflows_stack' at u = 0" --isolate all
    blames eval_hangs "type 'eval_hangs' at u = 0, v = 0, t = 0: does not answer within 5 s" \
        --isolate eval_hangs
}

@test "what a batch has answered before a crash is not lost" {
    takes eval_crashes
    {
        scene '"id": 1,'
        sed 's/sphere", "center": \[-2,0,0\]/eval_crashes"/' < <(scene '"id": 2,')
    } >scenes.jsonl
    # with one thread line 1 is answered before line 2 begins
    run -5 --separate-stderr "$IMPINGE" batch scenes.jsonl --threads 1 --plugin-path "$PWD/plugins"
    [[ $stderr == *"crashed in the eval of type 'eval_crashes'"* ]]
    valid result
    [ "$(jq .id <<<"$output")" = 1 ]
}

# --- Lies --------------------------------------------------------------------------------------------------

whole='over u [-1, 1], v [-1, 1], t [0, 1]'

@test "create that fails, gives nothing or changes the arithmetic is named with its file" {
    takes create_fails create_null create_rounds
    blames create_fails "a: create failed with status 4: bug in plugin type 'create_fails' ($PWD/plugins/"
    blames create_null "a: create returned IMP_STATUS_OK without an instance: bug in plugin type 'create_null' ("
    blames create_rounds "a: create changed the mode of arithmetic: bug in plugin type 'create_rounds' ("
    still_works
}

@test "a domain that is none, or changes the arithmetic, ends the query" {
    takes domain_nan domain_rounds
    blames domain_nan "domain_nan.so) has a domain that is empty, NaN, or infinite in u or v"
    blames domain_rounds "domain_rounds.so) changes the floating-point mode of its caller"
    blames domain_rounds "domain_rounds.so) changes the floating-point mode" --isolate all
}

@test "pieces that are none, too many, missing or of other times end the query; those in order are named" {
    takes pieces pieces_none pieces_many pieces_null pieces_times pieces_half
    blames pieces_none "pieces_none.so) gives a piece_count that is 0 or above IMP_PIECES_MAX"
    blames pieces_many "pieces_many.so) gives a piece_count that is 0 or above IMP_PIECES_MAX"
    blames pieces_null "pieces_null.so) gives NULL for one of its pieces"
    blames pieces_null "pieces_null.so) gives NULL for one of its pieces" --isolate all
    blames pieces_many "pieces_many.so) gives a piece_count that is 0 or above" --isolate all
    blames pieces_times "pieces_times.so) has pieces whose domains differ in time"
    run -0 list --json
    left_out pieces_half.so 'pieces_half: piece is NULL; give piece_count and piece, or neither'
    local way
    for way in '' '--isolate all'; do
        # shellcheck disable=SC2086 # words on purpose
        run -0 pair pieces 'sphere radius=.25 center=.3,.2,3.5 ! translate velocity=0,0,-1' --json $way
        json '.verdict == "contact" and .a.piece == 2 and (.b | has("piece") | not) and .t > 0.62 and .t < 0.63'
    done
}

@test "points that are no numbers end the query and name body, type, parameters and point" {
    takes eval_nan_late eval_error_negative
    blames 'eval_nan_late height=.1' "body 'a', surface 0: type 'eval_nan_late height=0.1' at u = "
    run -0 pair eval_nan_late 'sphere radius=.5 center=.3,.2,.8' --time 0,.4 --json
    json '.verdict == "contact" and .t < 0.31'
    blames eval_error_negative "type 'eval_error_negative' at u = "
    run -5 --separate-stderr pair 'eval_nan_late' 'sphere radius=.5 center=.3,.2,1' --time .7,.9
    [[ $stderr == *"type 'eval_nan_late'"*'t = 0.'*'eval gives a point that is infinite or NaN' ]]
}

@test "bounds that are infinite, negative or inverted end the query and name the region" {
    takes rate_infinite rate_negative include_inverted include_negative
    blames 'rate_infinite height=.5' "type 'rate_infinite height=0.5' $whole: a rate is negative"
    blames rate_negative "body 'a', surface 0: type 'rate_negative' $whole: a rate is negative"
    blames include_inverted "type 'include_inverted' $whole: the range is inverted"
    blames include_negative "type 'include_negative' $whole: the remainder is negative"
    local type
    for type in rate_infinite rate_negative; do
        blames $type "type '$type' $whole: " --method paper
    done
    still_works
}

@test "bounds that break the ABI do not hide behind a map, nor do a map's behind a surface" {
    takes rate_negative include_inverted include_negative map_rate_negative
    local type turned='rotate axis=1,1,1 rate=.7'
    for type in rate_negative include_inverted include_negative; do
        blames "$type ! $turned" "type '$type ! rotate axis=1,1,1 rate=0.7' $whole: a r"
    done
    blames 'sphere radius=.1 ! map_rate_negative' \
        "type 'sphere radius=0.1 ! map_rate_negative' over u [0, "
    blames "sphere ! map_rate_negative ! $turned" 'a rate is negative, infinite or NaN'
    blames 'sphere ! map_rate_negative' 'negative' --method paper
}

@test "lies that the search meets end it, and --audit finds the others" {
    takes include_lies rate_lies
    blames include_lies "body 'a', surface 0: type 'include_lies' breaks its own bounds $whole: at u = "
    blames 'rate_lies height=.5' "type 'rate_lies height=0.5' breaks its own bounds $whole: at u = " --audit
    blames include_lies "breaks its own bounds" --audit
    still_works
}

@test "control nets that break the ABI end the query, and --audit finds those that points refute" {
    takes net_nan liar_net
    blames net_nan "type 'net_nan' over u [0, 4], v [0, 4], t [0, 1]: a control net has too many points"
    blames liar_net "type 'liar_net' breaks its control net over u [" --audit
}

@test "poses that break the ABI end the query, and --audit finds those that points refute" {
    takes mistakes_pose
    blames 'torus center=2,0,1 ! pose_depends_on_u' "! pose_depends_on_u' over t [0, 1]: a pose depends on more than time"
    blames 'torus center=2,0,1 ! pose_turns_backward' 'breaks its own bounds over u ['
    blames 'torus center=2,0,1 ! pose_turns_backward' 'breaks its own bounds over u [0, ' --audit
}

@test "distances that break the ABI end the query, and --audit finds those that points refute" {
    takes distance_nan distance_infinite liar_distance liar_distance_remainder liar_truthful_distance
    # Its type gives no distance, so that the other's is asked for.
    local type within='superellipsoid radii=.98,.97,.5 exponents=1,1 center=0,0,1 ! rotate rate=3'
    for type in distance_nan distance_infinite; do
        fails 5 "type '$type': a distance from it has a remainder that is negative or NaN, or" \
            pair $type "$within" --gamma 1e-3
    done
    for type in liar_distance liar_distance_remainder; do
        fails 5 "type '$type' claims too large a distance over u [" pair $type "$within" --gamma 1e-3 --audit
    done
    run -0 pair liar_truthful_distance "$within" --gamma 1e-3 --audit --json
    json '.verdict == "clear"'
}

@test "a symmetry that breaks the ABI ends the query" {
    takes symmetry_nan liar_truthful_symmetry
    local within='cylinder radius=.98 height=1 center=.01,0,1 ! rotate rate=3'
    fails 5 "type 'symmetry_nan': its symmetry has an unknown kind, a center or an axis that is not finite" \
        pair symmetry_nan "$within" --gamma 1e-3
    run -0 pair liar_truthful_symmetry "$within" --gamma 1e-3 --json
    json '.verdict == "clear" and .stats.pairs < 40'
}

@test "distances and symmetries that lie where the search asks are found by --audit" {
    takes mistakes_distance
    local ring='bezier degree=[1,1] points=[[50,-1,0],[50,-1,2],[50,1,0],[50,1,2]] ! rotate axis=0,0,1 rate=2'
    local ball='sphere radius=0.15 center=0.9,0,1 ! rotate axis=0,0,1 times=0,1 angles=3.5,7'
    run -0 pair symmetry_half "$ball" --json
    json '.verdict == "clear"' # wrongly
    fails 5 "type 'symmetry_half' is not as symmetric as it says: the distance from a surface that does not turn claims at least" \
        pair symmetry_half "$ball" --audit
    clearance() { "$IMPINGE" clearance --plugin-path "$PWD/plugins" "$@"; }
    fails 5 "type 'distance_farther' claims too large a distance: distance claims at least" \
        clearance distance_farther "$ring" --audit
    clearance distance_no_mistake "$ring" --json | jq 'del(.stats)' >plain
    clearance distance_no_mistake "$ring" --json --audit | jq 'del(.stats)' >audited
    cmp plain audited
}

@test "distances under rigid maps are held against points too" {
    takes liar_distance liar_truthful_distance
    local maps='! rotate axis=1,2,3 angle=0.7 ! translate velocity=1,2,3'
    local within="cylinder radius=.99 height=1 center=0,0,1 ! rotate rate=3 $maps"
    fails 5 "type 'liar_distance ! rotate axis=1,2,3 angle=0.7 ! translate velocity=1,2,3' claims too large a distance" \
        pair "liar_distance $maps" "$within" --gamma 1e-3 --audit
    run -0 pair "liar_truthful_distance $maps" "$within" --gamma 1e-3 --audit --json
    json '.verdict == "clear"'
}

@test "distances are asked for at times at which the surface exists" {
    takes pipe_absent
    run -0 pair pipe_absent 'cylinder radius=.99 height=1 center=0,0,1 ! rotate rate=3' --gamma 1e-3 --json
    json '.verdict == "clear" and .t_examined == [0.25, 0.5]'
}

@test "callbacks that change the arithmetic end the query" {
    takes eval_rounds include_rounds
    blames eval_rounds "type 'eval_rounds' at u = 0, v = 0, t = 0: changes the floating-point mode"
    blames include_rounds "type 'include_rounds' $whole: changes the floating-point mode"
}

@test "a scene with a liar has no answer, and one that ignores it answers as ever" {
    takes include_inverted
    scene >good.json
    sed 's/"bodies": \[/&{"name": "liar", "surfaces": [{"type": "include_inverted"}]},/' good.json >bad.json
    fails 5 "body 'liar', surface 0: type 'include_inverted'" \
        "$IMPINGE" solve bad.json --plugin-path "$PWD/plugins"
    run -0 "$IMPINGE" solve good.json --plugin-path "$PWD/plugins" --json
    json '.verdict == "contact"'
}

# --- What is remembered of a bad moment -----------------------------------------------------------------

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
