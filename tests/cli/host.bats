#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Whatever lies in a plugin directory: the host says why it is refused, and goes on with the rest.

load ../support/host_helper

# --- Loading ------------------------------------------------------------------------------------
sins_of_loading='bad_name: types: a type'"'"'s name is '"'"'bad name!'"'"'; must be
bad_parameter_table: types: bad_parameter_table: radius: default_value: got -1, must be > 0
bad_parts: types: bad_parts: parts name '"'"'$ofset'"'"', which must be a parameter of numbers that is required or has a default
constructor_aborts: trial: loading it crashes: signal 6
constructor_crashes: trial: loading it crashes: signal 11
constructor_exits: trial: loading it ends the process with status 0; a plugin must not exit
constructor_overwrites: trial: loading it overwrites the environment variable
fp_mode: load: loading it changes the mode of arithmetic
half_bad: types: half_bad: create is NULL; only include, apply, net, rigid, span, distance, symmetry, tube, formula and write_formula may be
newer_minor: abi: abi_minor is 77, the host'"'"'s is 0 and may not be less; use a newer host, or
no_entry: entry: does not export the symbol impinge_plugin; define it by the macro IMPINGE_PLUGIN
no_factory: types: get_factory knows neither impinge.surface/1 nor impinge.map/1
no_note: note: has no Impinge note: it is not a plugin, or was built without the macro
note_disagrees: entry: impinge_plugin says note_disagrees 2.0, ABI 1.0, but the note
null_callback: types: null_callback: eval is NULL; only include, apply, net, rigid, span, distance, symmetry, tube, formula and write_formula may be
null_string: entry: impinge_plugin: author is NULL; must be a line of text
symmetry_alone: types: symmetry_alone: distance is NULL, but symmetry is given
undefined_symbol: nobody_defines_this; link it with every library it uses
wrong_abi_major: abi: abi_major is 9, the host'"'"'s is 1; rebuild the plugin'

@test "each sin of loading is refused by its name, and why agrees with list" {
    local name reason check
    while IFS=: read -r name reason; do takes "$name"; done <<<"$sins_of_loading"
    run -0 list
    [[ $output == *'19 files or directories were rejected; `impinge list --refused` shows why.'* ]]
    run -0 list --json
    valid types
    json '.refused | length == 19'
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

@test "parts that cannot be read are told with the map that names them" {
    takes parts_unread
    fails 4 "parts_unknown: unknown map 'nothing_like_it'" pair 'sphere ! parts_unknown' sphere
    fails 5 "the parts of 'parts_of_parts' cannot be read: one of them has parts itself" \
        pair 'sphere ! parts_of_parts' sphere
    fails 5 "the parts of 'parts_empty' cannot be read: there are none" pair 'sphere ! parts_empty' sphere
    fails 4 'clock: got the range [1, -1]' pair 'sphere ! parts_reversed' sphere
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

# --- What is no plugin --------------------------------------------------------------------------
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
    cp "$(command -v bash)" program.so
    cd ..
    patched 4 '\001' class.so
    patched 18 '\010' machine.so
    run -0 timeout 60 "$IMPINGE" list --plugin-path "$PWD/plugins" --json
    valid types
    json '.refused | length == 10'
    left_out program.so 'is a program'
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

# --- Directories --------------------------------------------------------------------------------
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
#include "core/common/search_path.h"
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
        -DPLUGINDIR='"/installed"' -o privileged privileged.c "$top_srcdir"/core/common/search_path.c \
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
