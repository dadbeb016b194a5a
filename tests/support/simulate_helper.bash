# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the suites of impinge simulate share.

load ../support/cli_helper

floor='{"name": "floor", "surfaces": [{"type": "plane", "origin": [-9,-9,0], "edge_u": [18,0,0], "edge_v": [0,18,0]}]'

# ball NAME MASS "X,Y,Z" [KEYS]: a body, a sphere of radius 1/2.
ball() {
    echo "{\"name\": \"$1\", \"mass\": $2, ${4-} \"surfaces\": [{\"type\": \"sphere\", \"radius\": 0.5, \"center\": [$3]}]}"
}

# simulated SCENE [OPTION...]: runs it to the end into out.json; sets output to its JSON.
simulated() {
    run -0 "$IMPINGE" simulate "$@" -o out.json --json
    valid simulate
}

# out.json has gamma, and twice gamma, as its gamma_clear and gamma; gamma_clear was gamma / 2.
# never_nearer [WHOLE]: solve proves of out.json that no two bodies are nearer than 0.98 times
# gamma_clear: from event to event, or of all its time at once.
never_nearer() {
    local gamma clear window
    gamma=$(jq '.gamma_clear / 2' out.json)
    clear=$(jq '.gamma_clear * 0.49' out.json)
    jq -r --arg whole "${1-}" '([.time[0]] + (if $whole == "" then [.events[].t] | unique else [] end)
        + [.time[1]]) as $t | range(0; ($t | length) - 1) | "\($t[.]),\($t[. + 1])"' out.json >windows
    while read -r window; do
        run -0 "$IMPINGE" solve out.json --time "$window" --gamma "$gamma" --gamma-clear "$clear" \
            --max-pairs 1M
        echo "$window: $output"
        [ "${lines[0]}" = clear ]
    done <windows
}

# near A B: two jq expressions differ by at most 1e-5.
near() { json "[($1) - ($2)] | all(.[]; fabs <= 1e-5)"; }
