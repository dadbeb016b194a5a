/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/distance_halving.h"

#include <impinge/model.h>

#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"

/* Whether a slides along b within itself, or the pair is searched at one moment that represents all
 * times. */
static bool is_within_itself(const distance_question *q)
{
    return distance_slides(q) || q->a->region.lo[PARAMETER_T] == q->a->region.hi[PARAMETER_T];
}

/* Whether halves of this node alone, whose remainders are much smaller but for the floor, are
 * likely to be separated: the polynomial without the remainder proves the node apart, or varies
 * little beside the remainder, as between parallel surfaces; or the node slides within itself, so
 * that at all times some neighbours are as near. Such halves then help more than halves of its
 * neighbours. False if the remainder is mere rounding, or the node so large that the remainder
 * exceeds its extents. */
static bool is_worth_halving(const distance_question *q, const halving_signs *of, double floor)
{
    const node *n = q->a;
    const double extent = n->extent[PARAMETER_U] + n->extent[PARAMETER_V], e = of->g->e - floor;
    const double *least = of->least, farther = least[0] > least[1] ? least[0] : least[1];
    if (q->held != 0 && fabs(of->g->a) - of->g->e > of->limit) return true;
    if (!(e > TUNING_DISTANCE_ROUNDING * of->size && e < TUNING_DISTANCE_EXTENT * extent))
        return false;
    const bool is_level = -(least[0] + least[1]) < TUNING_DISTANCE_LEVEL * e;
    return farther - floor + (is_within_itself(q) || is_level ? e : 0) > of->limit;
}

/* The points' middle, which moves in time alone. */
static imp_model middle_of(const imp_model *x, bool moves)
{
    const double way = fabs(x->b[PARAMETER_T]) + fabs(x->q[IMP_TT]);
    if (!moves) return imp_num(x->a);
    return (imp_model){.a = x->a,
                       .b = {[PARAMETER_T] = x->b[PARAMETER_T]},
                       .q = {[IMP_TT] = x->q[IMP_TT]},
                       .lo = x->a - way,
                       .hi = x->a + way,
                       .rate = {INFINITY, INFINITY, INFINITY},
                       .depends = 1 << PARAMETER_T};
}

/* Computes the remainder that the distance of the points' middle has at these times, which halves
 * in u and v do not make smaller: what the other surface itself is known within, and slips; and
 * what is due to time. */
static imp_code find_rest(const distance_question *q, const imp_model point[3],
                          const imp_region *times, double *rest, imp_error *error)
{
    imp_model middle[3], g;
    for (int i = 0; i < 3; ++i) middle[i] = middle_of(&point[i], times->d[PARAMETER_T] > 0);
    const imp_status status = distance_of_points(q, times, middle, &g);
    *rest = status == IMP_STATUS_OK ? g.e : 0;
    if (status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    return distance_fault(q->b->surface, status, error);
}

/* Whether the distance's remainder is mostly that of its points, which halves make smaller. */
static bool is_of_points(const halving_signs *of)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += of->point[i].e;
    return of->g->e < TUNING_DISTANCE_OF_POINTS * sum;
}

/* Where a surface is known within a bump of it, or is round but for that, a node that reaches
 * through it is not separated, however small it is; and a node that moves fast only by cuts in
 * time. Large nodes, whose middle may be far from their points, are not looked at. In a search for
 * the least distance halves in time double the work, since its windows do not become shorter. */
imp_code distance_judge_halving(const distance_question *q, const halving_signs *of,
                                distance_view *view, imp_error *error)
{
    const imp_region *r = &q->a->region, now = region_make(r->c, r->c);
    double floor = 0, in_time = 0;
    view->is_promising = is_worth_halving(q, of, 0);
    if (!view->is_promising || is_of_points(of)) return IMP_SUCCESS;
    if (!q->is_ball && !strategy_is_small(q->a)) return IMP_SUCCESS;
    imp_code code = find_rest(q, of->point, &now, &floor, error);
    if (code != IMP_SUCCESS) return code;
    view->is_promising = is_worth_halving(q, of, floor);
    if (!view->is_promising || !q->seeks_contact || !(r->d[PARAMETER_T] > 0)) return IMP_SUCCESS;
    code = find_rest(q, of->point, r, &in_time, error);
    const double due = TUNING_DISTANCE_IN_TIME * (in_time - floor);
    if (due > 0 && due < INFINITY) view->bend[PARAMETER_T] += due;
    return code;
}
