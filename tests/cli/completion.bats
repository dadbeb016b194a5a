#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What shells offer at the end of a command line, and topics of help.

load ../support/cli_helper

setup_file() {
    mkdir "$BATS_FILE_TMPDIR/bin"
    printf '#!/bin/sh\nexec "%s" "$@"\n' "$IMPINGE" >"$BATS_FILE_TMPDIR/bin/impinge"
    chmod +x "$BATS_FILE_TMPDIR/bin/impinge"
    export PATH=$BATS_FILE_TMPDIR/bin:$PATH
    export IMPINGE_PLUGIN_PATH=$top_builddir/plugins/.libs
}

# offers LINE WORD...: at the end of the line all these words are offered, in full.
offers() {
    run -0 --separate-stderr impinge complete "$1"
    shift
    local word
    for word; do
        cut -f1 <<<"$output" | grep -qxF -- "$word" || { printf 'no %s in\n%s\n' "$word" "$output"; false; }
    done
}

# offers_no LINE WORD...: none of these.
offers_no() {
    run -0 --separate-stderr impinge complete "$1"
    shift
    local word
    for word; do run ! grep -qxF -- "$word" <<<"$(cut -f1 <<<"$output")"; done
}

@test "every verb, option and choice of the help is offered" {
    offers "impinge " $("$IMPINGE" help | sed -n "s/^  \([a-z]*\) .*/\1/p")
    offers_no 'impinge ' complete
    local verb
    for verb in pair clearance view bench new; do
        offers "impinge $verb --" $("$IMPINGE" help "$verb" | sed -n 's/^  \(--[a-z-]*\).*/\1/p')
    done
    offers 'impinge pair --method ' models paper
    offers 'impinge pair --method=p' --method=paper
    offers 'impinge --progress ' auto json none
    offers 'impinge bench ' figure7 bicubic
    offers 'impinge demo ' blade teapot
    offers 'impinge help ' solve scenes
}

@test "types are offered, and the parameters of a type, with quotes and without" {
    offers 'impinge pair ' torus sphere
    offers_no 'impinge pair ' rotate
    offers 'impinge pair torus ' major_radius= minor_radius= center= sphere
    offers "impinge pair 'torus " 'torus major_radius=' 'torus !'
    offers_no "impinge pair 'torus major_radius=1 " 'torus major_radius=1 major_radius='
    offers "impinge clearance sphere 'torus major_radius=1 ! " 'torus major_radius=1 ! rotate'
    offers_no "impinge clearance sphere 'torus major_radius=1 ! " 'torus major_radius=1 ! sphere'
    offers "impinge pair 'torus ! rotate a" 'torus ! rotate axis='
    offers 'impinge --gamma 1e-3 pair "sphere radius=2" to' torus
    offers 'impinge info ' torus rotate :files
    offers 'impinge check ' torus rotate :files
    offers "impinge check 'rotate " 'rotate axis='
    offers 'impinge pair --isolate t' torus translate
    # A plugin of the user's own.
    build_twin
    IMPINGE_PLUGIN_PATH=$PWD offers 'impinge pair tw' twin
}

@test "names of files are offered where files may stand, and no complaint ever" {
    offers 'impinge solve ' :files
    offers 'impinge clearance ' :files torus
    offers 'impinge view -o ' :files
    offers_no 'impinge list ' :files
    local line
    for line in '' impinge 'impinge pair' 'impinge nonsense ' "impinge pair 'no-type " 'impinge pair "' \
        'impinge pair \' 'impinge --nonsense ' "impinge pair '! ! " 'impinge pair = ' $'impinge\tpair\n'; do
        run -0 --separate-stderr impinge complete "$line"
        [ -z "$stderr" ]
    done
}

# completed LINE: what bash makes of it, by the function that the completion defines.
completed() {
    bash -c '. "$top_srcdir/tools/completion/impinge.bash"
        compopt() { :; }
        COMP_LINE=$1 COMP_POINT=${#1}
        shift
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
        _impinge impinge
        printf "%s\n" "${COMPREPLY[@]}"' completed "$@"
}

@test "bash completes a word, an option behind its sign, a pipeline in quotes, and files" {
    completed 'impinge pair torus ' impinge pair torus '' | grep -qx 'major_radius='
    [ "$(completed 'impinge cle' impinge cle)" = clearance ]
    [ "$(completed 'impinge pair --method=p' impinge pair --method = p)" = paper ]
    # Two answers, so that the quote stays open.
    [ "$(completed "impinge pair 'torus maj" impinge pair "'torus maj")" = \
        $'torus major_radius=\ntorus major_radius= ' ]
    touch scene.json
    [ "$(completed 'impinge solve sc' impinge solve sc)" = scene.json ]
}

@test "fish offers the parameters of a type" {
    command -v fish >/dev/null || skip 'no fish'
    export HOME=$PWD
    cat >ask.fish <<'END'
source $top_srcdir/tools/completion/impinge.fish
complete -C "impinge pair torus "
complete -C "impinge pair 'sphere ra"
END
    fish --no-config ask.fish >offered
    grep -q '^major_radius=' offered
    grep -q 'radius=' offered
}

@test "zsh reads its completion" {
    command -v zsh >/dev/null || skip 'no zsh'
    zsh -fn "$top_srcdir/tools/completion/_impinge"
    # The function itself, with stand-ins for what the completion system brings.
    run -0 zsh -fc 'compadd() { print -l -- $found; }
        words=(impinge pair torus "") CURRENT=4 PREFIX= QIPREFIX=
        f() { . "$top_srcdir/tools/completion/_impinge" }
        f'
    [[ $output == *major_radius=* ]]
}

@test "help tells of each topic, and the overview names it" {
    local topic
    for topic in pipelines scenes proof plugins completion; do
        run -0 impinge help
        [[ $output == *"Topics: "*"$topic"* ]]
        run -0 impinge help "$topic"
        [ "${#lines[@]}" -ge 5 ]
        [ "$(wc -L <<<"$output")" -le 100 ]
    done
    run -0 impinge help scenes
    sed -n '/^  { /,/\] }$/p' <<<"$output" >scene.json
    run -0 impinge solve scene.json --json
    json '.verdict == "contact"'
}
