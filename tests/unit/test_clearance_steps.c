/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/clearance_helpers.h"

/* Clearances in steps, under budgets, cancelled; and questions that are refused. */

/* --- Steps and budgets ------------------------------------------------------------------------ */

static void check_same(const imp_clearance *x, const imp_clearance *y)
{
    ck_assert(x->reason == y->reason && x->lower == y->lower && x->upper == y->upper &&
              x->t == y->t && x->a.u == y->a.u && x->b.v == y->b.v);
    ck_assert_uint_eq(x->stats.pairs, y->stats.pairs);
    ck_assert_uint_eq(x->stats.witness_searches, y->stats.witness_searches);
}

/* Whatever the steps, the bracket narrows to the same bits. */
static void step_any_size(imp_registry *registry, const ladder *l)
{
    imp_scene *whole = scene_told(registry, l->about);
    const imp_options options = before_contact(whole, l);
    const imp_clearance_options asked = imp_clearance_options_default();
    const imp_clearance known = measure(whole, &options, &asked);
    const uint64_t sizes[] = {1, 7, 64};
    for (int k = 0; k < 3; ++k) {
        imp_scene *scene = scene_told(registry, l->about);
        imp_query *query = begin(scene, &options, &asked);
        imp_clearance now = read_answer(query, 0);
        ck_assert(now.lower == 0 && now.upper == INFINITY && now.reason == IMP_REASON_RUNNING);
        while (now.reason == IMP_REASON_RUNNING) {
            const imp_clearance before = now;
            step(query, sizes[k]);
            now = read_answer(query, 0);
            check_answer_itself(scene, &now, asked.tolerance, options.gamma);
            ck_assert(now.upper <= before.upper && now.lower <= known.upper &&
                      now.upper >= known.lower);
        }
        check_same(&now, &known);
        imp_query_free(query);
        imp_scene_free(scene);
    }
    imp_scene_free(whole);
}

START_TEST(steps_of_any_size_lead_to_the_same_bits) { for_each_setting(step_any_size); }
END_TEST

START_TEST(a_budget_that_ends_leaves_a_true_bracket)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_clearance_options asked = imp_clearance_options_default();
    int ended = 0;
    for (uint64_t pairs = 1; pairs < 40; ++pairs) {
        imp_options options = imp_options_default(scene);
        options.max_pairs = pairs;
        const imp_clearance r = measure(scene, &options, &asked);
        ck_assert(r.lower <= 0.5 && r.upper >= 0.5 * (1 - 1e-15));
        ck_assert(r.reason == IMP_REASON_PAIRS || r.reason == IMP_REASON_NONE);
        ended += r.reason == IMP_REASON_PAIRS;
    }
    ck_assert(ended > 0 && ended < 39);
    imp_options options = imp_options_default(scene);
    options.max_seconds = 1e-9;
    ck_assert_int_eq(measure(scene, &options, &asked).reason, IMP_REASON_SECONDS);
    options = imp_options_default(scene);
    options.max_bytes = 1;
    ck_assert_int_eq(measure(scene, &options, &asked).reason, IMP_REASON_MEMORY);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

static bool never_on(void *context, const imp_progress *progress)
{
    imp_progress *kept = context;
    *kept = *progress;
    return false;
}

START_TEST(cancelled_or_ended_by_progress_it_goes_on_when_asked)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_options options = imp_options_default(scene);
    imp_query *query = begin(scene, &options, &asked);
    imp_query_cancel(query);
    ck_assert_int_eq(step(query, 0), IMP_REASON_CANCELLED);
    ck_assert_int_eq(read_answer(query, 0).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    const imp_clearance done = read_answer(query, 0);
    imp_query_free(query);
    imp_progress progress = {.reason = IMP_REASON_NONE};
    options.progress = never_on;
    options.progress_context = &progress;
    query = begin(scene, &options, &asked);
    ck_assert_int_eq(step(query, 0), IMP_REASON_CANCELLED);
    ck_assert(progress.reason == IMP_REASON_RUNNING && isnan(progress.t_lower));
    while (step(query, 0) != IMP_REASON_NONE) {
    }
    const imp_clearance again = read_answer(query, 0);
    ck_assert(again.lower == done.lower && again.upper == done.upper);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* Bodies a and b, b and c, and b and d come as near as 1, 1 and sqrt(9.25) - 2, which is
 * 1.04. */
START_TEST(what_never_comes_within_a_distance_is_not_measured)
{
    const size_t body[][2] = {{0, 1}, {1, 2}, {1, 3}};
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of_three(registry);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.each = true;
    asked.within = 1.5;
    imp_query *query = begin(scene, &options, &asked);
    ck_assert_uint_eq(imp_clearance_count(query), 0);
    ck_assert_int_eq(step(query, 0), IMP_REASON_NONE);
    ck_assert_uint_eq(imp_clearance_count(query), 3);
    for (size_t k = 0; k < 3; ++k) {
        const imp_clearance r = read_answer(query, k);
        ck_assert(r.body[0] == body[k][0] && r.body[1] == body[k][1]);
        ck_assert(r.reason == IMP_REASON_NONE && r.lower > 0.999 && r.upper < 1.05);
    }
    imp_query_free(query);
    asked.each = false;
    const double within[] = {0.5, 0.9999, 1.0001, 9};
    for (int k = 0; k < 4; ++k) {
        asked.within = within[k];
        asked.required = asked.within < 1 ? within[k] : 0;
        query = begin(scene, &options, &asked);
        step(query, 0);
        const imp_clearance r = read_answer(query, 0);
        ck_assert_int_eq(r.reason, within[k] < 1 ? IMP_REASON_DECIDED : IMP_REASON_NONE);
        ck_assert(within[k] < 1 ? r.lower == within[k] : r.lower > 0.999 && r.lower <= 1);
        if (within[k] < 1) ck_assert_int_eq(r.verdict, IMP_REQUIREMENT_HOLDS);
        imp_query_free(query);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* --- What cannot be asked --------------------------------------------------------------------- */

START_TEST(wrong_questions_are_refused_by_name)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, still, passing);
    const struct {
        double tolerance, required;
        uint64_t slices;
        const char *name;
        double within;
    } wrong[] = {{0, 0, 1, "tolerance", 0},       {1e-10, 0, 1, "tolerance", 0},
                 {1, 0, 1, "tolerance", 0},       {NAN, 0, 1, "tolerance", 0},
                 {1e-3, -1, 1, "required", 0},    {1e-3, INFINITY, 1, "required", 0},
                 {1e-3, NAN, 1, "required", 0},   {1e-3, 0, 0, "slices", 0},
                 {1e-3, 0, 1000001, "slices", 0}, {1e-3, 0, 1, "within", -1},
                 {1e-3, 0, 1, "within", NAN},     {1e-3, 0, 1, "within", INFINITY},
                 {1e-3, 2, 1, "within", 1}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        imp_clearance_options asked = imp_clearance_options_default();
        imp_options options = imp_options_default(scene);
        imp_error error = {IMP_SUCCESS, ""};
        asked.tolerance = wrong[k].tolerance;
        asked.required = wrong[k].required;
        asked.slices = wrong[k].slices;
        asked.within = wrong[k].within;
        ck_assert_ptr_null(imp_clearance_new(scene, &options, &asked, &error));
        ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, wrong[k].name));
    }
    imp_options options = imp_options_default(scene);
    options.baseline = IMP_BASELINE_BOXES;
    ck_assert_ptr_null(imp_clearance_new(scene, &options, NULL, NULL));
    options = imp_options_default(scene);
    imp_query *query = begin(scene, &options, NULL);
    imp_clearance answer = {.struct_size = 4};
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_ERROR_USAGE);
    answer.struct_size = (uint32_t)sizeof answer;
    ck_assert_int_eq(imp_clearance_get(query, 1, &answer, NULL), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_query_refine(query, 1e-9, -1, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    query = imp_query_new(scene, &options, NULL);
    ck_assert_uint_eq(imp_clearance_count(query), 0);
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_ERROR_USAGE);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("clearance_steps", steps_of_any_size_lead_to_the_same_bits,
           a_budget_that_ends_leaves_a_true_bracket,
           cancelled_or_ended_by_progress_it_goes_on_when_asked,
           what_never_comes_within_a_distance_is_not_measured, wrong_questions_are_refused_by_name)
