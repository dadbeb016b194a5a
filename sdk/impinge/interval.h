/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_INTERVAL_H
#define IMPINGE_INTERVAL_H

#include <errno.h>
#include <math.h>

#include <impinge/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Interval arithmetic with outward rounding
 * =====================================
 *
 * [lo, hi] with lo <= hi; an end may be infinite. Every operation returns an interval that contains
 * all results for all operands in the given intervals. The rounding mode stays "to nearest";
 * computed ends are rounded outward instead. No end is NaN: an end that cannot be computed is
 * infinite.
 *
 * Notation in the lemmas: u = 2^-53, fl(x) the double nearest to x. A sum, difference,
 * product, quotient or square root z computed in double is x = fl(z), and then
 *
 *   (R)  |z - x| <= u |x| + 2^-1075     (the last term is 0 for sums)
 *
 * unless it overflows. A libm call is trusted to 4 units in the last place, that is
 * |z - x| <= 4 * 2^-52 max(|z|, |x|) + 4 * 2^-1074; with 2^-52 (1 + 2^-49) < 1.25 * 2^-52:
 *
 *   (L)  |z - x| <= 5 * 2^-52 |x| + 2^-1072     (glibc's are below 1 unit)
 *
 * IMP_TINY bounds all errors of underflow. It is far larger than they are, so that no bound is a
 * subnormal number, which many processors handle slowly. It is far smaller than any length, time or
 * rate of interest. */

#define IMP_TINY 0x1p-1000
#define IMP_LIBM 0x1.4p-50 /* 5 * 2^-52, relative, see (L) */

typedef struct imp_interval {
    double lo, hi;
} imp_interval;

/* --- Rounding outward ------------------------------------------------------------------------- */

/* At least every z with (R). Lemma: |x| 2^-52 >= ulp(x) for normal x, and IMP_TINY covers the rest,
 * so the sum in exact arithmetic is >= the double above x, and fl is monotone. z itself lies below
 * the double above x because it rounds to x. NaN for x = -INFINITY (overflow: the true value may be
 * anything below): callers replace a NaN by an infinite end on that side. */
static inline double imp_round_up(double x) { return x + (fabs(x) * 0x1p-52 + IMP_TINY); }

static inline double imp_round_down(double x) { return x - (fabs(x) * 0x1p-52 + IMP_TINY); }

/* At least and at most every number that rounds to the sum or difference x. These are exact where
 * they would underflow: no IMP_TINY is added, and 0 stays 0. */
static inline double imp_sum_up(double x) { return x + fabs(x) * 0x1p-52; }

static inline double imp_sum_down(double x) { return x - fabs(x) * 0x1p-52; }

/* At least and at most the number that libm computed as x. Lemma: by (L) z <= x + 5 * 2^-52 |x| +
 * 2^-1072; the sixth unit covers the rounding of the sum. */
static inline double imp_libm_up(double x) { return x + (fabs(x) * 0x1.8p-50 + IMP_TINY); }

static inline double imp_libm_down(double x) { return x - (fabs(x) * 0x1.8p-50 + IMP_TINY); }

/* The larger and the smaller of two. If one is NaN the result is b. */
static inline double imp_larger(double a, double b) { return a > b ? a : b; }

static inline double imp_smaller(double a, double b) { return a < b ? a : b; }

/* --- Construction and queries ----------------------------------------------------------------- */

/* [lo, hi]; a NaN end becomes infinite. */
static inline imp_interval imp_interval_make(double lo, double hi)
{
    imp_interval r;
    r.lo = lo > -INFINITY ? lo : -INFINITY;
    r.hi = hi < INFINITY ? hi : INFINITY;
    return r;
}

static inline imp_interval imp_interval_whole(void)
{
    return imp_interval_make(-INFINITY, INFINITY);
}

static inline int imp_interval_is_finite(imp_interval x)
{
    return x.lo > -INFINITY && x.hi < INFINITY;
}

/* Greatest |z| in x; exact. */
static inline double imp_interval_mag(imp_interval x) { return imp_larger(fabs(x.lo), fabs(x.hi)); }

/* Least |z| in x; exact. */
static inline double imp_interval_mig(imp_interval x)
{
    return imp_larger(imp_larger(x.lo, -x.hi), 0);
}

/* A double inside x, near its middle; x is finite. */
static inline double imp_interval_mid(imp_interval x)
{
    double m = 0.5 * x.lo + 0.5 * x.hi;
    return imp_smaller(imp_larger(m, x.lo), x.hi);
}

/* At least |z - m| for every z in x; m is in x. */
static inline double imp_interval_radius_upper(imp_interval x, double m)
{
    return imp_sum_up(imp_larger(x.hi - m, m - x.lo));
}

/* The intersection. The caller knows that it is not empty. */
static inline imp_interval imp_interval_intersect(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_larger(x.lo, y.lo), imp_smaller(x.hi, y.hi));
}

/* --- Arithmetic ------------------------------------------------------------------------------- */

static inline imp_interval imp_interval_neg(imp_interval x)
{
    return imp_interval_make(-x.hi, -x.lo);
}

static inline imp_interval imp_interval_add(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_sum_down(x.lo + y.lo), imp_sum_up(x.hi + y.hi));
}

static inline imp_interval imp_interval_sub(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_sum_down(x.lo - y.hi), imp_sum_up(x.hi - y.lo));
}

/* a b with 0 * INFINITY = 0: an infinite end is the limit of finite ones. */
static inline double imp_limit_product_(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

static inline imp_interval imp_interval_mul_infinite_(imp_interval x, imp_interval y)
{
    double p = imp_limit_product_(x.lo, y.lo), q = imp_limit_product_(x.lo, y.hi);
    double r = imp_limit_product_(x.hi, y.lo), s = imp_limit_product_(x.hi, y.hi);
    double lo = imp_smaller(imp_smaller(p, q), imp_smaller(r, s));
    double hi = imp_larger(imp_larger(p, q), imp_larger(r, s));
    return imp_interval_make(imp_round_down(lo), imp_round_up(hi));
}

/* The extremes of a product are at corners. The sum is NaN or infinite if a corner is. */
static inline imp_interval imp_interval_mul(imp_interval x, imp_interval y)
{
    double p = x.lo * y.lo, q = x.lo * y.hi, r = x.hi * y.lo, s = x.hi * y.hi;
    double sum = (p + q) + (r + s);
    if (!(sum - sum == 0)) return imp_interval_mul_infinite_(x, y);
    double lo = imp_smaller(imp_smaller(p, q), imp_smaller(r, s));
    double hi = imp_larger(imp_larger(p, q), imp_larger(r, s));
    return imp_interval_make(imp_round_down(lo), imp_round_up(hi));
}

static inline imp_interval imp_interval_scale(imp_interval x, double k)
{
    return imp_interval_mul(x, imp_interval_make(k, k));
}

/* 1/x is monotone on either side of 0. If x contains 0, inside or at an end, it is unbounded there.
 */
static inline imp_interval imp_interval_inverse(imp_interval x)
{
    if (x.lo > 0)
        return imp_interval_make(imp_larger(imp_round_down(1 / x.hi), 0), imp_round_up(1 / x.lo));
    if (x.hi < 0)
        return imp_interval_make(imp_round_down(1 / x.hi), imp_smaller(imp_round_up(1 / x.lo), 0));
    if (x.lo == 0 && x.hi > 0)
        return imp_interval_make(imp_larger(imp_round_down(1 / x.hi), 0), INFINITY);
    if (x.hi == 0 && x.lo < 0)
        return imp_interval_make(-INFINITY, imp_smaller(imp_round_up(1 / x.lo), 0));
    return imp_interval_whole();
}

/* Corners again, as y has one sign. Two infinite ends: through the inverse. */
static inline imp_interval imp_interval_div(imp_interval x, imp_interval y)
{
    double p = x.lo / y.lo, q = x.lo / y.hi, r = x.hi / y.lo, s = x.hi / y.hi;
    double sum = (p + q) + (r + s);
    if (!(sum - sum == 0) || (y.lo <= 0 && y.hi >= 0))
        return imp_interval_mul(x, imp_interval_inverse(y));
    double lo = imp_smaller(imp_smaller(p, q), imp_smaller(r, s));
    double hi = imp_larger(imp_larger(p, q), imp_larger(r, s));
    return imp_interval_make(imp_round_down(lo), imp_round_up(hi));
}

/* Unlike x times x, the result is never negative. */
static inline imp_interval imp_interval_sqr(imp_interval x)
{
    double lo = imp_interval_mig(x), hi = imp_interval_mag(x);
    return imp_interval_make(imp_larger(imp_round_down(lo * lo), 0), imp_round_up(hi * hi));
}

static inline imp_interval imp_interval_abs(imp_interval x)
{
    return imp_interval_make(imp_interval_mig(x), imp_interval_mag(x));
}

static inline imp_interval imp_interval_min(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_smaller(x.lo, y.lo), imp_smaller(x.hi, y.hi));
}

static inline imp_interval imp_interval_max(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_larger(x.lo, y.lo), imp_larger(x.hi, y.hi));
}

/* The part of x below 0 counts as 0, because it may come from rounding. If all of x is negative,
 * the result is the whole line. */
static inline imp_interval imp_interval_sqrt(imp_interval x)
{
    if (!(x.hi >= 0)) return imp_interval_whole();
    double lo = imp_round_down(sqrt(imp_larger(x.lo, 0)));
    return imp_interval_make(imp_larger(lo, 0), imp_round_up(sqrt(x.hi)));
}

#ifdef __cplusplus
}
#endif

#include <impinge/interval_functions.h>

#endif /* IMPINGE_INTERVAL_H */
