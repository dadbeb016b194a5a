/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_RELATIVE_H
#define CORE_SOLVER_RELATIVE_H

#include "core/base/rounding.h"
#include "core/tree/node.h"

/* Two nodes' models, re-centred on a window of time and seen from each other. */

typedef struct time_window {
    double lo, hi; /* lo <= hi */
} time_window;

/* More than what two products that underflow are off by: windows are cut with that much to spare. */
#define WINDOW_TINY 0x1p-1070

/* From its middle to either end, rounded up. */
PAD_COVERS(4, 1); /* one difference */
static inline double window_half_upper(const time_window *window, double mid)
{
    const double above = window->hi - mid, below = mid - window->lo;
    return padded_upper(above > below ? above : below, 4);
}

/* One surface over the window t = mid + half * w, w in [-1, 1]: the polynomial in s_u, s_v that
 * holds at its middle, and how its slopes turn with w. x, y, z and a 0, here and below. */
typedef struct slice {
    double bu[4], bv[4], quu[4], quv[4], qvv[4];
    double quw[4], qvw[4]; /* the slopes at w are bu + quw * w, bv + qvw * w */
    double uuw[4], uvw[4],
        vvw[4];  /* the same of quu, quv, qvv; where r.posed > 0, else not filled */
    vec3 normal; /* bu x bv: at the window's middle, which may be far from the node's */
} slice;

/* B - A over the window: offset delta + drift * w + bend * w^2, plus slice b, minus slice a, give or take
 * slack, and plus, for each posed node i, the sum over k = 0, 1, 2 of d_k (edge[i].k + swing[i].k w), any
 * |d_k| <= 1; edge[i][j][k] is coordinate j of edge k. */
typedef struct relative {
    slice a, b;
    double delta[4], drift[4], bend[4];
    double slack[4]; /* both remainders, and the rounding of moving the centre */
    int posed;       /* nodes that are posed: the edges of their remainders turn (posed_terms.h), */
    double edge[2][3][4], swing[2][3][4]; /* and only the rest of these is in the slack */
    double magnitude[4];                  /* >= sum of abs of the coefficients above */
    double squares;   /* 0: neither slice has a square of s_u or s_v; else not 0, or NaN */
    double mid, half; /* of the window; half is rounded up */
    double share;     /* of the widest gap along any axis, that a search for one must come to */
    double focus;     /* the w that axes are chosen for; -1: the start of the window */
} relative;

/* What the coefficients in `relative` may be off by beside what slack counts: units of u times
 * `magnitude`. */
enum { RELATIVE_ROUNDING = 4 };

void relative_at(const node *a, const node *b, const time_window *window, relative *r);

/* The offset at w, about. */
static inline vec3 relative_offset(const relative *r, double w)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = r->delta[i] + (r->drift[i] + r->bend[i] * w) * w;
    return x;
}

/* Where w may be: [lo, hi] within [-1, 1]. */
typedef struct w_range {
    double lo, hi;
} w_range;

/* Cuts a window, whose middle and half these are, to the part that `s` leaves, rounded outward. In units
 * of u (|mid| + half): half w is off by 1, its sum with mid by 1, that with the slack by 1. WINDOW_TINY
 * covers what underflows. */
enum { WINDOW_ROUNDING = 4 };
_Static_assert(1 + 1 + 1 <= WINDOW_ROUNDING, "rounding of a window");

static inline void window_cut(time_window *window, double mid, double half, const w_range *s)
{
    const double slack = (fabs(mid) + half) * (WINDOW_ROUNDING * UNIT_ROUNDOFF) + WINDOW_TINY;
    const double lo = mid + half * s->lo - slack, hi = mid + half * s->hi + slack;
    if (s->lo > -1 && lo > window->lo) window->lo = lo < window->hi ? lo : window->hi;
    if (s->hi < 1 && hi < window->hi) window->hi = hi > window->lo ? hi : window->lo;
}

enum { W_RANGE_ROUNDING = 8 }; /* units of u by which a bound of w is moved outward */

/* Keeps the w with low + drift w <= limit; false: there is none. NaN keeps everything. */
bool w_range_cut(w_range *s, double low, double drift, double limit);

#endif
