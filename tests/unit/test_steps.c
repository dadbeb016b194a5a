/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/scene_variants.h"

/* A search taken apart: made finer, cut into steps, ended by a budget. Whatever is done to it, its
 * answers fit those of a search that ran through. */

/* --- Finer ------------------------------------------------------------------------------------ */

static imp_result step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_query_step(query, pairs, &error) == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query);
}

static imp_query *query_on_rung(imp_scene *scene, const setting *s, int rung)
{
    imp_options options = imp_options_default(scene);
    options.gamma = rung_gamma(s, &plain, rung);
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_ptr_nonnull(query);
    return query;
}

static void refine(imp_query *query, const setting *s, int rung)
{
    ck_assert_int_eq(imp_query_refine(query, rung_gamma(s, &plain, rung), -1, NULL), IMP_SUCCESS);
}

/* The lemma, for an answer on any rung. */
static void check_rung(const ladder *l, int rung, const imp_result *r)
{
    if (r->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert(r->gap <= r->gamma);
    for (int k = 0; k < 3; ++k) {
        if (k < rung) ck_assert_double_ge(r->t, l->rung[k].t_lower);
        if (k > rung) ck_assert_double_le(r->t, l->rung[k].t);
    }
}

/* Coarse first, to the end or for `first` pairs, then finer rung by rung: each answer keeps the
 * promises of one asked afresh, and t_lower never falls. */
static void refine_from(imp_registry *registry, const ladder *l, uint64_t first)
{
    imp_scene *scene = scene_told(registry, l->about);
    imp_query *query = query_on_rung(scene, l->about, -2);
    double t_lower = step(query, first).t_lower;
    for (int rung = -1; rung < 5; ++rung) {
        refine(query, l->about, rung);
        const imp_result r = step(query, 0);
        ck_assert_int_eq(r.verdict, l->rung[1].verdict);
        ck_assert(r.gamma == rung_gamma(l->about, &plain, rung));
        ck_assert(r.t_lower >= t_lower);
        check_rung(l, rung, &r);
        t_lower = r.t_lower;
    }
    imp_query_free(query);
    imp_scene_free(scene);
}

static void refine_step_by_step(imp_registry *registry, const ladder *l)
{
    const uint64_t first[] = {0, 1, 20, 150};
    for (int k = 0; k < 4; ++k) refine_from(registry, l, first[k]);
}

START_TEST(a_coarse_answer_made_finer_is_as_good_as_one_asked_afresh)
{
    for_each_setting(refine_step_by_step);
}
END_TEST

/* --- Steps and budgets ------------------------------------------------------------------------ */

static void check_same(const imp_result *x, const imp_result *y)
{
    ck_assert(x->verdict == y->verdict && x->reason == y->reason && x->t_lower == y->t_lower);
    ck_assert_uint_eq(x->stats.pairs, y->stats.pairs);
    ck_assert_uint_eq(x->stats.nodes, y->stats.nodes);
    ck_assert_uint_eq(x->stats.peak_heap, y->stats.peak_heap);
    ck_assert_uint_eq(x->stats.witness_searches, y->stats.witness_searches);
    ck_assert_uint_eq(x->stats.bytes, y->stats.bytes);
    if (x->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert(x->t == y->t && x->gap == y->gap);
    ck_assert(x->a.u == y->a.u && x->a.v == y->a.v && x->b.u == y->b.u && x->b.v == y->b.v);
    ck_assert(memcmp(x->normal, y->normal, sizeof x->normal) == 0);
}

static void step_any_size(imp_registry *registry, const ladder *l)
{
    const uint64_t sizes[] = {1, 7, 64, 1000};
    for (int k = 0; k < 4; ++k) {
        imp_scene *scene = scene_told(registry, l->about);
        imp_query *query = query_on_rung(scene, l->about, 1);
        imp_result r = imp_query_result(query);
        ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_RUNNING &&
                  r.t_lower == 0);
        while (r.reason == IMP_REASON_RUNNING) {
            const double t_lower = r.t_lower;
            r = step(query, sizes[k]);
            ck_assert(r.t_lower >= t_lower && r.t_lower <= l->rung[1].t_lower);
        }
        check_same(&r, &l->rung[1]);
        imp_query_free(query);
        imp_scene_free(scene);
    }
}

START_TEST(steps_of_any_size_lead_to_the_same_bits) { for_each_setting(step_any_size); }
END_TEST

static imp_result solve_within(imp_registry *registry, const setting *s, imp_options budget)
{
    imp_scene *scene = scene_told(registry, s);
    imp_options options = imp_options_default(scene);
    options.gamma = rung_gamma(s, &plain, 1);
    options.max_pairs = budget.max_pairs;
    options.max_seconds = budget.max_seconds;
    options.max_bytes = budget.max_bytes;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
    query_check(scene, &options, &r);
    imp_scene_free(scene);
    return r;
}

/* What is proved when a budget ends is true: t_lower is no later than in the whole answer. */
static void end_early(imp_registry *registry, const ladder *l)
{
    double t_lower = 0;
    for (uint64_t pairs = 1; pairs < l->rung[1].stats.pairs; pairs += 1 + pairs / 2) {
        const imp_result r = solve_within(registry, l->about, (imp_options){.max_pairs = pairs});
        ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_PAIRS);
        ck_assert(r.t_lower >= t_lower && r.t_lower <= l->rung[1].t_lower);
        ck_assert(isnan(r.t) && isnan(r.gap));
        t_lower = r.t_lower;
    }
    imp_result r = solve_within(registry, l->about, (imp_options){.max_seconds = 1e-9});
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_SECONDS);
    ck_assert(r.t_lower <= l->rung[1].t_lower);
    r = solve_within(registry, l->about, (imp_options){.max_bytes = 1});
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    ck_assert(r.t_lower <= l->rung[1].t_lower);
    r = solve_within(registry, l->about,
                     (imp_options){.max_pairs = l->rung[1].stats.pairs + 1,
                                   .max_seconds = 1e3,
                                   .max_bytes = (uint64_t)1 << 30});
    check_same(&r, &l->rung[1]);
}

START_TEST(a_budget_that_ends_leaves_a_true_t_lower) { for_each_setting(end_early); }
END_TEST

SUITE_MAIN("steps", a_coarse_answer_made_finer_is_as_good_as_one_asked_afresh,
           steps_of_any_size_lead_to_the_same_bits, a_budget_that_ends_leaves_a_true_t_lower)
