/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_LD_INTERVAL_H
#define TOOLS_PROOF_LD_INTERVAL_H

#include <math.h>
#include <stdbool.h>

/* Interval arithmetic of the proofs
 * =================================
 * The claims of a plugin are proved or refuted by an arithmetic that shares no code with the
 * plugin's: neither <impinge/model.h>, nor <impinge/interval.h>, nor their libm functions. Ends are
 * long doubles. They have more digits than the claims, so that the outward rounding of a claim is
 * enough slack to prove it. (If long double is double, all results still hold, but tight claims
 * stay unsettled.) impinge-verify is built with PROOF_DOUBLE: its ends are doubles, and it has
 * operations of its own (double_interval.h) and functions.
 *
 * [lo, hi], lo <= hi, ends may be infinite; every result contains all values for all operands, and
 * no end is NaN. If nothing is known, the result is the whole line. Roots, logarithms, powers, asin
 * and acos use the part of an operand where they are defined. */

#ifdef PROOF_DOUBLE
typedef double proof_real;
#else
typedef long double proof_real;
#endif

typedef struct ld_interval {
    proof_real lo, hi;
} ld_interval;

/* --- What needs no rounding ------------------------------------------------------------------- */

static inline proof_real proof_larger(proof_real a, proof_real b) { return a > b ? a : b; }
static inline proof_real proof_smaller(proof_real a, proof_real b) { return a < b ? a : b; }
static inline proof_real proof_size(proof_real a) { return a < 0 ? -a : a; }

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

/* Whether x is exactly that value. */
static inline bool ld_interval_is(ld_interval x, proof_real value)
{
    return x.lo == value && x.hi == value;
}

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

/* All between. */
static inline ld_interval ld_interval_hull(ld_interval x, ld_interval y)
{
    return ld_interval_make(proof_smaller(x.lo, y.lo), proof_larger(x.hi, y.hi));
}

/* The intersection; not empty. */
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

/* --- What is rounded -------------------------------------------------------------------------- */

#ifdef PROOF_DOUBLE
#include "tools/proof/double_interval.h"
#else
/* Sums and products that need no rounding are exact. */
ld_interval ld_interval_add(ld_interval x, ld_interval y);
ld_interval ld_interval_sub(ld_interval x, ld_interval y);
ld_interval ld_interval_mul(ld_interval x, ld_interval y);
ld_interval ld_interval_scale(ld_interval x, proof_real k);
ld_interval ld_interval_inverse(ld_interval x);
ld_interval ld_interval_div(ld_interval x, ld_interval y);
ld_interval ld_interval_sqr(ld_interval x);
ld_interval ld_interval_sqrt(ld_interval x);
#endif

ld_interval ld_interval_pi(void);
ld_interval ld_interval_e(void);

ld_interval ld_interval_cbrt(ld_interval x);
ld_interval ld_interval_exp(ld_interval x);
ld_interval ld_interval_log(ld_interval x);
ld_interval ld_interval_sin(ld_interval x);
ld_interval ld_interval_cos(ld_interval x);
ld_interval ld_interval_tan(ld_interval x);
ld_interval ld_interval_asin(ld_interval x);
ld_interval ld_interval_acos(ld_interval x);
ld_interval ld_interval_atan(ld_interval x);
ld_interval ld_interval_sinh(ld_interval x);
ld_interval ld_interval_cosh(ld_interval x);
ld_interval ld_interval_tanh(ld_interval x);
ld_interval ld_interval_integer_power(ld_interval x, int n);
ld_interval ld_interval_power(ld_interval x, ld_interval y); /* x >= 0 */
ld_interval
ld_interval_angle(ld_interval y,
                  ld_interval x); /* of the point (x, y), continuous where it is not everything */

#endif
