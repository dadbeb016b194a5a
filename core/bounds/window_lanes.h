/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_WINDOW_LANES_H
#define CORE_BOUNDS_WINDOW_LANES_H

#include "core/bounds/difference.h"

#include <impinge/quad.h>

/* Cuts of a window by inequalities, four side by side: w_range_cut, in lanes. */

/* The range [lo, hi] of w at which the inequalities low + drift w <= limit of each lane hold;
 * `gone`: they hold nowhere. */
typedef struct window_lanes {
    imp_quad lo, hi;
    imp_quad_mask gone;
} window_lanes;

IMP_QUAD_INLINE window_lanes window_lanes_none(void)
{
    return (window_lanes){imp_quad_all(-1), imp_quad_all(1), (imp_quad_mask){0}};
}

/* Keeps in each lane the w with low + drift w <= limit; a NaN keeps everything. */
IMP_QUAD_INLINE void window_lanes_add(window_lanes *c, imp_quad low, imp_quad drift, imp_quad limit)
{
    const imp_quad reach = imp_quad_abs(drift);
    c->gone |= low - reach > limit;
    const imp_quad_mask some = low + reach > limit;
    if (!imp_quad_any(some)) return;
    const imp_quad w = (limit - low) / drift;
    const imp_quad slack = imp_quad_all(W_RANGE_ROUNDING * UNIT_ROUNDOFF);
    c->hi = imp_quad_pick(some & (drift > imp_quad_all(0)), imp_quad_min(w + slack, c->hi), c->hi);
    c->lo = imp_quad_pick(some & (drift < imp_quad_all(0)), imp_quad_max(w - slack, c->lo), c->lo);
}

/* Cuts s by all lanes. False: nothing is left. */
IMP_QUAD_INLINE bool window_lanes_take(w_range *s, const window_lanes *c)
{
    if (imp_quad_any(c->gone)) return false;
    w_range left = *s;
    for (int k = 0; k < IMP_QUAD; ++k) {
        left.hi = c->hi[k] < left.hi ? c->hi[k] : left.hi;
        left.lo = c->lo[k] > left.lo ? c->lo[k] : left.lo;
    }
    *s = left;
    return !(left.lo > left.hi);
}

#endif
