/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "region.h"

#include <assert.h>

/* Lemma. c is a double in [lo, hi] and d covers both halves in exact arithmetic. The larger half is
 * one difference, computed as r with r (1 + 2^-53) >= the exact one; adding r 2^-51 and rounding
 * once more gives at least r (1 + 2^-51)(1 - 2^-53) > r (1 + 2^-53). Differences of doubles never
 * underflow inexactly. */
static void interval_centre(double lo, double hi, double *c, double *d)
{
    double mid = 0.5 * lo + 0.5 * hi;
    if (!(mid > lo)) mid = lo;
    if (!(mid < hi)) mid = hi;
    const double below = mid - lo, above = hi - mid;
    const double reach = below > above ? below : above;
    *c = mid;
    *d = reach + reach * 0x1p-51;
}

imp_region region_make(const double lo[3], const double hi[3])
{
    imp_region r;
    for (int j = 0; j < 3; ++j) {
        assert(lo[j] <= hi[j]);
        r.lo[j] = lo[j];
        r.hi[j] = hi[j];
        interval_centre(lo[j], hi[j], &r.c[j], &r.d[j]);
    }
    return r;
}

bool region_can_split(const imp_region *region, parameter j)
{
    return region->lo[j] < region->c[j] && region->c[j] < region->hi[j];
}

imp_region region_half(const imp_region *region, parameter j, int side)
{
    assert(region_can_split(region, j));
    imp_region half = *region;
    *(side ? &half.lo[j] : &half.hi[j]) = region->c[j];
    interval_centre(half.lo[j], half.hi[j], &half.c[j], &half.d[j]);
    return half;
}

double region_reach_upper(const imp_region *region, const double rate[3])
{
    double sum = 0;
    for (int j = 0; j < 3; ++j)
        if (region->d[j] > 0) sum += rate[j] * region->d[j];
    /* three products, three sums of non-negative terms: (1 + 2^-53)^6 < 1 + 2^-50 */
    return sum + sum * 0x1p-50 + 0x1p-1070;
}
