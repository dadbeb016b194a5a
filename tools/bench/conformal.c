/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdlib.h>

/* Machine parts that slide in each other, c apart along a whole area: the inner one, up to the radius that is
 * c less than where they would touch and from there on; the outer one; and the maps that move one of both. */
typedef struct parts {
    const char *name, *before, *after, *outer, *inner_maps, *outer_maps;
    double radius;
} parts;

/* Thread of pitch 0.5, which a screw motion of this pitch takes into itself. */
#define THREAD_BOLT "\"type\":\"thread\",\"radius\":"
#define THREAD_NUT "\"type\":\"thread\",\"height\":0.5"
#define FORMULA                                                                                    \
    "\"type\":\"formula\",\"x\":\"(r+0.1*cos(2*pi*(v-u)))*cos(2*pi*u)\","                          \
    "\"y\":\"(r+0.1*cos(2*pi*(v-u)))*sin(2*pi*u)\",\"z\":\"0.5*v\",\"domain\":[[0,1],"
#define FORMULA_BOLT FORMULA "[-2,2]],\"constants\":{\"r\":"
#define FORMULA_NUT FORMULA "[-0.5,0.5]],\"constants\":{\"r\":1}"
#define SCREW "{\"type\":\"screw\",\"pitch\":0.5,\"rate\":1}"
#define ALONG_A_RACE "\"type\":\"sphere\",\"center\":[1,0,0],\"radius\":"

enum { PISTON = 2 };
static const parts all[] = {
    {"shaft", "\"type\":\"cylinder\",\"radius\":", "", "\"type\":\"cylinder\"",
     "{\"type\":\"rotate\",\"rate\":3}", "", 1},
    {"socket", "\"type\":\"sphere\",\"radius\":", "", "\"type\":\"sphere\"",
     "{\"type\":\"rotate\",\"axis\":[1,2,3],\"rate\":2}", "", 1},
    {"piston", "\"type\":\"cylinder\",\"height\":1,\"radius\":", "",
     "\"type\":\"cylinder\",\"height\":4", "{\"type\":\"translate\",\"velocity\":[0,0,0.5]}", "",
     1},
    {"race", ALONG_A_RACE, "", "\"type\":\"torus\"", "{\"type\":\"rotate\",\"rate\":1}", "", 0.25},
    {"thread", THREAD_BOLT, "", THREAD_NUT, "", SCREW, 1},
    {"thread by formula", FORMULA_BOLT, "}", FORMULA_NUT, "", SCREW, 1}};

/* Where the parts are: as they are; each placed elsewhere; or the one that rests in a fast tumble, and the
 * other one moving with it. */
enum { AS_THEY_ARE, PLACED, CARRIED, PLACINGS };
static const char *const placing_names[PLACINGS] = {"", "placed, ", "carried, "};
static const char *const placing_maps[PLACINGS] = {
    "",
    "{\"type\":\"rotate\",\"axis\":[1,2,3],\"angle\":[0.7]},{\"type\":\"translate\",\"offset\":[[3,"
    "-2,5]]}",
    "{\"type\":\"rotate\",\"axis\":[1,-2,0.5],\"rate\":6},{\"type\":\"translate\",\"velocity\":[3,"
    "1,-2]}"};

/* The rest of a body: its own maps, then those of the placing, or those of the part that rests. */
static char *moves(const char *own, const char *other, int placing)
{
    const char *maps = placing_maps[placing], *comma = *own != 0 && *maps != 0 ? "," : "";
    if (placing == CARRIED && *own != 0)
        return bench_text("\"maps\":[%s],\"parent\":\"%s\"", own, other);
    return bench_text("\"maps\":[%s%s%s]", own, comma, maps);
}

static void add_parts(bench_cases *list, const parts *p, double c, int placing)
{
    char *inner = moves(p->inner_maps, "outer", placing),
         *outer = moves(p->outer_maps, "inner", placing);
    char *text = NULL;
    if (inner != NULL && outer != NULL)
        text = bench_text("{\"bodies\":[{\"name\":\"inner\",\"surfaces\":[{%s%.17g%s}],%s},"
                          "{\"name\":\"outer\",\"surfaces\":[{%s}],%s}]}",
                          p->before, p->radius - c, p->after, inner, p->outer, outer);
    bench_begin(list, c / 10, -1, "%s, %sc = %g", p->name, placing_names[placing], c);
    bench_add_text(list, text);
    free(inner);
    free(outer);
}

static exit_status build(bench_cases *list, const bench_request *request)
{
    const double clearances[] = {1e-1, 1e-2, 1e-3};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        for (size_t c = 0; c < sizeof clearances / sizeof *clearances; ++c)
            add_parts(list, &all[k], clearances[c], AS_THEY_ARE);
        if (k == PISTON) add_parts(list, &all[k], 1e-6, AS_THEY_ARE);
        for (int placing = PLACED; placing < PLACINGS; ++placing)
            add_parts(list, &all[k], 1e-2, placing);
    }
    return bench_built(list, request);
}

static const bench_method models = {.name = "models", .method = IMP_METHOD_MODELS, .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_conformal = {"conformal",
                                   "A shaft turning in a bore, a ball in a socket and along a "
                                   "race, a piston in a sleeve, a nut on\n"
                                   "its bolt, c apart everywhere; both placed by maps, and carried "
                                   "away. gamma c / 10. Ends at --max-pairs.",
                                   methods, build, NULL};
