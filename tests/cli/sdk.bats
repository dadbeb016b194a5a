#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The SDK as a newcomer has it: Impinge is installed, its sources and its build are far away. What
# the command, the guide and the examples say is done here as it stands.

bats_require_minimum_version 1.5.0

setup_file() {
    unset MAKEFLAGS MFLAGS DESTDIR IMPINGE XDG_DATA_HOME CPPFLAGS CFLAGS CXXFLAGS LDFLAGS LD_LIBRARY_PATH
    [ ! -d ~/.rustup ] || export RUSTUP_HOME=${RUSTUP_HOME-~/.rustup} # where rustc finds itself
    export prefix=$top_builddir/tests/installed/prefix HOME=$BATS_FILE_TMPDIR/home
    mkdir "$HOME"
    export PATH=$prefix/bin:$PATH PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    export ACLOCAL_PATH=$prefix/share/aclocal

    # configure of all projects below remembers what it found out about this machine.
    echo "cache_file=$BATS_FILE_TMPDIR/config.cache" >"$BATS_FILE_TMPDIR/config.site"
    export CONFIG_SITE=$BATS_FILE_TMPDIR/config.site
    user=$HOME/.local/share/impinge/1
    export user
}

setup() {
    mkdir "$BATS_TEST_TMPDIR/work"
    cd "$BATS_TEST_TMPDIR/work"
    wobble=$BATS_FILE_TMPDIR/wobble
}

teardown() { rm -rf "$user"; }

# What is compiled only to be loaded need not be fast.
hurry() { export CFLAGS=-O0; }

# fails STATUS TEXT COMMAND...: that status, and a complaint in the last line that holds the text.
fails() {
    local status=$1 text=$2
    shift 2
    run "-$status" --separate-stderr "$@"
    # shellcheck disable=SC2154 # set by run
    echo "$stderr"
    [[ ${stderr_lines[-1]} == "impinge: "*"$text"* ]]
}

# has_verb NAME
has_verb() { impinge help "$1" >/dev/null 2>&1; }

# Runs each line of standard input in this shell, up to the first that fails.
run_commands() {
    local command
    while read -r command; do
        if [[ $command == "impinge check "* ]] && ! has_verb check; then continue; fi
        echo "\$ $command"
        eval "$command" </dev/null || return
    done
}

# --- impinge new --------------------------------------------------------------------------------

# new_project NAME ARG...: makes it and runs the commands printed; $log holds what they said.
new_project() {
    run -0 impinge new "$@"
    grep '^  ' <<<"$output" >commands
    [ "$(wc -l <commands)" -eq 4 ]
    log=$PWD/log
    run_commands <commands >"$log" 2>&1 || { cat "$log"; false; }
}

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

# --- impinge build ------------------------------------------------------------------------------

examples=share/doc/impinge/sdk/examples

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

# --- The guide ----------------------------------------------------------------------------------

# Files and commands of the guide, in its order: "file NAME", "command TEXT", or "line TEXT".
parts_of_guide() {
    awk '/^File [^ ]+:$/ { print "file " substr($2, 1, length($2) - 1); inside = 1; next }
         /^    \$ / { print "command " substr($0, 7); inside = 0; next }
         /^[^ ]/ { inside = 0 }
         inside { print "line " substr($0, 5) }' "$prefix/share/doc/impinge/sdk/README"
}

@test "every file and every command of the guide works as it stands, in its order" {
    local kind text file
    parts_of_guide >parts
    [ "$(grep -c '^file ' parts)" -ge 3 ]
    [ "$(grep -c '^command ' parts)" -ge 10 ]
    while IFS= read -r line; do
        kind=${line%% *} text=${line#* }
        case $kind in
        file) file=$text ;;
        line) printf '%s\n' "$text" >>"$file" ;;
        command) run_commands <<<"$text" ;;
        esac
    done <parts
    impinge list --json | jq -e '.refused == []'
}

@test "the guide names every operation of the model headers" {
    local name guide
    guide=$(<"$prefix/share/doc/impinge/sdk/README")
    for name in $(sed -nE 's/^static inline (imp_model|void) imp_([a-z0-9_]*[a-z0-9])\(.*/\2/p' \
        "$prefix"/include/impinge/model*.h | sort -u); do
        case $name in param | between | unbounded | model_*) continue ;; esac
        grep -qwE "(imp_)?$name" <<<"$guide" || { echo "no $name"; false; }
    done
}

@test "impinge-sdk.pc keeps a * b + c as written, and check notes where it is contracted" {
    { [ "$(uname -m)" = x86_64 ] && grep -qw fma /proc/cpuinfo; } || skip 'needs fused operations'
    local source=$prefix/share/doc/impinge/sdk/examples/seashell.c
    # shellcheck disable=SC2046 # flags are words
    $CC -shared -fPIC -O2 -mfma -o seashell.so "$source" $(pkg-config --cflags --libs impinge-sdk)
    run -0 impinge check seashell --plugin-path . --only build
    $CC -shared -fPIC -O2 -mfma -o seashell.so "$source" -I"$prefix/include" -lm
    run -0 impinge check ./seashell.so --only build
    [[ $output == *'note  build        compiled so that a * b + c is rounded once'*'add -ffp-contract=off'* ]]
}

# --- The ABI ------------------------------------------------------------------------------------

# layout FOLDER_OF_HEADERS
layout() {
    $CC -std=c11 -I"$1" -o layout "$top_srcdir/tests/abi/layout.c" && ./layout
}

# Is what layout printed, on standard input, an ABI that plugins of 1.0 can live with? Prints what
# they would stumble over.
compare_layout() {
    awk 'NR == FNR { now[$0] = 1; if ($1 == "size") size[$2] = $3; next }
         $0 in now { next }
         $1 == "size" && $4 == "may" && size[$2] > $3 { next }
         { print }' - "$top_srcdir/tests/abi/layout_1.txt"
}

@test "sizes, offsets, callbacks and numbers of the ABI are those of version 1.0" {
    layout "$prefix/include" >now
    run -0 compare_layout <now
    [ -z "$output" ]
}

@test "the table of the ABI leaves no byte of a struct out" {
    awk '$1 == "size" { if (end != size) { print of " ends at " end; bad = 1 }
                        of = $2; size = $3; end = $4 == "fixed" && $3 == 4 ? 4 : 0 }
         $1 == "field" { if ($4 != end) { print $2 " does not begin at " end; bad = 1 }
                         end = $4 + $6 }
         END { exit bad || end != size }' "$top_srcdir/tests/abi/layout_1.txt"
}

# changed SED_SCRIPT LINE...: with the ABI header edited so, the comparison prints these lines.
changed() {
    mkdir -p impinge
    sed -e "$1" -e '/^IMP_LAYOUT(/{:a;/;$/!{N;ba};d}' "$prefix/include/impinge/surface.h" \
        >impinge/surface.h
    shift
    layout . >now
    run -0 compare_layout <now
    echo "$output"
    [ "$output" = "$(printf '%s\n' "$@")" ]
}

@test "a field that moves, a callback that changes and a new number are found; growth is not" {
    changed '/const char \*equation;/{h;d};/const char \*source;/{G}' \
        field\ imp_{surface,map}_type.{'equation at 32','source at 40'}' of 8'
    changed 's/(\*eval)(const void \*self, size_t n/(*eval)(const void *self, uint32_t n/' \
        "$(grep '^call .*\.eval ' "$top_srcdir/tests/abi/layout_1.txt")"
    changed 's/IMP_STATUS_DOMAIN = 1/IMP_STATUS_DOMAIN = 5/' 'number IMP_STATUS_DOMAIN 1'
    changed 's/^} imp_region;/double more; &/' 'size imp_region 96 fixed'
    changed 's/^} imp_surface_type;/void (*more)(void); &/' ''
}

on_x86_64() { [ "$(uname -m)" = x86_64 ] || skip 'the fixture is for x86-64'; }

@test "a plugin built by the first release is loaded, listed and paired" {
    on_x86_64
    run -0 impinge list --plugin-path "$top_srcdir/tests/abi" --json
    jq -e '[.types[] | select(.file | endswith("fixture_1_0.so")) | .name] | sort == ["fixture_bare",
        "fixture_kinds", "fixture_lean", "fixture_rise", "fixture_sheet"]' <<<"$output"
    run -0 impinge pair 'fixture_sheet ! fixture_lean' 'fixture_bare ! fixture_rise' --gamma 1e-4 \
        --plugin-path "$top_srcdir/tests/abi"
    [[ $output == 'contact at t = 0'$'\n'* ]]
    # t (1 - u v) = 0.75 t / (1 + u^2 + v^2) + u v + 2 - 2 t, first at u = 1, v = 0: t = 2/2.625.
    run -0 impinge pair fixture_bare 'fixture_sheet ! translate offset=[[0,0,2],[0,0,-2]]' \
        --plugin-path "$top_srcdir/tests/abi" --json
    jq -e '.verdict == "contact" and .t > 0.761904 and .t < 0.761905' <<<"$output"
}

@test "its types answer as they did then, to the last digit" {
    on_x86_64
    $CC -o ask_fixture "$top_srcdir/tests/abi/ask_fixture.c" $(pkg-config --cflags --libs impinge) \
        -Wl,-rpath,"$prefix/lib" -ldl
    ./ask_fixture "$top_srcdir/tests/abi" >answers
    diff "$top_srcdir/tests/abi/fixture_1_0.txt" answers
}

# --- The interface of libimpinge ----------------------------------------------------------------

with_abidiff() {
    command -v abidiff >/dev/null || skip 'abidiff (abigail-tools) not found'
    readelf -S "$top_builddir/.libs/libimpinge.so" | grep -q debug_info ||
        skip 'libimpinge was built without debug information'
}

@test "programs built against the kept libimpinge can use this one" {
    with_abidiff
    "$top_srcdir/tests/abi/libimpinge" compare "$top_builddir"
}

@test "a function that is gone from libimpinge is found" {
    with_abidiff
    mkdir tests
    cp -R "$top_srcdir/tests/abi" tests
    ln -s "$top_srcdir/core" "$top_srcdir/sdk" .
    chmod -R u+w tests
    sed -i 's/imp_query_step/imp_forgotten/' tests/abi/libimpinge_0.abi
    run ! tests/abi/libimpinge compare "$top_builddir"
    [[ $output == *imp_forgotten* ]]
}

@test "types in C++ are proved by their formulas, and no exception leaves a callback" {
    local file
    for file in waves puddle; do impinge build "$prefix/$examples/$file.cc" >/dev/null; done
    export IMPINGE_PLUGIN_PATH=$PWD
    run -0 impinge check waves --only proof --effort 0.1 --formula 'u; v; height*sin(waves*(u+v/2)-speed*t)'
    [[ $output == *'  proved('* ]]
    fails 4 'size: must be below 1e100' impinge pair 'puddle size=1e101' sphere
    run -0 impinge check puddle
    for std in 17 20; do
        g++ -std=c++$std -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" "$prefix/$examples/puddle.cc"
    done
    g++ -std=c++17 -fno-exceptions -Wall -Wextra -Werror -fsyntax-only -I"$prefix/include" "$prefix/$examples/waves.cc"
}

@test "C++ before C++17 is told so, once" {
    echo '#include <impinge/formula.h>' >old.cc
    run ! g++ -std=c++14 -fsyntax-only -I"$top_srcdir/sdk" old.cc
    [[ $output == *"need C++17: compile with -std=c++17"* ]]
    [ "$(grep -c 'error: #error' <<<"$output")" -eq 1 ]
    [ "${#lines[@]}" -lt 16 ]
    g++ -std=c++17 -fsyntax-only -I"$top_srcdir/sdk" old.cc
}

@test "newer headers build for an older host where the plugin asks for that" {
    hurry
    mkdir headers
    cp -r "$prefix/include/impinge" headers/
    sed -i 's/^#define IMP_ABI_MINOR 0/#define IMP_ABI_MINOR 1/' headers/impinge/surface.h
    cp "$prefix/share/doc/impinge/sdk/examples/seashell.c" .
    newer() { cc -shared -fPIC -O0 -ffp-contract=off -Iheaders "$@" -o seashell.so seashell.c -lm; }
    newer
    run ! impinge why ./seashell.so
    [[ $output == *"abi_minor is 1, the host's is 0"*"-DIMP_ABI_MINOR_TARGET=0"* ]]
    newer -DIMP_ABI_MINOR_TARGET=0
    impinge info seashell --plugin-path .
    run ! newer -DIMP_ABI_MINOR_TARGET=2
    [[ $output == *"beyond what these headers know"* ]]
}

# --- Other builds -------------------------------------------------------------------------------

# The commands for the machines of GitHub or GitLab that check the plugin: as in the project.
ci_check() { grep -o 'impinge check .* --require proved --badge badge.json' "$1"; }

@test "a project in C++ for CMake builds, is checked, installed and proved as its CI demands" {
    command -v cmake >/dev/null || skip 'no cmake'
    new_project drumhead --cxx --cmake
    grep -q '100% tests passed' "$log"
    grep -q '^contact at t = 0\.862' "$log"
    [ "$(ls "$user")" = drumhead.so ]
    [ "$(nm -D --defined-only "$user/drumhead.so" | awk '{ print $3 }')" = impinge_plugin ]
    run -0 bash -c "$(ci_check .github/workflows/check.yml) --effort 0.1"
    jq -e '.message == "proved" and .version == "0.1"' badge.json
    cmp <(ci_check .github/workflows/check.yml) <(ci_check .gitlab-ci.yml)
}

@test "find_package(ImpingeSDK) takes versions that fit, and installs below a prefix" {
    command -v cmake >/dev/null || skip 'no cmake'
    run -0 impinge new sway --map --cmake
    cd sway
    hurry
    cmake -S . -B build -DCMAKE_INSTALL_PREFIX="$PWD/there" >/dev/null
    cmake --build build >/dev/null
    cmake --install build >/dev/null
    [ "$(cd there && find . ! -type d)" = ./lib/impinge/1/sway.so ]
    sed -i 's/find_package(ImpingeSDK /&0.1 /' CMakeLists.txt
    cmake -S . -B build >/dev/null
    sed -i 's/find_package(ImpingeSDK 0.1/find_package(ImpingeSDK 7/' CMakeLists.txt
    run ! cmake -S . -B build
}

@test "a project for Meson builds, is checked and installed" {
    command -v meson >/dev/null || skip 'no meson'
    new_project sway --map --meson
    grep -q '^contact at t = 0\.7' "$log"
    [ "$(ls "$user")" = sway.so ]
}

@test "a project in C++ for autotools builds, and new refuses what does not go together" {
    new_project drumhead --cxx
    grep -q '^# PASS:  1' "$log"
    fails 2 'exclude each other' impinge new a --cmake --meson
    fails 2 'which are written in C' impinge new a --map --cxx
    [ ! -e a ]
}

# --- While it is written ------------------------------------------------------------------------

@test "watch builds, checks and solves again when the file is saved, and says what changed" {
    hurry
    local k
    run -0 impinge new drum folder
    cp folder/drum.c .
    echo '{"gamma": 1e-2, "bodies": [{"surfaces": [{"type": "drum"}]},
        {"surfaces": [{"type": "sphere", "radius": 0.5, "center": [0,0,2]}],
         "maps": [{"type": "translate", "velocity": [0,0,-2]}]}]}' >scene.json
    impinge watch drum.c scene.json --rounds 2 >log 2>&1 &
    for ((k = 0; k < 600; ++k)); do
        grep -q '^  answer ' log && break
        sleep 0.05
    done
    sed -i 's/, free),/&\n    .include = NULL,/' drum.c
    wait $!
    cat log
    grep -q '^  check    passed' log
    grep -q '^  answer   contact at t = 0\.8.*; before: .*pairs (+' log
    fails 4 'nowhere/: No such file' impinge watch nowhere/a.c scene.json
    fails 2 'a source file is wanted' impinge watch a.txt scene.json
}

@test "the guide is a page, too, with every section and every line of code" {
    local page=$prefix/share/doc/impinge/sdk/guide.html
    [ "$(grep -c '<h2 ' "$page")" -eq "$(grep -cxE -- '-{3,}' "${page%/*}/README")" ]
    [ "$(sed -n '/<pre>/,/<\/pre>/p' "$page" | grep -c IMPINGE_SURFACE_PLUGIN)" -eq \
        "$(grep -c '^    .*IMPINGE_SURFACE_PLUGIN' "${page%/*}/README")" ]
    [ "$(grep -o '<pre>' "$page" | wc -l)" -eq "$(grep -c '</pre>' "$page")" ]
}

# --- Other languages ----------------------------------------------------------------------------

@test "the page of the layout tells what this build has, and the smallest sizes that hosts take" {
    local page=$prefix/share/doc/impinge/sdk/layout.txt line
    cc -o layout -I"$prefix/include" "$top_srcdir/tests/abi/layout.c"
    ./layout >now
    sed -n '/^number IMP_ABI_MAJOR/,$p' "$page" >told
    [ "$(wc -l <told)" -gt 150 ]
    while read -r line; do
        # What may grow is at least as large as when it was frozen.
        [[ $line == *"may grow" ]] || grep -qxF "$line" now || { echo "no: $line"; false; }
    done <told
    [ "$(tr '\n' ' ' <"$page" | grep -oE 'imp_surface_type [0-9]+ bytes' | grep -oE '[0-9]+')" -eq \
        "$(awk '$2 == "imp_surface_type.piece_count" && $1 == "field" { print $4 }' now)" ]
    [ "$(tr '\n' ' ' <"$page" | grep -oE 'imp_map_type [0-9]+ \(up' | grep -oE '[0-9]+')" -eq \
        "$(awk '$2 == "imp_map_type.rigid" && $1 == "field" { print $4 }' now)" ]
}

@test "the linkable operations are the inline ones, to the last bit, and none is missing" {
    local name
    hurry
    for name in $(sed -nE 's/^static inline (imp_model|void) imp_([a-z0-9_]*[a-z0-9])\(.*/\2/p' \
        "$prefix"/include/impinge/model*.h | sort -u); do
        case $name in model_zero | model_collapse | model_within | model_box | series_* | compose | \
            point_within) continue ;; esac
        grep -q "impinge_$name(" "$prefix/include/impinge/model_link.h" || { echo "no $name"; false; }
    done
    cat >same.c <<'END'
#include <impinge/model_link.h>
#include <stdio.h>
#include <string.h>
static int wrong;
#define SAME(NAME, ...) do { imp_model x = imp_##NAME(__VA_ARGS__), y = impinge_##NAME(__VA_ARGS__); \
    if (memcmp(&x, &y, sizeof x) != 0) wrong = 1, puts(#NAME); } while (0)
int main(void)
{
    imp_region r = imp_region_between((double[3]){0.2, 0.3, 0.1}, (double[3]){0.5, 0.4, 0.7});
    imp_model u = imp_param(&r, 0), v = imp_param(&r, 1), t = imp_param(&r, 2);
    SAME(add, u, v); SAME(sub, u, t); SAME(mul, u, v); SAME(div, u, v); SAME(sqr, t); SAME(sqrt, t);
    SAME(exp, u); SAME(log, u); SAME(sin, t); SAME(cos, t); SAME(tan, t); SAME(asin, u); SAME(acos, u);
    SAME(atan, t); SAME(atan2, u, v); SAME(sinh, u); SAME(cosh, u); SAME(tanh, u); SAME(pow, u, 1.5);
    SAME(powi, u, 3); SAME(min, u, v); SAME(max, u, t); SAME(lerp, u, v, t); SAME(scale, u, 3);
    return wrong;
}
END
    # shellcheck disable=SC2046 # flags are several words
    cc -O2 same.c -o same $(pkg-config --cflags impinge-sdk) -L"$prefix/lib" -limpinge-model -lm
    ./same
}

@test "the gear of two classes in C++ answers as the gear in C does" {
    g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I"$prefix/include" \
        "$prefix/$examples/gear_pieces.cc"
    impinge build "$prefix/$examples/gear_pieces.cc"
    impinge build "$prefix/$examples/gear.c"
    impinge check ./gear_pieces.so --effort 0.05 --require tested
    answer() {
        impinge pair "$1 teeth=20 roll=0.5 ! rotate rate=1" --plugin-path . --json \
            'sphere radius=0.2 center=2,0,0 ! translate velocity=-1,0,0' |
            jq -c '[.verdict, .t, .a.piece]'
    }
    [ "$(answer gear-pieces)" = "$(answer involute-flanks)" ]
    [[ $(answer gear-pieces) == '["contact",'* ]]
    run -4 impinge pair 'gear-pieces roll=2' sphere --plugin-path .
    [[ $output == *"roll: the flanks of a tooth meet before that"* ]]
}

@test "the gear in Rust answers as the gear in C does, to the last bit" {
    rustc --version >/dev/null 2>&1 || skip 'no rustc'
    local crate=$prefix/share/doc/impinge/sdk/gear-rs
    rustc --edition 2021 --crate-type cdylib -C opt-level=1 -C panic=abort -L "$prefix/lib" \
        -o gear_rs.so "$crate/src/lib.rs"
    impinge build "$prefix/$examples/gear.c"
    impinge check ./gear_rs.so --effort 0.05 --require tested
    answer() {
        impinge pair "$1 teeth=20 roll=0.5 ! rotate rate=1" --plugin-path . --json \
            'sphere radius=0.2 center=2,0,0 ! translate velocity=-1,0,0' |
            jq -c 'del(.scene, .stats.seconds, .stats.bytes)'
    }
    [ "$(answer gear-rs)" = "$(answer involute-flanks)" ]
    [ "$(answer gear-rs | jq -r .verdict)" = contact ]
    run -4 impinge pair 'gear-rs roll=2' sphere --plugin-path .
    [[ $output == *"the flanks of a tooth meet before that"* ]]
}
