/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

#include <pthread.h>

/* Several threads at once, with one registry and one scene: every answer is that of a thread which
 * has the scene to itself, bit for bit. Fit for ThreadSanitizer. */

enum { THREADS = 6, QUESTIONS = 4 };

/* Whose nodes have no nets, and have nets. */
static const char *const turning[2] = {
    "superellipsoid ! rotate axis=1,0.2,0 rate=2",
    "torus ! rotate axis=0,1,1 rate=3 ! translate offset=[[2.7,0.2,0],[-1,0,0]]"};
#define PATCH(Z, BULGE)                                                                            \
    "bezier degree=[2,2] points=[[-1,-1," Z "],[-1,0.2," Z "],[-1,1," Z "],[0,-1," Z "],"          \
    "[0.1,0," BULGE "],[0,1," Z "],[1,-1," Z "],[1,0.1," Z "],[1,1.2," Z "]]"
static const char *const bending[2] = {
    PATCH("0", "1.1") " velocities=[[0,0,0.2],[0,0,0],[0,0,0],[0.1,0,0],[0,0,1],[0,0,0],[0,0,0],"
                      "[0,0,0],[0,0,-0.3]]",
    PATCH("2", "0.7") " ! translate velocity=0.1,0.2,-2"};

static imp_scene *scene_of(imp_registry *registry, const char *const texts[2])
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, texts[0], texts[1], &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* --- One thread's questions ------------------------------------------------------------------- */

typedef struct answers {
    imp_result contact[QUESTIONS];
    imp_clearance clearance;
    double point[3];
    bool good; /* checked by the main thread: Check's assertions belong to it */
} answers;

/* At different tolerances and over different times, whose trees are different ones. */
static bool ask_contact_number(imp_scene *scene, int k, imp_result *answer)
{
    imp_options options = imp_options_default(scene);
    options.gamma = k % 2 == 0 ? 1e-4 : 1e-8;
    options.t_end = k < 2 ? 1 : 0.375;
    answer->struct_size = sizeof *answer;
    return imp_scene_solve(scene, &options, answer, NULL) == IMP_SUCCESS;
}

static bool ask_clearance(imp_scene *scene, imp_clearance *answer)
{
    imp_options options = imp_options_default(scene);
    options.t_end = 0.375;
    imp_query *query = imp_clearance_new(scene, &options, NULL, NULL);
    *answer = (imp_clearance){.struct_size = (uint32_t)sizeof *answer};
    const bool good = query != NULL && imp_query_step(query, 0, NULL) == IMP_SUCCESS &&
                      imp_clearance_get(query, 0, answer, NULL) == IMP_SUCCESS;
    imp_query_free(query);
    return good;
}

/* All questions, the one of that number first. */
static void ask_all(imp_scene *scene, int first, answers *to)
{
    const double p[3] = {0.25, 0.5, 0.125};
    to->good = true;
    for (int n = 0; n < QUESTIONS; ++n) {
        const int k = (first + n) % QUESTIONS;
        to->good = ask_contact_number(scene, k, &to->contact[k]) && to->good;
    }
    to->good = ask_clearance(scene, &to->clearance) && to->good;
    to->good = imp_scene_eval(scene, 1, 0, 1, p, to->point, NULL, NULL) == IMP_SUCCESS && to->good;
}

static void same_side(const imp_side *x, const imp_side *y)
{
    ck_assert_uint_eq(x->body, y->body);
    ck_assert_double_eq(x->u, y->u);
    ck_assert_double_eq(x->v, y->v);
    ck_assert_double_eq(query_distance(x->point, y->point), 0);
}

static void same_answers(const answers *x, const answers *y)
{
    ck_assert(x->good && y->good);
    for (int k = 0; k < QUESTIONS; ++k) {
        const imp_result *r = &x->contact[k], *s = &y->contact[k];
        ck_assert_int_eq(r->verdict, s->verdict);
        ck_assert_double_eq(r->t_lower, s->t_lower);
        ck_assert_uint_eq(r->stats.pairs, s->stats.pairs);
        if (r->verdict != IMP_VERDICT_CONTACT) continue;
        ck_assert_double_eq(r->gap, s->gap);
        same_side(&r->a, &s->a);
        same_side(&r->b, &s->b);
    }
    ck_assert_double_eq(x->clearance.lower, y->clearance.lower);
    ck_assert_double_eq(x->clearance.upper, y->clearance.upper);
    ck_assert_double_eq(x->clearance.t, y->clearance.t);
    same_side(&x->clearance.a, &y->clearance.a);
    ck_assert_double_eq(query_distance(x->point, y->point), 0);
}

/* --- All threads ------------------------------------------------------------------------------ */

typedef struct worker {
    pthread_t thread;
    pthread_barrier_t *start;
    imp_registry *registry;
    const char *const *texts;
    imp_scene *scene; /* of the texts; NULL: makes its own */
    int number;
    answers answers;
} worker;

static void *run(void *context)
{
    worker *w = context;
    pthread_barrier_wait(w->start);
    imp_scene *own =
        w->scene == NULL ? imp_scene_from_pair(w->registry, w->texts[0], w->texts[1], NULL) : NULL;
    ask_all(w->scene != NULL ? w->scene : own, w->number, &w->answers);
    imp_scene_free(own);
    return NULL;
}

/* The answers of all threads are those of a scene that no thread has used before. */
static void all_at_once(imp_registry *registry, const char *const texts[2], imp_scene *scene)
{
    worker workers[THREADS];
    answers alone;
    imp_scene *fresh = scene_of(registry, texts);
    ask_all(fresh, 0, &alone);
    imp_scene_free(fresh);
    ck_assert_int_eq(alone.contact[0].verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_eq(alone.contact[2].verdict, IMP_VERDICT_CLEAR);
    pthread_barrier_t start;
    pthread_barrier_init(&start, NULL, THREADS);
    for (int k = 0; k < THREADS; ++k) {
        workers[k] = (worker){
            .start = &start, .registry = registry, .texts = texts, .scene = scene, .number = k};
        ck_assert_int_eq(pthread_create(&workers[k].thread, NULL, run, &workers[k]), 0);
    }
    for (int k = 0; k < THREADS; ++k) pthread_join(workers[k].thread, NULL);
    pthread_barrier_destroy(&start);
    for (int k = 0; k < THREADS; ++k) same_answers(&alone, &workers[k].answers);
}

static void share_a_scene(const char *const texts[2])
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, texts);
    all_at_once(registry, texts, scene);
    imp_scene_free(scene);
    imp_registry_free(registry);
}

START_TEST(threads_that_share_a_scene_get_the_answers_of_one_that_is_alone)
{
    share_a_scene(turning);
    share_a_scene(bending);
}
END_TEST

START_TEST(nodes_made_by_one_thread_are_not_made_again_by_the_next)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, turning);
    all_at_once(registry, turning, scene);
    answers after;
    ask_all(scene, 0, &after);
    for (int k = 0; k < QUESTIONS; ++k) ck_assert_uint_eq(after.contact[k].stats.nodes, 0);
    ck_assert_uint_eq(after.clearance.stats.nodes, 0);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

START_TEST(threads_that_share_a_registry_make_scenes_at_once)
{
    imp_registry *registry = query_registry();
    all_at_once(registry, bending, NULL);
    imp_registry_free(registry);
}
END_TEST

/* --- Cancelling ------------------------------------------------------------------------------- */

static void *cancel(void *context)
{
    imp_query_cancel(context);
    return NULL;
}

START_TEST(a_query_is_cancelled_by_another_thread)
{
    imp_registry *registry = query_registry();
    imp_scene *scene = scene_of(registry, turning);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    pthread_t thread;
    ck_assert_int_eq(pthread_create(&thread, NULL, cancel, query), 0);
    imp_reason reason = IMP_REASON_RUNNING;
    while (reason == IMP_REASON_RUNNING) { /* until it is decided or the thread has come to it */
        ck_assert_int_eq(imp_query_step(query, 1, NULL), IMP_SUCCESS);
        reason = imp_query_result(query).reason;
    }
    pthread_join(thread, NULL);
    ck_assert(reason == IMP_REASON_CANCELLED || reason == IMP_REASON_NONE);
    imp_query_free(query);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("threads", threads_that_share_a_scene_get_the_answers_of_one_that_is_alone,
           nodes_made_by_one_thread_are_not_made_again_by_the_next,
           threads_that_share_a_registry_make_scenes_at_once,
           a_query_is_cancelled_by_another_thread)
