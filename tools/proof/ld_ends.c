/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/ld_interval.h"

#include <math.h>

/* What needs no rounding: the checker's arithmetic (ld_interval.c) and the verifier's, which is
 * MPFI's, have it in common. */

static long double larger(long double a, long double b) { return a > b ? a : b; }
static long double smaller(long double a, long double b) { return a < b ? a : b; }

ld_interval ld_interval_make(long double lo, long double hi)
{
    return (ld_interval){lo > -INFINITY ? lo : -INFINITY, hi < INFINITY ? hi : INFINITY};
}

ld_interval ld_interval_of(long double x) { return ld_interval_make(x, x); }

ld_interval ld_interval_entire(void) { return (ld_interval){-INFINITY, INFINITY}; }

bool ld_interval_is_within(ld_interval x, ld_interval limits)
{
    return x.lo >= limits.lo && x.hi <= limits.hi;
}

bool ld_interval_is(ld_interval x, long double value) { return x.lo == value && x.hi == value; }

long double ld_interval_mag(ld_interval x) { return larger(fabsl(x.lo), fabsl(x.hi)); }

long double ld_interval_mid(ld_interval x)
{
    return smaller(larger(0.5L * x.lo + 0.5L * x.hi, x.lo), x.hi);
}

ld_interval ld_interval_hull(ld_interval x, ld_interval y)
{
    return ld_interval_make(smaller(x.lo, y.lo), larger(x.hi, y.hi));
}

ld_interval ld_interval_intersect(ld_interval x, ld_interval y)
{
    return ld_interval_make(larger(x.lo, y.lo), smaller(x.hi, y.hi));
}

ld_interval ld_interval_plus_minus(long double size) { return ld_interval_make(-size, size); }

ld_interval ld_interval_neg(ld_interval x) { return (ld_interval){-x.hi, -x.lo}; }

ld_interval ld_interval_abs(ld_interval x)
{
    return ld_interval_make(larger(larger(x.lo, -x.hi), 0), ld_interval_mag(x));
}

ld_interval ld_interval_min(ld_interval x, ld_interval y)
{
    return ld_interval_make(smaller(x.lo, y.lo), smaller(x.hi, y.hi));
}

ld_interval ld_interval_max(ld_interval x, ld_interval y)
{
    return ld_interval_make(larger(x.lo, y.lo), larger(x.hi, y.hi));
}
