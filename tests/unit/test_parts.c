/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pthread.h>
#include <time.h>

#include "tests/support/query_helpers.h"
#include "tools/bench/crowd.h"

/* A query divided into its pairs of bodies. */

enum { BODIES = 30, PARTS_MAX = 512 };

static imp_registry *registry;
static imp_scene *scene;
static imp_options options;

static void open_crowd(void)
{
    imp_error error = {IMP_SUCCESS, ""};
    char *text = crowd_text(BODIES, 7);
    registry = query_registry();
    scene = imp_scene_from_json(registry, text, strlen(text), "crowd", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    options = imp_options_default(scene);
    free(text);
}

static void close_crowd(void)
{
    imp_scene_free(scene);
    imp_registry_free(registry);
}

static imp_query *divided(size_t *count)
{
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_divide(query, count, NULL), IMP_SUCCESS);
    return query;
}

static imp_result solved(const imp_query *whole, size_t index)
{
    imp_query *part = imp_query_part(whole, index, NULL);
    ck_assert_int_eq(imp_query_step(part, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(part);
    imp_query_free(part);
    return r;
}

static bool same(const imp_result *x, const imp_result *y)
{
    return x->verdict == y->verdict && x->reason == y->reason && x->t_lower == y->t_lower &&
           x->a.body == y->a.body && x->b.body == y->b.body && x->a.u == y->a.u &&
           x->b.v == y->b.v && x->stats.pairs == y->stats.pairs &&
           x->stats.nodes == y->stats.nodes && x->stats.peak_heap == y->stats.peak_heap &&
           x->stats.bytes == y->stats.bytes;
}

START_TEST(parts_and_passes_give_the_same_contacts)
{
    size_t count, met = 0;
    imp_query *whole = divided(&count), *passed = imp_query_new(scene, &options, NULL);
    imp_result of[BODIES][BODIES] = {{{0}}};
    ck_assert_uint_gt(count, 0);
    ck_assert_int_eq(imp_query_result(whole).verdict, IMP_VERDICT_CLEAR);
    for (size_t k = 0; k < count; ++k) {
        size_t body[2];
        ck_assert(imp_query_part_bodies(whole, k, body) && body[0] < body[1]);
        of[body[0]][body[1]] = solved(whole, k);
        met += of[body[0]][body[1]].verdict == IMP_VERDICT_CONTACT;
    }
    for (;;) {
        ck_assert_int_eq(imp_query_step(passed, 0, NULL), IMP_SUCCESS);
        const imp_result r = imp_query_result(passed);
        if (r.verdict != IMP_VERDICT_CONTACT) break;
        const imp_result *own = &of[r.a.body][r.b.body];
        ck_assert(own->verdict == IMP_VERDICT_CONTACT && own->t == r.t && own->gap == r.gap);
        met -= 1;
        ck_assert_int_eq(imp_query_exclude_pair(passed, NULL), IMP_SUCCESS);
    }
    ck_assert_uint_eq(met, 0);
    imp_query_free(passed);
    imp_query_free(whole);
}
END_TEST

typedef struct share {
    const imp_query *whole;
    imp_result *results;
    size_t count;
    bool backwards;
} share;

static void *solve_all(void *context)
{
    const share *s = context;
    for (size_t k = 0; k < s->count; ++k) {
        const size_t index = s->backwards ? s->count - 1 - k : k;
        s->results[index] = solved(s->whole, index);
    }
    return NULL;
}

START_TEST(threads_at_once_and_any_order_give_the_same_answers_and_counts)
{
    size_t count;
    imp_query *whole = divided(&count);
    imp_result results[2][PARTS_MAX];
    ck_assert_uint_le(count, PARTS_MAX);
    share forwards = {whole, results[0], count, false},
          backwards = {whole, results[1], count, true};
    pthread_t other;
    ck_assert_int_eq(pthread_create(&other, NULL, solve_all, &backwards), 0);
    solve_all(&forwards);
    pthread_join(other, NULL);
    for (size_t k = 0; k < count; ++k) ck_assert(same(&results[0][k], &results[1][k]));
    imp_query_free(whole);
}
END_TEST

/* 40 spheres, which turn about the origin in two groups: pairs of one group are searched in the
 * frame of both. */
static imp_scene *turning(void)
{
    char text[40 * 160] = "{\"bodies\": [";
    imp_error error = {IMP_SUCCESS, ""};
    for (int k = 0; k < 40; ++k)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "%s{\"surfaces\": [{\"type\": \"sphere\", \"center\": [%d, 0, 0]}], \"maps\": "
                 "[{\"type\": \"rotate\", \"rate\": %d}]}",
                 k > 0 ? ", " : "", 3 * k, 1 + k / 20);
    strcat(text, "]}");
    imp_scene *made = imp_scene_from_json(registry, text, strlen(text), "turning", &error);
    ck_assert_msg(made != NULL, "%s", error.text);
    return made;
}

START_TEST(pairs_are_prepared_with_their_parts)
{
    imp_scene *turns = turning();
    imp_options own = imp_options_default(turns);
    imp_query *whole = imp_clearance_new(turns, &own, NULL, NULL);
    size_t count;
    ck_assert_int_eq(imp_query_divide(whole, &count, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(count, 40 * 39 / 2);
    const imp_stats before = imp_query_result(whole).stats;
    imp_query_free(imp_query_part(whole, 0, NULL));
    const imp_stats one = imp_query_result(whole).stats;
    for (size_t k = 0; k < count; ++k) imp_query_free(imp_query_part(whole, k, NULL));
    const imp_stats all = imp_query_result(whole).stats;
    for (size_t k = 0; k < count; ++k) imp_query_free(imp_query_part(whole, k, NULL));
    const imp_stats again = imp_query_result(whole).stats;
    ck_assert(before.nodes < one.nodes && one.nodes < all.nodes && all.nodes == again.nodes);
    ck_assert(before.bytes < one.bytes && one.bytes < all.bytes && all.bytes == again.bytes);
    imp_query_free(whole);
    imp_scene_free(turns);
}
END_TEST

START_TEST(a_part_of_a_clearance_is_the_clearance_of_two_bodies)
{
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = 0.1;
    imp_query *whole = imp_clearance_new(scene, &options, &asked, NULL);
    asked.each = true;
    imp_query *each = imp_clearance_new(scene, &options, &asked, NULL);
    size_t count;
    ck_assert_int_eq(imp_query_divide(each, &count, NULL), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_query_divide(whole, &count, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(count, BODIES * (BODIES - 1) / 2);
    ck_assert_int_eq(imp_query_step(each, 4000, NULL), IMP_SUCCESS);
    imp_clearance own = {.struct_size = sizeof own}, other = {.struct_size = sizeof other};
    imp_clearance_get(whole, 0, &own, NULL);
    ck_assert(own.reason == IMP_REASON_NO_TIME && own.lower == INFINITY && own.upper == INFINITY);
    size_t compared = 0;
    for (; imp_clearance_get(each, compared, &other, NULL) == IMP_SUCCESS; ++compared) {
        if (other.reason == IMP_REASON_RUNNING) break;
        imp_query *part = imp_query_part(whole, compared, NULL);
        ck_assert_int_eq(imp_query_step(part, 0, NULL), IMP_SUCCESS);
        imp_clearance_get(part, 0, &own, NULL);
        ck_assert(own.body[0] == other.body[0] && own.body[1] == other.body[1]);
        ck_assert(own.lower == other.lower && own.upper == other.upper && own.t == other.t);
        imp_query_free(part);
    }
    ck_assert_uint_gt(compared, 2);
    imp_query_free(whole);
    imp_query_free(each);
}
END_TEST

/* Bodies of several surfaces, of which some pairs come near each other and some do not. */
START_TEST(a_part_of_bodies_of_many_surfaces_is_the_scene_of_the_two)
{
    static const char *const bodies[3] = {
        "{\"name\": \"a\", \"surfaces\": [{\"type\": \"sphere\"}, {\"type\": \"sphere\", "
        "\"center\": "
        "[2, 0, 0]}, {\"type\": \"torus\", \"center\": [1, 0, 2]}]}",
        "{\"name\": \"b\", \"surfaces\": [{\"type\": \"sphere\", \"center\": [9, 0, 0]}, "
        "{\"type\": "
        "\"sphere\", \"center\": [6, 0, 0]}], \"maps\": [{\"type\": \"translate\", \"velocity\": "
        "[-1, 0, "
        "0]}]}",
        "{\"name\": \"c\", \"surfaces\": [{\"type\": \"sphere\", \"center\": [1, 5, 0]}, "
        "{\"type\": "
        "\"sphere\", \"center\": [4, 5, 0]}], \"maps\": [{\"type\": \"translate\", \"velocity\": "
        "[0, -1, "
        "0]}]}"};
    char text[2000];
    snprintf(text, sizeof text, "{\"time\": [0, 8], \"bodies\": [%s, %s, %s]}", bodies[0],
             bodies[1], bodies[2]);
    imp_scene *all = imp_scene_from_json(registry, text, strlen(text), "all", NULL);
    ck_assert_ptr_nonnull(all);
    const imp_options some = imp_options_default(all);
    imp_query *whole = imp_query_new(all, &some, NULL);
    size_t count;
    ck_assert_int_eq(imp_query_divide(whole, &count, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(count, 3);
    for (size_t k = 0; k < count; ++k) {
        size_t body[2];
        ck_assert(imp_query_part_bodies(whole, k, body));
        snprintf(text, sizeof text, "{\"time\": [0, 8], \"bodies\": [%s, %s]}", bodies[body[0]],
                 bodies[body[1]]);
        imp_scene *two = imp_scene_from_json(registry, text, strlen(text), "two", NULL);
        imp_query *alone = imp_query_new(two, &some, NULL);
        ck_assert_int_eq(imp_query_step(alone, 0, NULL), IMP_SUCCESS);
        const imp_result part = solved(whole, k), own = imp_query_result(alone);
        ck_assert(part.verdict == IMP_VERDICT_CONTACT && own.verdict == IMP_VERDICT_CONTACT);
        ck_assert(part.t == own.t && part.gap == own.gap && part.stats.pairs == own.stats.pairs);
        ck_assert(part.a.surface == own.a.surface && part.b.surface == own.b.surface);
        imp_query_free(alone);
        imp_scene_free(two);
    }
    imp_query_free(whole);
    imp_scene_free(all);
}
END_TEST

/* The first answer may come before the time is over; parts begun after it have none left. */
START_TEST(parts_begun_after_the_time_of_all_are_undecided)
{
    size_t count, late = 0;
    options.max_seconds = 0.05;
    imp_query *whole = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_divide(whole, &count, NULL), IMP_SUCCESS);
    if (count > 0) nanosleep(&(struct timespec){.tv_nsec = 60000000}, NULL);
    for (size_t k = 0; k < count; ++k) {
        const imp_result r = solved(whole, k);
        ck_assert(r.verdict != IMP_VERDICT_UNDECIDED || r.reason == IMP_REASON_SECONDS);
        late += r.verdict == IMP_VERDICT_UNDECIDED;
    }
    ck_assert(count > 0 ? late > 0 : imp_query_result(whole).reason == IMP_REASON_SECONDS);
    imp_query_free(whole);
}
END_TEST

START_TEST(a_limit_before_the_parts_leaves_none)
{
    size_t count = 1, body[2];
    options.max_bytes = 1;
    imp_query *whole = divided(&count);
    ck_assert_uint_eq(count, 0);
    const imp_result r = imp_query_result(whole);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    ck_assert(!imp_query_part_bodies(whole, 0, body));
    imp_query_free(whole);
}
END_TEST

START_TEST(limits_of_pairs_are_each_parts_own_and_of_time_those_of_all)
{
    size_t count;
    options.max_pairs = 3; /* fewer than there are parts */
    imp_query *whole = divided(&count);
    ck_assert_uint_gt(count, 3);
    size_t ended = 0;
    for (size_t k = 0; k < count; ++k) ended += solved(whole, k).reason == IMP_REASON_PAIRS;
    ck_assert_uint_gt(ended, 0);
    imp_query_free(whole);
    options.max_pairs = 0;
    options.max_seconds = 1e-9;
    imp_query *late = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_divide(late, &count, NULL), IMP_SUCCESS);
    ck_assert(count == 0 && imp_query_result(late).reason == IMP_REASON_SECONDS);
    imp_query_free(late);
}
END_TEST

START_TEST(what_cannot_be_divided_is_refused)
{
    size_t count = 0, body[2];
    imp_error error;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_divide(NULL, &count, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_query_divide(query, NULL, &error), IMP_ERROR_USAGE);
    ck_assert_ptr_null(imp_query_part(query, 0, &error));
    ck_assert(error.code == IMP_ERROR_USAGE && !imp_query_part_bodies(NULL, 0, body));
    ck_assert_ptr_null(imp_query_part(NULL, 0, &error));
    ck_assert_int_eq(imp_query_step(query, 1, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_divide(query, &count, &error), IMP_ERROR_USAGE);
    ck_assert_ptr_nonnull(strstr(error.text, "stepped already"));
    imp_query_free(query);
    query = divided(&count);
    ck_assert_int_eq(imp_query_divide(query, &count, &error), IMP_ERROR_USAGE);
    ck_assert(!imp_query_part_bodies(query, SIZE_MAX, body));
    imp_query_free(query);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {parts_and_passes_give_the_same_contacts,
                                  threads_at_once_and_any_order_give_the_same_answers_and_counts,
                                  pairs_are_prepared_with_their_parts,
                                  a_part_of_a_clearance_is_the_clearance_of_two_bodies,
                                  a_part_of_bodies_of_many_surfaces_is_the_scene_of_the_two,
                                  parts_begun_after_the_time_of_all_are_undecided,
                                  a_limit_before_the_parts_leaves_none,
                                  limits_of_pairs_are_each_parts_own_and_of_time_those_of_all,
                                  what_cannot_be_divided_is_refused};
    return suite_main_with("parts", tests, sizeof tests / sizeof *tests, open_crowd, close_crowd);
}
