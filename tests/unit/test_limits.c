/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdatomic.h>

#include "tests/support/sphere_scenes.h"
#include "tests/support/suite.h"

/* Limits and cancellation hold from the first instruction of a query to the last, also while trees
 * are made and candidate pairs are collected. */

enum { CROWD = 1000 }; /* concentric balls: half a million candidate pairs */

static atomic_int roots_made;
static imp_query *cancelled_from_within;

static imp_status counting_include(const void *self, const imp_region *region, imp_model out[3])
{
    if (atomic_fetch_add(&roots_made, 1) == 4 && cancelled_from_within != NULL)
        imp_query_cancel(cancelled_from_within);
    return ball_formula_include(self, region, out);
}

static imp_scene *crowd(const ball balls[CROWD], imp_surface_type *type)
{
    imp_scene *scene = scene_new();
    ck_assert_ptr_nonnull(scene);
    *type = ball_type;
    type->include = counting_include;
    for (int k = 0; k < CROWD; ++k)
        ck_assert_int_eq(spheres_add(scene, type, &balls[k]), IMP_SUCCESS);
    return scene;
}

static ball balls[CROWD];
static imp_surface_type type;

static imp_query *begin(imp_scene *scene, imp_options options)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static imp_result step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = imp_query_step(query, pairs, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query);
}

static imp_scene *fresh_crowd(void)
{
    for (int k = 0; k < CROWD; ++k) balls[k] = (ball){.radius = 1 + 1e-4 * k};
    atomic_store(&roots_made, 0);
    cancelled_from_within = NULL;
    return crowd(balls, &type);
}

static imp_result ask_crowd(imp_options (*limit)(imp_options))
{
    imp_scene *scene = fresh_crowd();
    imp_query *query = begin(scene, limit(imp_options_default(scene)));
    const imp_result r = step(query, 0);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_UNDECIDED);
    ck_assert_double_eq(r.t_lower, 0);
    ck_assert_uint_eq(r.stats.pairs, 0); /* all of it was before the first test */
    imp_query_free(query);
    imp_scene_free(scene);
    return r;
}

static imp_options no_time(imp_options o)
{
    o.max_seconds = 1e-9;
    return o;
}

static imp_options ten_pairs(imp_options o)
{
    o.max_pairs = 10;
    return o;
}

static imp_options a_megabyte(imp_options o)
{
    o.max_bytes = 3 << 19; /* the scene takes half a megabyte, the trees of 1000 balls one */
    return o;
}

START_TEST(a_limit_of_seconds_ends_a_query_before_the_first_tree)
{
    ck_assert_int_eq(ask_crowd(no_time).reason, IMP_REASON_SECONDS);
    ck_assert_int_eq(atomic_load(&roots_made), 0);
}
END_TEST

START_TEST(a_limit_of_pairs_ends_the_broad_phase)
{
    const imp_result r = ask_crowd(ten_pairs);
    ck_assert_int_eq(r.reason, IMP_REASON_PAIRS);
    /* half a million pairs would be 4 MB */
    ck_assert_uint_lt(r.stats.bytes, 2 << 20);
}
END_TEST

START_TEST(a_limit_of_bytes_counts_trees_and_candidate_pairs)
{
    const imp_result r = ask_crowd(a_megabyte);
    ck_assert_int_eq(r.reason, IMP_REASON_MEMORY);
    ck_assert_uint_lt(r.stats.bytes, 3 << 20);
}
END_TEST

static imp_options less_than_the_scene(imp_options o)
{
    o.max_bytes = CROWD * 300; /* a body's surface alone takes more */
    return o;
}

START_TEST(a_limit_of_bytes_counts_the_scene)
{
    ck_assert_int_eq(ask_crowd(less_than_the_scene).reason, IMP_REASON_MEMORY);
    ck_assert_int_eq(atomic_load(&roots_made), 0);
}
END_TEST

START_TEST(a_query_is_cancelled_while_its_trees_are_made_and_may_go_on)
{
    imp_scene *scene = fresh_crowd();
    imp_query *query = begin(scene, imp_options_default(scene));
    cancelled_from_within = query;
    const imp_result r = step(query, 0);
    ck_assert_int_eq(r.reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(atomic_load(&roots_made), 5);
    ck_assert_int_eq(step(query, 100).reason, IMP_REASON_RUNNING);
    ck_assert_uint_ge(imp_query_result(query).stats.pairs, 100);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_limited_query_answers_as_if_it_had_none_once_the_limit_is_far)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0, 0}, .velocity = {-2, 0, 0}};
    imp_scene *scene = spheres_scene(&ball_type, &a, &ball_type, &b);
    imp_options options = imp_options_default(scene);
    imp_query *free_query = begin(scene, options);
    options.max_pairs = 1u << 20;
    options.max_seconds = 3600;
    imp_query *limited = begin(scene, options);
    const imp_result r = step(free_query, 0), s = step(limited, 0);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && s.verdict == IMP_VERDICT_CONTACT && r.t == s.t);
    ck_assert_uint_eq(r.stats.pairs, s.stats.pairs);
    imp_query_free(free_query);
    imp_query_free(limited);
    imp_scene_free(scene);
}
END_TEST

/* --- Pairs, to the last one ------------------------------------------------------------------- */

enum { MOST = 50 };

/* Balls that meet, or pass each other closely. */
static imp_scene *passing(bool meet, ball both[2])
{
    both[0] = (ball){.radius = 1};
    both[1] = (ball){.radius = 1, .centre = {3, meet ? 1.9 : 2.03, 0.3}, .velocity = {-4, 0, 0}};
    imp_scene *scene = spheres_scene(&ball_type, &both[0], &ball_type, &both[1]);
    ck_assert_ptr_nonnull(scene);
    return scene;
}

static imp_result solve_and_refine(imp_scene *scene, uint64_t most)
{
    imp_options options = imp_options_default(scene);
    options.max_pairs = most;
    options.gamma = 1e-2;
    imp_query *query = begin(scene, options);
    const imp_result coarse = step(query, 0);
    ck_assert(most == 0 || coarse.stats.pairs <= most);
    if (coarse.verdict == IMP_VERDICT_CONTACT)
        ck_assert_int_eq(imp_query_refine(query, 1e-6, -1, NULL), IMP_SUCCESS);
    const imp_result r = step(query, 0);
    imp_query_free(query);
    return r;
}

static imp_clearance measure(imp_scene *scene, double required, uint64_t most)
{
    imp_clearance answer = {.struct_size = sizeof answer};
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_error error = {IMP_SUCCESS, ""};
    options.max_pairs = most;
    asked.required = required;
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    step(query, 0);
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, &error), IMP_SUCCESS);
    imp_query_free(query);
    return answer;
}

/* A limit of `most` pairs ends with exactly as many, and loses nothing. */
static void check_solved(imp_scene *scene, const imp_result *all, uint64_t most)
{
    const imp_result r = solve_and_refine(scene, most);
    ck_assert_uint_le(r.stats.pairs, most);
    if (r.reason == IMP_REASON_PAIRS) {
        ck_assert(r.stats.pairs == most && r.verdict == IMP_VERDICT_UNDECIDED);
        ck_assert(r.t_lower <= (all->verdict == IMP_VERDICT_CONTACT ? all->t : INFINITY));
    } else {
        ck_assert(r.verdict == all->verdict && r.stats.pairs == all->stats.pairs);
        ck_assert(r.verdict != IMP_VERDICT_CONTACT || (r.t == all->t && r.gap == all->gap));
    }
}

static void check_measured(imp_scene *scene, double required, const imp_clearance *all,
                           uint64_t most)
{
    const imp_clearance r = measure(scene, required, most);
    ck_assert_uint_le(r.stats.pairs, most);
    ck_assert(r.lower <= all->upper && r.upper >= all->lower);
    if (r.reason == IMP_REASON_PAIRS)
        ck_assert_uint_eq(r.stats.pairs, most);
    else
        ck_assert(r.lower == all->lower && r.upper == all->upper && r.t == all->t &&
                  r.stats.pairs == all->stats.pairs);
}

START_TEST(no_more_pairs_are_tested_than_max_pairs)
{
    static const double required[] = {0, 0.029};
    for (int meet = 0; meet < 2; ++meet) {
        ball both[2];
        imp_scene *scene = passing(meet, both);
        const imp_result solved = solve_and_refine(scene, 0);
        ck_assert_int_eq(solved.verdict, meet ? IMP_VERDICT_CONTACT : IMP_VERDICT_CLEAR);
        for (uint64_t most = 1; most <= MOST; ++most) check_solved(scene, &solved, most);
        for (int k = 0; k < 2; ++k) {
            const imp_clearance measured = measure(scene, required[k], 0);
            for (uint64_t most = 1; most <= MOST; ++most)
                check_measured(scene, required[k], &measured, most);
        }
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Steps and cancellations ------------------------------------------------------------------ */

START_TEST(a_step_of_as_many_pairs_as_there_are_numbers_goes_to_the_end)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0, 0}, .velocity = {-2, 0, 0}};
    imp_scene *scene = spheres_scene(&ball_type, &a, &ball_type, &b);
    imp_query *query = begin(scene, imp_options_default(scene));
    ck_assert_int_eq(step(query, 1).reason, IMP_REASON_RUNNING);
    ck_assert_int_eq(step(query, UINT64_MAX).verdict, IMP_VERDICT_CONTACT);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(each_cancellation_ends_one_step)
{
    static const ball a = {.radius = 1},
                      b = {.radius = 1, .centre = {3, 0, 0}, .velocity = {-2, 0, 0}};
    imp_scene *scene = spheres_scene(&ball_type, &a, &ball_type, &b);
    imp_query *query = begin(scene, imp_options_default(scene));
    imp_query_cancel(query);
    ck_assert_int_eq(step(query, 1).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(step(query, 1).reason, IMP_REASON_RUNNING);
    imp_query_cancel(query); /* after the last look of a step: kept for the next */
    ck_assert_int_eq(step(query, 0).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(step(query, 0).verdict, IMP_VERDICT_CONTACT);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

static imp_status lost_include(const void *self, const imp_region *region, imp_model out[3])
{
    (void)self, (void)region, (void)out;
    return IMP_STATUS_DOMAIN;
}

static void by_itself(void *context, void (*call)(void *of, size_t index), void *of, size_t count)
{
    (void)context;
    for (size_t k = 0; k < count; ++k) call(of, k);
}

/* What becomes of seven balls, of which the last cannot be bounded. */
static int outcome(uint64_t bytes, bool ahead)
{
    imp_surface_type lost = ball_type;
    ball some[7];
    lost.include = lost_include;
    imp_scene *scene = scene_new();
    for (int k = 0; k < 7; ++k) {
        some[k] = (ball){.radius = 1, .centre = {10 * k, 0, 0}};
        spheres_add(scene, k < 6 ? &ball_type : &lost, &some[k]);
    }
    imp_options options = imp_options_default(scene);
    options.max_bytes = bytes;
    if (ahead) options.parallel = by_itself;
    imp_query *query = begin(scene, options);
    const imp_code code = imp_query_step(query, 0, NULL);
    const imp_reason reason = imp_query_result(query).reason;
    imp_query_free(query);
    imp_scene_free(scene);
    return code != IMP_SUCCESS ? -1 : (int)reason;
}

START_TEST(a_limit_of_bytes_comes_before_an_error_whatever_is_made_ahead)
{
    bool both[2] = {false, false};
    for (uint64_t bytes = 1000; bytes < 40000; bytes += 500) {
        const int alone = outcome(bytes, false);
        ck_assert_int_eq(alone, outcome(bytes, true));
        both[alone == -1] = true;
    }
    ck_assert(both[0] && both[1]);
}
END_TEST

SUITE_MAIN("limits", a_limit_of_bytes_comes_before_an_error_whatever_is_made_ahead,
           a_limit_of_seconds_ends_a_query_before_the_first_tree,
           a_limit_of_pairs_ends_the_broad_phase, a_limit_of_bytes_counts_trees_and_candidate_pairs,
           a_limit_of_bytes_counts_the_scene,
           a_query_is_cancelled_while_its_trees_are_made_and_may_go_on,
           a_limited_query_answers_as_if_it_had_none_once_the_limit_is_far,
           no_more_pairs_are_tested_than_max_pairs,
           a_step_of_as_many_pairs_as_there_are_numbers_goes_to_the_end,
           each_cancellation_ends_one_step)
