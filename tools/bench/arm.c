/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/arm.h"

#include <stdlib.h>

/* Lengths are those of common arms for 5 kg, in m; where all angles are 0 the arm stands upright.
 * Links are drawn in frames of their own, turned by a map that stays, as meshes of robots are: y is
 * up, z is -y of the world. */
#define OWN_FRAME "\"maps\":[{\"type\":\"rotate\",\"axis\":[1,0,0],\"angle\":[1.5707963267948966]}]"
#define ROD(RADIUS, FROM, TO)                                                                      \
    "{\"type\":\"capsule\",\"radius\":" RADIUS ",\"from\":" FROM ",\"to\":" TO "," OWN_FRAME "}"
#define BLOCK(SIZE, CENTER)                                                                        \
    "{\"type\":\"box\",\"size\":" SIZE ",\"center\":" CENTER "," OWN_FRAME "}"
#define FINGER(SIDE, FROM, TO)                                                                     \
    ROD("0.008", "[" SIDE ",1.0006," FROM "]", "[" SIDE ",1.0006," TO "]")

enum { JOINTS = 6 };

static const struct joint {
    const char *name, *axis, *center;
} joints[JOINTS] = {
    {"pan", "[0,0,1]", "[0,0,0]"},         {"lift", "[0,1,0]", "[0,0,0.089]"},
    {"elbow", "[0,1,0]", "[0,0,0.514]"},   {"wrist_1", "[0,1,0]", "[0,0,0.906]"},
    {"wrist_2", "[0,0,1]", "[0,0.109,0]"}, {"wrist_3", "[0,1,0]", "[0,0,1.0006]"},
};

enum {
    BASE,
    UPPER_ARM,
    FOREARM,
    FIRST_WRIST,
    SECOND_WRIST,
    THIRD_WRIST,
    PALM,
    CAMERA,
    LAMP,
    LEFT_KNUCKLE,
    LEFT_FINGER,
    LEFT_TIP,
    RIGHT_KNUCKLE,
    RIGHT_FINGER,
    RIGHT_TIP,
    LINKS
};

/* A link, and how many joints are before it. */
static const struct link {
    const char *name, *surface;
    int joint;
} links[LINKS] = {
    [BASE] = {"base",
              "{\"type\":\"cylinder\",\"radius\":0.06,\"height\":0.08,\"center\":[0,0,0.04],"
              "\"ends\":true}",
              0},
    [UPPER_ARM] = {"upper arm", ROD("0.055", "[0,0.089,-0.136]", "[0,0.514,-0.136]"), 2},
    [FOREARM] = {"forearm", ROD("0.045", "[0,0.514,-0.0165]", "[0,0.906,-0.0165]"), 3},
    [FIRST_WRIST] = {"1st wrist", ROD("0.04", "[0,0.906,-0.0165]", "[0,0.906,-0.109]"), 4},
    [SECOND_WRIST] = {"2nd wrist", ROD("0.04", "[0,0.906,-0.109]", "[0,1.0006,-0.109]"), 5},
    [THIRD_WRIST] = {"3rd wrist",
                     "{\"type\":\"cylinder\",\"radius\":0.0375,\"height\":0.081,"
                     "\"center\":[0,1.0006,-0.1495],\"ends\":true," OWN_FRAME "}",
                     6},
    [PALM] = {"palm", BLOCK("[0.06,0.06,0.06]", "[0,1.0006,-0.23]"), 6},
    [CAMERA] = {"camera", BLOCK("[0.03,0.015,0.04]", "[0,1.0461,-0.24]"), 6},
    [LAMP] = {"lamp", BLOCK("[0.02,0.01,0.02]", "[0,0.9546,-0.24]"), 6},
    [LEFT_KNUCKLE] = {"left knuckle", FINGER("0.02", "-0.272", "-0.28"), 6},
    [LEFT_FINGER] = {"left finger", FINGER("0.026", "-0.3", "-0.32"), 6},
    [LEFT_TIP] = {"left tip", FINGER("0.022", "-0.34", "-0.36"), 6},
    [RIGHT_KNUCKLE] = {"right knuckle", FINGER("-0.02", "-0.272", "-0.28"), 6},
    [RIGHT_FINGER] = {"right finger", FINGER("-0.026", "-0.3", "-0.32"), 6},
    [RIGHT_TIP] = {"right tip", FINGER("-0.022", "-0.34", "-0.36"), 6},
};

/* The pairs that take longest. */
static const int hard[ARM_HARD][2] = {
    {BASE, UPPER_ARM}, {FOREARM, SECOND_WRIST}, {FIRST_WRIST, THIRD_WRIST}};

/* Returns the maps of all joints before a link, from its own on; NULL: no memory. */
static char *maps_of(int joint)
{
    char *maps = bench_text("%s", "");
    for (int k = joint - 1; k >= 0 && maps != NULL; --k) {
        char *const before = maps;
        maps = bench_text("%s%s{\"type\":\"rotate\",\"axis\":%s,\"center\":%s,\"rate\":1,"
                          "\"clock\":\"%s\"}",
                          before, k < joint - 1 ? "," : "", joints[k].axis, joints[k].center,
                          joints[k].name);
        free(before);
    }
    return maps;
}

static char *ranges_of(int joint)
{
    char *ranges = bench_text("%s", "");
    for (int k = 0; k < joint && ranges != NULL; ++k) {
        char *const before = ranges;
        ranges =
            bench_text("%s%s\"%s\":[-3.1416,3.1416]", before, k > 0 ? "," : "", joints[k].name);
        free(before);
    }
    return ranges;
}

/* Adds a scene of two links; the joints that move both are in it. */
static void add_pair(bench_cases *list, int a, int b)
{
    char *ranges = ranges_of(links[b].joint), *text = NULL;
    char *maps[2] = {maps_of(links[a].joint), maps_of(links[b].joint)};
    if (ranges != NULL && maps[0] != NULL && maps[1] != NULL)
        text = bench_text("{\"time\":[0,0],\"parameters\":{%s},\"bodies\":["
                          "{\"name\":\"%s\",\"surfaces\":[%s],\"maps\":[%s]},"
                          "{\"name\":\"%s\",\"surfaces\":[%s],\"maps\":[%s]}]}",
                          ranges, links[a].name, links[a].surface, maps[0], links[b].name,
                          links[b].surface, maps[1]);
    free(ranges);
    free(maps[0]);
    free(maps[1]);
    bench_add_text(list, text);
}

/* Whether no angles of the joints make two links touch, the first being nearer to the base.
 * Neighbours share a bearing; what is drawn fixed to the third wrist is drawn apart. */
static bool never_touch(int a, int b)
{
    const int between = links[b].joint - links[a].joint;
    if (between == 0) return true;
    if (a == SECOND_WRIST) return b > THIRD_WRIST;
    if (a == FIRST_WRIST) return b > SECOND_WRIST && b != CAMERA && b != LAMP;
    return (a == BASE && b == UPPER_ARM) || (a == FOREARM && b == SECOND_WRIST);
}

void arm_add_pairs(bench_cases *list)
{
    for (int k = 0; k < ARM_HARD; ++k) {
        const int a = hard[k][0], b = hard[k][1];
        bench_begin(list, 1e-6, -1, "%s and %s", links[a].name, links[b].name);
        add_pair(list, a, b);
    }
    for (int between = 0; between < ARM_DEPTHS; ++between) {
        bench_begin(list, 1e-6, -1, "pairs of links, %d joint%s between", between,
                    between == 1 ? "" : "s");
        for (int a = 0; a < LINKS; ++a)
            for (int b = a + 1; b < LINKS; ++b)
                if (links[b].joint - links[a].joint == between && never_touch(a, b))
                    add_pair(list, a, b);
    }
}
