/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_FUNCTIONS_H
#define PLUGINS_EXPRESSION_FUNCTIONS_H

#include "plugins/common/near.h"

#include <stddef.h>

/* Functions of formulas that <impinge/model.h> lacks
 * ======================================================
 * Those with a constant that no double holds, the cube root, distances and the copied sign. Each
 * has its lemma; notation as in <impinge/model.h>. */

/* --- Powers ----------------------------------------------------------------------------------- */

/* At least the greatest |ln z| z^s for 0 < z in x and s between s0 and s1. Lemma: beyond 1, ln z
 * <= ln x.hi and z^s <= max(1, x.hi^s1). Below 1, |ln z| <= |ln x.lo| and z^s <= max(1, x.lo^s0);
 * if s0 > 0 also |ln z| z^s <= |ln z| z^s0 <= 1 / (e s0) < 0.37 / s0. */
static inline double log_power_upper(imp_interval x, double s0, double s1)
{
    double beyond = 0, below = 0;
    if (x.hi > 1)
        beyond = imp_libm_up(log(x.hi)) * imp_larger(1, imp_libm_up(imp_libm_pow(x.hi, s1)));
    if (x.lo < 1) {
        double drop = x.lo > 0 ? imp_libm_up(-log(x.lo)) : INFINITY;
        double climb = x.lo > 0 ? imp_libm_up(imp_libm_pow(x.lo, s0)) : s0 >= 0 ? 1 : INFINITY;
        below = drop * imp_larger(1, climb);
        if (s0 > 0) below = imp_smaller(below, 0.37 / s0 * (1 + 0x1p-50));
    }
    double most = imp_larger(beyond, below);
    return most * (1 + 0x1p-50) + IMP_TINY;
}

/* At least the greatest |d z^s / dz| for z in x and s between s0 and s1; `top` >= |s|. For a fixed
 * z, z^(s-1) is monotone in s. */
static inline double power_slope_upper(imp_interval x, double s0, double s1, double top)
{
    double first = imp_interval_pow(x, imp_sum_down(s0 - 1)).hi;
    double second = imp_interval_pow(x, imp_sum_up(s1 - 1)).hi;
    return imp_round_up(top * imp_larger(first, second));
}

/* x^p, |p - k.value| <= k.error, for x > 0, or x >= 0 if p > 0. Lemma: for z > 0
 *
 *   |z^p - z^k| = |integral of z^s ln z ds from k to p| <= error * max |ln z| z^s,
 *
 * s between k - error and k + error; at z = 0 both powers are 0, or both unbounded. */
static inline imp_model near_power(imp_model x, near_constant k)
{
    imp_model power = imp_pow(x, k.value);
    if (k.error == 0) return power;
    imp_interval range = imp_model_range(&x);
    double s0 = imp_sum_down(k.value - k.error), s1 = imp_sum_up(k.value + k.error);
    double slip = imp_round_up(k.error * log_power_upper(range, s0, s1));
    /* One end may be known without the other, also in exp(p log x). */
    if (!(slip < INFINITY)) return imp_exp(imp_mul(imp_log(x), imp_known(k.value, k.error)));
    double slope = power_slope_upper(range, s0, s1, imp_larger(fabs(s0), fabs(s1)));
    power.depends = x.depends;
    power.e = imp_sum_up(power.e + slip);
    power.lo = imp_larger(imp_sum_down(power.lo - slip), 0);
    power.hi = imp_sum_up(power.hi + slip);
    for (int j = 0; j < 3; ++j) power.rate[j] = (x.rate[j] * slope + IMP_TINY) * IMP_SLACK;
    return imp_model_finish(power);
}

/* The cube root over x.lo > 0: the series of a power with the exponent 1/3. Lemma: the double
 * nearest to 1/3 is off by u/2 of it, which changes no C(1/3, k) by more than u of it; with cbrt
 * within (L) all fits into the bounds that imp_series_power claims. */
static inline imp_model cube_root_above(const imp_model *x)
{
    imp_interval range = imp_model_range(x);
    double lo = imp_libm_down(cbrt(x->lo)), hi = imp_libm_up(cbrt(x->hi));
    double slope = imp_round_up(1 / (3 * lo * lo) * (1 + 0x1p-48));
    if (!(lo > 0)) slope = INFINITY;
    if (imp_is_point(x)) return imp_point_within(x, cbrt(x->a), slope, 0, INFINITY);
    imp_series s = imp_series_around(range);
    imp_series_power(&s, 1.0 / 3, cbrt(s.m));
    return imp_compose(x, &s, imp_interval_make(imp_larger(lo, 0), hi), slope);
}

/* The real cube root, odd and monotone. At 0 its rate is infinite. */
static inline imp_model cube_root(imp_model x)
{
    if (x.lo > 0) return cube_root_above(&x);
    if (x.hi < 0) {
        imp_model mirrored = imp_neg(x);
        return imp_neg(cube_root_above(&mirrored));
    }
    if (imp_is_exact(&x)) return x;
    imp_series s = {0, INFINITY, {0, 0, 0}, INFINITY};
    imp_interval range = imp_interval_make(imp_libm_down(cbrt(x.lo)), imp_libm_up(cbrt(x.hi)));
    return imp_compose(&x, &s, range, INFINITY);
}

/* --- Distances -------------------------------------------------------------------------------- */

/* sqrt(x^2 + y^2 + z^2), z may be NULL. Its rates are finite also at 0, where the square root's are
 * not. Lemma (triangle inequality, twice): the length changes by at most the length of the change
 * of (x, y, z). With a_j, b_j, c_j the rates of x, y, z, that change is, component by component, at
 * most sum_j (a_j, b_j, c_j) |p_j - p'_j|, which is no longer than sum_j |(a_j, b_j, c_j)| |p_j -
 * p'_j|. Underflow costs a square 2^-1075; the sum of the three bounds the length too. */
static inline imp_model distance(const imp_model *x, const imp_model *y, const imp_model *z)
{
    imp_model sum = imp_add(imp_sqr(*x), imp_sqr(*y));
    if (z != NULL) sum = imp_add(sum, imp_sqr(*z));
    imp_model r = imp_sqrt(sum);
    for (int j = 0; j < 3; ++j) {
        double a = x->rate[j], b = y->rate[j], c = z != NULL ? z->rate[j] : 0;
        double length = sqrt(a * a + b * b + c * c + IMP_TINY) * (1 + 0x1p-48);
        double limit = imp_smaller(length, (a + b + c) * (1 + 0x1p-48));
        if (r.depends >> j & 1) r.rate[j] = imp_smaller(r.rate[j], limit);
    }
    return r;
}

/* --- The copied sign -------------------------------------------------------------------------- */

/* |x| where y >= 0, -|x| where y < 0, provided that x is 0 wherever y is. Lemma: let r bound the
 * rates of x, and so of |x|. Between two points where y has one sign, the result changes
 * as |x| does. Between p and p' where it has two, the segment has a point p0 with y = 0, so x = 0:
 * |x(p)| + |x(p')| <= sum r_j |p - p0|_j + sum r_j |p0 - p'|_j = sum r_j |p - p'|_j. */
static inline imp_model copy_sign(imp_model x, imp_model y)
{
    imp_model size = imp_abs(x);
    if (y.lo >= 0) return size;
    if (y.hi <= 0) return imp_neg(size);
    size.lo = -size.hi;
    size.depends |= y.depends;
    return imp_model_collapse(size);
}

#endif
