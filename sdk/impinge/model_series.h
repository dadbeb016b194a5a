/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_SERIES_H
#define IMPINGE_MODEL_SERIES_H

#include <impinge/model_arithmetic.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Functions of models
 * ===================
 *
 * Each function g is handled in two steps. Over the range [m - r, m + r] of its argument, g
 * is replaced by a cubic in y = x - m with a proved error; then the argument's model is
 * substituted and the cubic terms folded. The cubic comes from the Taylor series at m: its
 * fourth term is not dropped but replaced by its best quadratic, 8 times closer than 0 is:
 *
 *   z^4 = z^2 - 1/8 +- 1/8     on [-1, 1]   (Chebyshev's T_4 = 8 z^4 - 8 z^2 + 1)
 *
 * As the folding of cubic terms is optimal too, the remainder is that of interpolation in
 * Chebyshev's points, g''' r^3 / 24, or less where g's curvature and its argument's
 * cancel; without the digits that divided differences lose, and for one call of libm. Sine and
 * cosine have cubics of their own (imp_wave_around_). */

/* g(m + y) = c0 + c1 y + c2 y^2 + c3 y^3 within e, for |y| <= r. */
typedef struct imp_series {
    double m, r;
    double c[4];
    double e;
} imp_series;

static inline imp_series imp_series_around(imp_interval x)
{
    imp_series s = {0, INFINITY, {0, 0, 0, 0}, INFINITY};
    if (imp_interval_is_finite(x)) {
        s.m = imp_interval_mid(x);
        s.r = imp_interval_radius_upper(x, s.m);
    }
    return s;
}

/* Completes s from t[k] = Taylor coefficients in z = y / scale, scale > 0, k = 0 ... 4. `tail`
 * bounds the rest of the series over |z| <= z_max = r / scale. t[0] is within u0 u |t[0]|, the
 * others within un u |t[k]|, of exact values.
 *
 * Rounding: t[0] passes one sum; the others at most 7 operations (z_max^2, product, sum, the
 * inverse of scale and products by it). Underflow: each operation may lose 2^-1075, then is
 * multiplied by at most max(1, r^3) or, t being finite, by z_max^4 / 8: IMP_TINY
 * (1 + r^2 + z_max^2)^2 covers them. */
static inline void imp_series_taylor(imp_series *s, double scale, const double t[5], double tail,
                                     double u0, double un)
{
    double z = scale == 1 ? s->r : imp_round_up(s->r / scale), zz = z * z;
    double inverse = 1 / scale, t4 = fabs(t[4]) * zz * zz;
    s->c[0] = t[0] - 0.125 * (t[4] * zz * zz);
    s->c[1] = t[1] * inverse;
    s->c[2] = (t[2] + t[4] * zz) * inverse * inverse;
    s->c[3] = t[3] * inverse * inverse * inverse;
    double high = fabs(t[1]) * z + fabs(t[2]) * zz + fabs(t[3]) * zz * z + t4;
    double rounding = (u0 + 1) * fabs(t[0]) + (un + 8) * high;
    double w = 1 + s->r * s->r + zz;
    s->e = (0.125 * t4 + tail + (IMP_U * rounding + IMP_TINY * w * w)) * IMP_SLACK;
}

/* y^3 = 3/4 r^2 y +- r^3 / 4: the resulting linear term of the series, and its error. */
static inline double imp_series_slant_(const imp_series *s)
{
    return s->c[1] + 0.75 * (s->c[3] * s->r * s->r);
}

static inline double imp_series_bend_(const imp_series *s)
{
    return 0.25 * fabs(s->c[3] * s->r * s->r * s->r);
}

/* Range of g: that of the quadratic, widened by the errors. Ten roundings, each below u times
 * the sum of magnitudes, which 16 u covers. */
static inline imp_interval imp_series_range_(const imp_series *s)
{
    double b = imp_series_slant_(s) * s->r, q = s->c[2] * s->r * s->r;
    double bend = imp_series_bend_(s);
    double size = fabs(s->c[0]) + fabs(s->c[1] * s->r) + 4 * bend + fabs(q);
    double pad = (s->e + bend + 0x1p-49 * size + IMP_TINY) * IMP_SLACK;
    return imp_interval_make(imp_sum_down(s->c[0] + (imp_bow_lower_(b, q) - pad)),
                             imp_sum_up(s->c[0] + (imp_bow_upper_(b, q) + pad)));
}

/* Is that range close enough, within 1/256 at either end, to make libm's calls at the ends
 * unnecessary? Never if r or a coefficient is infinite, because an end may still be known. */
static inline int imp_series_is_sharp_(const imp_series *s)
{
    double slant = fabs(imp_series_slant_(s));
    if (!(s->r < INFINITY && slant < INFINITY)) return 0;
    return s->e + imp_series_bend_(s) <= 0x1p-8 * slant * s->r && 4 * fabs(s->c[2]) * s->r <= slant;
}

/* --- Substitution ----------------------------------------------------------------------------- */

/* With p = P - m = A + L + Q, x = m + p + delta and y = p + delta, |y| <= r:
 *
 *   g = c0 + c1 p + c2 p^2 + c3 p^3 + delta (...) +- s.e
 *   |(...)| <= |c1| + |c2| (2 r + e) + 3 |c3| (r + e)^2
 *   p^2 = (A^2 - h^2) + 2 A L + (2 (A + h) Q + L^2) + 2 L Q + D^2,   0 <= D^2 <= swing^2
 *
 * as in a product: h = middle(Q), D = Q - h. The cubic terms can be bounded in two ways:
 *
 *   flat   c3 y^3 is 3/4 c3 r^2 y +- |c3| r^3 / 4 as a whole, and 2 c2 L Q is folded;
 *   deep   with C = A + h, p^3 = (C + L + D)^3 = C^3 + 3 C^2 L + 3 C L^2 + L^3 +- 3 |D| N^2 (mean
 *          value theorem, N >= |C + L + D|, |C + L|), and L (2 c2 Q + c3 L^2) is folded as
 *          one: here terms may cancel. N = |C| + B + swing, or r + e + swing.
 *
 * The one with the smaller remainder is used; if Q is 0, flat. */
typedef struct imp_terms_ {
    double c0, c1, c2; /* c2: factor of L^2 */
    double linear[3], rest;
} imp_terms_;

static inline imp_terms_ imp_terms_flat_(const imp_model *x, const imp_series *s, double size)
{
    imp_terms_ t = {s->c[0], imp_series_slant_(s), s->c[2], {0, 0, 0}, imp_series_bend_(s)};
    if (size == 0 || s->c[2] == 0) return t;
    double cubic[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    imp_cubic_add_(x->b, x->q, cubic);
    t.rest += 2 * fabs(s->c[2]) * imp_cubic_fold_(cubic, t.linear);
    for (int j = 0; j < 3; j++) t.linear[j] *= 2 * s->c[2];
    return t;
}

/* c = C, bb = coefficients of L^2. */
static inline imp_terms_ imp_terms_deep_(const imp_model *x, const imp_series *s, double c,
                                         const double bb[6], double swing)
{
    double c3 = s->c[3], cubic[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, w[6];
    double n = imp_smaller(fabs(c) + imp_sum_abs3_(x->b), s->r + x->e) + swing;
    imp_terms_ t = {s->c[0] + c3 * c * c * c, s->c[1], s->c[2] + 3 * (c3 * c), {0, 0, 0}, 0};
    for (int k = 0; k < 6; k++) w[k] = 2 * s->c[2] * x->q[k] + c3 * bb[k];
    imp_cubic_add_(x->b, w, cubic);
    t.rest = imp_cubic_fold_(cubic, t.linear) + 3 * fabs(c3) * swing * n * n;
    for (int j = 0; j < 3; j++) t.linear[j] += 3 * (c3 * c * c) * x->b[j];
    return t;
}

/* The remainder; `rest` is its part without rounding and delta. n >= |A| + |L| + |Q|.
 *
 * Rounding, in units of u and with d_k = |c_k|: c0 passes at most 3 roundings; c1 p at most 5
 * (A, sum in c1, product, two sums); c2 p^2 at most 8, the terms in h and swing adding less
 * than Q^2 / 2: hence 10; c3 p^3 and c3 r^2 p at most 12, and C,
 * itself off by 2 u n, adds 6 to the bound of D: 18.
 * Underflow: each product may lose 2^-1075, then is multiplied by at most one c_k and two of
 * what n or r + e bounds: IMP_TINY (1 + d1 + d2 + d3)(1 + n + r + e)^2. */
static inline double imp_substitute_error_(const imp_model *x, const imp_series *s, double n,
                                           double rest)
{
    double d1 = fabs(s->c[1]), d2 = fabs(s->c[2]), d3 = fabs(s->c[3]), far = s->r + x->e;
    double inherited = x->e * (d1 + d2 * (s->r + far) + 3 * d3 * far * far);
    double rounding =
        3 * fabs(s->c[0]) + n * (5 * (d1 + d3 * s->r * s->r) + n * (10 * d2 + 18 * d3 * n));
    double w = 1 + n + far, underflow = (1 + d1 + d2 + d3) * w * w;
    return (rest + inherited + (IMP_U * rounding + IMP_TINY * underflow)) * IMP_SLACK;
}

/* Where Q is 0 and L has but one parameter p, most of what follows is 0. */
static inline void imp_substitute_line_(const imp_model *x, const imp_series *s, int p,
                                        imp_model *r)
{
    static const int square[3] = {IMP_UU, IMP_VV, IMP_TT};
    double a = x->a - s->m, b = x->b[p], slant = imp_series_slant_(s), c2 = s->c[2];
    for (int j = 0; j < 3; j++) r->b[j] = 0;
    for (int k = 0; k < 6; k++) r->q[k] = 0;
    r->a = s->c[0] + (slant * a + c2 * (a * a));
    r->b[p] = (slant + 2 * c2 * a) * b;
    r->q[square[p]] = c2 * (b * b);
    r->e = imp_substitute_error_(x, s, fabs(a) + fabs(b), s->e + imp_series_bend_(s));
}

/* The only parameter that L may have; -1: there are several. */
static inline int imp_only_parameter_(const double b[3])
{
    if (b[1] == 0 && b[2] == 0) return 0;
    if (b[0] == 0) return b[2] == 0 ? 1 : b[1] == 0 ? 2 : -1;
    return -1;
}

static inline void imp_substitute_full_(const imp_model *x, const imp_series *s, double size,
                                        imp_model *r)
{
    double bb[6], a = x->a - s->m, c2 = s->c[2], h = 0, half = 0;
    imp_square_terms_(x->b, x->b, bb);
    imp_terms_ t = imp_terms_flat_(x, s, size);
    if (size != 0) {
        double swing = imp_swing_upper_(x->q, size);
        h = imp_middle_(x->q);
        half = 0.5 * swing * swing;
        if (s->c[3] != 0) {
            imp_terms_ deep = imp_terms_deep_(x, s, a + h, bb, swing);
            if (deep.rest < t.rest) t = deep;
        }
    }
    double slope = t.c1 + 2 * c2 * a, slope_q = t.c1 + 2 * c2 * (a + h);
    r->a = t.c0 + (t.c1 * a + c2 * (a * a - h * h + half));
    for (int j = 0; j < 3; j++) r->b[j] = slope * x->b[j] + t.linear[j];
    for (int k = 0; k < 6; k++) r->q[k] = slope_q * x->q[k] + t.c2 * bb[k];
    r->e = imp_substitute_error_(x, s, fabs(a) + imp_sum_abs3_(x->b) + size,
                                 s->e + t.rest + fabs(c2) * half);
}

static inline void imp_substitute_(const imp_model *x, const imp_series *s, imp_model *r)
{
    double size = imp_sum_abs6_(x->q);
    int p = size == 0 ? imp_only_parameter_(x->b) : -1;
    if (p >= 0)
        imp_substitute_line_(x, s, p, r);
    else
        imp_substitute_full_(x, s, size, r);
}

/* The model of g(x), from its series, its range, and slope >= max |g'| over x. */
static inline imp_model imp_compose(const imp_model *x, const imp_series *s, imp_interval range,
                                    double slope)
{
    imp_model r;
    imp_substitute_(x, s, &r);
    r.lo = range.lo;
    r.hi = range.hi;
    r.depends = x->depends;
    r.reserved = 0;
    for (int j = 0; j < 3; j++) r.rate[j] = (x->rate[j] * slope + IMP_TINY) * IMP_SLACK;
    imp_finish_(&r);
    return r;
}

/* g at a point: y = g(x.a) as libm gives it, slope >= |g'| between x.a and the exact x, but for
 * underflow: a slope below 2^-1022 matters where x.e is large. */
static inline imp_model imp_point_(const imp_model *x, double y, double slope)
{
    double inherited = (slope + IMP_TINY) * x->e;
    return imp_known(y, (fabs(y) * IMP_LIBM + inherited + IMP_TINY) * IMP_SLACK);
}

/* Like imp_point_, where lo <= g <= hi always holds. */
static inline imp_model imp_point_within(const imp_model *x, double y, double slope, double lo,
                                         double hi)
{
    imp_model r = imp_point_(x, y, slope);
    r.lo = imp_larger(r.lo, lo);
    r.hi = imp_smaller(r.hi, hi);
    return r;
}

/* g at a point where it overflows: its range, with one end possibly finite. */
static inline imp_model imp_point_beyond_(imp_interval range)
{
    return imp_between(range.lo, range.hi);
}

static inline double imp_power5_(double z) { return z * z * z * z * z; }

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_SERIES_H */
