/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <sys/resource.h>

#include "tests/support/alloc_failure.h"
#include "tests/support/built_plugins.h"
#include "tests/support/compose.h"
#include "tests/support/sphere_scenes.h"

#include <impinge/baseline.h>

/* Whatever allocation fails in a scene or a query, nothing leaks, what is answered is true, and a
 * query that ran out of memory goes on when there is some. */

#define ATTEMPTS 10000 /* more than any of these allocate: the loops end by themselves */

static const ball at_rest = {.radius = 1};
static const ball flying = {.radius = 0.5, .centre = {3, 0, 0}, .velocity = {-3, 0, 0}};
static const ball late = {.radius = 0.5, .centre = {0, 4, 0}, .velocity = {0, -3, 0}};
static const double meeting = 0.5; /* of the first two; others are later */

static void assert_nothing_left(size_t before, size_t n)
{
    ck_assert_msg(alloc_failure_live() == before, "failing allocation %zu leaves %zd blocks", n,
                  (ssize_t)(alloc_failure_live() - before));
}

/* Three bodies; NULL: no memory. */
static imp_scene *make_scene(void)
{
    const ball *const balls[] = {&at_rest, &flying, &late};
    imp_scene *scene = scene_new();
    for (int k = 0; k < 3 && scene != NULL; ++k)
        if (spheres_add(scene, &ball_type, balls[k]) != IMP_SUCCESS) {
            imp_scene_free(scene);
            return NULL;
        }
    if (scene == NULL || scene_ignore(scene, 1, 2) == IMP_SUCCESS) return scene;
    imp_scene_free(scene);
    return NULL;
}

static imp_options options_of(const imp_scene *scene, uint32_t baseline)
{
    imp_options options = imp_options_default(scene);
    options.gamma = baseline == IMP_BASELINE_NONE ? 1e-7 : 0.3;
    options.baseline = baseline;
    return options;
}

/* Contact is reported where it is, and what is proved before is true. */
static void check_true(const imp_result *r, size_t n)
{
    ck_assert_msg(r->t_lower <= meeting, "failing allocation %zu: t_lower %.17g", n, r->t_lower);
    ck_assert_int_ne(r->verdict, IMP_VERDICT_CLEAR);
    if (r->verdict == IMP_VERDICT_CONTACT)
        ck_assert(r->gap <= r->gamma && r->t >= meeting - r->gamma && r->a.body == 0);
    else
        ck_assert_int_eq(r->reason, IMP_REASON_MEMORY);
}

START_TEST(a_scene_is_whole_or_not_there)
{
    const size_t before = alloc_failure_live();
    size_t n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        alloc_failure_begin(++n);
        imp_scene *scene = make_scene();
        failed = alloc_failure_end();
        ck_assert((scene == NULL) == failed);
        imp_scene_free(scene);
        assert_nothing_left(before, n);
    }
    ck_assert_uint_gt(n, 10);
}
END_TEST

/* What a query that ran out of memory tells, and what becomes of it with enough. */
static void go_on(imp_query *query, bool failed, size_t n)
{
    imp_result r = imp_query_result(query);
    check_true(&r, n);
    ck_assert((r.verdict == IMP_VERDICT_UNDECIDED) == failed);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    r = imp_query_result(query);
    check_true(&r, n);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
}

/* The n-th allocation of a query fails; Check allocates too, so nothing is asserted meanwhile. */
static bool query_failing_at(size_t n, uint32_t baseline)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = make_scene();
    const imp_options options = options_of(scene, baseline);
    imp_code code = IMP_SUCCESS;
    alloc_failure_begin(n);
    imp_query *query = imp_query_new(scene, &options, &error);
    if (query != NULL) code = imp_query_step(query, 0, &error);
    const bool failed = alloc_failure_end();
    ck_assert_int_eq(code, IMP_SUCCESS);
    if (query != NULL)
        go_on(query, failed, n);
    else
        ck_assert_int_eq(error.code, IMP_ERROR_MEMORY);
    imp_query_free(query);
    imp_scene_free(scene);
    return failed;
}

static void fail_queries(uint32_t baseline)
{
    const size_t before = alloc_failure_live();
    size_t n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        failed = query_failing_at(++n, baseline);
        assert_nothing_left(before, n);
    }
    ck_assert_uint_gt(n, 12);
}

START_TEST(a_query_out_of_memory_is_undecided_with_what_is_proved_and_can_go_on)
{
    fail_queries(IMP_BASELINE_NONE);
}
END_TEST

START_TEST(so_is_the_papers_method) { fail_queries(IMP_BASELINE_BOXES); }
END_TEST

/* --- A crowd ---------------------------------------------------------------------------------- */

enum { SIDE = 9, CROWD = SIDE * SIDE * 7 }; /* more than have roots at once */

/* Balls that fly at will, most through the boxes of many others; every fifth for some time only. */
static imp_scene *make_crowd(void)
{
    static ball balls[CROWD];
    uint64_t state = 5;
    imp_scene *scene = scene_new();
    for (int k = 0; k < CROWD && scene != NULL; ++k) {
        ball *b = &balls[k];
        *b = (ball){.radius = 0.3,
                    .centre = {1.5 * (k % SIDE), 1.5 * (k / SIDE % SIDE), 1.5 * (k / SIDE / SIDE)}};
        for (int i = 0; i < 3; ++i) b->velocity[i] = random_between(&state, -3, 3);
        if (k % 5 == 0) b->start = 0.05, b->end = 0.4;
        ck_assert_int_eq(spheres_add(scene, &ball_type, b), IMP_SUCCESS);
    }
    return scene;
}

/* Returns the first of the contacts of each two bodies. */
static imp_result first_contact(void)
{
    imp_scene *scene = make_crowd();
    const imp_options options = options_of(scene, IMP_BASELINE_NONE);
    imp_query *query = imp_query_new(scene, &options, NULL);
    imp_result first = {.t = INFINITY};
    size_t parts;
    ck_assert_int_eq(imp_query_divide(query, &parts, NULL), IMP_SUCCESS);
    ck_assert_uint_gt(parts, CROWD); /* so that pairs wait (candidates_more.c) */
    for (size_t k = 0; k < parts; ++k) {
        imp_query *part = imp_query_part(query, k, NULL);
        ck_assert_int_eq(imp_query_step(part, 0, NULL), IMP_SUCCESS);
        const imp_result r = imp_query_result(part);
        if (r.verdict == IMP_VERDICT_CONTACT && r.t < first.t) first = r;
        imp_query_free(part);
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return first;
}

/* Returns how many allocations were made up to the end, or the failing one. */
static size_t crowd_failing_at(size_t n, const imp_result *first)
{
    imp_scene *scene = make_crowd();
    const imp_options options = options_of(scene, IMP_BASELINE_NONE);
    imp_query *query = imp_query_new(scene, &options, NULL);
    alloc_failure_begin(n);
    const imp_code code = imp_query_step(query, 0, NULL);
    const size_t calls = alloc_failure_calls();
    const bool failed = alloc_failure_end() && n > 0;
    imp_result r = imp_query_result(query);
    ck_assert_int_eq(code, IMP_SUCCESS);
    ck_assert_msg((r.verdict == IMP_VERDICT_UNDECIDED) == failed && r.t_lower <= first->t,
                  "failing allocation %zu", n);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    r = imp_query_result(query);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.t == first->t && r.gap == first->gap && r.a.u == first->a.u);
    ck_assert(r.a.body == first->a.body && r.b.body == first->b.body);
    imp_query_free(query);
    imp_scene_free(scene);
    return calls;
}

/* All trees are made first, one allocation each; each stretch of time makes as many boxes. */
START_TEST(a_crowd_goes_on_to_the_first_contact_of_each_two_bodies)
{
    const imp_result first = first_contact();
    const size_t before = alloc_failure_live(), all = crowd_failing_at(0, &first);
    ck_assert_uint_gt(all, 4 * CROWD); /* several stretches */
    for (size_t n = CROWD; n <= all; n += n % CROWD < 64 ? 1 : 67) {
        crowd_failing_at(n, &first);
        assert_nothing_left(before, n);
    }
}
END_TEST

/* --- At once ---------------------------------------------------------------------------------- */

START_TEST(solving_at_once_tells_of_memory_too)
{
    imp_scene *scene = make_scene();
    const imp_options options = options_of(scene, IMP_BASELINE_NONE);
    imp_error error = {IMP_SUCCESS, ""};
    imp_result r = {.struct_size = sizeof r};
    for (int told = 0; told < 2; ++told) {
        alloc_failure_begin(1);
        const imp_code code = imp_scene_solve(scene, &options, &r, told ? &error : NULL);
        ck_assert(alloc_failure_end());
        ck_assert_int_eq(code, IMP_ERROR_MEMORY);
    }
    ck_assert_int_eq(error.code, IMP_ERROR_MEMORY);
    imp_scene_free(scene);
}
END_TEST

/* --- Clearance -------------------------------------------------------------------------------- */

/* Up to t = 0.25 the first two bodies come as near as 0.75, and nearer than 1 from 1 / 6 on. */
static imp_query *begin_clearance(imp_scene *scene, const imp_clearance_options *asked,
                                  imp_error *error)
{
    imp_options options = imp_options_default(scene);
    options.t_end = 0.25;
    return imp_clearance_new(scene, &options, asked, error);
}

/* Brackets hold what they should, and are whole where memory sufficed. */
static void check_brackets(const imp_query *query, const imp_clearance_options *asked, bool whole)
{
    double least = INFINITY;
    for (size_t k = 0; k < imp_clearance_count(query); ++k) {
        imp_clearance a = {.struct_size = (uint32_t)sizeof a};
        ck_assert_int_eq(imp_clearance_get(query, k, &a, NULL), IMP_SUCCESS);
        ck_assert(a.reason == (whole ? IMP_REASON_NONE : IMP_REASON_MEMORY) ||
                  a.reason == IMP_REASON_NONE);
        ck_assert(a.lower <= a.upper && a.upper >= 0.75);
        if (a.lower < least) least = a.lower;
        if (whole && asked->required > 0 && a.body[1] == 1)
            ck_assert(fabs(a.t_violated - 1. / 6) < 1e-6);
    }
    ck_assert(least <= 0.75 && (!whole || least > 0.749));
}

static bool clearance_failing_at(size_t n, const imp_clearance_options *asked)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = make_scene();
    imp_code code = IMP_SUCCESS;
    alloc_failure_begin(n);
    imp_query *query = begin_clearance(scene, asked, &error);
    if (query != NULL) code = imp_query_step(query, 0, &error);
    const bool failed = alloc_failure_end();
    ck_assert_int_eq(code, IMP_SUCCESS);
    if (query == NULL) {
        ck_assert_int_eq(error.code, IMP_ERROR_MEMORY);
    } else {
        check_brackets(query, asked, !failed);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        check_brackets(query, asked, true);
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return failed;
}

START_TEST(a_clearance_out_of_memory_keeps_its_brackets_and_can_go_on)
{
    imp_clearance_options asked[2] = {imp_clearance_options_default(),
                                      imp_clearance_options_default()};
    asked[0].each = true, asked[0].required = 1;
    asked[1].slices = 3;
    const size_t before = alloc_failure_live();
    for (int k = 0; k < 2; ++k) {
        size_t n = 0;
        for (bool failed = true; failed && n < ATTEMPTS;) {
            failed = clearance_failing_at(++n, &asked[k]);
            assert_nothing_left(before, n);
        }
        ck_assert_uint_gt(n, 12);
    }
}
END_TEST

/* --- Pages ------------------------------------------------------------------------------------ */

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { FAULTS_MOST = 200 }; /* they keep what was freed for a while */
#else
enum { FAULTS_MOST = 2 };
#endif

static void solve_pair(imp_registry *registry)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(
        registry, "torus major_radius=1 minor_radius=.3 ! rotate axis=1,0,0 rate=2",
        "torus major_radius=1 minor_radius=.2 center=3,0,0 ! rotate axis=0,1,0 rate=1 ! "
        "translate velocity=-3,0,0",
        &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_result result = {.struct_size = sizeof result};
    const imp_options options = imp_options_default(scene);
    ck_assert_int_eq(imp_scene_solve(scene, &options, &result, &error), IMP_SUCCESS);
    ck_assert_int_eq(result.verdict, IMP_VERDICT_CONTACT);
    imp_scene_free(scene);
}

START_TEST(scenes_in_turn_use_the_same_pages)
{
    enum { SCENES = 50 };
    imp_registry *registry = built_registry();
    struct rusage before, after;
    for (int k = 0; k < 3; ++k) solve_pair(registry);
    getrusage(RUSAGE_SELF, &before);
    for (int k = 0; k < SCENES; ++k) solve_pair(registry);
    getrusage(RUSAGE_SELF, &after);
    ck_assert_int_lt(after.ru_minflt - before.ru_minflt, SCENES * FAULTS_MOST);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("query_memory", a_scene_is_whole_or_not_there,
           a_query_out_of_memory_is_undecided_with_what_is_proved_and_can_go_on,
           so_is_the_papers_method, a_crowd_goes_on_to_the_first_contact_of_each_two_bodies,
           solving_at_once_tells_of_memory_too,
           a_clearance_out_of_memory_keeps_its_brackets_and_can_go_on,
           scenes_in_turn_use_the_same_pages)
