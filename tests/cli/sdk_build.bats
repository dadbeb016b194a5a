#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# `impinge build`, debugging of what it builds, and our own types built so.

load ../support/sdk_helper

# --- impinge build ------------------------------------------------------------------------------
@test "every example builds, is loaded, and the command that info proposes finds an answer" {
    local file name
    [ "$(find "$prefix/$examples" -type f | wc -l)" -eq 7 ]
    for file in "$prefix/$examples"/*; do
        run -0 --separate-stderr impinge build "$file"
        [ -z "$stderr" ] # no warning
        name=$(sed -nE 's/^(surface|map) ([a-z-]+): .*/\2/p' <<<"$output")
        [[ ${lines[-1]} == "in $PWD/"*.so ]]
        eval "$(impinge info "$name" --plugin-path . | sed -n 's/^  try  *//p') --plugin-path ."
        if has_verb check; then impinge check "$name" --plugin-path . --effort 0.2; fi
    done
}

@test "the examples' contacts are where the formulas put them" {
    hurry
    for file in "$prefix/$examples"/*; do impinge build "$file" >/dev/null; done
    export IMPINGE_PLUGIN_PATH=$PWD
    t_of() { impinge pair "$@" --json | jq -e ".verdict == \"contact\" and .t > $from and .t < $to"; }
    # The seashell's last turn reaches x = 1.5 at u = end, v = 0; the tip of the blade is at x = 1;
    # the puddle is next to flat; the twirl turns the sphere into itself.
    from=0.4999 to=0.5
    t_of seashell 'sphere radius=0.5 center=2.5,0,0 ! translate velocity=-1,0,0'
    t_of 'blade pitch=0' 'sphere radius=0.5 center=2,0,0 ! translate velocity=-1,0,0'
    t_of 'puddle height=1e-9' 'sphere radius=0.5 center=1,1,1 ! translate velocity=0,0,-1'
    t_of 'waves height=1e-9' 'sphere radius=0.5 center=0,0,1 ! translate velocity=0,0,-1'
    t_of 'sphere radius=0.5 ! twirl' 'sphere radius=0.5 center=0,0,1.5 ! translate velocity=0,0,-1'
}

@test "build installs where impinge finds it, with and without XDG_DATA_HOME" {
    hurry
    impinge new wobble >/dev/null
    run -0 impinge build wobble/wobble.c --install
    [[ ${lines[-1]} == "in $user/wobble.so" ]]
    run -0 impinge build wobble/wobble.c --install # again: replaced, and shadowed by nobody
    [[ $output != *another* ]]
    impinge pair wobble sphere
    XDG_DATA_HOME=$PWD/data impinge build wobble/wobble.c --install
    [ "$(ls -A "$PWD/data/impinge/1")" = wobble.so ]
    [ "$(ls -A "$user")" = wobble.so ]
    fails 4 'neither XDG_DATA_HOME nor HOME' env -u HOME impinge build wobble/wobble.c --install
}

@test "build tells of a type that is there already" {
    hurry
    impinge new wobble >/dev/null
    sed -i 's/"wobble/"sphere/' wobble/wobble.c
    run -0 impinge build wobble/wobble.c
    [[ $output == *"There is another sphere in $prefix/lib/impinge/1/sphere.so"* ]]
}

@test "build puts the plugin into the folder asked for, or the current one" {
    hurry
    impinge new wobble >/dev/null
    mkdir there
    impinge build wobble/wobble.c --output there
    [ -f there/wobble.so ] && [ ! -e wobble.so ]
    fails 2 '--install and --output both say' impinge build wobble/wobble.c --install --output there
    fails 4 'nowhere: No such file' impinge build wobble/wobble.c --output nowhere
    mkdir a:b
    fails 4 "cannot have ':' in its name" impinge build wobble/wobble.c --output a:b
}

@test "build names the compiler's first error, and shows all of them" {
    impinge new wobble >/dev/null
    sed -i 's/imp_mul(shape, swing)/imp_times(shape, swing)/; s/out\[0\] = u;/out[0] = w;/' \
        wobble/wobble.c
    fails 4 "wobble/wobble.c was not built: wobble/wobble.c:" impinge build wobble/wobble.c
    [[ ${stderr_lines[-1]} == *": error: "*undeclared* ]]
    [[ $stderr == *imp_times* ]]
    [ "$(ls -A)" = wobble ]
}

@test "build says which file, compiler or flag it cannot use" {
    impinge new wobble >/dev/null
    fails 4 'none.c: No such file' impinge build none.c
    fails 2 'a source file is wanted' impinge build wobble/README
    fails 4 "the compiler 'no-such-cc' cannot be run: No such file" \
        env CC='no-such-cc -m64' impinge build wobble/wobble.c
    fails 4 "'false' ended with status 1" env CC=false impinge build wobble/wobble.c
    fails 4 'ffast-math' env CFLAGS='-O2 -ffast-math' impinge build wobble/wobble.c
    run -0 env CC="$CC -g0" CPPFLAGS='-DPACKAGE_VERSION="7"' impinge build wobble/wobble.c
    run -0 impinge info wobble --plugin-path .
    [[ $output == *'wobble 7, MIT'* ]]
}

# refused SED_SCRIPT TEXT: the template, edited so, is refused with that reason, and the plugin that
# was there stays.
refused() {
    sed "$1" wobble/wobble.c >wobble.c
    fails 5 "wobble.c was compiled, but is not a plugin that can be loaded: $2" impinge build wobble.c --install
    impinge pair wobble sphere >/dev/null
    [ "$(ls -A "$user")" = wobble.so ]
}

@test "build explains what the loader refuses, and replaces nothing by it" {
    hurry
    impinge new wobble >/dev/null
    impinge build wobble/wobble.c --install
    refused 's/, free),/&\n    .rate = NULL,/' 'types: wobble: rate is NULL'
    refused 's/, free),/&\n    .create = NULL,/' 'types: wobble: create is NULL'
    refused 's/"height"/"hei ght"/' 'types: wobble: 0: name: must be letters'
    refused '/<impinge.plugin.h>/a #undef IMP_ABI_MAJOR\n#define IMP_ABI_MAJOR 2' 'abi: abi_major is 2'
    refused '/_PLUGIN(/d' 'note: has no Impinge note'
    refused 's/= imp_sin(/= imp_shine(/; s/^static void drum_formula/imp_model imp_shine(imp_model);\n&/' 'load: wobble.so: undefined symbol: imp_shine'
}

# --- Debugging ----------------------------------------------------------------------------------
# broken SED_SCRIPT: the template `wobble`, edited so, as a plugin in this folder.
broken() {
    impinge new wobble >/dev/null
    sed -i "$1" wobble/wobble.c
    CFLAGS='-g -O0' impinge build wobble/wobble.c >/dev/null 2>&1
}

crashing='s/^static const imp_surface_type type/static imp_status crash(const void *self, const imp_region *r, imp_model m[3])\
{\
    fprintf(stderr, "about to crash\\n");\
    return m == NULL ? IMP_STATUS_OK : *(const volatile int *)((const char *)self - (uintptr_t)self);\
}\
&/; s/, free),/&\n    .include = crash,/'

@test "a crash in include is found by gdb with the command that check prints" {
    command -v gdb >/dev/null || skip 'no gdb'
    local debug
    broken "$crashing"
    run -6 impinge check wobble --plugin-path .
    [[ $output == *'crashed (Segmentation fault) in include over u in '*'said: about to crash'* ]]
    debug=$(sed -n 's/^ *debug: //p' <<<"$output" | head -n 1)
    [[ $debug == 'gdb -ex run --args impinge check wobble '*' --call '* ]]
    run -0 bash -c "${debug/-ex run/-batch -ex run -ex continue -ex backtrace} 2>&1"
    [[ $output == *'comes next, of include'*SIGTRAP*SIGSEGV*'#0 '*'crash (self='*'wobble.c:'* ]]
}

@test "check --in-process crashes itself, and --call wants to know which check" {
    broken "$crashing"
    run -5 impinge check wobble --plugin-path . --only inclusions --in-process
    [[ $output == *'about to crash'* ]]
    fails 2 '--call counts the calls of one check: add --only' \
        impinge check sphere --call 3
    run -0 impinge check sphere --in-process
    [[ $output == *'0 failed'* && $output == *'pass  environment'* ]]
}

@test "a plugin for AddressSanitizer is told what it needs, and its report is shown" {
    local runtime
    runtime=$($CC -print-file-name=libasan.so)
    [ -f "$runtime" ] || skip 'no libasan'
    impinge new wobble >/dev/null
    sed -i 's/^    const drum \*d = self;/&\n    static volatile double few[2];\n    few[d->height != 0 ? 2 : 0] = 1;/' wobble/wobble.c
    export CFLAGS='-g -fsanitize=address' ASAN_OPTIONS=detect_leaks=0
    fails 5 'is compiled with -fsanitize and needs libasan.so' impinge build wobble/wobble.c
    LD_PRELOAD=$runtime impinge build wobble/wobble.c
    run -6 env LD_PRELOAD="$runtime" impinge check wobble --plugin-path . --only finite
    [[ $output == *'said: '*'AddressSanitizer: global-buffer-overflow'* ]]
}

@test "an example that does not work is told once" {
    broken 's/ height=0.5"/ hieght=0.5"/'
    run -6 impinge check wobble --plugin-path .
    [[ $output == *"FAIL  example "*"the type's example does not work: 'wobble hieght=0.5': "*"'height'"* ]]
    [ "$(grep -c FAIL <<<"$output")" -eq 1 ]
    [[ $output == *'pass  rates'* ]]
}

# --- Our own types ------------------------------------------------------------------------------
# With nothing but $prefix/include and copies of plugins/ to include from.
build_our_types() {
    local flags
    flags="-std=c11 -O0 -ffp-contract=off -fvisibility=hidden -fPIC -Wall -Wextra -Werror -Wno-psabi \
        -I. $(pkg-config --cflags impinge-sdk)"
    cp -R "$top_srcdir/plugins" . && chmod -R u+w plugins
    find plugins/{common,expression,mesh,patch,subdivision} -name '*.c' | sort >shared
    find plugins/{surfaces,maps} -name '*.c' | sort >types
    # shellcheck disable=SC2086 # flags are words
    xargs -P2 -I{} $CC $flags -c -o {}.o {} <shared
    find plugins -name '*.c.o' -exec ar rcs shared.a {} +
    # shellcheck disable=SC2016 # for the shell of xargs
    xargs -P2 -I{} sh -c '$0 $1 -shared -o "$(basename "$2" .c).so" "$2" shared.a -lm '"$(pkg-config --libs jansson)" "$CC" "$flags" {} <types
}

@test "every type of ours builds against the installed SDK alone, loads and answers" {
    build_our_types
    run -0 impinge list --plugin-path . --json
    jq -e --arg here "$PWD/" --argjson files "$(wc -l <types)" '.refused == [] and
        ([.types[] | select(.file | startswith($here))] | length == $files)' <<<"$output"
    run -0 impinge pair 'torus ! bend ! rotate rate=1' 'nurbs ! translate velocity=0,0,1' --plugin-path .
    run -0 impinge pair 'formula z=u*v' 'bezier degree=1,1 points=[[0,0,2],[0,1,2],[1,0,2],[1,1,2.5]]
        ! map-formula z=z-2*t' --plugin-path .
    [[ $output == contact* ]]
}
