/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

/* Machine parts that slide in each other, c apart along a whole area: the inner one, before and after
 * its radius; the outer one; and the radius for which they would touch. */
typedef struct parts {
    const char *name, *before, *after, *outer;
    double radius;
} parts;

/* Thread of pitch 0.5, which a screw motion of this pitch takes into itself. */
#define THREAD                                                                                     \
    "formula x=(r+0.1*cos(2*pi*(v-u)))*cos(2*pi*u) y=(r+0.1*cos(2*pi*(v-u)))*sin(2*pi*u) z=0.5*v "

enum { PISTON = 2 };
static const parts all[] = {
    {"shaft", "cylinder radius=", " ! rotate rate=3", "cylinder", 1},
    {"socket", "sphere radius=", " ! rotate axis=1,2,3 rate=2", "sphere", 1},
    {"piston", "cylinder radius=", " height=1 ! translate velocity=0,0,0.5", "cylinder height=4",
     1},
    {"race", "sphere radius=", " center=1,0,0 ! rotate rate=1", "torus", 0.25},
    {"thread", THREAD "domain=[[0,1],[-2,2]] constants={\"r\":", "}",
     THREAD "domain=[[0,1],[-0.5,0.5]] constants={\"r\":1} ! screw pitch=0.5 rate=1", 1}};

static void add_parts(bench_cases *list, const parts *p, double c)
{
    bench_begin(list, c / 10, -1, "%s, c = %g", p->name, c);
    bench_add_pair(list, bench_text("%s%.17g%s", p->before, p->radius - c, p->after),
                   bench_text("%s", p->outer));
}

static exit_status build(bench_cases *list, const bench_request *request)
{
    const double clearances[] = {1e-1, 1e-2, 1e-3};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        for (size_t c = 0; c < sizeof clearances / sizeof *clearances; ++c)
            add_parts(list, &all[k], clearances[c]);
        if (k == PISTON) add_parts(list, &all[k], 1e-6);
    }
    return bench_built(list, request);
}

static const bench_method models = {.name = "models", .method = IMP_METHOD_MODELS, .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_conformal = {
    "conformal",
    "A shaft turning in a bore, a ball in a socket and along a race, a piston in a sleeve, a nut "
    "on\n"
    "its bolt, c apart everywhere; gamma c / 10. Ends at --max-pairs.",
    methods, build, NULL};
