/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/ball_queries.h"

/* Scenes of many bodies, and bodies that exist for a while. */

/* --- Scenes of many --------------------------------------------------------------------------- */

/* A ball that reaches the one of radius 1 at the origin at time t, from direction n. */
static ball arriving(const double n[3], double t)
{
    ball b = {.radius = 0.25};
    for (int i = 0; i < 3; ++i) {
        b.velocity[i] = -2 * n[i];
        b.centre[i] = (1.25 + 2 * t) * n[i];
    }
    return b;
}

static const double sides[5][3] = {
    {1, 0, 0}, {0, 0.6, 0.8}, {-0.8, 0, -0.6}, {0, -1, 0}, {-0.48, 0.6, -0.64}};
static const double arrivals[5] = {0.7, 0.4, 0.55, 0.3, 0.62};

/* Body 0 at rest and five that arrive one after the other; those ignore each other. */
static imp_scene *gathering(ball balls[5])
{
    imp_scene *scene = scene_new();
    ck_assert_int_eq(spheres_add(scene, &ball_type, &at_rest), IMP_SUCCESS);
    for (int k = 0; k < 5; ++k) {
        balls[k] = arriving(sides[k], arrivals[k]);
        ck_assert_int_eq(spheres_add(scene, &ball_type, &balls[k]), IMP_SUCCESS);
        for (size_t other = 1; other <= (size_t)k; ++other)
            ck_assert_int_eq(scene_ignore(scene, other, (size_t)k + 1), IMP_SUCCESS);
    }
    return scene;
}

START_TEST(of_many_bodies_the_first_that_touch_are_told_as_each_is_ignored_in_turn)
{
    const size_t order[5] = {4, 2, 3, 5, 1}; /* bodies by time of arrival */
    ball balls[5];
    imp_scene *scene = gathering(balls);
    for (int k = 0; k < 5; ++k) {
        const imp_result r = solve(scene, 1e-6);
        const double t = arrivals[order[k] - 1];
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_uint_eq(r.a.body, 0);
        ck_assert_uint_eq(r.b.body, order[k]);
        ck_assert_double_le(r.t, t);
        ck_assert_double_ge(r.t, t - 1e-6);
        ck_assert_int_eq(scene_ignore(scene, k % 2 ? order[k] : 0, k % 2 ? 0 : order[k]),
                         IMP_SUCCESS);
    }
    ck_assert_int_eq(solve(scene, 1e-6).verdict, IMP_VERDICT_CLEAR);
    imp_scene_free(scene);
}
END_TEST

START_TEST(who_touches_later_costs_little)
{
    ball balls[5];
    imp_scene *scene = gathering(balls), *alone = two(&at_rest, &balls[3]);
    ck_assert_uint_lt(solve(scene, 1e-8).stats.pairs, 2 * solve(alone, 1e-8).stats.pairs);
    imp_scene_free(scene);
    imp_scene_free(alone);
}
END_TEST

enum { FAR_AWAY = 600 };

/* Bodies far away cost neither nodes nor a kilobyte each. */
START_TEST(bodies_that_meet_none_cost_little_and_change_nothing)
{
    static ball others[FAR_AWAY];
    imp_scene *scene = two(&at_rest, &flying), *alone = two(&at_rest, &flying);
    const imp_result expected = solve(alone, 1e-6);
    for (int k = 0; k < FAR_AWAY; ++k) {
        others[k] = (ball){.radius = 1, .centre = {5 * k, 100, 0}};
        ck_assert_int_eq(spheres_add(scene, &ball_type, &others[k]), IMP_SUCCESS);
    }
    const imp_result r = solve(scene, 1e-6), again = solve(scene, 1e-6);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == expected.t && r.b.u == expected.b.u);
    ck_assert_uint_eq(r.stats.nodes, expected.stats.nodes);
    ck_assert_uint_lt(r.stats.bytes - expected.stats.bytes, FAR_AWAY * 1000);
    ck_assert(again.t == expected.t && again.stats.nodes == 0);
    imp_scene_free(scene);
    imp_scene_free(alone);
}
END_TEST

START_TEST(surfaces_of_one_body_are_not_tested_with_each_other)
{
    imp_scene *scene = two(&at_rest, &elsewhere);
    ck_assert_int_eq(scene_add_surface(scene, imp_scene_body_count(scene) - 1,
                                       surface_new(&ball_type, unconst(&elsewhere))),
                     IMP_SUCCESS);
    const imp_result r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NONE && r.t_lower == 1);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_body_that_is_alone_is_clear_for_that_reason)
{
    imp_scene *scene = scene_new();
    imp_result r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NO_PAIRS);
    ck_assert_int_eq(spheres_add(scene, &ball_type, &at_rest), IMP_SUCCESS);
    r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NO_PAIRS && r.t_lower == 1);
    ck_assert_int_eq(spheres_add(scene, &ball_type, &at_rest), IMP_SUCCESS);
    ck_assert_int_eq(solve(scene, 1e-3).verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_eq(scene_ignore(scene, 1, 0), IMP_SUCCESS);
    r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NO_PAIRS);
    imp_scene_free(scene);
}
END_TEST

/* --- Times of existence ----------------------------------------------------------------------- */

START_TEST(bodies_that_never_exist_together_are_clear_for_that_reason)
{
    const ball early = {.radius = 1, .start = -1, .end = 0.5},
               late = {.radius = 1, .start = 0.75, .end = 3},
               past = {.radius = 1, .start = -2, .end = -1};
    imp_scene *scene = two(&early, &late);
    imp_result r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NO_TIME && r.t_lower == 1);
    imp_scene_free(scene);
    scene = two(&past, &at_rest);
    r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NO_TIME);
    imp_scene_free(scene);
}
END_TEST

START_TEST(contact_is_no_earlier_than_both_exist)
{
    const ball early = {.radius = 1, .start = -1, .end = 0.625},
               late = {.radius = 1, .centre = {1, 0.5, 0}, .start = 0.25, .end = 3},
               moment = {.radius = 1, .centre = {1, 0.5, 0}, .start = 0.625, .end = 3};
    imp_scene *scene = two(&early, &late);
    imp_result r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == 0.25);
    imp_scene_free(scene);
    scene = two(&early, &moment);
    r = solve(scene, 1e-3);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == 0.625);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_body_that_ends_before_the_other_arrives_is_clear)
{
    const ball meets = {.radius = 0.25, .centre = {2.25, 0, 0}, .velocity = {-2, 0, 0}},
               ends = {.radius = 0.25,
                       .centre = {2.25, 0, 0},
                       .velocity = {-2, 0, 0},
                       .start = -1,
                       .end = 0.499};
    imp_scene *scene = two(&at_rest, &meets);
    ck_assert_double_le(fabs(solve(scene, 1e-4).t - 0.5), 5.1e-5);
    imp_scene_free(scene);
    scene = two(&at_rest, &ends);
    const imp_result r = solve(scene, 1e-4);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.reason == IMP_REASON_NONE && r.t_lower == 1);
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("query_bodies", of_many_bodies_the_first_that_touch_are_told_as_each_is_ignored_in_turn,
           who_touches_later_costs_little, bodies_that_meet_none_cost_little_and_change_nothing,
           surfaces_of_one_body_are_not_tested_with_each_other,
           a_body_that_is_alone_is_clear_for_that_reason,
           bodies_that_never_exist_together_are_clear_for_that_reason,
           contact_is_no_earlier_than_both_exist,
           a_body_that_ends_before_the_other_arrives_is_clear)
