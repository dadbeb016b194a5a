/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/bench.h"

#include <stdio.h>
#include <stdlib.h>

/* parameters: a ball at the end of an arm whose joints take all angles, before a ball at rest. The
 * arm of length 1 has `joints` equal links, and turns in a plane; stretched, at angles 0, its ball
 * is c apart from the other, and farther at all others. */

enum { JOINTS_MAX = 4 };

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

static exit_status build(bench_cases *list, const bench_request *request)
{
    const double gaps[] = {1e-1, 1e-2, 1e-3, 1e-4};
    for (int joints = 1; joints <= JOINTS_MAX; ++joints)
        for (size_t k = 0; k < sizeof gaps / sizeof *gaps; ++k) add_arm(list, joints, gaps[k]);
    return bench_built(list, request);
}

static const bench_method models = {.name = "models", .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_parameters = {
    "parameters",
    "A ball on an arm of length 1 at all angles of 1 to 4 joints, each over 1 rad: proved not to\n"
    "touch a ball that is c away from it where it is nearest. gamma c / 2. Ends at --max-pairs.",
    methods, build, NULL};
