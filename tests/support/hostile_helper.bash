# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# A plugin that does its worst in each phase of its life: isolated, it costs at most the answer;
# otherwise it is named, and nothing is taken for an answer that is none.

load ../support/cli_helper

setup() {
    cd "$BATS_TEST_TMPDIR" || return
    mkdir plugins
    # shellcheck disable=SC2154 # top_builddir comes from the environment
    cp "$top_builddir/tests/plugins/.libs/hostile.so" plugins
    export XDG_CACHE_HOME=$PWD/cache
    here=$PWD
    surroundings=()
}

# Any slab meets it at t = 0.9.
ball='sphere radius=.5 center=.3,.2,1.4'

# Those that are called for a surface, and for a map on an innocent one. rate: by the 1990 method.
surface='create domain eval rate include destroy'
map='create time_domain eval rate apply destroy'
square='plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0'
lifted="$square ! hostile-map"

usual_ball=$ball

# Those that a type need not offer, as TYPE:PHASE; and of such a type the two operands.
offered='hostile-net:net hostile-distance:distance hostile-pieces:piece_count hostile-pieces:piece hostile-rigid:rigid hostile-symmetry:symmetry'
operands_of() {
    OPERAND=$1 ball=$usual_ball
    [ "$1" != hostile-rigid ] || OPERAND="$square ! hostile-rigid"
    # No distance is asked for unless the other is much the same for long: here it is nearly flat.
    [[ $1 != hostile-distance && $1 != hostile-symmetry ]] || ball='sphere radius=9 center=.3,.2,9.9'
    # No symmetry is asked for unless the type turns.
    [ "$1" != hostile-symmetry ] || OPERAND='hostile-symmetry ! rotate axis=0,0,1 rate=1'
    # No net is asked for unless the other has one too, and bends.
    [ "$1" != hostile-net ] || ball='bezier degree=2,1 points=[[-1,-1,1.4],[-1,1,1.4],[0,-1,.6],[0,1,.6],[1,-1,1.4],[1,1,1.4]]'
}

# hostile PHASE SIN [OPTION]...: the pair of the plugin's surface, or with OPERAND another, and the
# ball; it is loaded in its right mind once, so that what happens while it is loaded happens in the
# host.
hostile() {
    local method=models
    [ "$1" != rate ] || method=paper
    [ -d "$here/cache" ] || "$IMPINGE" list --plugin-path "$here/plugins" >/dev/null
    : >"$here/confessions"
    HOSTILE="$1 $2" HOSTILE_CONFESSIONS=$here/confessions timeout 60 env --default-signal=QUIT,TERM "${surroundings[@]}" "$IMPINGE" pair "${OPERAND-hostile}" \
        "$ball" --method $method --gamma 0.1 --plugin-path "$here/plugins" --json "${@:3}"
}

# committed PHASE SIN: that was not only asked for, the scene has called the callback.
committed() { grep -qx "$1 $2" "$here/confessions"; }

# contact COMMAND...: the answer is one line that says so.
contact() {
    run -0 --separate-stderr "$@"
    echo "$*: $output / $stderr"
    [ "${#lines[@]}" -eq 1 ]
    json '.verdict == "contact"'
    [ "$1" != hostile ] || committed "$2" "$3"
}

# blamed PHASE TYPE WHAT TEXT: names the phase and the type, and says what they did.
blamed() {
    [[ $4 == *": $1 of '$2' ($PWD/plugins/hostile.so) $3"* || $4 == *": $3"*" ($1 of '$2')" ||
        ($1 == destroy && $4 == *"/hostile.so: destroy of '$2' $3"*) ]]
}
