/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/isolated_bowl.h"

/* Crashes, hangs, forks and kills of the processes that serve types. */

START_TEST(a_crash_costs_an_answer_and_every_later_one)
{
    isolated *i = isolated_bowl(CRASH_IN_EVAL, IMP_STATUS_OK);
    const imp_surface_type *type = isolate_surface_type(i);
    double p[3] = {0, 0, 0}, x[3];
    imp_rate_matrix rates;
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    ck_assert_int_eq(type->rate(i, &r, &rates), IMP_STATUS_OK);
    ck_assert_int_eq(type->eval(i, 1, p, x, NULL), SURFACE_CRASHED);
    ck_assert_int_eq(type->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    i = isolated_bowl(EXIT_IN_RATE, IMP_STATUS_OK);
    ck_assert_int_eq(isolate_surface_type(i)->rate(i, &r, &rates), SURFACE_CRASHED);
    isolate_destroy(i);
    isolate_destroy(isolated_bowl(CRASH_IN_CREATE, SURFACE_CRASHED));
}
END_TEST

START_TEST(a_call_that_never_comes_back_is_ended_in_time)
{
    isolated *i = isolated_bowl(HANG_IN_EVAL, IMP_STATUS_OK);
    double p[3] = {0, 0, 0}, x[3];
    ck_assert_int_eq(isolate_surface_type(i)->eval(i, 1, p, x, NULL), SURFACE_HUNG);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_changed_floating_point_mode_is_seen_there_too)
{
#if defined(__x86_64__)
    isolated *i = isolated_bowl(TRAP_IN_INCLUDE, IMP_STATUS_OK);
    const imp_region r = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    imp_model m[3];
    ck_assert_int_eq(isolate_surface_type(i)->include(i, &r, m), SURFACE_CHANGED_MODE);
    isolate_destroy(i);
#endif
}
END_TEST

START_TEST(no_child_is_left_behind)
{
    for (int k = 0; k < 20; ++k)
        isolate_destroy(isolated_bowl(k % 2 ? CRASH_IN_EVAL : 0, IMP_STATUS_OK));
    isolate_destroy(isolated_bowl(EXIT_IN_DESTROY, IMP_STATUS_OK));
    worker_pool_free(pool);
    pool = NULL;
    ck_assert_int_eq(waitpid(-1, NULL, WNOHANG), -1);
}
END_TEST

START_TEST(an_innocent_instance_is_lost_and_a_new_one_is_served)
{
    double x[3];
    isolated *innocent = isolated_bowl(0, IMP_STATUS_OK),
             *guilty = isolated_bowl(CRASH_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(guilty, x), SURFACE_CRASHED);
    ck_assert_int_eq(eval_at_zero(innocent, x), SURFACE_LOST);
    ck_assert_int_eq(eval_at_zero(guilty, x), SURFACE_CRASHED);
    isolated *fresh = isolated_bowl(0, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(fresh, x), IMP_STATUS_OK);
    isolate_destroy(guilty);
    isolate_destroy(innocent);
    ck_assert_int_eq(eval_at_zero(fresh, x), IMP_STATUS_OK);
    isolate_destroy(fresh);
}
END_TEST

START_TEST(a_copy_of_the_host_is_refused_and_ends_nothing)
{
    double x[3];
    isolated *i = isolated_bowl(0, IMP_STATUS_OK);
    const pid_t copy = fork();
    if (copy == 0) {
        const imp_status status = eval_at_zero(i, x);
        isolated *fresh = isolate_surface(pool, &bowl);
        imp_create_error why = {.struct_size = sizeof why};
        const imp_value value = {.count = 1, .number = x};
        const imp_status created = isolate_create(fresh, &value, &why);
        isolate_destroy(i);
        worker_pool_free(pool);
        _exit(status == SURFACE_FORKED && created == SURFACE_NO_PROCESS ? 0 : 1);
    }
    int end;
    ck_assert_int_eq(waitpid(copy, &end, 0), copy);
    ck_assert_int_eq(end, 0);
    ck_assert_int_eq(eval_at_zero(i, x), IMP_STATUS_OK);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_callback_that_forks_and_returns_gives_one_answer)
{
    isolated *i = isolated_bowl(FORK_IN_EVAL, IMP_STATUS_OK);
    for (int k = 0; k < 200; ++k) {
        const double p[3] = {0.001 * k, 0, k};
        double x[3], expected[3];
        ck_assert_int_eq(isolate_surface_type(i)->eval(i, 1, p, x, NULL), IMP_STATUS_OK);
        bowl_formula_eval(NULL, 1, p, expected, NULL);
        ck_assert_mem_eq(x, expected, sizeof x);
    }
    isolate_destroy(i);
}
END_TEST

static void *make_in_thread(void *unused)
{
    (void)unused;
    return isolated_bowl(0, IMP_STATUS_OK);
}

START_TEST(an_instance_outlives_the_thread_that_made_it)
{
    pthread_t thread;
    void *made;
    double x[3];
    ck_assert_int_eq(pthread_create(&thread, NULL, make_in_thread, NULL), 0);
    ck_assert_int_eq(pthread_join(thread, &made), 0);
    usleep(20000); /* a signal at the thread's end would have come */
    ck_assert_int_eq(eval_at_zero(made, x), IMP_STATUS_OK);
    isolate_destroy(made);
}
END_TEST

START_TEST(the_process_ends_with_its_host)
{
    ck_assert_int_eq(prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
    const pid_t host = fork();
    if (host == 0) {
        worker_pool_free(pool);
        open_pool();
        double x[3];
        _exit(eval_at_zero(isolated_bowl(FORK_IN_EVAL, IMP_STATUS_OK), x) == IMP_STATUS_OK ? 0 : 1);
    }
    int end;
    ck_assert_int_eq(waitpid(host, &end, 0), host);
    ck_assert_int_eq(end, 0);
    for (pid_t ended; (ended = wait(&end)) > 0;) /* until there is no descendant any more */
        ck_assert_int_ne(ended, host);
}
END_TEST

START_TEST(memory_is_limited)
{
    double x[3];
    isolated *i = isolated_bowl(ALLOCATE_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), IMP_STATUS_INTERNAL);
    isolate_destroy(i);
}
END_TEST

START_TEST(a_thread_that_ends_itself_is_a_crash)
{
    double x[3];
    isolated *i = isolated_bowl(THREAD_EXIT_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_CRASHED);
    isolate_destroy(i);
}
END_TEST

START_TEST(what_is_killed_or_stopped_from_outside_is_not_blamed)
{
    double x[3];
    isolated *i = isolated_bowl(KILLED_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_KILLED);
    isolate_destroy(i);
    i = isolated_bowl(STOPPED_IN_EVAL, IMP_STATUS_OK);
    ck_assert_int_eq(eval_at_zero(i, x), SURFACE_KILLED);
    isolate_destroy(i);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_crash_costs_an_answer_and_every_later_one,
        a_call_that_never_comes_back_is_ended_in_time,
        a_changed_floating_point_mode_is_seen_there_too,
        no_child_is_left_behind,
        an_innocent_instance_is_lost_and_a_new_one_is_served,
        a_copy_of_the_host_is_refused_and_ends_nothing,
        a_callback_that_forks_and_returns_gives_one_answer,
        an_instance_outlives_the_thread_that_made_it,
        the_process_ends_with_its_host,
        memory_is_limited,
        a_thread_that_ends_itself_is_a_crash,
        what_is_killed_or_stopped_from_outside_is_not_blamed,
    };
    return suite_main_with("isolate_faults", tests, sizeof tests / sizeof *tests, open_pool,
                           close_pool);
}
