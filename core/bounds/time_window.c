/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/time_window.h"

time_window window_common(time_window x, time_window y)
{
    return (time_window){x.lo > y.lo ? x.lo : y.lo, x.hi < y.hi ? x.hi : y.hi};
}

time_window pair_times(const node *a, const node *b)
{
    const imp_region *r = &a->region, *s = &b->region;
    return window_common((time_window){r->lo[2], r->hi[2]}, (time_window){s->lo[2], s->hi[2]});
}

/* Roundings of w, |w| <= 1: the difference 1, the quotient 1, moving it outward 1. */
_Static_assert(1 + 1 + 1 <= W_RANGE_ROUNDING, "rounding of w");

bool w_range_cut(w_range *s, double low, double drift, double limit)
{
    if (low + fabs(drift) <= limit) return true;
    if (low - fabs(drift) > limit) return false;
    const double w = (limit - low) / drift;
    const double slack = W_RANGE_ROUNDING * UNIT_ROUNDOFF;
    if (drift > 0 && w + slack < s->hi) s->hi = w + slack;
    if (drift < 0 && w - slack > s->lo) s->lo = w - slack;
    return !(s->lo > s->hi);
}
