# shellcheck shell=bash
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# What the suites of the command line share. IMPINGE, top_srcdir and top_builddir come from
# tests/local.mk.

bats_require_minimum_version 1.5.0

setup() { cd "$BATS_TEST_TMPDIR" || return; }

# Two balls of radius 1 that meet halfway, at t = 0.5, at the origin.
left='sphere radius=1 center=-2,0,0 ! translate velocity=2,0,0'
right='sphere radius=1 center=2,0,0 ! translate velocity=-2,0,0'

# A scene of the two: scene [KEYS], such as scene '"id": 7,'.
scene() {
    cat <<END | tr -d '\n'
{${1-} "bodies": [
{"name": "left", "surfaces": [{"type": "sphere", "center": [-2,0,0]}],
"maps": [{"type": "translate", "velocity": [2,0,0]}]},
{"name": "right", "surfaces": [{"type": "sphere", "center": [2,0,0]}],
"maps": [{"type": "translate", "velocity": [-2,0,0]}]}]}
END
    echo
}

# Whether the command is built with AddressSanitizer, which finds some faults before we do.
has_sanitizers() {
    # shellcheck disable=SC2154 # top_builddir comes from the environment
    nm -D "$top_builddir/.libs/libimpinge.so" | grep -q __asan_init
}

# For long searches, which take five times as long with sanitizers. Suites in C, or shorter tests of the same
# suite, run their code with sanitizers.
without_sanitizers() { ! has_sanitizers || skip 'a long search, whose code shorter tests run with sanitizers'; }

# scaled NUMBER: by IMPINGE_TEST_MULTIPLIER, as suites of Check scale how often they draw.
scaled() { awk -v n="$1" -v by="${IMPINGE_TEST_MULTIPLIER-1}" 'BEGIN { print n * by }'; }

# Tests of what a terminal shows need a pseudo-terminal, which chroots and containers may lack.
needs_terminal() {
    command -v script >/dev/null || skip 'no script (bsdutils)'
    script -qec true /dev/null >/dev/null 2>&1 || skip 'no pseudo-terminal here'
}

# fails STATUS TEXT COMMAND...: that status, nothing on standard output, and one line on standard
# error that begins with "impinge: " and holds the text.
fails() {
    local status=$1 text=$2
    shift 2
    run "-$status" --separate-stderr "$@"
    # shellcheck disable=SC2154 # set by run
    echo "$stderr"
    [ -z "$output" ]
    [[ ${#stderr_lines[@]} -eq 1 && $stderr == "impinge: "* && $stderr == *"$text"* ]]
}

# Waits until a process catches a signal and has then used half a second of processor time: it is at
# its search, however busy the machine is: at_work PID SIGNAL.
at_work() {
    local bit caught used limit=
    bit=$(($(kill -l "$2") - 1))
    while caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status") && [ -n "$caught" ]; do
        if (((16#$caught >> bit) & 1)); then
            used=$(awk '{ sub(/.*\) /, ""); print $12 + $13 }' "/proc/$1/stat") # in ticks
            : "${limit:=$((used + $(getconf CLK_TCK) / 2))}"
            [ "$used" -lt "$limit" ] || return 0
        fi
        sleep 0.05
    done
    return 1
}

# interrupted STATUS SIGNAL COMMAND...: the signal ends the command at its search, with that status.
# Sets output and stderr as run does.
interrupted() {
    local expected=$1 signal=$2 pid status=0
    shift 2
    env --default-signal="$signal" "$@" >interrupted.out 2>interrupted.err &
    pid=$!
    at_work "$pid" "$signal"
    kill -s "$signal" "$pid"
    wait "$pid" || status=$?
    output=$(<interrupted.out)
    stderr=$(<interrupted.err)
    echo "status $status: $output $stderr"
    [ "$status" -eq "$expected" ]
}

# jq 1.6 takes no result at all for true with -e, where 1.7 returns 4.
jq() {
    if ! [[ $1 =~ ^-[a-z]*e[a-z]*$ ]]; then
        command jq "$@"
        return
    fi
    local printed
    printed=$(command jq "$@") || { printf '%s\n' "$printed" && return 1; }
    [ -n "$printed" ] || return 4
    printf '%s\n' "$printed"
}

# json FILTER [ARG]...: jq -e over what the last run printed.
json() { jq -e "$@" <<<"$output"; }

# valid SCHEMA: each line of what the last run printed is as tools/schema/SCHEMA.schema.json says.
valid() {
    local faults
    faults=$(jq -r --slurpfile schema "$top_srcdir/tools/schema/$1.schema.json" \
        -f "$top_srcdir/tests/support/schema.jq" <<<"$output")
    echo "$faults"
    [ -z "$faults" ]
}

# Two nested surfaces that never touch, too near to each other to prove it in a lifetime.
near='superellipsoid radii=1.000000002,1.000000002,1.000000002'
endless=(superellipsoid "$near" --gamma 1e-9 --max-bytes 0)

# twin.so: a surface and a map, both called twin, that fail at every call; the surface is defined
# for t from LOW to HIGH, else always: build_twin [LOW HIGH].
build_twin() {
    cat >twin.c <<END
#include <impinge/surface.h>
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    static char instance;
    (void)values, (void)why;
    *self = &instance;
    return IMP_STATUS_OK;
}
static void destroy(void *self) { (void)self; }
static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    lo[0] = lo[1] = 0, hi[0] = hi[1] = 1, lo[2] = ${1--INFINITY}, hi[2] = ${2-INFINITY};
}
static void time_domain(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}
static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self, (void)n, (void)p, (void)x, (void)error;
    return IMP_STATUS_INTERNAL;
}
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    (void)self, (void)region, (void)rates;
    return IMP_STATUS_INTERNAL;
}
static imp_status map_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    (void)self, (void)box, (void)rates;
    return IMP_STATUS_INTERNAL;
}
static const imp_surface_type surface = {
    .flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES,
    .struct_size = sizeof surface, .parameter_size = sizeof(imp_parameter), .name = "twin",
    .summary = "one of two", .equation = "none", .example = "twin",
    .create = create, .destroy = destroy, .domain = domain, .eval = eval, .rate = rate};
static const imp_map_type map = {
    .struct_size = sizeof map, .parameter_size = sizeof(imp_parameter), .name = "twin",
    .summary = "the other", .equation = "none", .example = "twin",
    .create = create, .destroy = destroy, .time_domain = time_domain, .eval = eval,
    .rate = map_rate};
static const imp_surface_type *const surfaces[] = {&surface};
static const imp_map_type *const maps[] = {&map};
static const imp_surface_factory surface_factory = {sizeof surface_factory, 1, surfaces};
static const imp_map_factory map_factory = {sizeof map_factory, 1, maps};
static const void *get_factory(const char *id)
{
    return id[8] == 's' ? (const void *)&surface_factory : id[8] == 'm' ? &map_factory : NULL;
}
IMPINGE_PLUGIN("twin", "1", "MIT", "a test", get_factory);
END
    # shellcheck disable=SC2086 # CC may hold flags
    $CC -shared -fPIC -I"$top_srcdir/sdk" -o twin.so twin.c
}
