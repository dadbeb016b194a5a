/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_LD_ENDS_H
#define TOOLS_PROOF_LD_ENDS_H

#include <math.h>
#include <stdbool.h>

/* What needs no rounding of the intervals of ld_interval.h, whose ends are long doubles, or doubles
 * with PROOF_DOUBLE */

#ifdef PROOF_DOUBLE
typedef double proof_real;
static inline proof_real proof_size(proof_real a) { return fabs(a); }
#else
typedef long double proof_real;
static inline proof_real proof_size(proof_real a) { return fabsl(a); }
#endif

typedef struct ld_interval {
    proof_real lo, hi;
} ld_interval;

static inline proof_real proof_larger(proof_real a, proof_real b) { return a > b ? a : b; }
static inline proof_real proof_smaller(proof_real a, proof_real b) { return a < b ? a : b; }

/* NaN: infinite. */
static inline ld_interval ld_interval_make(proof_real lo, proof_real hi)
{
    return (ld_interval){lo > -INFINITY ? lo : -INFINITY, hi < INFINITY ? hi : INFINITY};
}

static inline ld_interval ld_interval_of(proof_real x) { return ld_interval_make(x, x); }

static inline ld_interval ld_interval_entire(void) { return (ld_interval){-INFINITY, INFINITY}; }

static inline bool ld_interval_is_within(ld_interval x, ld_interval limits)
{
    return x.lo >= limits.lo && x.hi <= limits.hi;
}

/* Returns whether x is exactly that value. */
static inline bool ld_interval_is(ld_interval x, proof_real value)
{
    return x.lo == value && x.hi == value;
}

static inline bool ld_interval_excludes_0(ld_interval x) { return x.lo > 0 || x.hi < 0; }

/* Greatest |z|. */
static inline proof_real ld_interval_mag(ld_interval x)
{
    return proof_larger(proof_size(x.lo), proof_size(x.hi));
}

/* A number within x, which is finite. */
static inline proof_real ld_interval_mid(ld_interval x)
{
    const proof_real half = 0.5F;
    return proof_smaller(proof_larger(half * x.lo + half * x.hi, x.lo), x.hi);
}

/* Returns the least interval that contains both. */
static inline ld_interval ld_interval_hull(ld_interval x, ld_interval y)
{
    return ld_interval_make(proof_smaller(x.lo, y.lo), proof_larger(x.hi, y.hi));
}

/* Returns the intersection, which is not empty. */
static inline ld_interval ld_interval_intersect(ld_interval x, ld_interval y)
{
    return ld_interval_make(proof_larger(x.lo, y.lo), proof_smaller(x.hi, y.hi));
}

/* [-size, size] */
static inline ld_interval ld_interval_plus_minus(proof_real size)
{
    return ld_interval_make(-size, size);
}

static inline ld_interval ld_interval_neg(ld_interval x) { return (ld_interval){-x.hi, -x.lo}; }

static inline ld_interval ld_interval_abs(ld_interval x)
{
    return ld_interval_make(proof_larger(proof_larger(x.lo, -x.hi), 0), ld_interval_mag(x));
}

static inline ld_interval ld_interval_min(ld_interval x, ld_interval y)
{
    return ld_interval_make(proof_smaller(x.lo, y.lo), proof_smaller(x.hi, y.hi));
}

static inline ld_interval ld_interval_max(ld_interval x, ld_interval y)
{
    return ld_interval_make(proof_larger(x.lo, y.lo), proof_larger(x.hi, y.hi));
}

#endif
