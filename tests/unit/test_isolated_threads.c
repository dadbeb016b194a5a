/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

/* Scenes whose types live in other processes, handed from thread to thread, shared by several, and
 * copied by fork: the answers are those of a scene that is not isolated, bit for bit, or an error.
 * Fit for ThreadSanitizer. */

enum { THREADS = 4 };

static const char *const a_text = "superellipsoid ! rotate axis=1,0.2,0 rate=2";
static const char *const b_text = "torus ! rotate axis=0,1,1 rate=3 ! translate velocity=-1,0,0";

static imp_registry *isolated_registry(void)
{
    imp_registry *registry = query_registry();
    ck_assert_int_eq(imp_registry_isolate(registry, NULL, NULL), IMP_SUCCESS);
    return registry;
}

static imp_scene *scene_in(imp_registry *registry)
{
    return imp_scene_from_pair(registry, a_text, b_text, NULL);
}

static imp_code ask_scene(imp_scene *scene, imp_result *answer)
{
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-4;
    answer->struct_size = sizeof *answer;
    return imp_scene_solve(scene, &options, answer, NULL);
}

/* Without isolation. */
static imp_result expected(void)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_in(registry);
    imp_result r;
    ck_assert_int_eq(ask_scene(scene, &r), IMP_SUCCESS);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    imp_scene_free(scene);
    imp_registry_free(registry);
    return r;
}

static bool is_same(const imp_result *x, const imp_result *y)
{
    return x->verdict == y->verdict && x->t == y->t && x->t_lower == y->t_lower &&
           x->gap == y->gap && x->a.u == y->a.u && x->a.v == y->a.v && x->b.u == y->b.u &&
           x->b.v == y->b.v && x->stats.pairs == y->stats.pairs;
}

/* --- Threads ---------------------------------------------------------------------------------- */

typedef struct job {
    pthread_t thread;
    imp_registry *registry;
    imp_scene *scene; /* NULL: makes its own, and leaves it to the main thread */
    imp_result answer;
    imp_code code;
} job;

static void *make(void *context)
{
    job *j = context;
    j->scene = scene_in(j->registry);
    return NULL;
}

static void *query(void *context)
{
    job *j = context;
    if (j->scene == NULL) make(j);
    j->code = j->scene != NULL ? ask_scene(j->scene, &j->answer) : IMP_ERROR_MEMORY;
    return NULL;
}

static void start(job *j, void *(*run)(void *))
{
    ck_assert_int_eq(pthread_create(&j->thread, NULL, run, j), 0);
}

static void await_answer(job *j, const imp_result *answer)
{
    pthread_join(j->thread, NULL);
    ck_assert_int_eq(j->code, IMP_SUCCESS);
    ck_assert(is_same(&j->answer, answer));
}

START_TEST(a_scene_made_by_a_thread_that_has_ended_answers_in_another)
{
    const imp_result answer = expected();
    job maker = {.registry = isolated_registry()};
    start(&maker, make);
    pthread_join(maker.thread, NULL);
    ck_assert_ptr_nonnull(maker.scene);
    job asker = {.scene = maker.scene};
    start(&asker, query);
    await_answer(&asker, &answer);
    imp_result r;
    ck_assert_int_eq(ask_scene(maker.scene, &r), IMP_SUCCESS);
    ck_assert(is_same(&r, &answer));
    imp_scene_free(maker.scene);
    imp_registry_free(maker.registry);
}
END_TEST

static void all_at_once(imp_registry *registry, imp_scene *shared)
{
    const imp_result answer = expected();
    job jobs[THREADS];
    for (int k = 0; k < THREADS; ++k) {
        jobs[k] = (job){.registry = registry, .scene = shared};
        start(&jobs[k], query);
    }
    for (int k = 0; k < THREADS; ++k) await_answer(&jobs[k], &answer);
    for (int k = 0; k < THREADS && shared == NULL; ++k) imp_scene_free(jobs[k].scene);
}

START_TEST(threads_that_share_an_isolated_scene_get_the_answers_of_one_that_is_alone)
{
    imp_registry *registry = isolated_registry();
    imp_scene *scene = scene_in(registry);
    all_at_once(registry, scene);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(threads_that_share_an_isolated_registry_make_scenes_at_once)
{
    imp_registry *registry = isolated_registry();
    all_at_once(registry, NULL);
    imp_registry_free(registry);
}
END_TEST

/* --- Copies of the process -------------------------------------------------------------------- */

/* Ends with 0 if the copy was refused, and could free all that it has. */
_Noreturn static void be_a_copy(imp_registry *registry, imp_scene *scene)
{
    imp_result r;
    const bool refused = ask_scene(scene, &r) == IMP_ERROR_USAGE;
    imp_scene_free(scene);
    imp_registry_free(registry);
    _exit(refused ? 0 : 1);
}

static void fork_copy(imp_registry *registry, imp_scene *scene)
{
    const pid_t copy = fork();
    if (copy == 0) be_a_copy(registry, scene);
    int end;
    ck_assert_int_eq(waitpid(copy, &end, 0), copy);
    ck_assert_int_eq(end, 0);
}

START_TEST(a_copy_made_by_fork_is_refused_and_the_original_goes_on)
{
    const imp_result answer = expected();
    imp_registry *registry = isolated_registry();
    imp_scene *scene = scene_in(registry);
    imp_result r;
    for (int k = 0; k < 2; ++k) { /* the second copy has trees of a query */
        fork_copy(registry, scene);
        ck_assert_int_eq(ask_scene(scene, &r), IMP_SUCCESS);
        ck_assert(is_same(&r, &answer));
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_thread_that_queries_is_not_disturbed_by_a_fork_in_another)
{
    const imp_result answer = expected();
    imp_registry *registry = isolated_registry();
    imp_scene *scene = scene_in(registry);
    job j = {.scene = scene};
    start(&j, query);
    for (int k = 0; k < 3; ++k) {
        const pid_t copy = fork();
        if (copy == 0) _exit(0);
        ck_assert_int_eq(waitpid(copy, NULL, 0), copy);
    }
    await_answer(&j, &answer);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* --- Cancelling ------------------------------------------------------------------------------- */

static void *cancel(void *context)
{
    imp_query_cancel(context);
    return NULL;
}

START_TEST(an_isolated_query_is_cancelled_by_another_thread)
{
    imp_registry *registry = isolated_registry();
    imp_scene *scene = scene_in(registry);
    const imp_options options = imp_options_default(scene);
    imp_query *q = imp_query_new(scene, &options, NULL);
    pthread_t thread;
    ck_assert_int_eq(pthread_create(&thread, NULL, cancel, q), 0);
    pthread_join(thread, NULL); /* before the step, which must see it */
    ck_assert_int_eq(imp_query_step(q, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(q).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(imp_query_step(q, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(q).verdict, IMP_VERDICT_CONTACT);
    imp_query_free(q);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("isolated_threads", a_scene_made_by_a_thread_that_has_ended_answers_in_another,
           threads_that_share_an_isolated_scene_get_the_answers_of_one_that_is_alone,
           threads_that_share_an_isolated_registry_make_scenes_at_once,
           a_copy_made_by_fork_is_refused_and_the_original_goes_on,
           a_thread_that_queries_is_not_disturbed_by_a_fork_in_another,
           an_isolated_query_is_cancelled_by_another_thread)
