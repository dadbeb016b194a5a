/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_FUNCTIONS_H
#define IMPINGE_MODEL_FUNCTIONS_H

#include <impinge/model.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Functions of models
 * ===================
 *
 * Each function g is handled in two steps. Over the range [m - r, m + r] of its argument, g is
 * replaced by a quadratic c0 + c1 y + c2 y^2 in y = x - m with a proved error; then the
 * argument's model is substituted. The quadratic comes from the Taylor series at m: its terms of
 * third and fourth order are not dropped but replaced by their best approximations of lower
 * order, which are 4 and 8 times closer than 0 is:
 *
 *   z^3 = 3/4 z +- 1/4,     z^4 = z^2 - 1/8 +- 1/8     on [-1, 1]
 *
 * (T_3 = 4 z^3 - 3 z and T_4 = 8 z^4 - 8 z^2 + 1 are at most 1). So the error is that of
 * interpolation in Chebyshev's points, g''' r^3 / 24, without the cancellation of divided
 * differences, and for one call of libm. */

/* g(m + y) = c0 + c1 y + c2 y^2 within e, for |y| <= r. */
typedef struct imp_series_ {
    double m, r;
    double c[3];
    double e;
} imp_series_;

static inline imp_series_ imp_series_at_(imp_interval x)
{
    imp_series_ s = {0, INFINITY, {0, 0, 0}, INFINITY};
    if (imp_interval_is_finite(x)) {
        s.m = imp_interval_mid(x);
        s.r = imp_interval_radius_upper(x, s.m);
    }
    return s;
}

/* Completes s from t[k] = Taylor coefficients in z = y / scale, scale > 0: k = 0 ... 4. `tail`
 * bounds what follows, over |z| <= z_max = r / scale. t[0] is within u0 u |t[0]|, the others within
 * un u |t[k]|, of exact values.
 *
 * Rounding: t[0] passes one sum; the others at most 6 operations (z_max^4, product, sum, division
 * by scale twice). Underflow: each operation may lose 2^-1075, then is multiplied by at most max(1,
 * r^2), or by z_max^4, as t is finite: IMP_TINY (1 + r^2 + z_max^2)^2 covers them. */
static inline void imp_series_set_(imp_series_ *s, double scale, const double t[5], double tail,
                                   double u0, double un)
{
    double z = scale == 1 ? s->r : imp_round_up(s->r / scale), zz = z * z;
    double t3 = fabs(t[3]) * zz * z, t4 = fabs(t[4]) * zz * zz;
    s->c[0] = t[0] - 0.125 * t[4] * zz * zz;
    s->c[1] = (t[1] + 0.75 * t[3] * zz) / scale;
    s->c[2] = (t[2] + t[4] * zz) / scale / scale;
    double rounding =
        (u0 + 1) * fabs(t[0]) + (un + 6) * (fabs(t[1]) * z + fabs(t[2]) * zz + t3 + t4);
    double w = 1 + s->r * s->r + zz;
    s->e = (0.25 * t3 + 0.125 * t4 + tail + (IMP_U * rounding + IMP_TINY * w * w)) * IMP_SLACK;
}

/* Range of the quadratic, and whether it is close enough to spare calls of libm at both ends:
 * when it overshoots by less than 1/32 on either side. */
static inline imp_interval imp_series_range_(const imp_series_ *s)
{
    double b = s->c[1] * s->r, q = s->c[2] * s->r * s->r;
    double pad = s->e + 0x1p-49 * (fabs(s->c[0]) + fabs(b) + fabs(q)) + IMP_TINY;
    return imp_interval_make(s->c[0] + imp_bow_lower_(b, q) - pad,
                             s->c[0] + imp_bow_upper_(b, q) + pad);
}

static inline int imp_series_is_sharp_(const imp_series_ *s)
{
    return s->e <= 0x1p-6 * fabs(s->c[1]) * s->r && fabs(s->c[2]) * s->r <= 0x1p-3 * fabs(s->c[1]);
}

/* y^2 for the model y with middle a: its coefficients and the bound of what does not fit. As a
 * product of a model by itself, but D^2 is in [0, swing^2], so it is swing^2 / 2 +- as much. */
static inline double imp_square_(double a, const imp_model *x, double *middle, double b[3],
                                 double q[6])
{
    double bb[6];
    double h = imp_middle_(x->q), swing = imp_swing_upper_(x->q, imp_sum_abs6_(x->q));
    double rest = imp_fold_cubic_(x->b, x->q, x->b, x->q, b);
    double half = 0.5 * swing * swing;
    imp_square_terms_(x->b, x->b, bb);
    *middle = a * a - h * h + half;
    for (int j = 0; j < 3; j++) b[j] += 2 * a * x->b[j];
    for (int k = 0; k < 6; k++) q[k] = 2 * (a + h) * x->q[k] + bb[k];
    return rest + half;
}

/* c0 + c1 y + c2 y^2 with y = x - m. Lemma, with x = P + delta, p = P - m, so y = p + delta:
 *
 *   g = c0 + c1 p + c2 p^2 + delta (c1 + c2 (y + p)) +- s.e,   |y + p| <= 2 r + e
 *
 * Rounding, in products' magnitudes with N = |a - m| + B + Q, a - m itself rounded once: c0 1; c1 p
 * at most 4; c2 p^2 at most 9 (in the middle a - m twice, square, two sums, c2, two sums; in b and
 * q fewer; cubic terms 9 with weight 3/4 and 4 with the rest; h and swing at most Q / 2 and Q).
 * Underflow: each product may lose 2^-1075, then is multiplied by at most c2, or by a coefficient
 * of p: IMP_TINY (1 + |c1| + |c2|)(1 + N). */
static inline void imp_substitute_(const imp_model *x, const imp_series_ *s, imp_model *r)
{
    double a = x->a - s->m, c1 = s->c[1], c2 = s->c[2], middle, b[3], q[6];
    double rest = imp_square_(a, x, &middle, b, q);
    r->a = s->c[0] + (c1 * a + c2 * middle);
    for (int j = 0; j < 3; j++) r->b[j] = c1 * x->b[j] + c2 * b[j];
    for (int k = 0; k < 6; k++) r->q[k] = c1 * x->q[k] + c2 * q[k];
    double n = fabs(a) + imp_sum_abs3_(x->b) + imp_sum_abs6_(x->q);
    double d1 = fabs(c1), d2 = fabs(c2);
    double inherited = x->e * (d1 + d2 * (2 * s->r + x->e));
    double rounding = fabs(s->c[0]) + (4 * d1 + 10 * d2 * n) * n;
    double underflow = (1 + d1 + d2) * (1 + n);
    r->e = (s->e + d2 * rest + inherited + (IMP_U * rounding + IMP_TINY * underflow)) * IMP_SLACK;
}

/* The model of g(x), from its series, its range, and slope >= max |g'| over x. */
static inline imp_model imp_compose_(const imp_model *x, const imp_series_ *s, imp_interval range,
                                     double slope)
{
    imp_model r;
    imp_substitute_(x, s, &r);
    r.lo = range.lo;
    r.hi = range.hi;
    r.depends = x->depends;
    r.reserved = 0;
    for (int j = 0; j < 3; j++) r.rate[j] = (x->rate[j] * slope + IMP_TINY) * IMP_SLACK;
    return imp_model_finish(r);
}

/* g at a point: y = g(x.a) as libm gives it (or within that of exact), slope >= |g'| nearby. */
static inline imp_model imp_point_(const imp_model *x, double y, double slope)
{
    return imp_known_(y, (fabs(y) * IMP_LIBM + slope * x->e + IMP_TINY) * IMP_SLACK);
}

/* The same, and lo <= g <= hi always. */
static inline imp_model imp_point_within_(const imp_model *x, double y, double slope, double lo,
                                          double hi)
{
    imp_model r = imp_point_(x, y, slope);
    r.lo = imp_larger(r.lo, lo);
    r.hi = imp_smaller(r.hi, hi);
    return r;
}

/* --- Polynomials ------------------------------------------------------------------------- */

/* x^2 = m^2 + 2 m y + y^2, exactly but for rounding m^2. */
static inline imp_model imp_sqr(imp_model x)
{
    if (imp_is_point_(&x)) {
        imp_model p = imp_mul_point_(&x, &x);
        p.lo = imp_larger(p.lo, 0);
        return p;
    }
    imp_series_ s = imp_series_at_(imp_range_(&x));
    s.c[0] = s.m * s.m;
    s.c[1] = 2 * s.m;
    s.c[2] = 1;
    s.e = s.r < INFINITY ? IMP_U * s.c[0] + IMP_TINY : INFINITY;
    return imp_compose_(&x, &s, imp_interval_sqr(imp_range_(&x)),
                        2 * imp_interval_mag(imp_range_(&x)));
}

/* --- Exponential and logarithm -------------------------------------------------------------- */

/* t_k = e^m / k!; the rest of the series is below e^(m+r) r^5 / 120. */
static inline imp_model imp_exp(imp_model x)
{
    double y = imp_exp_(x.a);
    if (imp_is_point_(&x)) return imp_point_within_(&x, y, 1.001 * y, 0, INFINITY);
    imp_interval range = imp_interval_exp(imp_range_(&x));
    imp_series_ s = imp_series_at_(imp_range_(&x));
    y = imp_exp_(s.m);
    double t[5] = {y, y, y / 2, y / 6, y / 24};
    imp_series_set_(&s, 1, t, range.hi * s.r * s.r * s.r * s.r * s.r / 120, 10, 11);
    return imp_compose_(&x, &s, range, range.hi);
}

/* z >= y / m > 0 for tails of series in y / m. */
static inline double imp_ratio_upper_(double y, double m) { return imp_round_up(y / m); }

static inline double imp_power5_(double z) { return z * z * z * z * z; }

/* With z = y / m: log m + z - z^2 / 2 + ..., the rest below |z|^5 / (5 (1 - |z|)). */
static inline imp_model imp_log(imp_model x)
{
    imp_interval range = imp_interval_log(imp_range_(&x));
    double slope = x.lo > 0 ? imp_round_up(1 / x.lo) : INFINITY;
    if (imp_is_point_(&x) && x.lo > 0) return imp_point_(&x, log(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double z = s.m > 0 ? imp_ratio_upper_(s.r, s.m) : INFINITY;
    if (z < 1) {
        const double t[5] = {log(s.m), 1, -1. / 2, 1. / 3, -1. / 4};
        imp_series_set_(&s, s.m, t, imp_power5_(z) / (5 * imp_sum_down(1 - z)), 10, 1);
    }
    return imp_compose_(&x, &s, range, slope);
}

/* --- Powers ----------------------------------------------------------------------------------- */

/* Series of (m + y)^p, m > 0, in z = y / m: m^p sum C(p, k) z^k. From k = 5 on a term is the one
 * before times |p - k| / (k + 1) |z| <= g |z| with g = max(1, (|p| + 5) / 6), so the rest is below
 * |C(p, 5)| |z|^5 / (1 - g |z|). Each C(p, k) is within 3 k u; m^p within (L). */
static inline void imp_series_power_(imp_series_ *s, double p, double value)
{
    double z = s->m > 0 ? imp_ratio_upper_(s->r, s->m) : INFINITY;
    double g = imp_larger(1, (fabs(p) + 5) / 6 * (1 + 0x1p-50));
    if (!(g * z < 0.99)) return;
    double c2 = p * (p - 1) / 2, c3 = c2 * (p - 2) / 3, c4 = c3 * (p - 3) / 4;
    double c5 = fabs(c4 * (p - 4) / 5);
    const double t[5] = {value, value * p, value * c2, value * c3, value * c4};
    double tail = value * c5 * imp_power5_(z) / (1 - g * z) * (1 + 0x1p-40);
    imp_series_set_(s, s->m, t, tail, 10, 30);
}

/* At least the greatest |p| z^(p-1) over x. */
static inline double imp_power_slope_upper_(imp_interval x, double p)
{
    if (p == 0) return 0;
    return imp_round_up(imp_interval_pow(x, p - 1).hi * fabs(p) * (1 + 0x1p-40));
}

/* x^p for x > 0, or x >= 0 if p > 0. The part of x below 0 counts as 0. */
static inline imp_model imp_pow(imp_model x, double p)
{
    imp_interval range = imp_interval_pow(imp_range_(&x), p);
    double slope = imp_power_slope_upper_(imp_range_(&x), p);
    if (p == 0) return imp_num(1);
    if (!(x.hi >= 0) || !(p - p == 0)) return imp_unbounded_(x.depends);
    if (imp_is_point_(&x) && x.lo > 0)
        return imp_point_within_(&x, imp_pow_(x.a, p), slope, 0, INFINITY);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (x.lo > 0) imp_series_power_(&s, p, imp_pow_(s.m, p));
    return imp_compose_(&x, &s, range, slope);
}

/* The square root. The part of x below 0, where rounding may have put it, counts as 0.
 * At 0 the rate is infinite. */
static inline imp_model imp_sqrt(imp_model x)
{
    imp_interval range = imp_interval_sqrt(imp_range_(&x));
    double slope = range.lo > 0 ? imp_round_up(0.5 / range.lo) : INFINITY;
    if (!(x.hi >= 0)) return imp_unbounded_(x.depends);
    if (imp_is_exact_(&x) && x.a == 0) return x;
    if (imp_is_point_(&x) && x.lo > 0) return imp_point_within_(&x, sqrt(x.a), slope, 0, INFINITY);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (x.lo > 0) imp_series_power_(&s, 0.5, sqrt(s.m));
    return imp_compose_(&x, &s, range, slope);
}

/* 1/x: the series of the power -1, mirrored if x < 0. */
static inline imp_model imp_inverse_(const imp_model *x)
{
    imp_interval range = imp_interval_inverse(imp_range_(x));
    double top = imp_interval_mag(range), slope = imp_round_up(top * top);
    imp_series_ s = imp_series_at_(imp_range_(x));
    if (x->lo > 0) imp_series_power_(&s, -1, 1 / s.m);
    if (x->hi < 0) {
        double m = s.m;
        s.m = -m;
        imp_series_power_(&s, -1, 1 / s.m);
        s.m = m;
        s.c[0] = -s.c[0];
        s.c[2] = -s.c[2];
    }
    return imp_compose_(x, &s, range, slope);
}

/* x / y at a point: |x / y - a / a'| <= (e + |a / a'| e') / min |y|. */
static inline imp_model imp_div_point_(const imp_model *x, const imp_model *y)
{
    double a = x->a / y->a, least = imp_interval_mig(imp_range_(y));
    double inherited = (x->e + imp_round_up(fabs(a)) * y->e) / least;
    return imp_known_(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

/* x (1 / y), with the range of a true quotient and its rate, (|x'| + |x / y| |y'|) / |y|. */
static inline imp_model imp_div(imp_model x, imp_model y)
{
    imp_interval range = imp_interval_div(imp_range_(&x), imp_range_(&y));
    double least = imp_interval_mig(imp_range_(&y));
    if (imp_is_exact_(&x) && x.a == 0 && least > 0) return x;
    if (imp_is_point_(&x) && imp_is_point_(&y) && least > 0) return imp_div_point_(&x, &y);
    imp_model inverse = imp_inverse_(&y), r;
    imp_product_(&x, &inverse, &r);
    for (int j = 0; j < 3; j++) {
        double change = x.rate[j] + imp_interval_mag(range) * y.rate[j];
        r.rate[j] = (change / least + IMP_TINY) * IMP_SLACK;
    }
    r.lo = range.lo;
    r.hi = range.hi;
    r.depends = x.depends | y.depends;
    r.reserved = 0;
    return imp_model_finish(r);
}

/* x^n for whole n >= 0 and m of any sign. t_k = C(n, k) m^(n-k); what follows the fourth is below
 * C(n, 5)
 * (|m| + r)^(n-5) r^5 (Lagrange). The powers of m are one call of libm and four products, the
 * binomials are within 4 u: (L) + 8 u. */
static inline void imp_series_powi_(imp_series_ *s, int n)
{
    double m = s->m, p = n > 4 ? imp_pow_(m, n - 4) : 1, tail = 0;
    double c2 = (double)n * (n - 1.) / 2, c3 = c2 * (n - 2.) / 3, c4 = c3 * (n - 3.) / 4;
    double power[5] = {1, 1, 1, 1, 1}; /* power[k] = m^(n-k) */
    for (int k = n < 4 ? n : 4; k >= 0; k--) {
        power[k] = p;
        p *= m;
    }
    if (n > 4)
        tail = c4 * (n - 4.) / 5 * imp_libm_up(imp_pow_(imp_sum_up(fabs(m) + s->r), n - 5)) *
               imp_power5_(s->r) * (1 + 0x1p-40);
    double t[5] = {power[0], n * power[1], c2 * power[2], c3 * power[3], c4 * power[4]};
    imp_series_set_(s, 1, t, tail, 20, 20);
}

/* x^n for any whole n; x != 0 if n < 0. */
static inline imp_model imp_powi(imp_model x, int n)
{
    if (n < 0)
        return n < -INT32_MAX ? imp_unbounded_(x.depends) : imp_div(imp_num(1), imp_powi(x, -n));
    if (n < 3) return n == 0 ? imp_num(1) : n == 1 ? x : imp_sqr(x);
    imp_interval range = imp_interval_powi(imp_range_(&x), n);
    double top = imp_interval_pow(imp_interval_abs(imp_range_(&x)), n - 1).hi;
    double slope = imp_round_up(top * n);
    if (imp_is_point_(&x)) return imp_point_(&x, imp_pow_(x.a, n), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    imp_series_powi_(&s, n);
    return imp_compose_(&x, &s, range, slope);
}

/* x^y for x > 0. */
static inline imp_model imp_pow_model(imp_model x, imp_model y)
{
    if (imp_is_exact_(&y)) return imp_pow(x, y.a);
    return imp_exp(imp_mul(y, imp_log(x)));
}

/* sum_k coef[k] t^k, n coefficients, lowest first: Horner's rule. */
static inline imp_model imp_poly(const double *coef, size_t n, imp_model t)
{
    imp_model r = imp_num(n > 0 ? coef[n - 1] : 0);
    for (size_t k = n > 0 ? n - 1 : 0; k > 0; k--) r = imp_shift(imp_mul(r, t), coef[k - 1]);
    return r;
}

/* --- Circular functions --------------------------------------------------------------------------
 */

/* Beyond this many radians of half-width sin and cos take all values. */
static inline int imp_is_far_(const imp_series_ *s) { return !(s->r < 4); }

/* sin and cos from their values S, C at m: S + C y - S y^2 / 2 - C y^3 / 6 + S y^4 / 24 within r^5
 * / 120. The slope |C'| <= |C| + |S| r + r^2 / 2, and 1. */
static inline imp_model imp_wave_(const imp_model *x, imp_series_ s, double sine, double cosine,
                                  imp_interval range)
{
    const double t[5] = {sine, cosine, -sine / 2, -cosine / 6, sine / 24};
    imp_series_set_(&s, 1, t, imp_power5_(s.r) / 120, 10, 11);
    double slope = (fabs(cosine) + fabs(sine) * s.r + 0.5 * s.r * s.r) * (1 + 0x1p-40) + IMP_TINY;
    return imp_compose_(x, &s, range, imp_smaller(slope, 1));
}

static inline imp_model imp_far_wave_(const imp_model *x)
{
    imp_series_ s = {0, INFINITY, {0, 0, 0}, INFINITY};
    return imp_compose_(x, &s, imp_interval_make(-1, 1), 1);
}

static inline imp_model imp_sin(imp_model x)
{
    if (imp_is_point_(&x)) return imp_point_within_(&x, sin(x.a), 1, -1, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (imp_is_far_(&s)) return imp_far_wave_(&x);
    return imp_wave_(&x, s, sin(s.m), cos(s.m), imp_interval_sin(imp_range_(&x)));
}

static inline imp_model imp_cos(imp_model x)
{
    if (imp_is_point_(&x)) return imp_point_within_(&x, cos(x.a), 1, -1, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (imp_is_far_(&s)) return imp_far_wave_(&x);
    return imp_wave_(&x, s, cos(s.m), -sin(s.m), imp_interval_cos(imp_range_(&x)));
}

static inline void imp_sincos(imp_model x, imp_model *sine, imp_model *cosine)
{
    *sine = imp_sin(x);
    *cosine = imp_cos(x);
}

/* With T = tan m, D = 1 + T^2, the t_k are D, D T, D (1 + 3 T^2) / 3, D T (2 + 3 T^2) / 3, and the
 * next is D (2 + 15 T^2 + 15 T^4) / 15, which grows with |T|: Lagrange's bound at the end with the
 * larger |tan|. T is within (L), so T^2 within 21 u, and no t_k is off by more than 100 u. */
static inline imp_model imp_tan(imp_model x)
{
    imp_interval range = imp_interval_tan(imp_range_(&x));
    double top = imp_interval_mag(range), tt = top * top;
    double slope = imp_round_up(imp_sum_up(1 + tt * (1 + 0x1p-50)));
    if (imp_is_point_(&x) && top < INFINITY) return imp_point_(&x, tan(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (top < INFINITY) {
        double y = tan(s.m), yy = y * y, d = 1 + yy;
        const double t[5] = {y, d, d * y, d * (1 + 3 * yy) / 3, d * y * (2 + 3 * yy) / 3};
        double next = slope * (2 + 15 * tt + 15 * tt * tt) / 15 * (1 + 0x1p-40);
        imp_series_set_(&s, 1, t, next * imp_power5_(s.r), 10, 100);
    }
    return imp_compose_(&x, &s, range, slope);
}

/* With w = 1 / (1 + m^2): t_1 = w, t_2 = -m w^2, t_3 = (3 m^2 - 1) w^3 / 3, t_4 = m (1 - m^2) w^4;
 * the next is at most w^(5/2) / 5 in magnitude, w being largest where |x| is least. |t_k| <=
 * w^(k/2) / k, and t_3, t_4 cancel near their zeros only: their errors are below 20 u w^(3/2), 20 u
 * w^2, added to the tail. */
static inline imp_model imp_atan(imp_model x)
{
    imp_interval range = imp_interval_atan(imp_range_(&x));
    double least = imp_interval_mig(imp_range_(&x));
    double slope = imp_round_up(1 / (1 + least * least)) * (1 + 0x1p-50);
    if (imp_is_point_(&x)) return imp_point_(&x, atan(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double m = s.m, w = 1 / (1 + m * m), z = s.r * sqrt(slope);
    const double t[5] = {atan(m), w, -m * w * w, (3 * m * m - 1) * w * w * w / 3,
                         m * (1 - m * m) * w * w * w * w};
    double tail = imp_power5_(z) / 5 + 20 * IMP_U * (z * z * z + z * z * z * z);
    imp_series_set_(&s, 1, t, tail * (1 + 0x1p-40), 10, 12);
    return imp_compose_(&x, &s, range, slope);
}

/* With w = 1 / (1 - m^2): the derivatives of asin are w^(1/2), m w^(3/2), (1 + 2 m^2) w^(5/2),
 * m (9 + 6 m^2) w^(7/2) and (9 + 72 m^2 + 24 m^4) w^(9/2); the last grows with |m|. 1 - m^2 is
 * computed as (1 - m)(1 + m), within 3 u, so no t_k is off by more than 40 u. */
static inline void imp_series_asin_(imp_series_ *s, double top)
{
    double m = s->m, mm = m * m, w = 1 / ((1 - m) * (1 + m)), v = sqrt(w);
    double far = 1 / (imp_sum_down(1 - top) * (1 + top)), tt = top * top;
    double next = (9 + 72 * tt + 24 * tt * tt) / 120 * (far * far * far * far * sqrt(far));
    const double t[5] = {asin(m), v, m * v * w / 2, (1 + 2 * mm) * v * w * w / 6,
                         m * (9 + 6 * mm) * v * w * w * w / 24};
    imp_series_set_(s, 1, t, next * imp_power5_(s->r) * (1 + 0x1p-40), 10, 40);
}

/* At least 1 / sqrt(1 - z^2) for |z| <= top. */
static inline double imp_asin_slope_upper_(double top)
{
    return top < 1 ? imp_sum_up(1 / sqrt(imp_sum_down(1 - top) * (1 + top))) * (1 + 0x1p-48)
                   : INFINITY;
}

/* Beyond -1 and 1 rounding is to blame: those parts of x count as -1 and 1. At -1 and 1 the rate is
 * infinite. */
static inline imp_model imp_asin(imp_model x)
{
    imp_interval range = imp_interval_asin(imp_range_(&x));
    double top = imp_interval_mag(imp_range_(&x)), slope = imp_asin_slope_upper_(top);
    if (!imp_interval_is_finite(range)) return imp_unbounded_(x.depends);
    if (imp_is_point_(&x) && (top < 1 || (top == 1 && imp_is_exact_(&x))))
        return imp_point_(&x, asin(x.a), imp_is_exact_(&x) ? 0 : slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (top < 1) imp_series_asin_(&s, top);
    return imp_compose_(&x, &s, range, slope);
}

/* pi/2 - asin x; acos m itself from libm. */
static inline imp_model imp_acos(imp_model x)
{
    imp_interval range = imp_interval_acos(imp_range_(&x));
    double top = imp_interval_mag(imp_range_(&x)), slope = imp_asin_slope_upper_(top);
    if (!imp_interval_is_finite(range)) return imp_unbounded_(x.depends);
    if (imp_is_point_(&x) && (top < 1 || (top == 1 && imp_is_exact_(&x))))
        return imp_point_within_(&x, acos(x.a), imp_is_exact_(&x) ? 0 : slope, 0, IMP_PI_UPPER);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (top < 1) {
        imp_series_asin_(&s, top);
        s.c[0] = IMP_PI_UPPER / 2 - s.c[0];
        s.c[1] = -s.c[1];
        s.c[2] = -s.c[2];
        s.e += 8 * IMP_U;
    }
    return imp_compose_(&x, &s, range, slope);
}

/* --- Hyperbolic functions
 * -------------------------------------------------------------------------- */

/* sinh and cosh are their own second derivatives; cosh at the far end bounds the fifth. */
static inline imp_model imp_sinh(imp_model x)
{
    imp_interval range = imp_interval_sinh(imp_range_(&x));
    double slope = imp_interval_cosh(imp_range_(&x)).hi;
    if (imp_is_point_(&x)) return imp_point_(&x, imp_sinh_(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double f = imp_sinh_(s.m), g = imp_cosh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_set_(&s, 1, t, slope * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose_(&x, &s, range, slope);
}

static inline imp_model imp_cosh(imp_model x)
{
    imp_interval range = imp_interval_cosh(imp_range_(&x));
    double slope = imp_interval_mag(imp_interval_sinh(imp_range_(&x)));
    if (imp_is_point_(&x)) return imp_point_within_(&x, imp_cosh_(x.a), slope, 1, INFINITY);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double f = imp_cosh_(s.m), g = imp_sinh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_set_(&s, 1, t, range.hi * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose_(&x, &s, range, slope);
}

/* With T = tanh m, D = 1 - T^2: t_k = D, -D T, D (3 T^2 - 1) / 3, D T (2 - 3 T^2) / 3, next at most
 * 2 D / 15. T is within 10 u, so D within 24 u, absolutely; all else keeps these errors below 60 u.
 */
static inline imp_model imp_tanh(imp_model x)
{
    imp_interval range = imp_interval_tanh(imp_range_(&x));
    double least = imp_interval_mig(range);
    double slope = imp_smaller((1 - least) * (1 + least) * (1 + 0x1p-50) + IMP_TINY, 1);
    if (imp_is_point_(&x)) return imp_point_within_(&x, tanh(x.a), slope, -1, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double y = tanh(s.m), yy = y * y, d = (1 - y) * (1 + y), r = s.r;
    const double t[5] = {y, d, -d * y, d * (3 * yy - 1) / 3, d * y * (2 - 3 * yy) / 3};
    double tail = slope * imp_power5_(r) * 2 / 15 + 60 * IMP_U * (r + r * r) * (1 + r * r);
    imp_series_set_(&s, 1, t, tail * (1 + 0x1p-40), 10, 1);
    return imp_compose_(&x, &s, range, slope);
}

/* --- Kinks
 * ---------------------------------------------------------------------------------------------- */

/* |x|. Of one sign: x or -x. Else, with R = max |x|: z^2 / R <= |z| <= z^2 / R + R / 4 on [-R, R];
 * or, when one side is short, |z| = +-z within twice that side. */
static inline imp_model imp_abs(imp_model x)
{
    if (x.lo >= 0) return x;
    if (x.hi <= 0) return imp_neg(x);
    imp_interval range = imp_interval_abs(imp_range_(&x));
    imp_series_ s = {0, range.hi, {0, 0, 0}, INFINITY};
    double side = imp_smaller(-x.lo, x.hi);
    if (range.hi < INFINITY && side < range.hi / 8) {
        s.c[0] = side;
        s.c[1] = x.hi > -x.lo ? 1 : -1;
        s.e = side;
    } else if (range.hi < INFINITY) {
        s.c[0] = range.hi / 8;
        s.c[2] = 1 / range.hi;
        s.e = range.hi / 8 * (1 + 0x1p-50) + IMP_TINY;
    }
    return imp_compose_(&x, &s, range, 1);
}

/* Range and rates that max and min share: each rate is at most the larger one. */
static inline imp_model imp_either_(imp_model r, const imp_model *x, const imp_model *y,
                                    imp_interval range)
{
    r.lo = range.lo;
    r.hi = range.hi;
    for (int j = 0; j < 3; j++) r.rate[j] = imp_larger(x->rate[j], y->rate[j]);
    r.depends = x->depends | y->depends;
    return imp_model_finish(r);
}

/* Where one is the larger all over the region, that one; else (x + y + |x - y|) / 2. */
static inline imp_model imp_max(imp_model x, imp_model y)
{
    if (x.lo >= y.hi) return x;
    if (y.lo >= x.hi) return y;
    imp_model apart = imp_abs(imp_sub(x, y));
    imp_model r = imp_scale(imp_add(imp_add(x, y), apart), 0.5);
    return imp_either_(r, &x, &y, imp_interval_max(imp_range_(&x), imp_range_(&y)));
}

static inline imp_model imp_min(imp_model x, imp_model y)
{
    return imp_neg(imp_max(imp_neg(x), imp_neg(y)));
}

/* --- The angle of a point
 * ---------------------------------------------------------------------------------- */

/* The angle of (x, y) in [-pi, pi], as C's atan2(y, x); 0 counts as +0. A region that crosses the
 * cut, y = 0 with x <= 0, or holds the origin has the whole range and no rates. Elsewhere it is the
 * arc tangent of y / x or of x / y, whichever has its divisor farther from 0. */
static inline imp_model imp_atan2(imp_model y, imp_model x)
{
    double x_least = imp_interval_mig(imp_range_(&x)), y_least = imp_interval_mig(imp_range_(&y));
    imp_model turn = imp_const_pi();
    if ((x.lo <= 0 && y.lo < 0 && y.hi >= 0) || !(x_least > 0 || y_least > 0)) {
        imp_model r = imp_unbounded_(x.depends | y.depends);
        r.lo = -IMP_PI_UPPER;
        r.hi = IMP_PI_UPPER;
        return imp_collapse_(r);
    }
    if (x_least >= y_least) {
        imp_model angle = imp_atan(imp_div(y, x));
        if (x.lo > 0) return angle;
        return y.lo >= 0 ? imp_add(angle, turn) : imp_sub(angle, turn);
    }
    imp_model quarter = imp_scale(turn, y.lo > 0 ? 0.5 : -0.5);
    return imp_sub(quarter, imp_atan(imp_div(x, y)));
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_FUNCTIONS_H */
