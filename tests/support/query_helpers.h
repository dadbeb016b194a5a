/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_QUERY_HELPERS_H
#define TESTS_SUPPORT_QUERY_HELPERS_H

#include <stdlib.h>
#include <string.h>

#include <impinge/baseline.h>
#include <impinge/impinge.h>

#include "tests/support/suite.h"

/* Questions to the whole library, with the plugins of the build tree. */

static inline imp_registry *query_registry(void)
{
    const char *build = getenv("top_builddir");
    char path[4096];
    snprintf(path, sizeof path, "%s/plugins/.libs", build != NULL ? build : ".");
    imp_registry *registry = imp_registry_new(path);
    ck_assert_ptr_nonnull(registry);
    return registry;
}

/* The first contact of two surfaces at gamma 1e-9, each bound held against points. */
static inline imp_result query_audited(const char *a, const char *b)
{
    imp_registry *plugins = query_registry();
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(plugins, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-9;
    options.audit = true;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    imp_scene_free(scene);
    imp_registry_free(plugins);
    return r;
}

/* What a question leaves open: times [0, 1], whatever tables the scene has, gamma 1e-6, gamma_clear
 * gamma / 2, models. */
typedef struct question {
    const char *a, *b; /* pipelines */
    double t_start, t_end, gamma, gamma_clear;
    uint32_t baseline; /* of imp_options */
    uint64_t max_pairs;
} question;

static inline imp_options query_options(const imp_scene *scene, const question *q)
{
    imp_options options = imp_options_default(scene);
    const bool open = q->t_start == 0 && q->t_end == 0;
    options.t_start = q->t_start;
    options.t_end = open ? 1 : q->t_end;
    if (q->gamma > 0) options.gamma = q->gamma;
    if (q->gamma_clear > 0) options.gamma_clear = q->gamma_clear;
    options.baseline = q->baseline;
    options.max_pairs = q->max_pairs > 0 ? q->max_pairs : 2000000;
    return options;
}

static inline double query_distance(const double *x, const double *y)
{
    return sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                (x[2] - y[2]) * (x[2] - y[2]));
}

/* What every result promises by itself: the witness lies where it says, the gap is within gamma,
 * times are in order. */
static inline void query_check(const imp_scene *scene, const imp_options *options,
                               const imp_result *r)
{
    ck_assert(r->t_lower >= options->t_start && r->t_lower <= options->t_end);
    if (r->verdict == IMP_VERDICT_CLEAR) ck_assert(r->t_lower == options->t_end);
    if (r->verdict != IMP_VERDICT_CONTACT) return;
    ck_assert(r->t == r->t_lower);
    ck_assert(r->gap >= 0 && r->gap <= r->gamma);
    const imp_side *sides[2] = {&r->a, &r->b};
    for (int k = 0; k < 2; ++k) {
        const double p[3] = {sides[k]->u, sides[k]->v, r->t};
        double x[3], inexact[3];
        ck_assert_int_eq(
            imp_scene_eval(scene, sides[k]->body, sides[k]->surface, 1, p, x, inexact, NULL),
            IMP_SUCCESS);
        ck_assert_double_eq(query_distance(x, sides[k]->point), 0);
    }
    ck_assert_double_le(fabs(query_distance(r->a.point, r->b.point) - r->gap), 1e-12 * r->gap);
    if (r->has_normal) {
        const double zero[3] = {0, 0, 0};
        ck_assert_double_le(fabs(query_distance(r->normal, zero) - 1), 1e-12);
    }
}

/* Asks for the least distance, with the usual options if `asked` is NULL. */
static inline imp_clearance query_clearance(imp_scene *scene, const imp_options *options,
                                            const imp_clearance_options *asked)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_clearance found = {.struct_size = sizeof found};
    imp_query *query = imp_clearance_new(scene, options, asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_int_eq(imp_query_step(query, 0, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_clearance_get(query, 0, &found, &error), IMP_SUCCESS);
    imp_query_free(query);
    return found;
}

/* Asks for the least distance, with the usual options if `asked` is NULL. It is enclosed within
 * `part` of the one that is known, and to a thousandth, by that many pairs at most. */
static inline void query_brackets(imp_scene *scene, const imp_options *options,
                                  const imp_clearance_options *asked, double distance, double part,
                                  uint64_t pairs)
{
    const imp_clearance found = query_clearance(scene, options, asked);
    ck_assert_msg(found.stats.pairs <= pairs, "%llu pairs", (unsigned long long)found.stats.pairs);
    ck_assert_double_le(found.lower, distance * (1 + part));
    ck_assert_double_ge(found.upper, distance * (1 - part));
    ck_assert_double_le(found.upper - found.lower, 1e-3 * found.upper);
}

/* The types come from `registry`: tests that ask often make one once. */
static inline imp_result ask_in(imp_registry *registry, const question *q)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, q->a, q->b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    const imp_options options = query_options(scene, q);
    imp_result result = {.struct_size = sizeof result};
    const imp_code code = imp_scene_solve(scene, &options, &result, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s | %s: %s", q->a, q->b, error.text);
    query_check(scene, &options, &result);
    imp_scene_free(scene);
    return result;
}

static inline imp_result ask(const question *q)
{
    imp_registry *registry = query_registry();
    const imp_result result = ask_in(registry, q);
    imp_registry_free(registry);
    return result;
}

/* Contact at `time`: never reported later, and earlier by at most `early` (gamma over the closing
 * speed, or more where they meet slowly). */
static inline imp_result ask_contact(const question *q, double time, double early)
{
    const imp_result r = ask(q);
    ck_assert_msg(
        r.verdict == IMP_VERDICT_CONTACT && r.t <= time && r.t >= time - early,
        "%s | %s: verdict %d (reason %d), t_lower %.17g, expected contact in [%.17g, %.17g]", q->a,
        q->b, (int)r.verdict, (int)r.reason, r.t_lower, time - early, time);
    return r;
}

static inline imp_result ask_clear(const question *q)
{
    const imp_result r = ask(q);
    ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR,
                  "%s | %s: verdict %d (reason %d), t_lower %.17g, expected clear", q->a, q->b,
                  (int)r.verdict, (int)r.reason, r.t_lower);
    return r;
}

#endif
