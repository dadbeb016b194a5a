/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/ball_queries.h"

/* The query as an object: options, structs that grow, trees that queries share. */

/* --- Options ---------------------------------------------------------------------------------- */

typedef struct wrong {
    const char *word; /* that the complaint begins with */
    imp_options options;
} wrong;

static void is_refused(imp_scene *scene, const wrong *w)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_result r = {.struct_size = sizeof r};
    ck_assert_ptr_null(imp_query_new(scene, &w->options, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    ck_assert_msg(strncmp(error.text, w->word, strlen(w->word)) == 0, "%s", error.text);
    ck_assert_ptr_nonnull(strstr(error.text, "must be"));
    ck_assert_ptr_null(imp_query_new(scene, &w->options, NULL));
    ck_assert_int_eq(imp_scene_solve(scene, &w->options, &r, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_scene_solve(scene, &w->options, &r, NULL), IMP_ERROR_USAGE);
}

START_TEST(options_out_of_range_are_refused_with_what_is_allowed)
{
    imp_scene *scene = two(&at_rest, &flying);
    const double bad_gamma[] = {0, -1, NAN, INFINITY}, bad_clearance[] = {1e-6, 1, NAN, INFINITY},
                 bad_seconds[] = {-1, NAN},
                 bad_time[][2] = {{1, 0},   {0, INFINITY}, {-INFINITY, 0},
                                  {NAN, 1}, {0, NAN},      {INFINITY, INFINITY}};
    for (int k = 0; k < 4; ++k) {
        wrong w = {"gamma", imp_options_default(scene)};
        w.options.gamma = bad_gamma[k];
        is_refused(scene, &w);
        w = (wrong){"gamma_clear", imp_options_default(scene)};
        w.options.gamma_clear = bad_clearance[k];
        is_refused(scene, &w);
    }
    for (int k = 0; k < 2; ++k) {
        wrong w = {"max_seconds", imp_options_default(scene)};
        w.options.max_seconds = bad_seconds[k];
        is_refused(scene, &w);
    }
    for (int k = 0; k < 6; ++k) {
        wrong w = {"time", imp_options_default(scene)};
        w.options.t_start = bad_time[k][0];
        w.options.t_end = bad_time[k][1];
        is_refused(scene, &w);
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(forms_of_the_baseline_there_are_not_are_refused)
{
    const uint32_t both = IMP_BASELINE_BOXES | IMP_BASELINE_SPHERES,
                   all_rates = IMP_BASELINE_COLUMN_RATES | IMP_BASELINE_CONSTANT_RATES;
    const uint32_t bad[] = {both, IMP_BASELINE_COLUMN_RATES, IMP_BASELINE_BOXES | all_rates, 16,
                            IMP_BASELINE_SPHERES | 1u << 31};
    imp_scene *scene = two(&at_rest, &flying);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        wrong w = {"baseline", imp_options_default(scene)};
        w.options.baseline = bad[k];
        is_refused(scene, &w);
    }
    imp_scene_free(scene);
}
END_TEST

START_TEST(the_tolerances_in_force_are_told)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_options options = imp_options_default(scene);
    options.gamma = 0.125;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.gamma == 0.125 && r.gamma_clear == 0.0625);
    options.gamma_clear = 0;
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.gamma == 0.125 && r.gamma_clear == 0);
    imp_scene_free(scene);
}
END_TEST

/* --- Trees are shared ------------------------------------------------------------------------- */

START_TEST(a_second_query_makes_no_node_that_the_first_has_made)
{
    imp_scene *scene = two(&at_rest, &flying);
    const imp_result first = solve(scene, 1e-6), second = solve(scene, 1e-6),
                     coarser = solve(scene, 1e-2), finer = solve(scene, 1e-8);
    ck_assert_uint_gt(first.stats.nodes, 2);
    ck_assert_uint_eq(second.stats.nodes, 0);
    ck_assert_uint_eq(coarser.stats.nodes, 0);
    ck_assert_uint_lt(finer.stats.nodes, first.stats.nodes);
    ck_assert(first.t == second.t && first.gap == second.gap && first.a.u == second.a.u);
    ck_assert_uint_eq(first.stats.pairs, second.stats.pairs);
    imp_scene_free(scene);
}
END_TEST

START_TEST(queries_take_turns_on_the_same_trees)
{
    imp_scene *scene = two(&at_rest, &flying), *alone = two(&at_rest, &flying);
    const imp_result expected = solve(alone, 1e-5);
    imp_query *queries[3];
    for (int k = 0; k < 3; ++k) queries[k] = begin(scene, 1e-5);
    uint64_t nodes = 0;
    for (int turn = 0; turn < 1000; ++turn) step(queries[turn % 3], 1 + (uint64_t)turn % 5);
    for (int k = 0; k < 3; ++k) {
        const imp_result r = step(queries[k], 0);
        ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.t == expected.t && r.a.u == expected.a.u);
        nodes += r.stats.nodes;
        imp_query_free(queries[k]);
    }
    ck_assert_uint_eq(nodes, expected.stats.nodes);
    imp_scene_free(scene);
    imp_scene_free(alone);
}
END_TEST

START_TEST(other_times_and_methods_have_trees_of_their_own)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_options options = imp_options_default(scene);
    options.gamma = 0.1;
    imp_result r = {.struct_size = sizeof r};
    for (int k = 0; k < 4; ++k) {
        if (k == 1) options.t_end = 2;
        if (k == 2) options.baseline = IMP_BASELINE_BOXES;
        if (k == 3) options.baseline = IMP_BASELINE_BOXES | IMP_BASELINE_COLUMN_RATES;
        if (k == 3) options.max_pairs = 100;
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert_uint_ge(r.stats.nodes, 2);
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert_uint_eq(r.stats.nodes, 0);
    }
    imp_scene_free(scene);
}
END_TEST

/* --- Structs that grow ------------------------------------------------------------------------ */

START_TEST(structs_of_no_size_are_refused)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_options options = imp_options_default(scene);
    imp_error error = {IMP_SUCCESS, ""};
    const uint32_t sizes[] = {0, 4, (uint32_t)sizeof options - 1, 5000, UINT32_MAX};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        options.struct_size = sizes[k];
        ck_assert_ptr_null(imp_query_new(scene, &options, &error));
        ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, "imp_options.struct_size: got "));
        ck_assert_int_eq(imp_options_get_default(scene, &options, NULL), IMP_ERROR_USAGE);
        imp_query *query = begin(scene, 1e-3);
        imp_result r = {.struct_size = sizes[k]};
        ck_assert_int_eq(imp_query_get_result(query, &r, NULL), IMP_ERROR_USAGE);
        imp_query_free(query);
    }
    imp_scene_free(scene);
}
END_TEST

/* The struct that a later header would have. */
typedef struct later_options {
    imp_options now;
    uint64_t later;
} later_options;
typedef struct later_result {
    imp_result now;
    uint64_t later;
} later_result;

START_TEST(programs_newer_than_the_library_run_and_are_told_what_it_does_not_know)
{
    imp_scene *scene = two(&at_rest, &flying);
    later_options options = {.later = 1};
    options.now.struct_size = sizeof options;
    ck_assert_int_eq(imp_options_get_default(scene, &options.now, NULL), IMP_SUCCESS);
    ck_assert(options.now.struct_size == sizeof options && options.later == 0);
    options.later = 1;
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_ptr_null(imp_query_new(scene, &options.now, &error));
    ck_assert_ptr_nonnull(strstr(error.text, "is older than the header"));
    options.later = 0;
    imp_query *query = imp_query_new(scene, &options.now, NULL);
    ck_assert_ptr_nonnull(query);
    step(query, 0);
    later_result r = {.now = {.struct_size = sizeof r}, .later = 1};
    ck_assert_int_eq(imp_query_get_result(query, &r.now, NULL), IMP_SUCCESS);
    ck_assert(r.now.struct_size == sizeof r && r.later == 0);
    ck_assert_int_eq(r.now.verdict, IMP_VERDICT_CONTACT);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("query", structs_of_no_size_are_refused,
           programs_newer_than_the_library_run_and_are_told_what_it_does_not_know,
           options_out_of_range_are_refused_with_what_is_allowed,
           forms_of_the_baseline_there_are_not_are_refused, the_tolerances_in_force_are_told,
           a_second_query_makes_no_node_that_the_first_has_made,
           queries_take_turns_on_the_same_trees, other_times_and_methods_have_trees_of_their_own)
