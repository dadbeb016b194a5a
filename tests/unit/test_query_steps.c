/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/ball_queries.h"

/* Queries that are stepped, made finer, cancelled and freed. */

/* So nearly the same as the first that no search comes to an end. */
static const ball endless = {.radius = 1.000000002};

/* --- Life ------------------------------------------------------------------------------------- */

START_TEST(a_query_that_never_stepped_knows_nothing_and_is_freed)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_query *query = begin(scene, 1e-3);
    const imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_RUNNING &&
              r.t_lower == 0);
    ck_assert(isnan(r.t) && isnan(r.gap) && !r.has_normal);
    ck_assert_uint_eq(r.stats.pairs, 0);
    ck_assert_uint_eq(r.stats.nodes, 0);
    imp_query_free(query);
    imp_query_free(NULL);
    imp_scene_free(scene);
    imp_scene_free(NULL);
}
END_TEST

START_TEST(steps_behind_the_end_change_nothing)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_query *query = begin(scene, 1e-3);
    const imp_result first = step(query, 0), again = step(query, 5);
    ck_assert_int_eq(first.verdict, IMP_VERDICT_CONTACT);
    ck_assert(first.t == again.t && first.stats.pairs == again.stats.pairs);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_step_is_about_as_long_as_asked_for)
{
    imp_scene *scene = two(&at_rest, &endless);
    imp_query *query = begin(scene, 1e-9);
    uint64_t pairs = 0;
    for (int k = 0; k < 50; ++k) {
        const imp_result r = step(query, 10);
        ck_assert_int_eq(r.reason, IMP_REASON_RUNNING);
        ck_assert_uint_ge(r.stats.pairs, pairs + 10);
        ck_assert_uint_le(r.stats.pairs, pairs + 12);
        pairs = r.stats.pairs;
    }
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(refining_takes_nothing_coarser)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_query *query = begin(scene, 1e-3);
    imp_error error = {IMP_SUCCESS, ""};
    const double bad[][2] = {{2e-3, -1}, {1e-3, 6e-4}, {0, -1},
                             {NAN, -1},  {1e-4, 1e-4}, {1e-4, NAN}};
    for (int k = 0; k < 6; ++k) {
        ck_assert_int_eq(imp_query_refine(query, bad[k][0], bad[k][1], &error), IMP_ERROR_USAGE);
        ck_assert_int_eq(imp_query_refine(query, bad[k][0], bad[k][1], NULL), IMP_ERROR_USAGE);
        ck_assert_ptr_nonnull(strstr(error.text, k < 2 ? "may not exceed" : "must be"));
    }
    const imp_result r = step(query, 0);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.gamma == 1e-3 && r.gamma_clear == 5e-4);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_contact_made_finer_runs_again_and_clear_stays_clear)
{
    imp_scene *scene = two(&at_rest, &flying);
    imp_query *query = begin(scene, 1e-2);
    const imp_result coarse = step(query, 0);
    ck_assert_int_eq(imp_query_refine(query, 1e-4, -1, NULL), IMP_SUCCESS);
    imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_RUNNING);
    ck_assert(r.t_lower == coarse.t_lower && isnan(r.t));
    r = step(query, 0);
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.gap <= 1e-4 && r.t > coarse.t);
    imp_query_free(query);
    imp_scene_free(scene);

    scene = two(&at_rest, &elsewhere);
    query = begin(scene, 1e-2);
    ck_assert_int_eq(step(query, 0).verdict, IMP_VERDICT_CLEAR);
    ck_assert_int_eq(imp_query_refine(query, 1e-4, 0, NULL), IMP_SUCCESS);
    r = step(query, 0);
    ck_assert(r.verdict == IMP_VERDICT_CLEAR && r.t_lower == 1 && r.gamma_clear == 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- Cancelling ------------------------------------------------------------------------------- */

static imp_query *_Atomic to_cancel;

static void on_alarm(int number)
{
    (void)number;
    imp_query_cancel(to_cancel);
}

static void check_cancelled(imp_query *query, imp_result r)
{
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_CANCELLED &&
              r.t_lower == 0);
    const uint64_t pairs = r.stats.pairs;
    r = step(query, 100); /* and may go on */
    ck_assert_int_eq(r.reason, IMP_REASON_RUNNING);
    ck_assert_uint_ge(r.stats.pairs, pairs + 100);
}

START_TEST(a_signal_handler_ends_a_step)
{
    imp_scene *scene = two(&at_rest, &endless);
    imp_query *query = begin(scene, 1e-9);
    to_cancel = query;
    signal(SIGALRM, on_alarm);
    const struct itimerval soon = {.it_value = {.tv_usec = 30000}};
    ck_assert_int_eq(setitimer(ITIMER_REAL, &soon, NULL), 0);
    check_cancelled(query, step(query, 0));
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

static void *cancel_soon(void *query)
{
    const struct timespec soon = {.tv_nsec = 30000000};
    nanosleep(&soon, NULL);
    imp_query_cancel(query);
    return NULL;
}

START_TEST(another_thread_ends_a_step)
{
    imp_scene *scene = two(&at_rest, &endless);
    imp_query *query = begin(scene, 1e-9);
    pthread_t thread;
    ck_assert_int_eq(pthread_create(&thread, NULL, cancel_soon, query), 0);
    check_cancelled(query, step(query, 0));
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_query_cancelled_before_its_step_does_no_work_in_it)
{
    imp_scene *scene = two(&at_rest, &endless);
    imp_query *query = begin(scene, 1e-9);
    imp_query_cancel(query);
    const imp_result r = step(query, 0);
    ck_assert_uint_eq(r.stats.pairs, 0);
    check_cancelled(query, r);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- Progress --------------------------------------------------------------------------------- */

typedef struct reports {
    uint64_t count, allowed;
    double t_lower, seconds;
} reports;

static bool take_report(void *context, const imp_progress *progress)
{
    reports *all = context;
    ck_assert(progress->struct_size == sizeof *progress);
    ck_assert(progress->t_lower >= all->t_lower && progress->seconds >= all->seconds);
    ck_assert(isnan(progress->lower) && isnan(progress->upper));
    all->t_lower = progress->t_lower;
    all->seconds = progress->seconds;
    return ++all->count < all->allowed;
}

START_TEST(progress_is_reported_and_may_end_the_step)
{
    imp_scene *scene = two(&at_rest, &endless);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-9;
    reports all = {.allowed = 3};
    options.progress = take_report;
    options.progress_context = &all;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_CANCELLED);
    ck_assert(all.count == 3);
    imp_scene_free(scene);
}
END_TEST

SUITE_MAIN("query_steps", progress_is_reported_and_may_end_the_step,
           a_query_that_never_stepped_knows_nothing_and_is_freed,
           steps_behind_the_end_change_nothing, a_step_is_about_as_long_as_asked_for,
           refining_takes_nothing_coarser, a_contact_made_finer_runs_again_and_clear_stays_clear,
           a_signal_handler_ends_a_step, another_thread_ends_a_step,
           a_query_cancelled_before_its_step_does_no_work_in_it)
