/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/baseline.h>
#include <impinge/examine.h>

#include "tests/support/sphere_scenes.h"

/* Why pairs had to be divided: what is counted, and whom it blames. */

static const ball at_rest = {.radius = 1};
static const ball flying = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, -2, 1.2}};
static const ball inner = {.radius = 0.99};

static imp_query *begin(imp_scene *scene, double gamma, bool explains)
{
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.max_pairs = 20000;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    if (explains) ck_assert_int_eq(imp_query_explain(query, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    return query;
}

static uint64_t sum_of(const imp_explanation *row)
{
    uint64_t sum = 0;
    for (int k = 0; k < IMP_OBSTACLES; ++k) sum += row->by[k];
    return sum;
}

/* Explains a search of two balls of these types. */
static imp_explanation explained(const imp_surface_type *type_a, const ball *a,
                                 const imp_surface_type *type_b, const ball *b, double gamma)
{
    imp_explanation row;
    imp_scene *scene = spheres_scene(type_a, a, type_b, b);
    imp_query *query = begin(scene, gamma, true);
    ck_assert(imp_query_explanation(query, 0, &row));
    ck_assert(!imp_query_explanation(query, 1, &row));
    ck_assert(imp_query_explanation(query, 0, &row));
    ck_assert_uint_eq(row.tested, imp_query_result(query).stats.pairs);
    ck_assert_uint_eq(sum_of(&row), row.divided);
    ck_assert_uint_gt(row.divided, 0);
    ck_assert_uint_eq(row.body[1], 1);
    imp_query_free(query);
    imp_scene_free(scene);
    return row;
}

START_TEST(explaining_changes_neither_the_answer_nor_what_it_costs)
{
    imp_result r[2];
    for (int explains = 0; explains < 2; ++explains) {
        imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
        imp_query *query = begin(scene, 1e-6, explains);
        r[explains] = imp_query_result(query);
        imp_query_free(query);
        imp_scene_free(scene);
    }
    ck_assert_int_eq(r[0].verdict, IMP_VERDICT_CONTACT);
    ck_assert(r[0].t == r[1].t && r[0].gap == r[1].gap);
    ck_assert_uint_eq(r[0].stats.pairs, r[1].stats.pairs);
    ck_assert_uint_eq(r[0].stats.nodes, r[1].stats.nodes);
}
END_TEST

START_TEST(a_type_without_inclusions_is_blamed_on_its_side)
{
    imp_surface_type rates_only = ball_type;
    rates_only.include = NULL;
    const imp_explanation a = explained(&rates_only, &at_rest, &ball_type, &flying, 1e-3);
    ck_assert_str_eq(a.without_order_2[0], "ball");
    ck_assert_ptr_null(a.without_order_2[1]);
    ck_assert_uint_gt(2 * a.by[IMP_OBSTACLE_REMAINDER_A], a.divided);
    const imp_explanation b = explained(&ball_type, &at_rest, &rates_only, &flying, 1e-3);
    ck_assert_ptr_null(b.without_order_2[0]);
    ck_assert_uint_gt(2 * (b.by[IMP_OBSTACLE_REMAINDER_B] + b.by[IMP_OBSTACLE_TIME_B]), b.divided);
    ck_assert_uint_lt(10 * b.by[IMP_OBSTACLE_REMAINDER_A], b.divided);
}
END_TEST

START_TEST(good_inclusions_are_not_blamed)
{
    const imp_explanation row = explained(&ball_type, &at_rest, &ball_type, &flying, 1e-6);
    ck_assert_ptr_null(row.without_order_2[0]);
    ck_assert_uint_gt(2 * row.by[IMP_OBSTACLE_SIZE], row.divided);
}
END_TEST

START_TEST(surfaces_that_lie_along_each_other_lack_a_distance)
{
    const imp_explanation row = explained(&ball_type, &at_rest, &ball_type, &inner, 1e-3);
    ck_assert(!row.knows_distance[0] && !row.knows_distance[1]);
    ck_assert_uint_gt(3 * row.by[IMP_OBSTACLE_DISTANCE], row.divided);
}
END_TEST

START_TEST(what_was_not_counted_is_told_of_pairs_that_wait)
{
    imp_surface_type rates_only = ball_type;
    rates_only.include = NULL;
    imp_explanation row;
    imp_scene *scene = spheres_scene(&rates_only, &at_rest, &ball_type, &flying);
    imp_query *query = begin(scene, 1e-9, false);
    ck_assert_int_eq(imp_query_result(query).reason, IMP_REASON_PAIRS);
    ck_assert(imp_query_explanation(query, 0, &row));
    ck_assert_uint_eq(row.tested, 0);
    ck_assert(row.divided > 100 && row.divided <= 1000);
    ck_assert_uint_eq(sum_of(&row), row.divided);
    ck_assert_uint_gt(2 * row.by[IMP_OBSTACLE_REMAINDER_A], row.divided);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(what_a_limit_ends_of_a_clearance_is_told_of_pairs_that_wait)
{
    imp_surface_type rates_only = ball_type;
    rates_only.include = NULL;
    imp_scene *scene = spheres_scene(&rates_only, &at_rest, &ball_type, &inner);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-9;
    options.max_pairs = 5000;
    for (int requires = 0; requires < 2; ++requires) {
        imp_clearance_options asked = imp_clearance_options_default();
        imp_explanation row;
        asked.required = requires * 9.999e-3;
        asked.decide = requires;
        imp_query *query = imp_clearance_new(scene, &options, &asked, NULL);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_query_result(query).reason, IMP_REASON_PAIRS);
        ck_assert(imp_query_explanation(query, 0, &row));
        ck_assert(!imp_query_explanation(query, 1, &row));
        ck_assert(imp_query_explanation(query, 0, &row));
        ck_assert_uint_eq(row.tested, 0);
        ck_assert(row.divided > 10 && row.divided <= 1000);
        ck_assert_uint_eq(sum_of(&row), row.divided);
        ck_assert_uint_gt(2 * row.by[IMP_OBSTACLE_REMAINDER_A], row.divided);
        imp_query_free(query);
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(nothing_waits_once_a_clearance_is_known)
{
    imp_explanation row;
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    imp_options options = imp_options_default(scene);
    imp_query *query = imp_clearance_new(scene, &options, NULL, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert(imp_query_explanation(query, 0, &row));
    ck_assert_uint_eq(row.divided, 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(only_a_new_query_for_a_contact_by_models_is_explained)
{
    imp_error why;
    imp_explanation row;
    imp_scene *scene = spheres_scene(&ball_type, &at_rest, &ball_type, &flying);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-2;
    imp_query *clearance = imp_clearance_new(scene, &options, NULL, &why);
    ck_assert_int_eq(imp_query_explain(clearance, &why), IMP_ERROR_USAGE);
    ck_assert(!imp_query_explanation(clearance, 0, &row));
    imp_query_free(clearance);
    options.baseline = IMP_BASELINE_BOXES;
    imp_query *paper = imp_query_new(scene, &options, &why);
    ck_assert_int_eq(imp_query_explain(paper, &why), IMP_ERROR_USAGE);
    imp_query_free(paper);
    imp_query *stepped = begin(scene, 1e-2, false);
    ck_assert_int_eq(imp_query_explain(stepped, &why), IMP_ERROR_USAGE);
    imp_query_free(stepped);
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("explanation", explaining_changes_neither_the_answer_nor_what_it_costs,
           a_type_without_inclusions_is_blamed_on_its_side, good_inclusions_are_not_blamed,
           surfaces_that_lie_along_each_other_lack_a_distance,
           what_was_not_counted_is_told_of_pairs_that_wait,
           what_a_limit_ends_of_a_clearance_is_told_of_pairs_that_wait,
           nothing_waits_once_a_clearance_is_known,
           only_a_new_query_for_a_contact_by_models_is_explained)
