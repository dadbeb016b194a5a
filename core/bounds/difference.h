/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DIFFERENCE_H
#define CORE_BOUNDS_DIFFERENCE_H

#include <stddef.h>

#include "core/bounds/time_window.h"

/* The Minkowski difference of two nodes' Taylor models, re-centred on a window of time. */

/* One surface over the window t = mid + half * w, w in [-1, 1]: the polynomial in s_u, s_v at the
 * window's middle, and how its coefficients change with w. Each array, here and below, holds x, y,
 * z and a 0. */
typedef struct slice {
    double bu[4], bv[4], quu[4], quv[4], qvv[4];
    double quw[4], qvw[4];         /* the slopes at w are bu + quw * w, bv + qvw * w */
    double uuw[4], uvw[4], vvw[4]; /* changes of quu, quv, qvv with w; only set if r.posed > 0 */
    vec3 normal; /* bu x bv: at the window's middle, which may be far from the node's */
} slice;

/* B - A over the window: offset delta + drift * w + bend * w^2, plus slice b, minus slice a, plus
 * or minus slack, and plus, for each posed node i, the sum over k = 0, 1, 2 of d_k (edge[i].k +
 * swing[i].k w), any |d_k| <= 1; edge[i][j][k] is coordinate j of edge k. */
typedef struct difference {
    slice a, b;
    double delta[4], drift[4], bend[4];
    double slack[4]; /* both remainders, and the rounding of moving the centre */
    int posed;       /* number of posed nodes: their remainders turn (posed_terms.h) */
    double edge[2][3][4], swing[2][3][4]; /* of posed nodes; slack has the rest */
    double magnitude[4];                  /* >= sum of abs of the coefficients above */
    double squares;    /* 0: neither slice has a square of s_u or s_v; else not 0, or NaN */
    double ball;       /* B - A is the sum of x above and of any vector no longer than this */
    double mid, half;  /* of the window; half is rounded up */
    double share;      /* GJK stops at an axis that shows this part of the widest gap */
    double focus;      /* the w that axes are chosen for; -1: the start of the window */
    size_t way_count;  /* 0, unless the caller sets it and */
    double (*ways)[4]; /* ways: B - A is the sum of x above and of d_k ways[k], |d_k| <= 1 */
} difference;

/* Rounding of a `difference`'s coefficients that slack does not count: units of u times
 * `magnitude`. */
enum { DIFFERENCE_ROUNDING = 4 };

void difference_at(const node *a, const node *b, const time_window *window, difference *r);

/* Estimates the offset at w. */
static inline vec3 difference_offset(const difference *r, double w)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = r->delta[i] + (r->drift[i] + r->bend[i] * w) * w;
    return x;
}

#endif
