/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_POWERS_H
#define IMPINGE_MODEL_POWERS_H

#include <impinge/model_functions.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Exponential and logarithm, real powers, kinks
 * =============================================
 *
 * In each lemma, x is the argument, m + y with |y| <= r over its range; t_k are Taylor coefficients
 * at m. slope is an upper bound of |g'| over the range of x; the rates follow from it. */

/* --- Exponential and logarithm ---------------------------------------------------------------- */

/* At least e^r, for a factor: below 5/4, e^r <= 1 + 2 r. */
static inline double imp_growth_upper_(double r)
{
    return r < 1.25 ? 1 + 2 * r : imp_libm_up(imp_libm_exp(r));
}

/* t_k = e^m / k!; the rest of the series is below e^(m+r) r^5 / 120, in which e^m may have
 * underflowed while e^(m+r) is large: hence an upper bound of e^m, not its value. */
static inline imp_model imp_exp(imp_model x)
{
    if (imp_is_point(&x)) {
        double y = imp_libm_exp(x.a);
        if (y > 0x1p1020) return imp_point_beyond_(imp_interval_exp(imp_model_range(&x)));
        return imp_point_within(&x, y, 1.001 * y, 0, INFINITY);
    }
    imp_series s = imp_series_around(imp_model_range(&x));
    double y = imp_libm_exp(s.m);
    const double t[5] = {y, y, y / 2, y / 6, y / 24};
    double tail = imp_libm_up(y) * imp_growth_upper_(s.r) * imp_power5_(s.r) / 120 * (1 + 0x1p-40);
    imp_series_taylor(&s, 1, t, tail, 10, 11);
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_exp(imp_model_range(&x));
    return imp_compose(&x, &s, range, range.hi);
}

/* With z = y / m: log m + z - z^2 / 2 + ..., the rest below |z|^5 / (5 (1 - |z|)). */
static inline imp_model imp_log(imp_model x)
{
    double slope = x.lo > 0 ? imp_round_up(1 / x.lo) : INFINITY;
    if (imp_is_point(&x) && x.lo > 0) return imp_point_(&x, log(x.a), slope);
    imp_series s = imp_series_around(imp_model_range(&x));
    double z = s.m > 0 ? imp_round_up(s.r / s.m) : INFINITY;
    if (z < 1) {
        const double t[5] = {log(s.m), 1, -1. / 2, 1. / 3, -1. / 4};
        double tail = imp_power5_(z) / (5 * imp_sum_down(1 - z)) * (1 + 0x1p-40);
        imp_series_taylor(&s, s.m, t, tail, 10, 1);
    }
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_log(imp_model_range(&x));
    return imp_compose(&x, &s, range, slope);
}

/* --- Real powers ------------------------------------------------------------------------------ */

/* Series of (m + y)^p, m > 0, in z = y / m: value sum C(p, k) z^k with value = m^p, within (L).
 * From k = 5 on a term is the one before times |p - k| / (k + 1) |z| <= g |z| with g = max(1, (|p|
 * + 5) / 6), so the rest is below |C(p, 5) z^5| / (1 - g |z|). Each C(p, k) is within 3 k u. */
static inline void imp_series_power(imp_series *s, double p, double value)
{
    double z = s->m > 0 ? imp_round_up(s->r / s->m) : INFINITY;
    double g = imp_larger(1, (fabs(p) + 5) / 6 * (1 + 0x1p-50));
    if (!(g * z < 0.99)) return;
    double c2 = p * (p - 1) / 2, c3 = c2 * (p - 2) / 3, c4 = c3 * (p - 3) / 4;
    double c5 = fabs(c4 * (p - 4) / 5);
    const double t[5] = {value, value * p, value * c2, value * c3, value * c4};
    double tail = imp_libm_up(value) * c5 * imp_power5_(z) / (1 - g * z) * (1 + 0x1p-40);
    imp_series_taylor(s, s->m, t, tail, 10, 30);
}

/* At least the greatest |p| z^(p-1) over x. The rounding of p - 1 changes the power by less than
 * |log z^(p-1)| u < 2^-43. */
static inline double imp_power_slope_upper_(imp_interval x, double p)
{
    return imp_round_up(imp_interval_pow(x, p - 1).hi * fabs(p) * (1 + 0x1p-40));
}

/* x^p at a point: x differs from x.a by less than 2^-30 of it, so x^(p-1) by less than 1 in 100,
 * while |p| < 2^20. */
static inline imp_model imp_power_point_(const imp_model *x, double y, double p)
{
    return imp_point_within(x, y, 1.01 * fabs(p * (y / x->a)), 0, INFINITY);
}

/* x^p for x > 0, or x >= 0 if p > 0; the part of x below 0 counts as 0. For whole p, as powi. */
static inline imp_model imp_pow(imp_model x, double p)
{
    if (fabs(p) < 1000 && p == floor(p)) return imp_powi(x, (int)p);
    imp_interval at = imp_model_range(&x);
    if (!(x.hi >= 0) || !(p - p == 0)) return imp_unbounded(x.depends);
    if (imp_is_point(&x) && x.lo > 0 && fabs(p) < 0x1p20)
        return imp_power_point_(&x, imp_libm_pow(x.a, p), p);
    imp_series s = imp_series_around(at);
    if (x.lo > 0) imp_series_power(&s, p, imp_libm_pow(s.m, p));
    imp_interval range = imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_pow(at, p);
    return imp_compose(&x, &s, range, imp_power_slope_upper_(at, p));
}

/* The square root. The part of x below 0, where rounding may have put it, counts as 0.
 * At 0 the rate is infinite. */
static inline imp_model imp_sqrt(imp_model x)
{
    if (!(x.hi >= 0)) return imp_unbounded(x.depends);
    if (imp_is_exact(&x) && x.a == 0) return x;
    if (imp_is_point(&x) && x.lo > 0) return imp_power_point_(&x, sqrt(x.a), 0.5);
    imp_interval range = imp_interval_sqrt(imp_model_range(&x));
    double slope = range.lo > 0 ? imp_round_up(0.5 / range.lo) : INFINITY;
    imp_series s = imp_series_around(imp_model_range(&x));
    if (x.lo > 0) imp_series_power(&s, 0.5, sqrt(s.m));
    return imp_compose(&x, &s, range, slope);
}

/* x^y for x > 0. */
static inline imp_model imp_pow_model(imp_model x, imp_model y)
{
    if (imp_is_exact(&y)) return imp_pow(x, y.a);
    return imp_exp(imp_mul(y, imp_log(x)));
}

/* --- Kinks ------------------------------------------------------------------------------------ */

/* |x|. If x has one sign: x or -x. Otherwise, with R = max |x|, on [-R, R]: z^2 / R <= |z| <= z^2 /
 * R + R / 4; or, when one side is short, |z| is z or -z within twice that side. */
static inline imp_model imp_abs(imp_model x)
{
    if (x.lo >= 0) return x;
    if (x.hi <= 0) return imp_neg(x);
    imp_interval range = imp_interval_abs(imp_model_range(&x));
    imp_series s = {0, range.hi, {0, 0, 0, 0}, INFINITY};
    double side = imp_smaller(-x.lo, x.hi);
    if (range.hi < INFINITY && side < range.hi / 8) {
        s.c[0] = side;
        s.c[1] = x.hi > -x.lo ? 1 : -1;
        s.e = side;
    } else if (range.hi < INFINITY) {
        s.c[0] = range.hi / 8;
        s.c[2] = 1 / range.hi;
        s.e = range.hi / 8 * (1 + 0x1p-47) + IMP_TINY;
    }
    return imp_compose(&x, &s, range, 1);
}

/* Range and rates that max and min share: each rate is at most the larger one. */
static inline imp_model imp_either_(imp_model r, const imp_model *x, const imp_model *y,
                                    imp_interval range)
{
    r.lo = range.lo;
    r.hi = range.hi;
    for (int j = 0; j < 3; j++) r.rate[j] = imp_larger(x->rate[j], y->rate[j]);
    r.depends = x->depends | y->depends;
    imp_finish_(&r);
    return r;
}

/* If one is the larger over the whole region, that one; otherwise (x + y + |x - y|) / 2. */
static inline imp_model imp_max(imp_model x, imp_model y)
{
    if (x.lo >= y.hi) return x;
    if (y.lo >= x.hi) return y;
    imp_model apart = imp_abs(imp_sub(x, y));
    imp_model r = imp_scale(imp_add(imp_add(x, y), apart), 0.5);
    return imp_either_(r, &x, &y, imp_interval_max(imp_model_range(&x), imp_model_range(&y)));
}

static inline imp_model imp_min(imp_model x, imp_model y)
{
    return imp_neg(imp_max(imp_neg(x), imp_neg(y)));
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_POWERS_H */
