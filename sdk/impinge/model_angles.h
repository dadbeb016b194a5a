/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_ANGLES_H
#define IMPINGE_MODEL_ANGLES_H

#include <impinge/model_functions.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Circular and hyperbolic functions, and their inverses
 * =====================================================
 *
 * As in <impinge/model_functions.h>: x = m + y, |y| <= r, t_k Taylor coefficients at m,
 * slope >= |g'| over the range of x. */

/* --- Circular functions ----------------------------------------------------------------------- */

/* For |y| <= r, cos y = even[0] + even[1] y^2 within even[2], and sin y = odd[0] y + odd[1] y^3
 * within odd[2]. */
typedef struct imp_wave_series_ {
    double even[3], odd[3];
} imp_wave_series_;

/* Greatest r for which these are used; the lemma holds up to 4. For a whole turn the polynomial and
 * its error reach beyond [-1, 1] by a third: the range alone says more. */
#define IMP_WAVE_FARTHEST_ 2

/* Lemma. With z = y / r and Bessel's J_k = J_k(r) (Jacobi and Anger),
 *
 *   cos y = J_0 - 2 J_2 T_2(z) + 2 J_4 T_4(z) - ...,   sin y = 2 J_1 T_1(z) - 2 J_3 T_3(z) + ...,
 *
 * |T_k| <= 1 being Chebyshev's polynomials. The first two terms are kept: up to their fourth and
 * fifth, they are the best approximations of their degree. With x = r^2 / 4,
 *
 *   J_k = (r / 2)^k S_k,   S_k = sum of (-x)^m / (m! (m + k)!),
 *   even[0] = S_0 + 2 x S_2,   even[1] = -S_2,   odd[0] = S_1 + 3 x S_3,   odd[1] = -S_3.
 *
 * As x <= 4, terms of S_k fall from m = 2 on, from each to the next: what S_k leaves out is at most
 * the first term that it leaves out, and S_k <= its first three terms. |J_k| <= (r / 2)^k / k!. So
 * what is left out of cos y and of sin y is at most
 *
 *   2 (J_4 + J_6 + ...) <= x^2 (1/12 - x/60 + x^2/720) + x^3/360 + 1.05 x^4/20160
 *                       <= x^2 (1/12 - x/72 + x^2/690)
 *   2 (J_5 + J_7 + ...) <= r (x^2 (1/120 - x/720 + x^2/10080) + x^3/5040 + 1.05 x^4/362880)
 *                       <= r x^2 (1/120 - x/840 + x^2/9700)
 *   of S_0 and S_2      x^6/518400 + 6 x x^5/604800 <= x^6/84000
 *   of S_1 and S_3      r (x^6/3628800 + 7 x x^5/4838400) <= r x^6/570000
 *
 * Rounding, and that of f and g below, each within 11 u: x is off by u, a sum S_k by 12 u times its
 * terms behind the first, and by u; with products and sums 36 u of all terms but the first, and 16
 * u of that. The sizes of S_0 + 6 x S_2 and S_1 + 7 x S_3 are convex in x, 1 at x = 0, and 50 and
 * 17 at x = 4: at most 1 + 12.25 x and 1 + 4 x. */
static inline imp_wave_series_ imp_wave_around_(double r)
{
    imp_wave_series_ w = {{0, 0, INFINITY}, {0, 0, INFINITY}};
    if (!(r <= IMP_WAVE_FARTHEST_)) return w;
    double x = 0.25 * (r * r), xx = x * x, x4 = xx * xx;
    double s0 = 1 - x * (1 - x * (1.0 / 4 - x * (1.0 / 36 - x * (1.0 / 576 - x / 14400))));
    double s1 = 1 - x * (1.0 / 2 - x * (1.0 / 12 - x * (1.0 / 144 - x * (1.0 / 2880 - x / 86400))));
    double s2 = 1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 48 - x * (1.0 / 720 - x / 17280)));
    double s3 = 1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 240 - x * (1.0 / 4320 - x / 120960)));
    double even = xx * (1.0 / 12 - x * (1.0 / 72 - x / 690) + x4 / 84000);
    double odd = xx * (1.0 / 120 - x * (1.0 / 840 - x / 9700) + x4 / 570000);
    w.even[0] = s0 + 2 * x * s2;
    w.even[1] = -s2;
    w.even[2] = even + IMP_U * (16 + 600 * x);
    w.odd[0] = s1 + 3 * x * s3;
    w.odd[1] = -s3;
    w.odd[2] = r * (odd + IMP_U * (16 + 200 * x));
    return w;
}

/* f cos y + g sin y around m: a function with the value f and the derivative g at m, and -f as its
 * second derivative, and so on; its slope is at most |g| + |f| r, and 1. Where r is large, it is
 * f + g y - f y^2 / 2 - g y^3 / 6 + f y^4 / 24 within r^5 / 120. */
static inline imp_model imp_wave_(const imp_model *x, imp_series s, const imp_wave_series_ *w,
                                  double f, double g, imp_interval (*range)(imp_interval))
{
    if (s.r <= IMP_WAVE_FARTHEST_) {
        s.c[0] = f * w->even[0];
        s.c[1] = g * w->odd[0];
        s.c[2] = f * w->even[1];
        s.c[3] = g * w->odd[1];
        s.e = (fabs(f) * w->even[2] + fabs(g) * w->odd[2] + IMP_TINY) * IMP_SLACK;
    } else {
        const double t[5] = {f, g, -f / 2, -g / 6, f / 24};
        imp_series_taylor(&s, 1, t, imp_power5_(s.r) / 120, 10, 11);
    }
    imp_interval at = imp_series_is_sharp_(&s) ? imp_series_range_(&s) : range(imp_model_range(x));
    double slope = (fabs(g) + fabs(f) * s.r) * (1 + 0x1p-40) + IMP_TINY;
    at = imp_interval_intersect(at, imp_interval_make(-1, 1));
    return imp_compose(x, &s, at, imp_smaller(slope, 1));
}

static inline imp_model imp_sin(imp_model x)
{
    if (imp_is_point(&x)) return imp_point_within(&x, sin(x.a), 1, -1, 1);
    imp_series s = imp_series_around(imp_model_range(&x));
    imp_wave_series_ w = imp_wave_around_(s.r);
    return imp_wave_(&x, s, &w, sin(s.m), cos(s.m), imp_interval_sin);
}

static inline imp_model imp_cos(imp_model x)
{
    if (imp_is_point(&x)) return imp_point_within(&x, cos(x.a), 1, -1, 1);
    imp_series s = imp_series_around(imp_model_range(&x));
    imp_wave_series_ w = imp_wave_around_(s.r);
    return imp_wave_(&x, s, &w, cos(s.m), -sin(s.m), imp_interval_cos);
}

/* Both, at a lower cost. */
static inline void imp_sincos(imp_model x, imp_model *sine, imp_model *cosine)
{
    if (imp_is_point(&x)) {
        *sine = imp_point_within(&x, sin(x.a), 1, -1, 1);
        *cosine = imp_point_within(&x, cos(x.a), 1, -1, 1);
        return;
    }
    imp_series s = imp_series_around(imp_model_range(&x));
    imp_wave_series_ w = imp_wave_around_(s.r);
    double f = sin(s.m), g = cos(s.m);
    *sine = imp_wave_(&x, s, &w, f, g, imp_interval_sin);
    *cosine = imp_wave_(&x, s, &w, g, -f, imp_interval_cos);
}

/* With T = tan m, D = 1 + T^2, the t_k are D, D T, D (1 + 3 T^2) / 3, D T (2 + 3 T^2) / 3, and the
 * next is D (2 + 15 T^2 + 15 T^4) / 15, which grows with |T|: Lagrange's bound at the end with
 * the larger |tan|. T is within (L), so T^2 within 21 u, and no t_k is off by more than 100 u. */
static inline imp_model imp_tan(imp_model x)
{
    imp_interval range = imp_interval_tan(imp_model_range(&x));
    double top = imp_interval_mag(range), tt = top * top;
    double slope = imp_round_up(imp_sum_up(1 + tt * (1 + 0x1p-50)));
    if (imp_is_point(&x) && top < INFINITY) return imp_point_(&x, tan(x.a), slope);
    imp_series s = imp_series_around(imp_model_range(&x));
    if (top < INFINITY) {
        double y = tan(s.m), yy = y * y, d = 1 + yy;
        const double t[5] = {y, d, d * y, d * (1 + 3 * yy) / 3, d * y * (2 + 3 * yy) / 3};
        double next = slope * (2 + 15 * tt + 15 * tt * tt) / 15 * (1 + 0x1p-40);
        imp_series_taylor(&s, 1, t, next * imp_power5_(s.r), 10, 100);
    }
    return imp_compose(&x, &s, range, slope);
}

/* --- Inverse circular functions --------------------------------------------------------------- */

/* With w = 1 / (1 + m^2): t_1 = w, t_2 = -m w^2, t_3 = (3 m^2 - 1) w^3 / 3, t_4 = m (1 - m^2) w^4;
 * the next is at most w^(5/2) / 5 in magnitude, w being largest where |x| is least. t_3 and t_4
 * cancel near their zeros: there they are off by up to 20 u w^(3/2) and 20 u w^2, which the tail
 * includes. */
static inline imp_model imp_atan(imp_model x)
{
    double least = imp_interval_mig(imp_model_range(&x));
    double slope = imp_round_up(1 / (1 + least * least)) * (1 + 0x1p-50);
    if (imp_is_point(&x)) return imp_point_(&x, atan(x.a), slope);
    imp_series s = imp_series_around(imp_model_range(&x));
    double m = s.m, w = 1 / (1 + m * m), z = s.r * sqrt(slope), v = m * w;
    const double t[5] = {atan(m), w, -v * w, (3 * m * v - w) * w * w / 3, (w - m * v) * v * w * w};
    double tail = imp_power5_(z) / 5 + 20 * IMP_U * (z * z * z + z * z * z * z);
    imp_series_taylor(&s, 1, t, tail * (1 + 0x1p-40), 10, 12);
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_atan(imp_model_range(&x));
    return imp_compose(&x, &s, range, slope);
}

/* With w = 1 / (1 - m^2): the derivatives of asin are w^(1/2), m w^(3/2), (1 + 2 m^2) w^(5/2),
 * m (9 + 6 m^2) w^(7/2) and (9 + 72 m^2 + 24 m^4) w^(9/2); the last grows with |m| <= top.
 * 1 - m^2 is computed as (1 - m)(1 + m), within 3 u, so no t_k is off by more than 40 u. */
static inline void imp_series_asin_(imp_series *s, double top)
{
    double m = s->m, mm = m * m, w = 1 / ((1 - m) * (1 + m)), v = sqrt(w);
    double far = 1 / (imp_sum_down(1 - top) * (1 + top)), tt = top * top;
    double next = (9 + 72 * tt + 24 * tt * tt) / 120 * (far * far * far * far * sqrt(far));
    const double t[5] = {asin(m), v, m * v * w / 2, (1 + 2 * mm) * v * w * w / 6,
                         m * (9 + 6 * mm) * v * w * w * w / 24};
    imp_series_taylor(s, 1, t, next * imp_power5_(s->r) * (1 + 0x1p-40), 10, 40);
}

/* At least 1 / sqrt(1 - z^2) for |z| <= top. */
static inline double imp_asin_slope_upper_(double top)
{
    double rest = imp_sum_down(1 - top) * (1 + top);
    return top < 1 ? 1 / sqrt(rest) * (1 + 0x1p-48) : INFINITY;
}

/* A point: at 1 and -1 exactly, and between them. */
static inline int imp_asin_is_point_(const imp_model *x, double top)
{
    return imp_is_point(x) && (top < 1 || (top == 1 && x->e == 0));
}

/* Values beyond -1 and 1 come from rounding: those parts of x count as -1 and 1. There the rate is
 * infinite. */
static inline imp_model imp_asin(imp_model x)
{
    double top = imp_interval_mag(imp_model_range(&x));
    double slope = x.e > 0 || x.depends ? imp_asin_slope_upper_(top) : 0;
    if (imp_asin_is_point_(&x, top))
        return imp_point_within(&x, asin(x.a), slope, -IMP_PI_UPPER / 2, IMP_PI_UPPER / 2);
    imp_interval range = imp_interval_asin(imp_model_range(&x));
    imp_series s = imp_series_around(imp_model_range(&x));
    if (top < 1) imp_series_asin_(&s, top);
    return imp_compose(&x, &s, range, slope);
}

/* pi/2 - asin x. Rounding of pi/2, of asin m and of their difference: below 3 u, 8 u being asin's
 * (L) and already counted. */
static inline imp_model imp_acos(imp_model x)
{
    double top = imp_interval_mag(imp_model_range(&x));
    double slope = x.e > 0 || x.depends ? imp_asin_slope_upper_(top) : 0;
    if (imp_asin_is_point_(&x, top)) return imp_point_within(&x, acos(x.a), slope, 0, IMP_PI_UPPER);
    imp_interval range = imp_interval_acos(imp_model_range(&x));
    imp_series s = imp_series_around(imp_model_range(&x));
    if (top < 1) {
        imp_series_asin_(&s, top);
        s.c[0] = IMP_PI_LOWER / 2 - s.c[0];
        for (int k = 1; k < 4; k++) s.c[k] = -s.c[k];
        s.e += 8 * IMP_U;
    }
    return imp_compose(&x, &s, range, slope);
}

/* --- Hyperbolic functions --------------------------------------------------------------------- */

/* sinh and cosh are their own second derivatives; cosh at the far end bounds the fifth. At a point,
 * within 2^-30 |x| < 10^-6 of the exact x, slopes differ by less than 1 in 1000. */
static inline imp_model imp_sinh(imp_model x)
{
    if (imp_is_point(&x)) {
        double y = imp_sinh_(x.a);
        if (fabs(y) > 0x1p1020) return imp_point_beyond_(imp_interval_sinh(imp_model_range(&x)));
        return imp_point_(&x, y, 1.001 * (fabs(y) + 1));
    }
    double slope = imp_interval_cosh(imp_model_range(&x)).hi;
    imp_series s = imp_series_around(imp_model_range(&x));
    double f = imp_sinh_(s.m), g = imp_cosh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_taylor(&s, 1, t, slope * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose(&x, &s, imp_interval_sinh(imp_model_range(&x)), slope);
}

static inline imp_model imp_cosh(imp_model x)
{
    if (imp_is_point(&x)) {
        double y = imp_cosh_(x.a);
        if (y > 0x1p1020) return imp_point_beyond_(imp_interval_cosh(imp_model_range(&x)));
        return imp_point_within(&x, y, 1.001 * y, 1, INFINITY);
    }
    double slope = imp_interval_mag(imp_interval_sinh(imp_model_range(&x)));
    imp_interval range = imp_interval_cosh(imp_model_range(&x));
    imp_series s = imp_series_around(imp_model_range(&x));
    double f = imp_cosh_(s.m), g = imp_sinh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_taylor(&s, 1, t, range.hi * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose(&x, &s, range, slope);
}

/* With T = tanh m, D = 1 - T^2: t_k = D, -D T, D (3 T^2 - 1) / 3, D T (2 - 3 T^2) / 3, the next at
 * most 2 D / 15. T is within 10 u, so D within 24 u, absolutely, and the rest within 60 u. */
static inline imp_model imp_tanh(imp_model x)
{
    if (imp_is_point(&x)) return imp_point_within(&x, tanh(x.a), 1, -1, 1);
    imp_interval range = imp_interval_tanh(imp_model_range(&x));
    double least = imp_interval_mig(range);
    double slope = imp_smaller((1 - least) * (1 + least) * (1 + 0x1p-50) + IMP_TINY, 1);
    imp_series s = imp_series_around(imp_model_range(&x));
    double y = tanh(s.m), yy = y * y, d = (1 - y) * (1 + y), r = s.r;
    const double t[5] = {y, d, -d * y, d * (3 * yy - 1) / 3, d * y * (2 - 3 * yy) / 3};
    double tail = slope * imp_power5_(r) * 2 / 15 + 60 * IMP_U * (r + r * r) * (1 + r * r);
    imp_series_taylor(&s, 1, t, tail * (1 + 0x1p-40), 10, 1);
    return imp_compose(&x, &s, range, slope);
}

/* --- The angle of a point --------------------------------------------------------------------- */

/* All angles, at any rate: where (x, y) may cross the cut or be the origin. */
static inline imp_model imp_any_angle_(uint32_t depends)
{
    imp_model r = imp_unbounded(depends);
    r.lo = -IMP_PI_UPPER;
    r.hi = IMP_PI_UPPER;
    return imp_model_collapse(r);
}

/* The angle of (x, y) in [-pi, pi], as C's atan2(y, x), with y = 0 counting as +0. A region that
 * crosses the cut, y = 0 with x <= 0, or holds the origin has the whole range and no rates.
 * Elsewhere it is the arc tangent of y / x or of x / y, whichever has its divisor farther from 0.
 */
static inline imp_model imp_atan2(imp_model y, imp_model x)
{
    double x_least = imp_interval_mig(imp_model_range(&x)),
           y_least = imp_interval_mig(imp_model_range(&y));
    imp_model turn = imp_const_pi();
    if ((x.lo <= 0 && y.lo < 0 && y.hi >= 0) || !(x_least > 0 || y_least > 0))
        return imp_any_angle_(x.depends | y.depends);
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

#endif /* IMPINGE_MODEL_ANGLES_H */
