/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_RELATIVE_H
#define CORE_RELATIVE_H

#include "node.h"

/* Two nodes' models, re-centred on a window of time and seen from each other. */

typedef struct time_window {
    double lo, hi; /* lo <= hi */
} time_window;

/* One surface over the window t = mid + half * w, w in [-1, 1]: the polynomial in s_u, s_v that
 * holds at its middle, and how its slopes turn with w. x, y, z and a 0, here and below. */
typedef struct slice {
    double bu[4], bv[4], quu[4], quv[4], qvv[4];
    double quw[4], qvw[4]; /* the slopes at w are bu + quw * w, bv + qvw * w */
    vec3 normal;           /* bu x bv: at the window's middle, which may be far from the node's */
} slice;

/* B - A over the window: offset delta + drift * w, plus slice b, minus slice a, give or take slack.
 */
typedef struct relative {
    slice a, b;
    double delta[4], drift[4];
    double slack[4];     /* both remainders, what moving the centre put there, and its rounding */
    double magnitude[4]; /* >= sum of abs of the coefficients above */
    double mid, half;    /* of the window; half is rounded up */
} relative;

void relative_at(const node *a, const node *b, const time_window *window, relative *r);

/* Where w may be: [lo, hi] within [-1, 1]. */
typedef struct share {
    double lo, hi;
} share;

/* Keeps the w with low + drift w <= limit; false: there is none. NaN keeps everything. */
bool share_cut(share *s, double low, double drift, double limit);

#endif
