#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The command line itself: verbs, options, values, help, and what becomes of output.

load ../support/cli_helper

# --- Verbs ------------------------------------------------------------------------------------

@test "without a verb the command says how to go on" {
    fails 2 'which verb?' "$IMPINGE"
}

@test "an unknown verb is answered with the nearest" {
    fails 2 "unknown verb 'slove', did you mean 'solve'?" "$IMPINGE" slove x
}

@test "a verb that is near to none is answered with the way to all" {
    fails 2 'impinge help' "$IMPINGE" frobnicate
}

@test "too few operands are answered with the usage" {
    fails 2 'usage: impinge pair A B' "$IMPINGE" pair sphere
}

@test "too many operands are answered with the first that is too much" {
    fails 2 "unexpected argument 'radius=1'" "$IMPINGE" pair sphere sphere radius=1
}

@test "control characters in names do not reach the terminal" {
    fails 2 "'a\\x1b[2Jb\\nc'" "$IMPINGE" $'a\e[2Jb\nc'
}

# --- Options ----------------------------------------------------------------------------------

@test "options stand before the verb as well as behind it" {
    run -0 "$IMPINGE" --gamma 1e-3 --json pair "$left" "$right"
    json '.gamma == 1e-3'
    run -0 "$IMPINGE" pair "$left" --gamma 1e-3 "$right" --json
    json '.gamma == 1e-3'
}

@test "a value may stand behind an equals sign" {
    run -0 "$IMPINGE" pair --gamma=1e-3 "$left" "$right" --json
    json '.gamma == 1e-3'
}

@test "of an option given twice the last counts" {
    run -0 "$IMPINGE" pair --gamma 1e-3 "$left" "$right" --json --gamma 1e-2
    json '.gamma == 1e-2'
}

@test "a negative number is a value, not an option" {
    run -0 "$IMPINGE" pair sphere 'sphere center=9,0,0' --time -1,-0.5 --json
    json '.t_lower == -0.5'
}

@test "two dashes end the options" {
    fails 2 "unknown verb '--json'" "$IMPINGE" -- --json
    fails 4 '--json: cannot be read' "$IMPINGE" solve -- --json
}

@test "an unknown option is answered with the nearest the verb has" {
    fails 2 "unknown option '--gama', did you mean '--gamma'?" "$IMPINGE" pair --gama 1 a b
    fails 2 "unknown option '--refuse', did you mean '--refused'?" "$IMPINGE" list --refuse
}

@test "an unknown option before the verb is not taken for the verb's fault" {
    fails 2 "unknown option '--gama', did you mean '--gamma'?" "$IMPINGE" --gama 1 pair a b
}

@test "an option of another verb is refused as such" {
    fails 2 'this verb takes no --gamma' "$IMPINGE" list --gamma 1
}

@test "an option with one dash is refused" {
    fails 2 "unknown option '-gamma'" "$IMPINGE" pair -gamma 1 a b
}

@test "an option without its value is told what it needs" {
    fails 2 '--gamma needs a value: --gamma LENGTH' "$IMPINGE" pair a b --gamma
}

@test "a flag with a value is refused" {
    fails 2 "--json takes no value, but 'yes' is given" "$IMPINGE" list --json=yes
}

# --- Values -----------------------------------------------------------------------------------

@test "gamma is a finite number greater than zero" {
    local value
    for value in 0 -1 nan inf 1e999 1x x '' ' 1' 1,2; do
        fails 2 "--gamma must be a finite number greater than 0, not '$value'" \
            "$IMPINGE" pair a b --gamma "$value"
    done
}

@test "what is called gamma_clear now is named where its former name is written" {
    fails 2 "unknown option '--clearance', did you mean '--gamma-clear'?" \
        "$IMPINGE" pair a b --clearance 1e-3
    echo '{"clearance": 1e-7, "bodies": [{"name": "a", "surfaces": [{"type": "sphere"}]}]}' >old.json
    fails 4 "/clearance: unknown key, did you mean 'gamma_clear'?" "$IMPINGE" solve old.json
}

@test "gamma_clear is at least zero and below gamma" {
    fails 2 "--gamma-clear must be a finite number of at least 0, not '-1'" \
        "$IMPINGE" pair a b --gamma-clear -1
    fails 2 '--gamma-clear 2e-3 must be less than --gamma 1e-3' \
        "$IMPINGE" pair a b --gamma-clear 2e-3 --gamma 1e-3
    fails 2 'gamma_clear' "$IMPINGE" pair "$left" "$right" --gamma-clear 1
    run -0 "$IMPINGE" pair sphere 'sphere center=9,0,0' --gamma-clear 0 --json
    json '.gamma_clear == 0'
}

@test "the time is two finite numbers" {
    local value
    for value in 1 0, ,1 0,1,2 nan,1 0,inf '0, 1' x; do
        fails 2 "--time must be two finite numbers, START,END" "$IMPINGE" pair a b --time "$value"
    done
}

@test "an empty interval is refused and a single instant is not" {
    fails 2 '--time 1,0 is an empty interval' "$IMPINGE" pair a b --time 1,0
    run -0 "$IMPINGE" pair sphere 'sphere center=9,0,0' --time 1,1
}

@test "counts are whole, not negative, and fit" {
    local value
    for value in -1 1.5 1KB K 0x10 99999999999999999999 20000000000000000000G ''; do
        fails 2 "--max-pairs must be a whole number below 2^64" \
            "$IMPINGE" pair a b --max-pairs "$value"
        fails 2 "--max-bytes must be a whole number below 2^64" \
            "$IMPINGE" pair a b --max-bytes "$value"
    done
}

@test "seconds are finite and not negative" {
    fails 2 '--max-seconds must be a finite number of at least 0' \
        "$IMPINGE" pair a b --max-seconds -1
}

@test "a wrong choice is answered with all and the nearest" {
    fails 2 "--method must be one of models, paper, not 'papre'; did you mean 'paper'?" \
        "$IMPINGE" pair a b --method papre
    fails 2 '--bounds must be one of box, sphere' "$IMPINGE" pair a b --bounds cone
    fails 2 '--rates must be one of full, column, constant' "$IMPINGE" pair a b --rates ''
}

@test "options of the paper's method are refused without it" {
    fails 2 '--bounds belongs to --method paper' "$IMPINGE" pair a b --bounds box
    fails 2 '--rates belongs to --method paper' "$IMPINGE" pair a b --rates full --method models
}

# --- Help -------------------------------------------------------------------------------------

verbs() { "$IMPINGE" help | sed -n 's/^  \([a-z]*\) .*/\1/p'; }

@test "help shows every verb, and the version is the package's" {
    run -0 "$IMPINGE" help
    [[ $output == *"pair A B"*"Find the earliest contact of two surfaces"* ]]
    [ "$(verbs | wc -l)" -ge 7 ]
    [ "$output" = "$("$IMPINGE" --help)" ]
    [ "$output" = "$("$IMPINGE" -h)" ]
    run -0 "$IMPINGE" --version --json
    valid version
    json '.abi.major == 1 and ([.abi.capabilities[].name] | contains(["core", "net", "rigid"]))'
    json '.abi.capabilities[] | select(.name == "rigid") | .kinds == ["map"]'
    run -0 "$IMPINGE" --version
    [[ $output =~ ^impinge\ [0-9]+\.[0-9]+\.[0-9]+\ \(libimpinge\  ]]
    [ "$output" = "$("$IMPINGE" pair -V)" ]
}

@test "help of a verb is the same asked in either way" {
    local verb
    for verb in $(verbs); do
        run -0 "$IMPINGE" help "$verb"
        [[ $output == "usage: impinge $verb "*"Options:"*"Example:"* ]]
        [ "$output" = "$("$IMPINGE" "$verb" --help)" ]
        [ "$output" = "$("$IMPINGE" --help "$verb")" ]
    done
}

@test "help of an unknown verb names the nearest" {
    fails 2 "help: unknown verb 'pare', did you mean 'pair'?" "$IMPINGE" help pare
}

@test "the example in the help of every verb works as it stands" {
    local verb example
    impinge() { "$IMPINGE" "$@"; }
    for verb in $(verbs); do
        example=$("$IMPINGE" help "$verb" | sed '1,/^Example:/d')
        run -0 eval "$example"
        [ -n "$output" ]
    done
}

@test "the manual page tells of every verb and every option" {
    local page=$top_srcdir/tools/impinge.1 verb word
    for verb in $(verbs); do
        grep -q "^\.B. *\"*impinge $verb\|^\.B impinge $verb" "$page"
        for word in $("$IMPINGE" help "$verb" | sed -n 's/^  \(--[a-z-]*\) .*/\1/p'); do
            grep -qF -- "${word//-/\\-}" "$page" || { echo "no $word"; return 1; }
        done
    done
}

@test "the manual page tells of no option there is not" {
    local word known
    known=$(for verb in $(verbs); do "$IMPINGE" help "$verb"; done)
    for word in $(sed 's/\\-/-/g' "$top_srcdir/tools/impinge.1" | grep -oE -- '--[a-z][a-z-]+' | sort -u)
    do
        [[ $known == *"  $word "* ]] || { echo "$word"; return 1; }
    done
}

# --- Output -----------------------------------------------------------------------------------

@test "a closed standard output is an error" {
    run -4 --separate-stderr bash -c '"$IMPINGE" list >&-'
    [[ $stderr == 'impinge: list: standard output: '* ]]
}

@test "a full disk is an error" {
    [ -c /dev/full ] || skip 'no /dev/full'
    run -4 --separate-stderr bash -c '"$IMPINGE" help >/dev/full'
    [[ $stderr == 'impinge: help: standard output: '* ]]
    local line
    for line in 'list --json' 'matrix --json --max-pairs 1' demo; do
        run -4 --separate-stderr bash -c "\"\$IMPINGE\" $line >/dev/full"
        [ "$stderr" = "impinge: ${line%% *}: standard output: No space left on device" ]
    done
}

@test "a pipe whose reader has left ends the command quietly, not by a signal" {
    run -0 --separate-stderr bash -c '"$IMPINGE" list | true; echo "${PIPESTATUS[0]}"'
    [ "$output" = 4 ] || [ "$output" = 0 ]
    [ -z "$stderr" ]
    run -0 --separate-stderr bash -c '(sleep 0.2; exec "$IMPINGE" help) | true; echo "${PIPESTATUS[0]}"'
    [ "$output" = 4 ]
    [ -z "$stderr" ]
}

@test "a signal while a slow reader blocks the pipe cuts no line" {
    "$top_builddir"/tests/support/crowd_scene 60 1 >crowd.json
    mkfifo pipe
    env --default-signal=TERM "$IMPINGE" solve crowd.json --each --json >pipe &
    local pid=$! status=0
    exec {slow}<pipe
    until [[ $(<"/proc/$pid/wchan") == *pipe_write ]]; do
        kill -0 "$pid"
        sleep 0.1
    done
    kill -TERM "$pid"
    jq -es '(map(select(.not_listed == null)) | length) + (.[-1].not_listed // {} | add // 0)
        == 60 * 59 / 2' <&"$slow"
    wait "$pid" || status=$?
    [ "$status" -eq 0 ]
}

@test "a long search shows on a terminal how far it came, and nowhere else" {
    needs_terminal
    run --separate-stderr "$IMPINGE" pair "${endless[@]}" --max-seconds 1.3
    [ -z "$stderr" ]
    export IMPINGE near
    run script -qec '"$IMPINGE" pair superellipsoid "$near" --gamma 1e-9 --max-bytes 0 --max-seconds 1.8' /dev/null
    [[ $output == *' pairs, '*' wait, clear until t = 0'*$'\e[K'* ]]
}

@test "help fits 80 columns, or those of COLUMNS, and tells a verb's own limits" {
    local verb
    for verb in $("$IMPINGE" help | sed -n 's/^  \([a-z]*\) .*/\1/p'); do
        "$IMPINGE" help "$verb" | sed -n '/^Options:/,/^Example:/p' >options
        [ "$(wc -L <options)" -le 80 ]
    done
    COLUMNS=120 "$IMPINGE" help pair | grep -q -- '--max-bytes N .*no limit (1G)$'
    "$IMPINGE" help matrix | tr -s ' \n' ' ' | grep -q 'no limit (10000)'
}
