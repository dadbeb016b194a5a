/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

/* Surfaces that run around a line: tori, and tori by formula, which are no tubes for the host. */

enum { TEXT = 500 };

static imp_registry *registry;

/* Two tori that turn and drift towards each other: twice the same, as types and as formulas. */
typedef struct scene_text {
    char type[2][TEXT], formula[2][TEXT];
} scene_text;

static void draw_scene(uint64_t *state, scene_text *s)
{
    for (int side = 0; side < 2; ++side) {
        const double major = random_between(state, 0.6, 1.2),
                     minor = random_between(state, 0.1, 0.4);
        char maps[TEXT / 3];
        snprintf(maps, sizeof maps,
                 "! rotate axis=%.3f,%.3f,1 rate=%.3f ! translate "
                 "offset=[[%.3f,%.3f,%.3f],[%.3f,%.3f,%.3f]]",
                 random_between(state, -1, 1), random_between(state, -1, 1),
                 random_between(state, -4, 4), side * 2.5, random_between(state, -1, 1),
                 random_between(state, -1, 1), side * -2.5, random_between(state, -1, 1),
                 random_between(state, -1, 1));
        snprintf(s->type[side], TEXT, "torus major_radius=%.6f minor_radius=%.6f %s", major, minor,
                 maps);
        snprintf(s->formula[side], TEXT,
                 "formula x=(a+b*cos(v))*cos(u) y=(a+b*cos(v))*sin(u) z=b*sin(v) "
                 "constants={\"a\":%.6f,\"b\":%.6f} domain=[[0,6.3],[0,6.3]] %s",
                 major, minor, maps);
    }
}

static imp_result solve(char text[2][TEXT], double gamma)
{
    const question q = {.a = text[0], .b = text[1], .gamma = gamma};
    return ask_in(registry, &q);
}

static double time_of(const imp_result *r)
{
    return r->verdict == IMP_VERDICT_CONTACT ? r->t : INFINITY;
}

/* Nothing is nearer than gamma / 2 before an answer: so neither is later than one to gamma / 2. */
START_TEST(tubes_answer_as_surfaces_do)
{
    uint64_t state = suite_seed();
    int met = 0;
    registry = query_registry();
    for (int k = 0; k < suite_times(8); ++k) {
        scene_text s;
        const double gamma = k % 2 ? 1e-3 : 1e-5;
        draw_scene(&state, &s);
        const imp_result tube = solve(s.type, gamma), surface = solve(s.formula, gamma / 2);
        const imp_result finer = solve(s.type, gamma / 4);
        ck_assert_msg(tube.t_lower <= time_of(&surface), "%s | %s: %.17g, %.17g", s.type[0],
                      s.type[1], tube.t_lower, surface.t);
        ck_assert_msg(surface.t_lower <= time_of(&finer), "%s | %s: %.17g, %.17g", s.type[0],
                      s.type[1], surface.t_lower, finer.t);
        met += tube.verdict == IMP_VERDICT_CONTACT;
    }
    ck_assert_int_gt(met, 0);
    imp_registry_free(registry);
}
END_TEST

START_TEST(points_of_surfaces_are_in_tubes)
{
    const imp_result r = query_audited("torus ! rotate axis=1,2,3 rate=2",
                                       "torus minor_radius=0.3 ! rotate axis=1,0.3,-0.5 rate=-3 ! "
                                       "translate offset=[[3,1,0.5],[-3,-1,-0.4]]");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_msg(r.stats.pairs <= 300, "%llu pairs", (unsigned long long)r.stats.pairs);
    const imp_result still = query_audited("torus", "torus ! translate offset=[[0,3,0],[0,-1,0]]");
    ck_assert_int_eq(still.verdict, IMP_VERDICT_CONTACT);
}
END_TEST

static void check_opened(const char *a, const char *b, imp_verdict verdict, uint64_t pairs)
{
    const question q = {.a = a, .b = b, .gamma = 1e-4};
    const imp_result r = ask_in(registry, &q);
    ck_assert_int_eq(r.verdict, verdict);
    ck_assert_msg(r.stats.pairs <= pairs, "%s | %s: %llu pairs", a, b,
                  (unsigned long long)r.stats.pairs);
}

START_TEST(tubes_that_cross_are_opened)
{
    registry = query_registry();
    check_opened("torus minor_radius=0.5", "torus minor_radius=0.1 ! rotate axis=1,0.2,0 rate=0.3",
                 IMP_VERDICT_CLEAR, 60);
    check_opened("torus", "torus ! translate offset=[[0.1,0.2,0.1],[0,1,0]]", IMP_VERDICT_CONTACT,
                 200);
    check_opened("torus", "torus major_radius=1.2 ! translate offset=[[0,0,2],[0,0,-2]]",
                 IMP_VERDICT_CONTACT, 1500);
    imp_registry_free(registry);
}
END_TEST

/* Motion that bends by half of gamma within a window is cut before lines are cut that short. */
START_TEST(bending_motion_is_cut_before_lines)
{
    const question q = {
        .a = "torus major_radius=1.2103489078245466 minor_radius=0.2131504306885969 ! rotate "
             "axis=0.27341644141316479,0.54161727455869046,-0.56278888266724869 "
             "angle=[1.4199248136434783,-2.8798426259741516] "
             "center=0.24190623893163454,-0.2590738238905903,-0.02923778104032726 ! translate "
             "offset=[[654954.24689680629,-235265.0573160554,59845.943912200622],"
             "[0.35892330934472483,-0.20255446452520842,0.32764998647405053],"
             "[-0.51363709750591857,-0.99871771640368756,-0.85585289594997427]]",
        .b = "torus major_radius=1.124839046834083 minor_radius=0.42394327917979696 ! rotate "
             "axis=-0.83091554885245755,0.76397152369404808,-0.70339491610431115 "
             "angle=[-0.15989068341614132,-1.6676466303582824] "
             "center=0.31069529313446298,-0.076593267012168731,-0.084985372287982863 ! translate "
             "offset=[[654958.20947607828,-235265.69405873751,59846.339246407246],"
             "[-3.6436947604746188,-0.39647754738457119,-0.86889310951601684],"
             "[-0.20760000586712768,-0.8135893380664343,0.88393397563802778]]",
        .gamma = 1e-6};
    registry = query_registry();
    const imp_result r = ask_in(registry, &q);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_msg(r.stats.pairs <= 400, "%llu pairs", (unsigned long long)r.stats.pairs);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("tubes", tubes_answer_as_surfaces_do, points_of_surfaces_are_in_tubes,
           tubes_that_cross_are_opened, bending_motion_is_cut_before_lines)
