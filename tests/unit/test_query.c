/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/unconst.h"
#include "tests/support/compose.h"
#include "tests/support/sphere_scenes.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>

#include <impinge/baseline.h>

/* The query as an object: begun, stepped, made finer, cancelled, freed; and what a scene of many
 * surfaces makes of it. */

static const ball at_rest = {.radius = 1};
static const ball flying = {.radius = 0.5, .centre = {2, 1.5, -1}, .velocity = {-2, -2, 1.2}};
static const ball elsewhere = {.radius = 0.5, .centre = {9, 9, 9}};

/* So nearly the same as the first that no search comes to an end. */
static const ball endless = {.radius = 1.000000002};

static imp_scene *two(const ball *a, const ball *b)
{
    return spheres_scene(&ball_type, a, &ball_type, b);
}

static imp_query *begin(imp_scene *scene, double gamma)
{
    imp_options options = imp_options_default(scene);
    options.t_start = 0, options.t_end = 1;
    options.gamma = gamma;
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static imp_result step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_query_step(query, pairs, &error) == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query);
}

static imp_result solve(imp_scene *scene, double gamma)
{
    imp_query *query = begin(scene, gamma);
    const imp_result r = step(query, 0);
    imp_query_free(query);
    return r;
}

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

SUITE_MAIN("query", structs_of_no_size_are_refused,
           programs_newer_than_the_library_run_and_are_told_what_it_does_not_know,
           progress_is_reported_and_may_end_the_step,
           options_out_of_range_are_refused_with_what_is_allowed,
           forms_of_the_baseline_there_are_not_are_refused, the_tolerances_in_force_are_told,
           a_query_that_never_stepped_knows_nothing_and_is_freed,
           steps_behind_the_end_change_nothing, a_step_is_about_as_long_as_asked_for,
           refining_takes_nothing_coarser, a_contact_made_finer_runs_again_and_clear_stays_clear,
           a_second_query_makes_no_node_that_the_first_has_made,
           queries_take_turns_on_the_same_trees, other_times_and_methods_have_trees_of_their_own,
           of_many_bodies_the_first_that_touch_are_told_as_each_is_ignored_in_turn,
           who_touches_later_costs_little, bodies_that_meet_none_cost_little_and_change_nothing,
           surfaces_of_one_body_are_not_tested_with_each_other,
           a_body_that_is_alone_is_clear_for_that_reason,
           bodies_that_never_exist_together_are_clear_for_that_reason,
           contact_is_no_earlier_than_both_exist,
           a_body_that_ends_before_the_other_arrives_is_clear, a_signal_handler_ends_a_step,
           another_thread_ends_a_step, a_query_cancelled_before_its_step_does_no_work_in_it)
