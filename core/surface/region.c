/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/region.h"

#include <assert.h>

#include "core/base/rounding.h"

/* Lemma. c is a double in [lo, hi] and d covers both halves in exact arithmetic: the larger half is
 * one difference, padded. Differences of doubles never underflow inexactly. */
PAD_COVERS(4, 1);
static void interval_centre(double lo, double hi, double *c, double *d)
{
    double mid = 0.5 * lo + 0.5 * hi;
    if (!(mid > lo)) mid = lo;
    if (!(mid < hi)) mid = hi;
    const double below = mid - lo, above = hi - mid;
    const double reach = below > above ? below : above;
    *c = mid;
    *d = padded_upper(reach, 4);
}

void region_set(imp_region *region, const double lo[3], const double hi[3])
{
    for (int j = 0; j < 3; ++j) {
        assert(lo[j] <= hi[j]);
        region->lo[j] = lo[j];
        region->hi[j] = hi[j];
        interval_centre(lo[j], hi[j], &region->c[j], &region->d[j]);
    }
}

imp_region region_make(const double lo[3], const double hi[3])
{
    imp_region r;
    region_set(&r, lo, hi);
    return r;
}

void region_set_half(imp_region *half, const imp_region *region, parameter j, int side)
{
    assert(region_can_split(region, j));
    *half = *region;
    *(side ? &half->lo[j] : &half->hi[j]) = region->c[j];
    interval_centre(half->lo[j], half->hi[j], &half->c[j], &half->d[j]);
}

/* Each term is a product and goes through at most three sums of non-negative terms. */
PAD_COVERS(8, 1 + 3);
double region_reach_upper(const imp_region *region, const double rate[3])
{
    double sum = 0;
    for (int j = 0; j < 3; ++j)
        if (region->d[j] > 0) sum += rate[j] * region->d[j];
    return padded_upper(sum, 8) + PRODUCTS_UNDERFLOW;
}
