/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/crowd.h"

/* A query that is lent threads answers as one without: verdicts, counts and bytes. Fit for
 * ThreadSanitizer. */

enum { BODIES = 600, THREADS = 3 }; /* whose roots are made once they are in pairs */

static imp_registry *registry;
static char *crowd;

static void open_crowd(void)
{
    registry = query_registry();
    crowd = crowd_text(BODIES, 7);
    ck_assert_ptr_nonnull(crowd);
}

static void close_crowd(void)
{
    free(crowd);
    imp_registry_free(registry);
}

/* Afresh, so that no tree is there yet. */
static imp_scene *fresh(void)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_json(registry, crowd, strlen(crowd), "crowd", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* --- Hosts ------------------------------------------------------------------------------------ */

typedef struct host {
    int lent;           /* how often threads were asked for */
    imp_query *cancels; /* this query, the second time */
} host;

typedef struct work {
    void (*work)(void *of, size_t index);
    void *of;
    size_t count;
    atomic_size_t taken;
} work;

/* The last first. */
static void *take_all(void *context)
{
    work *w = context;
    for (size_t k; (k = atomic_fetch_add(&w->taken, 1)) < w->count;)
        w->work(w->of, w->count - 1 - k);
    return NULL;
}

static void by_threads(void *context, void (*call)(void *of, size_t index), void *of, size_t count)
{
    host *h = context;
    pthread_t threads[THREADS];
    work w = {.work = call, .of = of, .count = count};
    if (++h->lent == 2) imp_query_cancel(h->cancels);
    for (int k = 0; k < THREADS; ++k)
        ck_assert_int_eq(pthread_create(&threads[k], NULL, take_all, &w), 0);
    for (int k = 0; k < THREADS; ++k) pthread_join(threads[k], NULL);
}

/* --- Answers ---------------------------------------------------------------------------------- */

static imp_options lend(const imp_scene *scene, host *h)
{
    imp_options options = imp_options_default(scene);
    options.parallel = by_threads;
    options.parallel_context = h;
    return options;
}

static void step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = imp_query_step(query, pairs, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
}

static void same(const imp_result *r, const imp_result *s)
{
    ck_assert_int_eq(r->verdict, s->verdict);
    ck_assert_int_eq(r->reason, s->reason);
    ck_assert_double_eq(r->t_lower, s->t_lower);
    ck_assert_uint_eq(r->stats.pairs, s->stats.pairs);
    ck_assert_uint_eq(r->stats.nodes, s->stats.nodes);
    ck_assert_uint_eq(r->stats.peak_heap, s->stats.peak_heap);
    if (r->reason != IMP_REASON_RUNNING) ck_assert_uint_eq(r->stats.bytes, s->stats.bytes);
    ck_assert_uint_eq(r->stats.witness_searches, s->stats.witness_searches);
    if (r->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert(r->a.body == s->a.body && r->b.body == s->b.body && r->a.u == s->a.u);
    ck_assert(r->gap == s->gap && memcmp(r->normal, s->normal, sizeof r->normal) == 0);
}

/* In steps of so many pairs; 0: in one. `count` of them, or until it is decided. */
static imp_result solve(imp_options (*choose)(imp_options), host *h, uint64_t pairs, int count)
{
    imp_scene *scene = fresh();
    imp_options options = choose(lend(scene, h));
    if (h == NULL) options.parallel = NULL;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    imp_result r;
    do {
        step(query, pairs);
        r = imp_query_result(query);
    } while (r.reason == IMP_REASON_RUNNING && --count > 0);
    imp_query_free(query);
    imp_scene_free(scene);
    return r;
}

static imp_options as_it_is(imp_options o) { return o; }

START_TEST(a_query_that_is_lent_threads_answers_and_counts_as_one_without)
{
    host h = {0};
    const imp_result alone = solve(as_it_is, NULL, 0, 1), lent = solve(as_it_is, &h, 0, 1);
    ck_assert_int_eq(alone.verdict, IMP_VERDICT_CONTACT);
    ck_assert_uint_gt(alone.stats.pairs, BODIES);
    ck_assert_int_ge(h.lent, 3); /* trees, sweep, first tests */
    same(&alone, &lent);
}
END_TEST

START_TEST(a_step_of_a_few_pairs_ends_where_it_does_without_threads)
{
    for (int steps = 1; steps < 40; steps += 13) {
        host h = {0};
        const imp_result alone = solve(as_it_is, NULL, 37, steps);
        const imp_result lent = solve(as_it_is, &h, 37, steps);
        ck_assert_int_eq(alone.reason, IMP_REASON_RUNNING);
        same(&alone, &lent);
    }
}
END_TEST

static imp_options paper(imp_options o)
{
    o.baseline = IMP_BASELINE_BOXES;
    o.max_pairs = 90000; /* more than there can be candidates */
    return o;
}

START_TEST(the_paper_s_method_is_lent_threads_too)
{
    host h = {0};
    const imp_result alone = solve(paper, NULL, 0, 1), lent = solve(paper, &h, 0, 1);
    ck_assert_int_eq(alone.reason, IMP_REASON_PAIRS);
    ck_assert_int_ge(h.lent, 3);
    same(&alone, &lent);
}
END_TEST

/* --- Limits ----------------------------------------------------------------------------------- */

static imp_options fewer_than_candidates(imp_options o)
{
    o.max_pairs = 10;
    return o;
}

static imp_options before_the_heap(imp_options o)
{
    o.max_pairs = 1700; /* candidates are some 1600 */
    return o;
}

static imp_options some_trees(imp_options o)
{
    o.max_bytes = 100000;
    return o;
}

static imp_options some_nodes(imp_options o)
{
    o.max_bytes = 1400000;
    return o;
}

START_TEST(limits_end_a_query_that_is_lent_threads_for_the_same_reason)
{
    imp_options (*const limits[])(imp_options) = {fewer_than_candidates, before_the_heap,
                                                  some_trees, some_nodes};
    for (size_t k = 0; k < sizeof limits / sizeof *limits; ++k) {
        host h = {0};
        const imp_result alone = solve(limits[k], NULL, 0, 1), lent = solve(limits[k], &h, 0, 1);
        ck_assert_int_eq(alone.verdict, IMP_VERDICT_UNDECIDED);
        ck_assert_int_eq(alone.reason, lent.reason);
        ck_assert_uint_eq(alone.stats.pairs, lent.stats.pairs);
        ck_assert_double_eq(alone.t_lower, lent.t_lower);
    }
}
END_TEST

static imp_options no_time(imp_options o)
{
    o.max_seconds = 1e-9;
    return o;
}

START_TEST(a_limit_of_seconds_ends_it_before_any_thread_is_lent)
{
    host h = {0};
    ck_assert_int_eq(solve(no_time, &h, 0, 1).reason, IMP_REASON_SECONDS);
    ck_assert_int_eq(h.lent, 0);
}
END_TEST

START_TEST(a_query_that_is_cancelled_while_threads_work_for_it_goes_on_to_the_same_answer)
{
    host h = {0};
    imp_scene *scene = fresh();
    const imp_options options = lend(scene, &h);
    imp_query *query = imp_query_new(scene, &options, NULL);
    h.cancels = query;
    step(query, 0);
    ck_assert_int_eq(imp_query_result(query).reason, IMP_REASON_CANCELLED);
    ck_assert_int_eq(h.lent, 2);
    ck_assert_uint_eq(imp_query_result(query).stats.pairs, 0);
    step(query, 0);
    const imp_result alone = solve(as_it_is, NULL, 0, 1), lent = imp_query_result(query);
    same(&alone, &lent);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- Refinement, and hosts that do not help --------------------------------------------------- */

/* Refined while candidate pairs that were tested ahead have not had their turn. */
static imp_result refined(host *h)
{
    imp_scene *scene = fresh();
    imp_options options = lend(scene, h);
    if (h == NULL) options.parallel = NULL;
    options.gamma = 0.1;
    imp_query *query = imp_query_new(scene, &options, NULL);
    step(query, 100);
    ck_assert_int_eq(imp_query_result(query).reason, IMP_REASON_RUNNING);
    ck_assert_int_eq(imp_query_refine(query, 1e-5, -1, NULL), IMP_SUCCESS);
    step(query, 0);
    const imp_result r = imp_query_result(query);
    imp_query_free(query);
    imp_scene_free(scene);
    return r;
}

START_TEST(tests_made_ahead_are_made_again_after_refinement)
{
    host h = {0};
    const imp_result alone = refined(NULL), lent = refined(&h);
    ck_assert_int_eq(alone.verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_ge(h.lent, 4);
    same(&alone, &lent);
}
END_TEST

static void idle(void *context, void (*call)(void *of, size_t index), void *of, size_t count)
{
    (void)context, (void)call, (void)of, (void)count;
}

static imp_options idling(imp_options o)
{
    o.parallel = idle;
    return o;
}

START_TEST(what_a_host_leaves_undone_is_done_by_the_query)
{
    host h = {0};
    const imp_result alone = solve(as_it_is, NULL, 0, 1), lent = solve(idling, &h, 0, 1);
    same(&alone, &lent);
}
END_TEST

START_TEST(a_query_is_divided_by_threads_into_the_same_parts)
{
    host h = {0};
    size_t count[2], body[2][2];
    imp_scene *scenes[2] = {fresh(), fresh()};
    imp_query *queries[2];
    for (int k = 0; k < 2; ++k) {
        imp_options options = lend(scenes[k], &h);
        if (k == 0) options.parallel = NULL;
        queries[k] = imp_query_new(scenes[k], &options, NULL);
        ck_assert_int_eq(imp_query_divide(queries[k], &count[k], NULL), IMP_SUCCESS);
    }
    ck_assert(h.lent >= 2 && count[0] > BODIES && count[0] == count[1]);
    for (size_t part = 0; part < count[0]; ++part) {
        for (int k = 0; k < 2; ++k) imp_query_part_bodies(queries[k], part, body[k]);
        ck_assert(memcmp(body[0], body[1], sizeof body[0]) == 0);
    }
    const int lent = h.lent;
    imp_query *part = imp_query_part(queries[1], 0, NULL);
    step(part, 0);
    ck_assert_int_eq(h.lent, lent); /* parts use none */
    imp_query_free(part);
    for (int k = 0; k < 2; ++k) imp_query_free(queries[k]), imp_scene_free(scenes[k]);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_query_that_is_lent_threads_answers_and_counts_as_one_without,
        a_step_of_a_few_pairs_ends_where_it_does_without_threads,
        the_paper_s_method_is_lent_threads_too,
        limits_end_a_query_that_is_lent_threads_for_the_same_reason,
        a_limit_of_seconds_ends_it_before_any_thread_is_lent,
        a_query_that_is_cancelled_while_threads_work_for_it_goes_on_to_the_same_answer,
        tests_made_ahead_are_made_again_after_refinement,
        what_a_host_leaves_undone_is_done_by_the_query,
        a_query_is_divided_by_threads_into_the_same_parts};
    return suite_main_with("parallel", tests, sizeof tests / sizeof *tests, open_crowd,
                           close_crowd);
}
