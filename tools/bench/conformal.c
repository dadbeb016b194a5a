/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdlib.h>
#include <string.h>

/* Machine parts that slide in each other, c apart along a whole area: the inner one, where # stands
 * before what is less by c; the outer one; and the maps that move one of both. */
typedef struct parts {
    const char *name, *inner, *outer, *inner_maps, *outer_maps;
} parts;

/* Thread of pitch 0.5, which a screw motion of this pitch takes into itself. */
#define FORMULA                                                                                    \
    "\"type\":\"formula\",\"x\":\"(r+0.1*cos(2*pi*(v-u)))*cos(2*pi*u)\","                          \
    "\"y\":\"(r+0.1*cos(2*pi*(v-u)))*sin(2*pi*u)\",\"z\":\"0.5*v\",\"domain\":[[0,1],"
#define SCREW "{\"type\":\"screw\",\"pitch\":0.5,\"rate\":1}"

enum { PISTON = 2 };
static const parts all[] = {{"shaft", "\"type\":\"cylinder\",\"radius\":#1",
                             "\"type\":\"cylinder\"", "{\"type\":\"rotate\",\"rate\":3}", ""},
                            {"socket", "\"type\":\"sphere\",\"radius\":#1", "\"type\":\"sphere\"",
                             "{\"type\":\"rotate\",\"axis\":[1,2,3],\"rate\":2}", ""},
                            {"piston", "\"type\":\"cylinder\",\"height\":1,\"radius\":#1",
                             "\"type\":\"cylinder\",\"height\":4",
                             "{\"type\":\"translate\",\"velocity\":[0,0,0.5]}", ""},
                            {"race", "\"type\":\"sphere\",\"center\":[1,0,0],\"radius\":#0.25",
                             "\"type\":\"torus\"", "{\"type\":\"rotate\",\"rate\":1}", ""},
                            {"ellipsoid", "\"type\":\"ellipsoid\",\"radii\":[#1.5,#1,#1]",
                             "\"type\":\"ellipsoid\",\"radii\":[1.5,1,1]",
                             "{\"type\":\"rotate\",\"axis\":[1,0,0],\"rate\":2}", ""},
                            {"thread", "\"type\":\"thread\",\"radius\":#1",
                             "\"type\":\"thread\",\"height\":0.5", "", SCREW},
                            {"thread by formula", FORMULA "[-2,2]],\"constants\":{\"r\":#1}",
                             FORMULA "[-0.5,0.5]],\"constants\":{\"r\":1}", "", SCREW}};

/* Where the parts are: as they are; each placed elsewhere; or the one that rests in a fast tumble,
 * and the other one moving with it. */
enum { AS_THEY_ARE, PLACED, CARRIED, PLACINGS };
static const char *const placing_names[PLACINGS] = {"", "placed, ", "carried, "};
static const char *const placing_maps[PLACINGS] = {
    "",
    "{\"type\":\"rotate\",\"axis\":[1,2,3],\"angle\":[0.7]},{\"type\":\"translate\",\"offset\":[[3,"
    "-2,5]]}",
    "{\"type\":\"rotate\",\"axis\":[1,-2,0.5],\"rate\":6},{\"type\":\"translate\",\"velocity\":[3,"
    "1,-2]}"};

/* Returns the rest of a body: its own maps, then those of the placing, or those of the part that
 * rests. */
static char *moves(const char *own, const char *other, int placing)
{
    const char *maps = placing_maps[placing], *comma = *own != 0 && *maps != 0 ? "," : "";
    if (placing == CARRIED && *own != 0)
        return bench_text("\"maps\":[%s],\"parent\":\"%s\"", own, other);
    return bench_text("\"maps\":[%s%s%s]", own, comma, maps);
}

/* Returns the text with what stands behind each # less by c; NULL: no memory. */
static char *less_by(const char *text, double c)
{
    char *made = bench_text("%.*s", (int)strcspn(text, "#"), text), *end;
    for (const char *at = strchr(text, '#'); made != NULL && at != NULL; at = strchr(end, '#')) {
        const double number = strtod(at + 1, &end) - c;
        char *const before = made;
        made = bench_text("%s%.17g%.*s", before, number, (int)strcspn(end, "#"), end);
        free(before);
    }
    return made;
}

static void add_parts(bench_cases *list, const parts *p, double c, int placing)
{
    char *inner = less_by(p->inner, c), *text = NULL;
    char *inner_moves = moves(p->inner_maps, "outer", placing);
    char *outer_moves = moves(p->outer_maps, "inner", placing);
    if (inner != NULL && inner_moves != NULL && outer_moves != NULL)
        text = bench_text("{\"bodies\":[{\"name\":\"inner\",\"surfaces\":[{%s}],%s},"
                          "{\"name\":\"outer\",\"surfaces\":[{%s}],%s}]}",
                          inner, inner_moves, p->outer, outer_moves);
    bench_begin(list, c / 10, -1, "%s, %sc = %g", p->name, placing_names[placing], c);
    bench_add_text(list, text);
    free(inner);
    free(inner_moves);
    free(outer_moves);
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

static const bench_method models = {.name = "models", .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_conformal = {
    "conformal",
    "A shaft turning in a bore, a ball in a socket and along a race, a piston in a sleeve, an\n"
    "ellipsoid in its hollow and a nut on its bolt, c apart everywhere; at c = 0.01 also both "
    "placed\n"
    "by maps, and carried away. gamma c / 10. Ends at --max-pairs.",
    methods, build, NULL};
