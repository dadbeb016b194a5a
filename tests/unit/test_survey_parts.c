/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tests/support/query_helpers.h"
#include "tests/support/suite.h"

/* Surveys of a part: two bodies, a range of values; at a smaller gamma; what each pair costs. */

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* A ball on an arm of length 1 that turns by a, one on an arm that turns by b about a point 2.7
 * away and comes nearer by 0.2 t, and a third that stays far from both. */
static imp_scene *arms(double lo, double hi)
{
    char text[1024];
    imp_error error;
    snprintf(text, sizeof text,
             "{\"parameters\":{\"a\":[-1,1],\"b\":[%g,%g]},\"bodies\":["
             "{\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.3,\"center\":[1,0,0]}],"
             "\"maps\":[{\"type\":\"rotate\",\"axis\":[0,0,1],\"rate\":1,\"clock\":\"a\"}]},"
             "{\"surfaces\":[{\"type\":\"sphere\",\"center\":[0,0,50]}]},"
             "{\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.3,\"center\":[-1,0,0]}],"
             "\"maps\":[{\"type\":\"rotate\",\"axis\":[0,0,1],\"rate\":1,\"clock\":\"b\"},"
             "{\"type\":\"translate\",\"offset\":[[2.7,0,0],[-0.2,0,0]]}]}]}",
             lo, hi);
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "s.json", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static imp_survey *begin(imp_scene *scene, double gamma, const imp_survey_options *how)
{
    imp_error error;
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    imp_survey *s = imp_survey_new(scene, &options, NULL, how, &error);
    ck_assert_msg(s != NULL, "%s", error.text);
    return s;
}

static imp_result go_on(imp_survey *s)
{
    imp_error error;
    imp_result found = {.struct_size = sizeof found};
    ck_assert_msg(imp_survey_step(s, 0, &error) == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(imp_survey_get_result(s, &found, &error), IMP_SUCCESS);
    return found;
}

START_TEST(a_part_of_the_values_is_answered_like_a_scene_that_has_only_these)
{
    const double lo[] = {-1, 0.25}, hi[] = {1, 0.5};
    imp_scene *all = arms(-1, 1), *part = arms(lo[1], hi[1]);
    imp_survey_options how = imp_survey_options_default();
    how.lo = lo, how.hi = hi;
    imp_survey *x = begin(all, 1e-2, &how), *y = begin(part, 1e-2, NULL);
    const imp_result of_x = go_on(x), of_y = go_on(y);
    double values[2];
    ck_assert_int_eq(of_x.verdict, IMP_VERDICT_CONTACT);
    ck_assert(memcmp(&of_x.t, &of_y.t, sizeof of_x.t) == 0);
    ck_assert_double_eq(of_x.t_lower, of_y.t_lower);
    ck_assert_uint_eq(of_x.stats.pairs, of_y.stats.pairs);
    ck_assert(imp_survey_values(x, values));
    ck_assert(values[1] >= lo[1] && values[1] <= hi[1]);
    imp_survey_free(x);
    imp_survey_free(y);
    imp_scene_free(all);
    imp_scene_free(part);
}
END_TEST

static const struct wrong_range {
    double lo[2], hi[2];
    bool has_lo, has_hi;
    const char *words;
} wrong[] = {
    {.lo = {-1, -1}, .hi = {1, 1}, .has_lo = true, .words = "one is NULL"},
    {.lo = {-1, -1}, .hi = {1, 1}, .has_hi = true, .words = "one is NULL"},
    {{-1, 0.5}, {1, 0.25}, true, true, "parameter 'b' got [0.5, 0.25]"},
    {{-1.5, -1}, {1, 1}, true, true, "parameter 'a' got [-1.5, 1]"},
    {{-1, -1}, {1, 1.5}, true, true, "must be a range within [-1, 1]"},
    {{-1, NAN}, {1, 1}, true, true, "parameter 'b'"},
    {{-1, -1}, {NAN, 1}, true, true, "parameter 'a'"},
};

START_TEST(a_range_that_is_not_in_the_scene_is_refused)
{
    imp_error error;
    imp_scene *scene = arms(-1, 1);
    const imp_options options = imp_options_default(scene);
    imp_survey_options how = imp_survey_options_default();
    if (wrong[_i].has_lo) how.lo = wrong[_i].lo;
    if (wrong[_i].has_hi) how.hi = wrong[_i].hi;
    ck_assert_ptr_null(imp_survey_new(scene, &options, NULL, &how, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    ck_assert_msg(strstr(error.text, wrong[_i].words) != NULL, "%s", error.text);
    imp_scene_free(scene);
}
END_TEST

/* The balls touch where 2.7 - 0.2 t - 2 = 0.6 + gap: at t = 0.5 - 5 gap. */
START_TEST(a_finer_survey_goes_on_to_what_a_new_one_finds)
{
    imp_error error;
    imp_scene *scene = arms(-1, 1);
    imp_survey *s = begin(scene, 0.05, NULL);
    const imp_result coarse = go_on(s);
    ck_assert_int_eq(coarse.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_ge(coarse.t, 0.25 - 1e-9);
    ck_assert_double_le(coarse.t, 0.375 + 1e-9);
    ck_assert_int_eq(imp_survey_refine(s, 0.02, -1, &error), IMP_SUCCESS);
    const imp_result fine = go_on(s);
    ck_assert_int_eq(fine.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq(fine.gamma, 0.02);
    ck_assert_double_le(fine.gap, 0.02);
    ck_assert_double_ge(fine.t, 0.4 - 1e-9);
    ck_assert_double_le(fine.t, 0.45 + 1e-9);
    ck_assert_double_eq(fine.t, fine.t_lower);
    ck_assert_int_eq(imp_survey_refine(s, 0.03, -1, &error), IMP_ERROR_USAGE);
    ck_assert_ptr_nonnull(strstr(error.text, "may not exceed those in force, 0.02 and 0.01"));
    ck_assert_int_eq(imp_survey_refine(s, 0.02, 0.03, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_survey_refine(s, NAN, -1, &error), IMP_ERROR_USAGE);
    ck_assert_double_eq(go_on(s).t, fine.t); /* what was refused changed nothing */
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

START_TEST(what_is_clear_stays_clear_at_a_finer_gamma)
{
    imp_error error;
    imp_scene *scene = arms(0.6, 0.7);
    imp_survey *s = begin(scene, 0.02, NULL);
    const imp_result coarse = go_on(s);
    ck_assert_int_eq(coarse.verdict, IMP_VERDICT_CLEAR);
    ck_assert_int_eq(imp_survey_refine(s, 0.01, -1, &error), IMP_SUCCESS);
    const imp_result fine = go_on(s);
    ck_assert_int_eq(fine.verdict, IMP_VERDICT_CLEAR);
    ck_assert_uint_eq(fine.stats.pairs, coarse.stats.pairs);
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_survey_of_a_clearance_is_not_refined)
{
    imp_error error;
    imp_scene *scene = arms(-1, 1);
    const imp_options options = imp_options_default(scene);
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_survey *s = imp_survey_new(scene, &options, &asked, NULL, &error);
    ck_assert_int_eq(imp_survey_refine(s, 1e-9, -1, &error), IMP_ERROR_USAGE);
    ck_assert_ptr_nonnull(strstr(error.text, "asks for a minimum distance"));
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

START_TEST(costs_of_the_pairs_of_bodies_add_up)
{
    imp_error error;
    imp_scene *scene = arms(-1, 1);
    imp_survey *s = begin(scene, 0.05, NULL);
    const imp_result found = go_on(s);
    imp_survey_state state = {.struct_size = sizeof state};
    imp_survey_get_state(s, &state, &error);
    imp_survey_cost cost = {.struct_size = sizeof cost};
    uint64_t boxes = 0, pairs = 0, cuts[2];
    double proved = 0;
    for (size_t k = 0; k < state.pairs_of_bodies; ++k) {
        ck_assert_int_eq(imp_survey_get_cost(s, k, &cost, &error), IMP_SUCCESS);
        boxes += cost.boxes, pairs += cost.pairs, proved += cost.proved;
    }
    imp_survey_cuts(s, cuts);
    ck_assert_uint_gt(boxes, state.pairs_of_bodies);
    ck_assert_uint_eq(boxes, state.boxes);
    ck_assert_uint_eq(pairs, found.stats.pairs);
    ck_assert_double_eq_tol(proved, state.proved * (double)state.pairs_of_bodies, 1e-12);
    ck_assert_uint_gt(cuts[0] + cuts[1], 0);
    ck_assert_uint_le(cuts[0] + cuts[1], boxes);
    ck_assert_int_eq(imp_survey_get_cost(s, state.pairs_of_bodies, &cost, &error), IMP_ERROR_USAGE);
    imp_survey_free(s);
    imp_scene_free(scene);
}
END_TEST

static const char TITLE[] = "survey_parts";

int main(void)
{
    TCase *tcase = tcase_create(TITLE);
    Suite *suite = suite_create(TITLE);
    tcase_set_timeout(tcase, 300);
    tcase_add_checked_fixture(tcase, open_registry, close_registry);
    tcase_add_test(tcase, a_part_of_the_values_is_answered_like_a_scene_that_has_only_these);
    tcase_add_loop_test(tcase, a_range_that_is_not_in_the_scene_is_refused, 0,
                        sizeof wrong / sizeof *wrong);
    tcase_add_test(tcase, a_finer_survey_goes_on_to_what_a_new_one_finds);
    tcase_add_test(tcase, what_is_clear_stays_clear_at_a_finer_gamma);
    tcase_add_test(tcase, a_survey_of_a_clearance_is_not_refined);
    tcase_add_test(tcase, costs_of_the_pairs_of_bodies_add_up);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
