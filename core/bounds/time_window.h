/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_TIME_WINDOW_H
#define CORE_BOUNDS_TIME_WINDOW_H

#include "core/base/rounding.h"
#include "core/tree/node.h"

/* Windows of time in which two nodes may be near, and how bounds cut them
 * =======================================================================
 * Bounds are linear in w, which runs from -1 to 1 over a window: t = mid + half * w. */

typedef struct time_window {
    double lo, hi; /* lo <= hi */
} time_window;

/* Exceeds the error of two products that underflow; every cut of a window is moved outward by
 * it. */
#define WINDOW_TINY 0x1p-1070

/* Returns the distance from the window's middle to either end, rounded up. */
PAD_COVERS(4, 1); /* one difference */
static inline double window_half_upper(const time_window *window, double mid)
{
    const double above = window->hi - mid, below = mid - window->lo;
    return padded_upper(above > below ? above : below, 4);
}

/* The times of a window as a region, whose u and v are 0. */
static inline imp_region window_region(const time_window *window)
{
    return region_make((double[3]){0, 0, window->lo}, (double[3]){0, 0, window->hi});
}

/* The intersection of two windows; lo > hi: it is empty. */
time_window window_common(time_window x, time_window y);

/* The times that both nodes have. */
time_window pair_times(const node *a, const node *b);

/* The range in which w may be: [lo, hi] within [-1, 1]. */
typedef struct w_range {
    double lo, hi;
} w_range;

/* Cuts a window with this middle and half-width to the range `s` of w, rounded outward. In units of
 * u (|mid| + half): half w is off by 1, its sum with mid by 1, the sum with the slack by 1.
 * WINDOW_TINY covers what underflows. */
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
