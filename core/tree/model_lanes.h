/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_MODEL_LANES_H
#define CORE_TREE_MODEL_LANES_H

#include <impinge/quad.h>
#include <stddef.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/tree/node.h"
#include "core/tree/triple.h"

/* The models of three coordinates side by side
 * ============================================
 * One quad holds a coefficient of x, y and z; its fourth lane is 0. Files that fill nodes compile
 * these functions for both register widths; distance.c uses the narrow one. */

typedef struct model_lanes {
    imp_quad a, b[3], q[6], e, lo, hi, rate[3];
} model_lanes;

IMP_QUAD_INLINE imp_quad lanes_gather_one(const imp_model m[3], size_t offset)
{
    const double *x = (const double *)((const char *)m + offset);
    const size_t step = sizeof *m / sizeof *x;
    return (imp_quad){x[0], x[step], x[2 * step], 0};
}

IMP_QUAD_INLINE void lanes_gather(const imp_model m[3], model_lanes *all)
{
    all->a = lanes_gather_one(m, offsetof(imp_model, a));
    all->e = lanes_gather_one(m, offsetof(imp_model, e));
    all->lo = lanes_gather_one(m, offsetof(imp_model, lo));
    all->hi = lanes_gather_one(m, offsetof(imp_model, hi));
    for (size_t j = 0; j < 3; ++j) all->b[j] = lanes_gather_one(m, offsetof(imp_model, b) + 8 * j);
    for (size_t j = 0; j < 3; ++j)
        all->rate[j] = lanes_gather_one(m, offsetof(imp_model, rate) + 8 * j);
    for (size_t k = 0; k < 6; ++k) all->q[k] = lanes_gather_one(m, offsetof(imp_model, q) + 8 * k);
}

IMP_QUAD_INLINE double lanes_sum(imp_quad x) { return x[0] + x[1] + x[2]; }

/* How points of a region depend on each of u, v and t, by coordinate: the curved part of their
 * motion along it, and its share of the remainder. The remainder is distributed in proportion to
 * what the linear terms do not explain: the curved part, and what the rate allows beyond the slope.
 * This decides only what to split. */
typedef struct lanes_spread {
    imp_quad curved[3], blame[3];
} lanes_spread;

/* `d`: half-widths of the region. */
IMP_QUAD_INLINE lanes_spread lanes_spread_of(const model_lanes *m, const double d[3])
{
    const imp_quad none = imp_quad_all(0), half = imp_quad_all(0.5),
                   infinite = imp_quad_all(INFINITY);
    const imp_quad uv = half * imp_quad_abs(m->q[IMP_UV]), ut = half * imp_quad_abs(m->q[IMP_UT]);
    const imp_quad vt = half * imp_quad_abs(m->q[IMP_VT]);
    lanes_spread s = {.curved = {imp_quad_abs(m->q[IMP_UU]) + uv + ut,
                                 imp_quad_abs(m->q[IMP_VV]) + uv + vt,
                                 imp_quad_all(2) * imp_quad_abs(m->q[IMP_TT]) + ut + vt}};
    imp_quad unexplained[3], sum = none;
    for (int j = 0; j < 3; ++j) {
        const imp_quad beyond =
            imp_quad_max(m->rate[j] * imp_quad_all(d[j]) - imp_quad_abs(m->b[j]), none);
        unexplained[j] = imp_quad_pick(m->rate[j] < infinite, s.curved[j] + beyond,
                                       imp_quad_all(d[j] > 0 ? 0x1p500 : 0));
        sum += unexplained[j];
    }
    const imp_quad_mask blamed = (sum > none) & (m->e < infinite);
    for (int j = 0; j < 3; ++j)
        s.blame[j] = imp_quad_pick(blamed, m->e * (unexplained[j] / sum), none);
    return s;
}

/* Estimates how far u, v and t move a point across the region, and how much of that is not linear.
 * The length of a motion is about LENGTH_OF_SUM of the sum of its coordinates; the remainder, a
 * box, counts in full; the weight of acceleration was chosen by measurement. */
static const double LENGTH_OF_SUM = 0.6;

/* Returns lanes_sum of four quads. */
IMP_QUAD_INLINE imp_quad lanes_sums(imp_quad x[4])
{
    imp_quad_transpose(x);
    return x[0] + x[1] + x[2];
}

_Static_assert(offsetof(node, nonlinear_extent) == offsetof(node, extent) + 3 * sizeof(double) &&
                   offsetof(node, time_remainder) == offsetof(node, extent) + 6 * sizeof(double),
               "extents and time's remainder are side by side");

IMP_QUAD_INLINE void lanes_take_spread(node *n, const model_lanes *m)
{
    const imp_quad none = imp_quad_all(0), infinite = imp_quad_all(INFINITY);
    const lanes_spread s = lanes_spread_of(m, n->region.d);
    imp_quad bend[4], reach[4];
    for (int j = 0; j < 3; ++j) {
        bend[j] = s.curved[j] + s.blame[j];
        reach[j] = imp_quad_all(LENGTH_OF_SUM) * (imp_quad_abs(m->b[j]) + s.curved[j]) + s.blame[j];
    }
    bend[3] = reach[3] = imp_quad_pick(m->rate[PARAMETER_T] < infinite, s.blame[PARAMETER_T], none);
    double *const extents = (double *)((char *)n + offsetof(node, extent));
    imp_quad_store(extents, lanes_sums(reach));
    imp_quad_store(extents + 3, lanes_sums(bend));
}

_Static_assert(sizeof(quadratic3) == 30 * sizeof(double), "coefficients are stored one by one");

/* From the first on: a store writes one number behind its row, which the next store corrects. */
IMP_QUAD_INLINE void lanes_take_polynomial(quadratic3 *f, const model_lanes *m)
{
    double *const x = (double *)(void *)f;
    imp_quad_store(x, m->a);
    imp_quad_store(x + 3, m->b[0]);
    imp_quad_store(x + 6, m->b[1]);
    imp_quad_store(x + 9, m->b[2]);
    imp_quad_store(x + 12, m->q[IMP_UU]);
    imp_quad_store(x + 15, m->q[IMP_UV]);
    imp_quad_store(x + 18, m->q[IMP_UT]);
    imp_quad_store(x + 21, m->q[IMP_VV]);
    imp_quad_store(x + 24, m->q[IMP_VT]);
    triple_store(f->qtt, m->q[IMP_TT]);
}

/* Whether polynomial, remainder and range are finite. */
IMP_QUAD_INLINE bool lanes_are_bounded(const model_lanes *m)
{
    imp_quad sum = imp_quad_abs(m->a) + m->e;
    for (int j = 0; j < 3; ++j) sum += imp_quad_abs(m->b[j]);
    for (int k = 0; k < 6; ++k) sum += imp_quad_abs(m->q[k]);
    const imp_quad infinite = imp_quad_all(INFINITY);
    const imp_quad_mask fine = (sum < infinite) & (m->lo > -infinite) & (m->hi < infinite);
    return !imp_quad_any(~fine);
}

/* Whether bounded models also keep the other promises of imp_model (breach_of). */
IMP_QUAD_INLINE bool lanes_are_sound(const model_lanes *m)
{
    const imp_quad none = imp_quad_all(0), infinite = imp_quad_all(INFINITY);
    imp_quad_mask fine = (m->e >= none) & (m->lo <= m->hi);
    for (int j = 0; j < 3; ++j) fine &= (m->rate[j] >= none) & (m->rate[j] < infinite);
    return !imp_quad_any(~fine);
}

_Static_assert(offsetof(node, lo) == offsetof(node, e) + 3 * sizeof(double) &&
                   offsetof(node, hi) == offsetof(node, e) + 6 * sizeof(double),
               "remainder and box are side by side");

/* Fills n with bounded models that keep the promises of imp_model. */
IMP_QUAD_INLINE void lanes_take(node *n, const model_lanes *m)
{
    lanes_take_polynomial(&n->f, m);
    double *const box = (double *)((char *)n + offsetof(node, e));
    imp_quad_store(box, m->e);
    imp_quad_store(box + 3, m->lo);
    triple_store(n->hi, m->hi);
    lanes_take_spread(n, m);
    n->bounded = true;
}

/* Adds a ball around the line that the node's models follow. */
IMP_QUAD_INLINE void lanes_add_ball(node *n, double ball)
{
    n->ball = ball;
    for (int i = 0; i < 3; ++i) {
        n->e[i] = sum_upper(n->e[i], ball);
        n->lo[i] = difference_lower(n->lo[i], ball);
        n->hi[i] = sum_upper(n->hi[i], ball);
    }
}

#endif
