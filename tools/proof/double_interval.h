/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_LD_INTERVAL_H /* it stands alone: ld_interval.h includes it in its place */
#ifndef PROOF_DOUBLE
#define PROOF_DOUBLE
#endif
#include "tools/proof/ld_interval.h"
#elif !defined(TOOLS_PROOF_DOUBLE_INTERVAL_H)
#define TOOLS_PROOF_DOUBLE_INTERVAL_H

#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error "the verifier's intervals need doubles as IEEE 754 rounds them: no -ffast-math, no x87"
#endif

#include "tools/proof/ld_ends.h"

/* The operations of the verifier's intervals
 * ==========================================
 * ld_interval.h, which includes this, in doubles, which are rounded to nearest (IEEE 754);
 * tools/verify/mpfi_functions.c has the functions. tests/unit/test_certificate_changes holds each
 * result against that of MPFI.
 *
 * Lemma. Let x be the double nearest to z. The double below x is no greater than z. It is at most
 * DBL_EPSILON |x| below x, or 2^-1074 if x is subnormal, so that x - (DBL_EPSILON |x| + PROOF_TINY)
 * is no greater than it; neither is that number as computed, since rounding is monotone and leaves
 * doubles as they are. Infinity less infinity is NaN, which ld_interval_make opens. PROOF_TINY is
 * far above DBL_MIN, since processors take a hundred times longer for numbers below that. */

#define PROOF_TINY 0x1p-400

static inline double proof_down(double x) { return x - (DBL_EPSILON * proof_size(x) + PROOF_TINY); }
static inline double proof_up(double x) { return x + (DBL_EPSILON * proof_size(x) + PROOF_TINY); }

static inline bool ld_interval_is_finite(ld_interval x)
{
    return x.lo > -INFINITY && x.hi < INFINITY;
}

/* Returns whether one of two is 0: one branch, which is nearly always foreseen. */
static inline bool proof_either_is_0(ld_interval x, ld_interval y)
{
    return ((x.lo == 0) & (x.hi == 0)) | ((y.lo == 0) & (y.hi == 0));
}

/* 0 plus x is exactly x: jets use it for what does not depend on a variable. */
static inline ld_interval ld_interval_add(ld_interval x, ld_interval y)
{
    if (proof_either_is_0(x, y)) return (ld_interval){x.lo + y.lo, x.hi + y.hi};
    return ld_interval_make(proof_down(x.lo + y.lo), proof_up(x.hi + y.hi));
}

static inline ld_interval ld_interval_sub(ld_interval x, ld_interval y)
{
    return ld_interval_add(x, ld_interval_neg(y));
}

/* The extremes are at corners. 0 times anything is 0. Where an operand is infinite, or a product
 * is, so is the sum of the products, or NaN. */
static inline ld_interval ld_interval_mul(ld_interval x, ld_interval y)
{
    if (proof_either_is_0(x, y)) return ld_interval_of(0);
    const double a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
    if (!(proof_size(a + b + c + d) < INFINITY)) return ld_interval_entire();
    return (ld_interval){proof_down(proof_smaller(proof_smaller(a, b), proof_smaller(c, d))),
                         proof_up(proof_larger(proof_larger(a, b), proof_larger(c, d)))};
}

static inline ld_interval ld_interval_scale(ld_interval x, double k)
{
    return ld_interval_mul(x, ld_interval_of(k));
}

/* Monotone on either side of 0. */
static inline ld_interval ld_interval_inverse(ld_interval x)
{
    if (x.lo > 0)
        return ld_interval_make(proof_larger(proof_down(1 / x.hi), 0), proof_up(1 / x.lo));
    if (x.hi < 0) return ld_interval_neg(ld_interval_inverse(ld_interval_neg(x)));
    return ld_interval_entire();
}

static inline ld_interval ld_interval_div(ld_interval x, ld_interval y)
{
    if (ld_interval_is(x, 0)) return x;
    return ld_interval_mul(x, ld_interval_inverse(y));
}

static inline ld_interval ld_interval_sqr(ld_interval x)
{
    const ld_interval size = ld_interval_abs(x);
    if (ld_interval_is(x, 0)) return x;
    if (!ld_interval_is_finite(x)) return ld_interval_make(0, INFINITY);
    return ld_interval_make(proof_larger(proof_down(size.lo * size.lo), 0),
                            proof_up(size.hi * size.hi));
}

/* IEEE 754 rounds roots to nearest as it does sums. */
static inline ld_interval ld_interval_sqrt(ld_interval x)
{
    if (!(x.hi >= 0)) return ld_interval_entire();
    return ld_interval_make(x.lo > 0 ? proof_larger(proof_down(sqrt(x.lo)), 0) : 0,
                            proof_up(sqrt(x.hi)));
}

#endif
