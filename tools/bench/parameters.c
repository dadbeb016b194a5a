/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A ball at the end of an arm whose joints take all angles, before a ball at rest. The
 * arm of length 1 has `joints` equal links, and turns in a plane; stretched, at angles 0, its ball
 * is c apart from the other, and farther at all others. */

enum { JOINTS_MAX = 4, GAPS = 4 };

/* Returns the maps of the arm, from its tip on; NULL: no memory. */
static char *maps_of(int joints)
{
    char *maps = bench_text("%s", "");
    for (int k = joints; k >= 1 && maps != NULL; --k) {
        char *const before = maps;
        maps = bench_text("%s%s{\"type\":\"rotate\",\"axis\":[0,0,1],\"center\":[%.17g,0,0],"
                          "\"rate\":1,\"clock\":\"a%d\"}",
                          before, k < joints ? "," : "", (double)(k - 1) / joints, k);
        free(before);
    }
    return maps;
}

/* The angles' ranges, which do not have 0 in their middle. */
static char *ranges_of(int joints)
{
    char *ranges = bench_text("%s", "");
    for (int k = 1; k <= joints && ranges != NULL; ++k) {
        char *const before = ranges;
        ranges = bench_text("%s%s\"a%d\":[-0.4,0.6]", before, k > 1 ? "," : "", k);
        free(before);
    }
    return ranges;
}

static void add_arm(bench_cases *list, int joints, double c)
{
    char *maps = maps_of(joints), *ranges = ranges_of(joints), *text = NULL;
    if (maps != NULL && ranges != NULL)
        text = bench_text(
            "{\"time\":[0,0],\"parameters\":{%s},\"bodies\":[{\"name\":\"arm\",\"surfaces\":["
            "{\"type\":\"sphere\",\"radius\":0.1,\"center\":[1,0,0]}],\"maps\":[%s]},"
            "{\"name\":\"rest\",\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.1,"
            "\"center\":[%.17g,0,0]}]}]}",
            ranges, maps, 1.2 + c);
    bench_begin(list, c / 2, -1, "%d joint%s, c = %g", joints, joints == 1 ? "" : "s", c);
    bench_add_text(list, text);
    free(maps);
    free(ranges);
}

/* --- Links of an arm -------------------------------------------------------------------------- */

/* An arm of six joints, each of which turns all around, with lengths as those of common arms for
 * 5 kg; all in m, where all angles are 0 it stands upright. Its links are drawn in frames of their
 * own, turned by a map that stays, as meshes of robots are. */
#define TURN(NAME, AXIS, CENTER)                                                                   \
    "{\"type\":\"rotate\",\"axis\":" AXIS ",\"center\":" CENTER ",\"rate\":1,\"clock\":\"" NAME    \
    "\"}"
#define PAN TURN("pan", "[0,0,1]", "[0,0,0]")
#define LIFT TURN("lift", "[0,1,0]", "[0,0,0.089]")
#define WRIST_1 TURN("wrist_1", "[0,1,0]", "[0,0,0.906]")
#define WRIST_2 TURN("wrist_2", "[0,0,1]", "[0,0.109,0]")
#define WRIST_3 TURN("wrist_3", "[0,1,0]", "[0,0,1.0006]")
#define OWN_FRAME "\"maps\":[{\"type\":\"rotate\",\"axis\":[1,0,0],\"angle\":[1.5707963267948966]}]"
#define ROD(RADIUS, FROM, TO)                                                                      \
    "{\"type\":\"capsule\",\"radius\":" RADIUS ",\"from\":" FROM ",\"to\":" TO "," OWN_FRAME "}"

/* In its own frame (x, z, -y): y is up. */
#define BASE                                                                                       \
    "{\"type\":\"cylinder\",\"radius\":0.06,\"height\":0.08,\"center\":[0,0,0.04],\"ends\":true}"
#define UPPER_ARM ROD("0.055", "[0,0.089,-0.136]", "[0,0.514,-0.136]")
#define FOREARM ROD("0.045", "[0,0.514,-0.0165]", "[0,0.906,-0.0165]")
#define FIRST_WRIST ROD("0.04", "[0,0.906,-0.0165]", "[0,0.906,-0.109]")
#define SECOND_WRIST ROD("0.04", "[0,0.906,-0.109]", "[0,1.0006,-0.109]")
#define THIRD_WRIST                                                                                \
    "{\"type\":\"cylinder\",\"radius\":0.0375,\"height\":0.081,\"center\":[0,1.0006,-0.1495],"     \
    "\"ends\":true," OWN_FRAME "}"
#define TOOL                                                                                       \
    "{\"type\":\"box\",\"size\":[0.06,0.06,0.06],\"center\":[0,1.0006,-0.23]," OWN_FRAME "}"

/* Two links that never touch, the maps that move either, and the joints that these follow. */
static const struct link_pair {
    const char *name, *link[2], *maps[2], *joint[2];
} link_pairs[] = {
    {"base and upper arm", {BASE, UPPER_ARM}, {"", LIFT "," PAN}, {"pan", "lift"}},
    {"forearm and 2nd wrist",
     {FOREARM, SECOND_WRIST},
     {"", WRIST_2 "," WRIST_1},
     {"wrist_1", "wrist_2"}},
    {"1st and 3rd wrist",
     {FIRST_WRIST, THIRD_WRIST},
     {"", WRIST_3 "," WRIST_2},
     {"wrist_2", "wrist_3"}},
    {"1st wrist and tool", {FIRST_WRIST, TOOL}, {"", WRIST_3 "," WRIST_2}, {"wrist_2", "wrist_3"}},
};

static void add_links(bench_cases *list, const struct link_pair *pair)
{
    bench_begin(list, 1e-6, -1, "%s", pair->name);
    bench_add_text(list, bench_text("{\"time\":[0,0],\"parameters\":{\"%s\":[-3.1416,3.1416],"
                                    "\"%s\":[-3.1416,3.1416]},\"bodies\":["
                                    "{\"surfaces\":[%s],\"maps\":[%s]},"
                                    "{\"surfaces\":[%s],\"maps\":[%s]}]}",
                                    pair->joint[0], pair->joint[1], pair->link[0], pair->maps[0],
                                    pair->link[1], pair->maps[1]));
}

static const double gaps[GAPS] = {1e-1, 1e-2, 1e-3, 1e-4};

static exit_status build(bench_cases *list, const bench_request *request)
{
    for (int joints = 1; joints <= JOINTS_MAX; ++joints)
        for (size_t k = 0; k < GAPS; ++k) add_arm(list, joints, gaps[k]);
    for (size_t k = 0; k < sizeof link_pairs / sizeof *link_pairs; ++k)
        add_links(list, &link_pairs[k]);
    return bench_built(list, request);
}

/* --- Exponents -------------------------------------------------------------------------------- */

static double pairs_of(const bench_result *result)
{
    const bench_tally *of = &result->rows[0].tally;
    return of->ended == 0 && of->pairs.mean > 0 ? of->pairs.mean : NAN;
}

/* Says how pairs grow as c falls: with which power of 1/c between the two least gaps that were
 * decided. */
static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    static const char *const keys[JOINTS_MAX] = {"exponent_1_joint", "exponent_2_joints",
                                                 "exponent_3_joints", "exponent_4_joints"};
    size_t found = 0;
    for (size_t joints = 1; joints <= JOINTS_MAX && joints * GAPS <= count; ++joints) {
        const bench_result *of = results + (joints - 1) * GAPS;
        size_t last = GAPS - 1;
        while (last > 0 && !(pairs_of(&of[last]) > 0 && pairs_of(&of[last - 1]) > 0)) --last;
        if (last == 0) continue;
        bench_finding *to = &findings[found++];
        to->key = keys[joints - 1];
        to->value = log10(pairs_of(&of[last]) / pairs_of(&of[last - 1]));
        snprintf(to->text, sizeof to->text,
                 "%zu joint%s: pairs grow as the power %.2f of 1/c, from c = %g to %g", joints,
                 joints == 1 ? "" : "s", to->value, gaps[last - 1], gaps[last]);
    }
    return found;
}

static const bench_method models = {.name = "models", .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_parameters = {
    "parameters",
    "A ball on an arm of length 1 at all angles of 1 to 4 joints, each over 1 rad: proved not to\n"
    "touch a ball that is c away from it where it is nearest. gamma c / 2. Then links of an arm "
    "at\n"
    "all angles of the two joints between them. Ends at --max-pairs.",
    methods, build, find};
