/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/bench/crowd.h"

/* In a crowd most pairs wait until they come near (candidates_more.c): the answers are those of
 * each two bodies alone. */

enum { BODIES = 520 }; /* more than have roots at once */

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *read_scene(const char *text)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "crowd", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static imp_scene *mixed_crowd(uint64_t seed)
{
    char *text = crowd_text(BODIES, seed);
    ck_assert_ptr_nonnull(text);
    imp_scene *scene = read_scene(text);
    free(text);
    return scene;
}

/* Writes the translation of a body from its cell. */
static void write_flight(FILE *out, int k, double pace, uint64_t *random)
{
    const double from[3] = {1.8 * (k % 9), 1.8 * (k / 9 % 9), 1.8 * (k / 81)};
    double by[3];
    for (int i = 0; i < 3; ++i) by[i] = pace * random_between(random, -2, 2);
    fprintf(out, "{\"type\":\"translate\",\"offset\":[[%.3f,%.3f,%.3f],[%.3f,%.3f,%.3f]]}", from[0],
            from[1], from[2], by[0], by[1], by[2]);
}

/* Bodies of two balls each, which fly and turn. `pace` makes contacts early or late. */
static imp_scene *crowd_of_dumbbells(uint64_t seed, double pace)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    ck_assert_ptr_nonnull(out);
    fputs("{\"time\":[0,1],\"bodies\":[", out);
    for (int k = 0; k < BODIES; ++k) {
        fprintf(out, "%s{\"name\":\"%d\",\"surfaces\":[", k > 0 ? "," : "", k);
        for (int half = 0; half < 2; ++half)
            fprintf(out, "%s{\"type\":\"sphere\",\"radius\":%.3f,\"center\":[%.3f,0,0]}",
                    half > 0 ? "," : "", random_between(&seed, 0.1, 0.3), half - 0.5);
        fprintf(out, "],\"maps\":[{\"type\":\"rotate\",\"axis\":[0,1,%.3f],\"rate\":%.3f},",
                random_between(&seed, -1, 1), pace * random_between(&seed, -3, 3));
        write_flight(out, k, pace, &seed);
        fputs("]}", out);
    }
    fputs("]}", out);
    ck_assert_int_eq(fclose(out), 0);
    imp_scene *scene = read_scene(text);
    free(text);
    return scene;
}

static imp_query *begin(imp_scene *scene)
{
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-4;
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_query_new(scene, &options, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static imp_result step(imp_query *query)
{
    imp_error error = {IMP_SUCCESS, ""};
    const imp_code code = imp_query_step(query, 0, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query);
}

/* --- Contacts of each two bodies -------------------------------------------------------------- */

typedef struct contacts {
    imp_result *at;
    size_t count;
    uint64_t pairs; /* that all searches took */
} contacts;

static int by_time(const void *p, const void *q)
{
    const imp_result *r = p, *s = q;
    return r->t < s->t ? -1 : r->t > s->t;
}

static contacts contacts_of_each(imp_scene *scene)
{
    size_t parts;
    imp_query *whole = begin(scene);
    ck_assert_int_eq(imp_query_divide(whole, &parts, NULL), IMP_SUCCESS);
    contacts found = {malloc((parts + 1) * sizeof *found.at), 0, 0};
    ck_assert_ptr_nonnull(found.at);
    ck_assert_uint_gt(parts, BODIES); /* a crowd, by collection_sort_later */
    for (size_t k = 0; k < parts; ++k) {
        imp_query *part = imp_query_part(whole, k, NULL);
        const imp_result r = step(part);
        ck_assert_int_ne(r.verdict, IMP_VERDICT_UNDECIDED);
        found.pairs += r.stats.pairs;
        if (r.verdict == IMP_VERDICT_CONTACT) found.at[found.count++] = r;
        imp_query_free(part);
    }
    imp_query_free(whole);
    qsort(found.at, found.count, sizeof *found.at, by_time);
    return found;
}

static void check_same(const imp_result *r, const imp_result *s)
{
    ck_assert_double_eq(r->t, s->t);
    ck_assert_double_eq(r->gap, s->gap);
    ck_assert(r->a.body == s->a.body && r->b.body == s->b.body);
    ck_assert(r->a.u == s->a.u && r->a.v == s->a.v && r->b.u == s->b.u && r->b.v == s->b.v);
    ck_assert(memcmp(r->normal, s->normal, sizeof r->normal) == 0);
}

/* Up to `most` contacts in order of time, and clear after the last. */
static void check_contacts(imp_scene *scene, size_t most, bool are_same)
{
    const contacts each = contacts_of_each(scene);
    imp_query *query = begin(scene);
    for (size_t k = 0; k < most; ++k) {
        const imp_result r = step(query);
        if (k >= each.count) {
            ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
            break;
        }
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        if (are_same) check_same(&r, &each.at[k]);
        ck_assert_double_eq_tol(r.t, each.at[k].t, 1e-4);
        ck_assert_int_eq(imp_query_exclude_pair(query, NULL), IMP_SUCCESS);
    }
    imp_query_free(query);
    free(each.at);
}

START_TEST(a_crowd_s_first_contact_is_the_first_of_each_two_bodies)
{
    imp_scene *scene = mixed_crowd(suite_seed());
    check_contacts(scene, 1, true);
    imp_scene_free(scene);
}
END_TEST

START_TEST(contacts_follow_in_the_order_of_each_two_bodies_up_to_the_end)
{
    imp_scene *scene = crowd_of_dumbbells(suite_seed(), 1);
    check_contacts(scene, SIZE_MAX, true);
    imp_scene_free(scene);
}
END_TEST

/* --- What waits ------------------------------------------------------------------------------- */

static bool has_bodies(const imp_pending *p, const imp_result *r)
{
    return p->a.body == r->a.body && p->b.body == r->b.body;
}

START_TEST(each_later_contact_waits_and_no_pair_that_waits_meets_before)
{
    imp_scene *scene = crowd_of_dumbbells(suite_seed(), 1);
    const contacts each = contacts_of_each(scene);
    imp_query *query = begin(scene);
    const imp_result first = step(query);
    ck_assert_uint_gt(each.count, 2);
    ck_assert_uint_lt(4 * first.stats.pairs, each.pairs); /* most were not even tested */
    for (size_t k = 0; k < each.count; ++k) {
        imp_pending p;
        double from = INFINITY;
        for (size_t i = 0; imp_query_pending(query, i, &p); ++i)
            if (has_bodies(&p, &each.at[k]) && p.t_lower < from) from = p.t_lower;
        ck_assert_double_le(from, each.at[k].t + 1e-4);
    }
    imp_query_free(query);
    free(each.at);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_crowd_is_refined_to_the_answer_of_a_new_query)
{
    imp_scene *scene = mixed_crowd(suite_seed());
    imp_query *query = begin(scene);
    const imp_result rough = step(query);
    ck_assert_int_eq(rough.verdict, IMP_VERDICT_CONTACT);
    ck_assert_int_eq(imp_query_refine(query, 1e-6, -1, NULL), IMP_SUCCESS);
    const imp_result fine = step(query);
    ck_assert_int_eq(fine.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_ge(fine.t, rough.t);
    ck_assert_double_le(fine.gap, 1e-6);
    ck_assert_double_eq_tol(fine.t, rough.t, 1e-2);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- A pair that starts later than it seemed -------------------------------------------------- */

#define SHEET                                                                                      \
    "{\"type\":\"plane\",\"origin\":[-0.5,0.5,-50],\"edge_u\":[1,-1,0],\"edge_v\":[0,0,1]}"
#define SHEETS "{\"surfaces\":[" SHEET "," SHEET "," SHEET "," SHEET "]"

/* Stacks of sheets whose boxes overlap from the start, but which meet across them at 5/6; two balls
 * that meet at 0.2 and whose boxes are apart at first; and balls that drift side by side, through
 * the boxes of many others. */
static imp_scene *drifting_crowd(void)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    ck_assert_ptr_nonnull(out);
    fputs("{\"time\":[0,1],\"bodies\":[" SHEETS "}," SHEETS ",\"maps\":[{\"type\":\"translate\","
          "\"offset\":[[0.5,0.5,0],[-0.6,-0.6,0]]}]},"
          "{\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.1,\"center\":[-30,0,0]}]},"
          "{\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.1,\"center\":[-32.2,0,0]}],"
          "\"maps\":[{\"type\":\"translate\",\"velocity\":[10,0,0]}]}",
          out);
    for (int k = 0; k < BODIES; ++k)
        fprintf(out,
                ",{\"surfaces\":[{\"type\":\"sphere\",\"radius\":0.1,\"center\":[%d,%d,%d]}],"
                "\"maps\":[{\"type\":\"translate\",\"velocity\":[8,8,8]}]}",
                k % 9, k / 9 % 9, k / 81);
    fputs("]}", out);
    ck_assert_int_eq(fclose(out), 0);
    imp_scene *scene = read_scene(text);
    free(text);
    return scene;
}

START_TEST(a_pair_whose_full_test_cuts_its_window_waits_for_pairs_that_come_near_before)
{
    imp_scene *scene = drifting_crowd();
    imp_query *query = begin(scene);
    imp_result r;
    do {
        ck_assert_int_eq(imp_query_step(query, 1, NULL), IMP_SUCCESS);
        r = imp_query_result(query);
        ck_assert_double_le(r.t_lower, 0.2);
    } while (r.reason == IMP_REASON_RUNNING);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert(r.a.body == 2 && r.b.body == 3);
    ck_assert_double_eq_tol(r.t, 0.2, 1e-4);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_crowd_s_first_contact_is_the_first_of_each_two_bodies,
        contacts_follow_in_the_order_of_each_two_bodies_up_to_the_end,
        each_later_contact_waits_and_no_pair_that_waits_meets_before,
        a_crowd_is_refined_to_the_answer_of_a_new_query,
        a_pair_whose_full_test_cuts_its_window_waits_for_pairs_that_come_near_before};
    return suite_main_with("crowds", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
