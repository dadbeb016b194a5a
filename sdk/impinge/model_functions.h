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
 * Each function g is handled in two steps. Over the range [m - r, m + r] of its argument, g
 * is replaced by a cubic in y = x - m with a proved error; then the argument's model is
 * substituted and the cubic terms folded. The cubic comes from the Taylor series at m: its
 * fourth term is not dropped but replaced by its best quadratic, 8 times closer than 0 is:
 *
 *   z^4 = z^2 - 1/8 +- 1/8     on [-1, 1]   (Chebyshev's T_4 = 8 z^4 - 8 z^2 + 1)
 *
 * As the folding of cubic terms is optimal too, the remainder is that of interpolation in
 * Chebyshev's points, g''' r^3 / 24, or less where g's curvature and its argument's
 * cancel; without the digits that divided differences lose, and for one call of libm. */

/* g(m + y) = c0 + c1 y + c2 y^2 + c3 y^3 within e, for |y| <= r. */
typedef struct imp_series_ {
    double m, r;
    double c[4];
    double e;
} imp_series_;

static inline imp_series_ imp_series_at_(imp_interval x)
{
    imp_series_ s = {0, INFINITY, {0, 0, 0, 0}, INFINITY};
    if (imp_interval_is_finite(x)) {
        s.m = imp_interval_mid(x);
        s.r = imp_interval_radius_upper(x, s.m);
    }
    return s;
}

/* Completes s from t[k] = Taylor coefficients in z = y / scale, scale > 0, k = 0 ... 4. `tail`
 * bounds what follows, over |z| <= z_max = r / scale. t[0] is within u0 u |t[0]|, the others
 * within un u |t[k]|, of exact values.
 *
 * Rounding: t[0] passes one sum; the others at most 7 operations (z_max^2, product, sum, the
 * inverse of scale and products by it). Underflow: each operation may lose 2^-1075, then is
 * multiplied by at most max(1, r^3) or, t being finite, by z_max^4 / 8: IMP_TINY
 * (1 + r^2 + z_max^2)^2 covers them. */
static inline void imp_series_set_(imp_series_ *s, double scale, const double t[5], double tail,
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

/* y^3 = 3/4 r^2 y +- r^3 / 4: what that makes of the series' linear term, and its error. */
static inline double imp_series_slant_(const imp_series_ *s)
{
    return s->c[1] + 0.75 * (s->c[3] * s->r * s->r);
}

static inline double imp_series_bend_(const imp_series_ *s)
{
    return 0.25 * fabs(s->c[3] * s->r * s->r * s->r);
}

/* Range of g: that of the quadratic, widened by the errors. Ten roundings, each below u times
 * the sum of magnitudes, which 16 u covers. */
static inline imp_interval imp_series_range_(const imp_series_ *s)
{
    double b = imp_series_slant_(s) * s->r, q = s->c[2] * s->r * s->r;
    double bend = imp_series_bend_(s);
    double size = fabs(s->c[0]) + fabs(s->c[1] * s->r) + 4 * bend + fabs(q);
    double pad = (s->e + bend + 0x1p-49 * size + IMP_TINY) * IMP_SLACK;
    return imp_interval_make(imp_sum_down(s->c[0] + (imp_bow_lower_(b, q) - pad)),
                             imp_sum_up(s->c[0] + (imp_bow_upper_(b, q) + pad)));
}

/* Is that range close enough, within 1/256 at either end, to spare libm's calls at the ends? */
static inline int imp_series_is_sharp_(const imp_series_ *s)
{
    double slant = fabs(imp_series_slant_(s));
    return s->e + imp_series_bend_(s) <= 0x1p-8 * slant * s->r && 4 * fabs(s->c[2]) * s->r <= slant;
}

/* --- Substitution ------------------------------------------------------------------------ */

/* With p = P - m = A + L + Q, x = m + p + delta and y = p + delta, |y| <= r:
 *
 *   g = c0 + c1 p + c2 p^2 + c3 p^3 + delta (...) +- s.e
 *   |(...)| <= |c1| + |c2| (2 r + e) + 3 |c3| (r + e)^2
 *   p^2 = (A^2 - h^2) + 2 A L + (2 (A + h) Q + L^2) + 2 L Q + D^2,   0 <= D^2 <= swing^2
 *
 * as in a product: h = middle(Q), D = Q - h. The cubic terms can be had in two ways:
 *
 *   flat   c3 y^3 is 3/4 c3 r^2 y +- |c3| r^3 / 4 as a whole, and 2 c2 L Q is folded;
 *   deep   with C = A + h, p^3 = (C + L + D)^3 = C^3 + 3 C^2 L + 3 C L^2 + L^3 +- 3 |D| N^2 (mean
 *          value theorem, N >= |C + L + D|, |C + L|), and L (2 c2 Q + c3 L^2) is folded as
 *          one: here terms may cancel. N = |C| + B + swing, or r + e + swing.
 *
 * The one with the smaller rest is taken; where Q is 0, flat is. */
typedef struct imp_terms_ {
    double c0, c1, c2; /* c2: factor of L^2 */
    double linear[3], rest;
} imp_terms_;

static inline imp_terms_ imp_terms_flat_(const imp_model *x, const imp_series_ *s)
{
    imp_terms_ t = {s->c[0], imp_series_slant_(s), s->c[2], {0, 0, 0}, 0};
    double cubic[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    imp_cubic_add_(x->b, x->q, cubic);
    t.rest = 2 * fabs(s->c[2]) * imp_cubic_fold_(cubic, t.linear) + imp_series_bend_(s);
    for (int j = 0; j < 3; j++) t.linear[j] *= 2 * s->c[2];
    return t;
}

/* c = C, bb = coefficients of L^2. */
static inline imp_terms_ imp_terms_deep_(const imp_model *x, const imp_series_ *s, double c,
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

/* Rounding, in units of u and with d_k = |c_k|: c0 passes at most 3 roundings; c1 p at most 5
 * (A, sum in c1, product, two sums); c2 p^2 at most 8, the terms in h and swing adding less
 * than Q^2 / 2: hence 10; c3 p^3 and c3 r^2 p at most 12, and C,
 * itself off by 2 u n, adds 6 to the bound of D: 18.
 * Underflow: each product may lose 2^-1075, then is multiplied by at most one c_k and two of
 * what n or r bounds: IMP_TINY (1 + d1 + d2 + d3)(1 + n + r)^2. */
static inline void imp_substitute_(const imp_model *x, const imp_series_ *s, imp_model *r)
{
    double bb[6], a = x->a - s->m, c2 = s->c[2];
    double size = imp_sum_abs6_(x->q), n = fabs(a) + imp_sum_abs3_(x->b) + size;
    double h = imp_middle_(x->q), swing = imp_swing_upper_(x->q, size), half = 0.5 * swing * swing;
    imp_square_terms_(x->b, x->b, bb);
    imp_terms_ t = imp_terms_flat_(x, s);
    if (size != 0 && s->c[3] != 0) {
        imp_terms_ deep = imp_terms_deep_(x, s, a + h, bb, swing);
        if (deep.rest < t.rest) t = deep;
    }
    double slope = t.c1 + 2 * c2 * a, slope_q = t.c1 + 2 * c2 * (a + h);
    r->a = t.c0 + (t.c1 * a + c2 * (a * a - h * h + half));
    for (int j = 0; j < 3; j++) r->b[j] = slope * x->b[j] + t.linear[j];
    for (int k = 0; k < 6; k++) r->q[k] = slope_q * x->q[k] + t.c2 * bb[k];
    double d1 = fabs(s->c[1]), d2 = fabs(c2), d3 = fabs(s->c[3]), far = s->r + x->e;
    double inherited = x->e * (d1 + d2 * (s->r + far) + 3 * d3 * far * far);
    double rounding =
        3 * fabs(s->c[0]) + n * (5 * (d1 + d3 * s->r * s->r) + n * (10 * d2 + 18 * d3 * n));
    double w = 1 + n + s->r, underflow = (1 + d1 + d2 + d3) * w * w;
    r->e = (s->e + t.rest + d2 * half + inherited + (IMP_U * rounding + IMP_TINY * underflow)) *
           IMP_SLACK;
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

/* g at a point: y = g(x.a) as libm gives it, slope >= |g'| between x.a and the exact x. */
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

/* x^2 = m^2 + 2 m y + y^2, exactly but for the rounding of m^2. */
static inline imp_model imp_sqr(imp_model x)
{
    imp_interval range = imp_range_(&x);
    if (imp_is_point_(&x)) {
        imp_model p = imp_mul_point_(&x, &x);
        p.lo = imp_larger(p.lo, 0);
        return p;
    }
    imp_series_ s = imp_series_at_(range);
    s.c[0] = s.m * s.m;
    s.c[1] = 2 * s.m;
    s.c[2] = 1;
    s.e = s.r < INFINITY ? IMP_U * s.c[0] + IMP_TINY : INFINITY;
    return imp_compose_(&x, &s, imp_interval_sqr(range), 2 * imp_interval_mag(range));
}

/* Bounds of P and P' where |t| <= x, with 2^-900 added to each |coefficient|, so that their
 * multiples by u outweigh underflow. */
typedef struct imp_poly_sizes_ {
    double value, slope;
} imp_poly_sizes_;

static inline imp_poly_sizes_ imp_poly_sizes_upper_(const double *coef, size_t n, double x)
{
    imp_poly_sizes_ r = {0, 0};
    for (size_t k = n; k > 0; k--) {
        r.slope = r.slope * x + r.value;
        r.value = r.value * x + (fabs(coef[k - 1]) + 0x1p-900);
    }
    r.value *= 1 + 0x1p-50 * (double)n;
    r.slope *= 1 + 0x1p-50 * (double)n;
    return r;
}

/* Horner's rule. Each term passes at most 2 n roundings. */
static inline imp_model imp_poly_point_(const double *coef, size_t n, const imp_model *t)
{
    imp_poly_sizes_ sizes = imp_poly_sizes_upper_(coef, n, imp_sum_up(fabs(t->a) + t->e));
    double y = 0, rounding = 2.01 * IMP_U * (double)n * sizes.value;
    for (size_t k = n; k > 0; k--) y = y * t->a + coef[k - 1];
    return imp_known_(y, (rounding + sizes.slope * t->e) * IMP_SLACK);
}

static inline imp_model imp_poly_horner_(const double *coef, size_t n, imp_model t)
{
    imp_model r = imp_num(coef[n - 1]);
    for (size_t k = n - 1; k > 0; k--) r = imp_shift(imp_mul(r, t), coef[k - 1]);
    return r;
}

static inline imp_interval imp_poly_interval_(const double *coef, size_t n, imp_interval t)
{
    imp_interval r = imp_interval_make(coef[n - 1], coef[n - 1]);
    for (size_t k = n - 1; k > 0; k--)
        r = imp_interval_add(imp_interval_mul(r, t), imp_interval_make(coef[k - 1], coef[k - 1]));
    return r;
}

#define IMP_POLY_MAX 24 /* coefficients; longer ones go by Horner's rule */

/* Taylor coefficients w_k of the polynomial at m, by repeated division; the answer bounds |P'|.
 * A term of w_k passes at most 2 n roundings, so the errors of all w_k r^k together are
 * below 2 n u times the polynomial of magnitudes at |m| + r; likewise for P'. */
static inline double imp_series_poly_(imp_series_ *s, const double *coef, size_t n)
{
    double w[IMP_POLY_MAX], t[5] = {0, 0, 0, 0, 0}, power = 1, tail = 0, slope = 0;
    imp_poly_sizes_ sizes = imp_poly_sizes_upper_(coef, n, imp_sum_up(fabs(s->m) + s->r));
    for (size_t k = 0; k < n; k++) w[k] = coef[k];
    for (size_t k = 0; k + 1 < n; k++)
        for (size_t i = n - 1; i > k; i--) w[i - 1] += w[i] * s->m;
    for (size_t k = 0; k < n && k < 5; k++) t[k] = w[k];
    for (size_t k = 1; k < n; k++) {
        slope += (double)k * fabs(w[k]) * power;
        power = power * s->r + IMP_TINY;
        tail += k < 5 ? 0 : fabs(w[k]) * power;
    }
    double unit = 2.01 * IMP_U * (double)n;
    imp_series_set_(s, 1, t, (tail + unit * sizes.value) * IMP_SLACK, 0, 0);
    return (slope + unit * sizes.slope) * IMP_SLACK;
}

/* sum_k coef[k] t^k; n coefficients, lowest first. */
static inline imp_model imp_poly(const double *coef, size_t n, imp_model t)
{
    if (n < 2) return imp_num(n > 0 ? coef[0] : 0);
    if (n == 2) return imp_shift(imp_scale(t, coef[1]), coef[0]);
    if (imp_is_point_(&t)) return imp_poly_point_(coef, n, &t);
    if (n > IMP_POLY_MAX) return imp_poly_horner_(coef, n, t);
    imp_series_ s = imp_series_at_(imp_range_(&t));
    double slope = imp_series_poly_(&s, coef, n);
    imp_interval range = imp_series_range_(&s);
    if (!imp_series_is_sharp_(&s))
        range = imp_interval_meet(range, imp_poly_interval_(coef, n, imp_range_(&t)));
    return imp_compose_(&t, &s, range, slope);
}

static inline double imp_power5_(double z) { return z * z * z * z * z; }

/* x^n, n >= 3, m of any sign. t_k = C(n, k) m^(n-k); what follows the fourth is below C(n, 5)
 * (|m| + r)^(n-5) r^5 (Lagrange). The powers of m are one call of libm and at most four products,
 * the binomials are within 4 u: (L) + 8 u. */
static inline void imp_series_powi_(imp_series_ *s, int n)
{
    double power = n > 4 ? imp_pow_(s->m, n - 4) : 1, tail = 0, t[5] = {0, 0, 0, 0, 0};
    double c2 = (double)n * (n - 1.) / 2, c3 = c2 * (n - 2.) / 3, c4 = c3 * (n - 3.) / 4;
    const double binomial[5] = {1, (double)n, c2, c3, c4};
    for (int k = n < 4 ? n : 4; k >= 0; k--) {
        t[k] = binomial[k] * power;
        power *= s->m;
    }
    if (n > 4) {
        double far = imp_libm_up(imp_pow_(imp_sum_up(fabs(s->m) + s->r), n - 5));
        tail = c4 * (n - 4.) / 5 * far * imp_power5_(s->r) * (1 + 0x1p-40);
    }
    imp_series_set_(s, 1, t, tail, 18, 20);
}

/* x^n at a point: |x| differs from |x.a| by less than 2^-30 of it, so x^(n-1) by less than 1 in
 * 100, while n < 2^20. */
static inline imp_model imp_powi_point_(const imp_model *x, int n)
{
    double y = imp_pow_(x->a, n);
    return x->a == 0 ? *x : imp_point_(x, y, 1.01 * n * fabs(y / x->a));
}

/* n >= 3. */
static inline imp_model imp_powi_positive_(imp_model x, int n)
{
    imp_interval range = imp_range_(&x);
    if (imp_is_point_(&x) && n < 1 << 20) return imp_powi_point_(&x, n);
    double top = imp_interval_pow(imp_interval_abs(range), n - 1).hi;
    imp_series_ s = imp_series_at_(range);
    imp_series_powi_(&s, n);
    return imp_compose_(&x, &s, imp_interval_powi(range, n), imp_round_up(top * n));
}

/* --- Quotients ------------------------------------------------------------------------------ */

/* x / y at a point: |x / y - a / a'| <= (e + |a / a'| e') / min |y|. */
static inline imp_model imp_div_point_(const imp_model *x, const imp_model *y)
{
    double a = x->a / y->a, least = imp_interval_mig(imp_range_(y));
    double inherited = (x->e + imp_round_up(fabs(a)) * y->e) / least;
    return imp_known_(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

static inline double imp_size_(const imp_model *x)
{
    return fabs(x->a) + imp_sum_abs3_(x->b) + imp_sum_abs6_(x->q);
}

/* The terms up to degree 2 of the power series of (quadratic of x) / (quadratic of y): a guess, of
 * which nothing is claimed. */
static inline imp_model imp_quotient_guess_(const imp_model *x, const imp_model *y, double inverse)
{
    imp_model z = imp_zero_();
    double zz[6];
    z.a = x->a * inverse;
    for (int j = 0; j < 3; j++) z.b[j] = (x->b[j] - z.a * y->b[j]) * inverse;
    imp_square_terms_(z.b, y->b, zz);
    for (int k = 0; k < 6; k++) z.q[k] = (x->q[k] - z.a * y->q[k] - zz[k]) * inverse;
    z.hi = imp_size_(&z) * IMP_SLACK;
    z.lo = -z.hi;
    return z;
}

/* Quadratic and remainder of x / y. With z any quadratic,
 *
 *   |x / y - z| = |x - y z| / |y| <= |x - y z| / least
 *
 * and y z is a product of models, whose cubic terms, folded, cancel against each other and x.
 * A first z leaves the residual rho; z + Delta with Delta = rho / a' leaves
 * rho - y Delta = (rho - a' Delta) - (y - a') Delta. Rounding: rho's coefficients by u each,
 * those of Delta (inverse, which may be subnormal, and product) by 5 u, of z + Delta by u of the
 * sum, which y multiplies: together less than 8 u |rho| + u |z + Delta| |y|. */
static inline void imp_quotient_(const imp_model *x, const imp_model *y, double least, imp_model *r)
{
    double inverse = 1 / y->a, swing = imp_sum_abs3_(y->b) + imp_sum_abs6_(y->q) + y->e;
    imp_model z = imp_quotient_guess_(x, y, inverse), w;
    imp_product_(y, &z, &w);
    w.a = x->a - w.a;
    r->a = z.a + w.a * inverse;
    for (int j = 0; j < 3; j++) {
        w.b[j] = x->b[j] - w.b[j];
        r->b[j] = z.b[j] + w.b[j] * inverse;
    }
    for (int k = 0; k < 6; k++) {
        w.q[k] = x->q[k] - w.q[k];
        r->q[k] = z.q[k] + w.q[k] * inverse;
    }
    double rho = imp_size_(&w), size = fabs(y->a) + swing;
    double rounding = 8 * rho + imp_size_(r) * size;
    double rest = w.e + x->e + swing * (rho * fabs(inverse));
    double residual = rest + (IMP_U * rounding + IMP_TINY * (1 + size));
    r->e = (residual / least + IMP_TINY) * IMP_SLACK;
}

/* x / k where k is exact: each of the ten quotients is rounded once. */
static inline imp_model imp_div_exact_(imp_model x, double k)
{
    imp_interval at = imp_interval_div(imp_range_(&x), imp_interval_make(k, k));
    x.a /= k;
    x.lo = at.lo;
    x.hi = at.hi;
    for (int j = 0; j < 3; j++) {
        x.b[j] /= k;
        x.rate[j] = imp_round_up(x.rate[j] / fabs(k));
    }
    for (int j = 0; j < 6; j++) x.q[j] /= k;
    x.e = (x.e / fabs(k) + (IMP_U * imp_size_(&x) + IMP_TINY)) * IMP_SLACK;
    return imp_model_finish(x);
}

/* The rate of a quotient: (|x'| + |x / y| |y'|) / |y|. */
static inline imp_model imp_div(imp_model x, imp_model y)
{
    double least = imp_interval_mig(imp_range_(&y));
    if (imp_is_exact_(&x) && x.a == 0 && least > 0) return x;
    if (imp_is_point_(&x) && imp_is_point_(&y) && least > 0) return imp_div_point_(&x, &y);
    if (imp_is_exact_(&y) && least > 0) return imp_div_exact_(x, y.a);
    imp_model r;
    imp_interval range = imp_interval_div(imp_range_(&x), imp_range_(&y));
    imp_quotient_(&x, &y, least, &r);
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

/* x^n for any whole n > -2^31; x != 0 if n < 0. */
static inline imp_model imp_powi(imp_model x, int n)
{
    if (n < -INT32_MAX) return imp_unbounded_(x.depends);
    imp_model r = n > 2 || n < -2 ? imp_powi_positive_(x, n < 0 ? -n : n)
                  : n == 0        ? imp_num(1)
                  : n % 2 == 0    ? imp_sqr(x)
                                  : x;
    return n < 0 ? imp_div(imp_num(1), r) : r;
}

/* --- Exponential and logarithm -------------------------------------------------------------- */

/* At least e^r, for a factor: below 5/4, e^r <= 1 + 2 r. */
static inline double imp_growth_upper_(double r)
{
    return r < 1.25 ? 1 + 2 * r : imp_libm_up(imp_exp_(r));
}

/* t_k = e^m / k!; the rest of the series is below e^(m+r) r^5 / 120. */
static inline imp_model imp_exp(imp_model x)
{
    if (imp_is_point_(&x)) {
        double y = imp_exp_(x.a);
        return imp_point_within_(&x, y, 1.001 * y, 0, INFINITY);
    }
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double y = imp_exp_(s.m);
    const double t[5] = {y, y, y / 2, y / 6, y / 24};
    double tail = y * imp_growth_upper_(s.r) * imp_power5_(s.r) / 120 * (1 + 0x1p-40);
    imp_series_set_(&s, 1, t, tail, 10, 11);
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_exp(imp_range_(&x));
    return imp_compose_(&x, &s, range, range.hi);
}

/* With z = y / m: log m + z - z^2 / 2 + ..., the rest below |z|^5 / (5 (1 - |z|)). */
static inline imp_model imp_log(imp_model x)
{
    double slope = x.lo > 0 ? imp_round_up(1 / x.lo) : INFINITY;
    if (imp_is_point_(&x) && x.lo > 0) return imp_point_(&x, log(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double z = s.m > 0 ? imp_round_up(s.r / s.m) : INFINITY;
    if (z < 1) {
        const double t[5] = {log(s.m), 1, -1. / 2, 1. / 3, -1. / 4};
        double tail = imp_power5_(z) / (5 * imp_sum_down(1 - z)) * (1 + 0x1p-40);
        imp_series_set_(&s, s.m, t, tail, 10, 1);
    }
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_log(imp_range_(&x));
    return imp_compose_(&x, &s, range, slope);
}

/* --- Real powers ---------------------------------------------------------------------------------
 */

/* Series of (m + y)^p, m > 0, in z = y / m: value sum C(p, k) z^k with value = m^p, within (L).
 * From k = 5 on a term is the one before times |p - k| / (k + 1) |z| <= g |z| with g = max(1, (|p|
 * + 5) / 6), so the rest is below |C(p, 5) z^5| / (1 - g |z|). Each C(p, k) is within 3 k u. */
static inline void imp_series_power_(imp_series_ *s, double p, double value)
{
    double z = s->m > 0 ? imp_round_up(s->r / s->m) : INFINITY;
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
    return imp_round_up(imp_interval_pow(x, p - 1).hi * fabs(p) * (1 + 0x1p-40));
}

/* x^p at a point: x differs from x.a by less than 2^-30 of it, so x^(p-1) by less than 1 in 100,
 * while |p| < 2^20. */
static inline imp_model imp_power_point_(const imp_model *x, double y, double p)
{
    return imp_point_within_(x, y, 1.01 * fabs(p * (y / x->a)), 0, INFINITY);
}

/* x^p for x > 0, or x >= 0 if p > 0; the part of x below 0 counts as 0. For whole p, as powi. */
static inline imp_model imp_pow(imp_model x, double p)
{
    if (fabs(p) < 1000 && p == floor(p)) return imp_powi(x, (int)p);
    imp_interval at = imp_range_(&x);
    if (!(x.hi >= 0) || !(p - p == 0)) return imp_unbounded_(x.depends);
    if (imp_is_point_(&x) && x.lo > 0 && fabs(p) < 0x1p20)
        return imp_power_point_(&x, imp_pow_(x.a, p), p);
    imp_series_ s = imp_series_at_(at);
    if (x.lo > 0) imp_series_power_(&s, p, imp_pow_(s.m, p));
    imp_interval range = imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_pow(at, p);
    return imp_compose_(&x, &s, range, imp_power_slope_upper_(at, p));
}

/* The square root. The part of x below 0, where rounding may have put it, counts as 0.
 * At 0 the rate is infinite. */
static inline imp_model imp_sqrt(imp_model x)
{
    if (!(x.hi >= 0)) return imp_unbounded_(x.depends);
    if (imp_is_exact_(&x) && x.a == 0) return x;
    if (imp_is_point_(&x) && x.lo > 0) return imp_power_point_(&x, sqrt(x.a), 0.5);
    imp_interval range = imp_interval_sqrt(imp_range_(&x));
    double slope = range.lo > 0 ? imp_round_up(0.5 / range.lo) : INFINITY;
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (x.lo > 0) imp_series_power_(&s, 0.5, sqrt(s.m));
    return imp_compose_(&x, &s, range, slope);
}

/* x^y for x > 0. */
static inline imp_model imp_pow_model(imp_model x, imp_model y)
{
    if (imp_is_exact_(&y)) return imp_pow(x, y.a);
    return imp_exp(imp_mul(y, imp_log(x)));
}

/* --- Circular functions ----------------------------------------------------------------------- */

/* A function with the value f and the derivative g at m, and -f as its second derivative, and so
 * on: f + g y - f y^2 / 2 - g y^3 / 6 + f y^4 / 24 within r^5 / 120. Its slope is at most |g| + |f|
 * r + r^2 / 2, and 1. */
static inline imp_model imp_wave_(const imp_model *x, imp_series_ s, double f, double g,
                                  imp_interval (*range)(imp_interval))
{
    const double t[5] = {f, g, -f / 2, -g / 6, f / 24};
    imp_series_set_(&s, 1, t, imp_power5_(s.r) / 120, 10, 11);
    imp_interval at = imp_series_is_sharp_(&s) ? imp_series_range_(&s) : range(imp_range_(x));
    double slope = (fabs(g) + fabs(f) * s.r) * (1 + 0x1p-40) + IMP_TINY;
    at = imp_interval_meet(at, imp_interval_make(-1, 1));
    return imp_compose_(x, &s, at, imp_smaller(slope, 1));
}

static inline imp_model imp_sin(imp_model x)
{
    if (imp_is_point_(&x)) return imp_point_within_(&x, sin(x.a), 1, -1, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    return imp_wave_(&x, s, sin(s.m), cos(s.m), imp_interval_sin);
}

static inline imp_model imp_cos(imp_model x)
{
    if (imp_is_point_(&x)) return imp_point_within_(&x, cos(x.a), 1, -1, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    return imp_wave_(&x, s, cos(s.m), -sin(s.m), imp_interval_cos);
}

/* Both, for less. */
static inline void imp_sincos(imp_model x, imp_model *sine, imp_model *cosine)
{
    if (imp_is_point_(&x)) {
        *sine = imp_point_within_(&x, sin(x.a), 1, -1, 1);
        *cosine = imp_point_within_(&x, cos(x.a), 1, -1, 1);
        return;
    }
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double f = sin(s.m), g = cos(s.m);
    *sine = imp_wave_(&x, s, f, g, imp_interval_sin);
    *cosine = imp_wave_(&x, s, g, -f, imp_interval_cos);
}

/* With T = tan m, D = 1 + T^2, the t_k are D, D T, D (1 + 3 T^2) / 3, D T (2 + 3 T^2) / 3, and the
 * next is D (2 + 15 T^2 + 15 T^4) / 15, which grows with |T|: Lagrange's bound at the end with
 * the larger |tan|. T is within (L), so T^2 within 21 u, and no t_k is off by more than 100 u. */
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

/* --- Inverse circular functions --------------------------------------------------------------- */

/* With w = 1 / (1 + m^2): t_1 = w, t_2 = -m w^2, t_3 = (3 m^2 - 1) w^3 / 3, t_4 = m (1 - m^2) w^4;
 * the next is at most w^(5/2) / 5 in magnitude, w being largest where |x| is least. t_3 and t_4
 * cancel near their zeros: there they are off by up to 20 u w^(3/2) and 20 u w^2, which the
 * tail takes. */
static inline imp_model imp_atan(imp_model x)
{
    double least = imp_interval_mig(imp_range_(&x));
    double slope = imp_round_up(1 / (1 + least * least)) * (1 + 0x1p-50);
    if (imp_is_point_(&x)) return imp_point_(&x, atan(x.a), slope);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double m = s.m, w = 1 / (1 + m * m), z = s.r * sqrt(slope), v = m * w;
    const double t[5] = {atan(m), w, -v * w, (3 * m * v - w) * w * w / 3, (w - m * v) * v * w * w};
    double tail = imp_power5_(z) / 5 + 20 * IMP_U * (z * z * z + z * z * z * z);
    imp_series_set_(&s, 1, t, tail * (1 + 0x1p-40), 10, 12);
    imp_interval range =
        imp_series_is_sharp_(&s) ? imp_series_range_(&s) : imp_interval_atan(imp_range_(&x));
    return imp_compose_(&x, &s, range, slope);
}

/* With w = 1 / (1 - m^2): the derivatives of asin are w^(1/2), m w^(3/2), (1 + 2 m^2) w^(5/2),
 * m (9 + 6 m^2) w^(7/2) and (9 + 72 m^2 + 24 m^4) w^(9/2); the last grows with |m| <= top.
 * 1 - m^2 is computed as (1 - m)(1 + m), within 3 u, so no t_k is off by more than 40 u. */
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
    double rest = imp_sum_down(1 - top) * (1 + top);
    return top < 1 ? 1 / sqrt(rest) * (1 + 0x1p-48) : INFINITY;
}

/* Nothing but points where the range is degenerate: at 1 and -1 exactly, and within. */
static inline int imp_asin_is_point_(const imp_model *x, double top)
{
    return imp_is_point_(x) && (top < 1 || (top == 1 && x->e == 0));
}

/* Beyond -1 and 1 rounding is to blame: those parts of x count as -1 and 1. There the rate is
 * infinite. */
static inline imp_model imp_asin(imp_model x)
{
    double top = imp_interval_mag(imp_range_(&x));
    double slope = x.e > 0 || x.depends ? imp_asin_slope_upper_(top) : 0;
    if (imp_asin_is_point_(&x, top))
        return imp_point_within_(&x, asin(x.a), slope, -IMP_PI_UPPER / 2, IMP_PI_UPPER / 2);
    imp_interval range = imp_interval_asin(imp_range_(&x));
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (top < 1) imp_series_asin_(&s, top);
    return imp_compose_(&x, &s, range, slope);
}

/* pi/2 - asin x. Rounding of pi/2, of asin m and of their difference: below 3 u, 8 u being asin's
 * (L) and already counted. */
static inline imp_model imp_acos(imp_model x)
{
    double top = imp_interval_mag(imp_range_(&x));
    double slope = x.e > 0 || x.depends ? imp_asin_slope_upper_(top) : 0;
    if (imp_asin_is_point_(&x, top))
        return imp_point_within_(&x, acos(x.a), slope, 0, IMP_PI_UPPER);
    imp_interval range = imp_interval_acos(imp_range_(&x));
    imp_series_ s = imp_series_at_(imp_range_(&x));
    if (top < 1) {
        imp_series_asin_(&s, top);
        s.c[0] = IMP_PI_LOWER / 2 - s.c[0];
        for (int k = 1; k < 4; k++) s.c[k] = -s.c[k];
        s.e += 8 * IMP_U;
    }
    return imp_compose_(&x, &s, range, slope);
}

/* --- Hyperbolic functions --------------------------------------------------------------------- */

/* sinh and cosh are their own second derivatives; cosh at the far end bounds the fifth. At a point,
 * within 2^-30 |x| < 10^-6 of the exact x, slopes differ by less than 1 in 1000. */
static inline imp_model imp_sinh(imp_model x)
{
    if (imp_is_point_(&x)) {
        double y = imp_sinh_(x.a);
        return imp_point_(&x, y, 1.001 * (fabs(y) + 1));
    }
    double slope = imp_interval_cosh(imp_range_(&x)).hi;
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double f = imp_sinh_(s.m), g = imp_cosh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_set_(&s, 1, t, slope * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose_(&x, &s, imp_interval_sinh(imp_range_(&x)), slope);
}

static inline imp_model imp_cosh(imp_model x)
{
    if (imp_is_point_(&x)) {
        double y = imp_cosh_(x.a);
        return imp_point_within_(&x, y, 1.001 * y, 1, INFINITY);
    }
    double slope = imp_interval_mag(imp_interval_sinh(imp_range_(&x)));
    imp_interval range = imp_interval_cosh(imp_range_(&x));
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double f = imp_cosh_(s.m), g = imp_sinh_(s.m);
    const double t[5] = {f, g, f / 2, g / 6, f / 24};
    imp_series_set_(&s, 1, t, range.hi * imp_power5_(s.r) / 120, 10, 11);
    return imp_compose_(&x, &s, range, slope);
}

/* With T = tanh m, D = 1 - T^2: t_k = D, -D T, D (3 T^2 - 1) / 3, D T (2 - 3 T^2) / 3, the next at
 * most 2 D / 15. T is within 10 u, so D within 24 u, absolutely, and the rest within 60 u. */
static inline imp_model imp_tanh(imp_model x)
{
    if (imp_is_point_(&x)) return imp_point_within_(&x, tanh(x.a), 1, -1, 1);
    imp_interval range = imp_interval_tanh(imp_range_(&x));
    double least = imp_interval_mig(range);
    double slope = imp_smaller((1 - least) * (1 + least) * (1 + 0x1p-50) + IMP_TINY, 1);
    imp_series_ s = imp_series_at_(imp_range_(&x));
    double y = tanh(s.m), yy = y * y, d = (1 - y) * (1 + y), r = s.r;
    const double t[5] = {y, d, -d * y, d * (3 * yy - 1) / 3, d * y * (2 - 3 * yy) / 3};
    double tail = slope * imp_power5_(r) * 2 / 15 + 60 * IMP_U * (r + r * r) * (1 + r * r);
    imp_series_set_(&s, 1, t, tail * (1 + 0x1p-40), 10, 1);
    return imp_compose_(&x, &s, range, slope);
}

/* --- Kinks -------------------------------------------------------------------------------------
 */

/* |x|. Of one sign: x or -x. Else, with R = max |x|, on [-R, R]: z^2 / R <= |z| <= z^2 / R + R / 4;
 * or, when one side is short, |z| is z or -z within twice that side. */
static inline imp_model imp_abs(imp_model x)
{
    if (x.lo >= 0) return x;
    if (x.hi <= 0) return imp_neg(x);
    imp_interval range = imp_interval_abs(imp_range_(&x));
    imp_series_ s = {0, range.hi, {0, 0, 0, 0}, INFINITY};
    double side = imp_smaller(-x.lo, x.hi);
    if (range.hi < INFINITY && side < range.hi / 8) {
        s.c[0] = side;
        s.c[1] = x.hi > -x.lo ? 1 : -1;
        s.e = side;
    } else if (range.hi < INFINITY) {
        s.c[0] = range.hi / 8;
        s.c[2] = 1 / range.hi;
        s.e = range.hi / 8 * (1 + 0x1p-49) + IMP_TINY;
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

/* --- The angle of a point ----------------------------------------------------------------------
 */

/* All angles, at any rate: where (x, y) may cross the cut or be the origin. */
static inline imp_model imp_any_angle_(uint32_t depends)
{
    imp_model r = imp_unbounded_(depends);
    r.lo = -IMP_PI_UPPER;
    r.hi = IMP_PI_UPPER;
    return imp_collapse_(r);
}

/* The angle of (x, y) in [-pi, pi], as C's atan2(y, x), with y = 0 counting as +0. A region that
 * crosses the cut, y = 0 with x <= 0, or holds the origin has the whole range and no rates.
 * Elsewhere it is the arc tangent of y / x or of x / y, whichever has its divisor farther from 0.
 */
static inline imp_model imp_atan2(imp_model y, imp_model x)
{
    double x_least = imp_interval_mig(imp_range_(&x)), y_least = imp_interval_mig(imp_range_(&y));
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

#endif /* IMPINGE_MODEL_FUNCTIONS_H */
