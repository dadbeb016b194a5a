/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_CLEARANCE_HELPERS_H
#define TESTS_SUPPORT_CLEARANCE_HELPERS_H

#include "tests/support/scene_variants.h"

#include <impinge/baseline.h>

/* Questions for a minimum distance; each answer is held against what it promises by itself. */

/* --- Asking ----------------------------------------------------------------------------------- */

static inline imp_clearance read_answer(const imp_query *query, size_t index)
{
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    ck_assert_int_eq(imp_clearance_get(query, index, &answer, NULL), IMP_SUCCESS);
    return answer;
}

static inline void check_point(const imp_scene *scene, const imp_side *side, double t)
{
    const double p[3] = {side->u, side->v, t};
    double x[3], inexact[3];
    ck_assert_int_eq(imp_scene_eval(scene, side->body, side->surface, 1, p, x, inexact, NULL),
                     IMP_SUCCESS);
    ck_assert_double_eq(query_distance(x, side->point), 0);
}

/* What every answer promises by itself. */
static inline void check_answer_itself(const imp_scene *scene, const imp_clearance *a,
                                       double tolerance, double gamma)
{
    ck_assert(a->lower >= 0 && a->lower <= a->upper);
    if (a->reason == IMP_REASON_NONE)
        ck_assert(a->upper - a->lower <= tolerance * a->upper || a->upper <= gamma);
    if (a->reason == IMP_REASON_DECIDED)
        ck_assert(a->has_witness &&
                  a->verdict == (a->lower >= a->required * (1 - 1e-6) ? IMP_REQUIREMENT_HOLDS
                                                                      : IMP_REQUIREMENT_VIOLATED));
    if (!a->has_witness) return;
    ck_assert(a->t >= a->t_start && a->t <= a->t_end && a->a.body < a->b.body);
    check_point(scene, &a->a, a->t);
    check_point(scene, &a->b, a->t);
    ck_assert_double_le(query_distance(a->a.point, a->b.point), a->upper * (1 + 1e-15));
    if (isnan(a->t_violated)) return;
    ck_assert(a->t_violated >= a->t_start && a->t_violated <= a->t_end);
    check_point(scene, &a->a_violated, a->t_violated);
    check_point(scene, &a->b_violated, a->t_violated);
    ck_assert(a->gap_violated <= a->required);
}

static inline imp_query *begin(imp_scene *scene, const imp_options *options,
                               const imp_clearance_options *asked)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_query *query = imp_clearance_new(scene, options, asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    return query;
}

static inline imp_reason step(imp_query *query, uint64_t pairs)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_query_step(query, pairs, &error) == IMP_SUCCESS, "%s", error.text);
    return imp_query_result(query).reason;
}

/* The first answer, checked. */
static inline imp_clearance measure(imp_scene *scene, const imp_options *options,
                                    const imp_clearance_options *asked)
{
    imp_query *query = begin(scene, options, asked);
    step(query, 0);
    const imp_clearance answer = read_answer(query, 0);
    check_answer_itself(scene, &answer, asked->tolerance, options->gamma);
    imp_query_free(query);
    return answer;
}

static inline imp_scene *scene_of(imp_registry *registry, const char *a, const char *b)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static inline imp_clearance measure_pair(imp_registry *registry, const char *a, const char *b,
                                         double tolerance, double required)
{
    imp_scene *scene = scene_of(registry, a, b);
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.tolerance = tolerance;
    asked.required = required;
    const imp_clearance answer = measure(scene, &options, &asked);
    imp_scene_free(scene);
    return answer;
}

/* --- Points sampled, and contact -------------------------------------------------------------- */

/* The scene until shortly before its bodies meet. */
static inline imp_options before_contact(const imp_scene *scene, const ladder *l)
{
    imp_options options = imp_options_default(scene);
    options.gamma = rung_gamma(l->about, &plain, 2);
    if (l->rung[1].verdict == IMP_VERDICT_CONTACT) options.t_end = 0.9 * l->rung[0].t_lower;
    return options;
}

/* --- Something is required -------------------------------------------------------------------- */

/* Centres (3 - 6 t, 2): the gap is sqrt((3 - 6 t)^2 + 4) - 1.5, at least 0.5. */
static const char *const still = "sphere",
                         *passing = "sphere radius=0.5 center=-3,2,0 ! translate velocity=6,0,0";

/* Asks one question with and without a bracket as narrow as the tolerance. */
static inline void decide(imp_scene *scene, const imp_options *options, double required,
                          imp_clearance *narrow, imp_clearance *decided)
{
    imp_clearance_options asked = imp_clearance_options_default();
    ck_assert(!asked.decide);
    asked.required = required;
    *narrow = measure(scene, options, &asked);
    asked.decide = true;
    *decided = measure(scene, options, &asked);
}

/* --- What was asked before -------------------------------------------------------------------- */

static const char three_bodies[] =
    "{\"bodies\":["
    "{\"name\":\"a\",\"surfaces\":[{\"type\":\"sphere\"}]},"
    "{\"name\":\"b\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[3,0,0]},"
    "{\"type\":\"sphere\",\"center\":[0,5,0]}]},"
    "{\"name\":\"c\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[8,0,0]}],"
    "\"maps\":[{\"type\":\"translate\",\"velocity\":[-2,0,0]}]},"
    "{\"name\":\"d\",\"surfaces\":[{\"type\":\"sphere\",\"center\":[0,0,0.5]}]}],"
    "\"ignore\":[[\"a\",\"d\"]]}";

static inline imp_scene *scene_of_three(imp_registry *registry)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene =
        imp_scene_from_json(registry, three_bodies, sizeof three_bodies - 1, "three", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

#endif
