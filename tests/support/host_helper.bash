# shellcheck shell=bash
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
