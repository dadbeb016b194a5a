/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/arm.h"

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

/* A spindle that turns all around by one parameter, slides in its bore by time, or tilts by another
 * one beside a ball: what the parameter turns is round, so that nothing shows. */
#define SPINDLE_TURNS "{\"type\":\"rotate\",\"axis\":[0,0,1],\"rate\":1,\"clock\":\"c\"}"
#define SPINDLE_CAN(NUMBERS) "{\"type\":\"cylinder\"," NUMBERS ",\"ends\":true}"

static const struct spindle {
    const char *name, *can, *moves, *beside;
    double radius; /* of what is beside it, less c or more */
    int sign;
} spindles[] = {{"spindle in a bore", SPINDLE_CAN("\"radius\":0.2"),
                 "{\"type\":\"translate\",\"velocity\":[0,0,1]}",
                 "\"type\":\"cylinder\",\"radius\":", 0.2, 1},
                {"spindle that tilts", SPINDLE_CAN("\"radius\":0.2,\"center\":[0,0,-0.7]"),
                 "{\"type\":\"rotate\",\"axis\":[0,1,0],\"rate\":1,\"clock\":\"b\"}",
                 "\"type\":\"sphere\",\"center\":[0,2.2,-0.5],\"radius\":", 2, -1}};
enum { SPINDLES = sizeof spindles / sizeof *spindles, SPINDLE_GAPS = 3 };

static void add_spindle(bench_cases *list, const struct spindle *of, double c)
{
    char *text = bench_text(
        "{\"parameters\":{\"c\":[-3,3.2],\"b\":[-1.5,1.4]},\"bodies\":[{\"surfaces\":[%s],"
        "\"maps\":[" SPINDLE_TURNS ",%s]},{\"surfaces\":[{%s%.17g}]}]}",
        of->can, of->moves, of->beside, of->radius + of->sign * c);
    bench_begin(list, c / 2, -1, "%s, c = %g", of->name, c);
    bench_add_text(list, text);
}

static void add_spindles(bench_cases *list)
{
    static const double apart[SPINDLE_GAPS] = {1e-1, 1e-2, 1e-3};
    for (size_t k = 0; k < SPINDLES; ++k)
        for (int j = 0; j < SPINDLE_GAPS; ++j) add_spindle(list, &spindles[k], apart[j]);
}

/* Gaps for each number of joints; the least ends in seconds. */
static const double gaps[JOINTS_MAX][GAPS] = {{1e-1, 1e-2, 1e-3, 1e-4},
                                              {1e-1, 1e-2, 1e-3, 1e-4},
                                              {3e-1, 1e-1, 3e-2, 1e-2},
                                              {8e-1, 4e-1, 2e-1, 1e-1}};

static exit_status build(bench_cases *list, const bench_request *request)
{
    for (int joints = 1; joints <= JOINTS_MAX; ++joints)
        for (size_t k = 0; k < GAPS; ++k) add_arm(list, joints, gaps[joints - 1][k]);
    add_spindles(list);
    arm_add_pairs(list);
    return bench_built(list, request);
}

/* --- Exponents -------------------------------------------------------------------------------- */

static double pairs_of(const bench_result *result)
{
    const bench_tally *of = &result->rows[0].tally;
    return of->ended == 0 && of->pairs.mean > 0 ? of->pairs.mean : NAN;
}

/* Says how pairs grow as c falls: with which power of 1/c between the two least gaps that were
 * decided. False: fewer were. */
static bool find_exponent(const bench_result *of, size_t joints, bench_finding *to)
{
    static const char *const keys[JOINTS_MAX] = {"exponent_1_joint", "exponent_2_joints",
                                                 "exponent_3_joints", "exponent_4_joints"};
    const double *c = gaps[joints - 1];
    size_t last = GAPS - 1;
    while (last > 0 && !(pairs_of(&of[last]) > 0 && pairs_of(&of[last - 1]) > 0)) --last;
    if (last == 0) return false;
    to->key = keys[joints - 1];
    to->value = log(pairs_of(&of[last]) / pairs_of(&of[last - 1])) / log(c[last - 1] / c[last]);
    snprintf(to->text, sizeof to->text,
             "%zu joint%s: pairs grow as the power %.2f of 1/c, from c = %g to %g", joints,
             joints == 1 ? "" : "s", to->value, c[last - 1], c[last]);
    return true;
}

/* Adds up the pairs of links of the arm, whose cases are the last. */
static bool find_arm(const bench_result *of, bench_finding *to)
{
    size_t scenes = 0, clear = 0;
    double seconds = 0;
    for (int k = 0; k < ARM_DEPTHS; ++k) {
        const bench_tally *t = &of[k].rows[0].tally;
        scenes += t->scenes;
        clear += t->verdicts[IMP_VERDICT_CLEAR];
        seconds += t->seconds.mean * (double)t->scenes;
    }
    to->key = "arm_seconds";
    to->value = seconds;
    snprintf(to->text, sizeof to->text,
             "the arm's links: %zu of %zu pairs proved never to touch, in %.3g s", clear, scenes,
             seconds);
    return true;
}

static size_t find(const bench_result *results, size_t count, bench_finding *findings)
{
    size_t found = 0;
    for (size_t joints = 1; joints <= JOINTS_MAX && joints * GAPS <= count; ++joints)
        found += find_exponent(results + (joints - 1) * GAPS, joints, &findings[found]);
    if (count == JOINTS_MAX * GAPS + SPINDLES * SPINDLE_GAPS + ARM_HARD + ARM_DEPTHS)
        found += find_arm(results + count - ARM_DEPTHS, &findings[found]);
    return found;
}

static const bench_method models = {.name = "models", .capped = true};
static const bench_method *const methods[] = {&models, NULL};

const bench_set bench_parameters = {
    "parameters",
    "A ball on an arm of length 1 at all angles of 1 to 4 joints, each over 1 rad: proved not to\n"
    "touch a ball that is c away from it where it is nearest. gamma c / 2. Then spindles that a\n"
    "parameter turns within themselves, c away from a bore or a ball, and the pairs of links\n"
    "of an arm of six joints with a gripper that never touch, whatever its joints do. Ends at\n"
    "--max-pairs.",
    methods, build, find};
