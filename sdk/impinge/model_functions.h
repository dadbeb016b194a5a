/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_FUNCTIONS_H
#define IMPINGE_MODEL_FUNCTIONS_H

#include <impinge/model_series.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Polynomials and quotients
 * =========================
 *
 * In each lemma, x is the argument, m + y with |y| <= r over its range; t_k are Taylor coefficients
 * at m. slope is an upper bound of |g'| over the range of x; the rates follow from it. */

/* --- Polynomials ------------------------------------------------------------------------------ */

/* x^2 = m^2 + 2 m y + y^2, exactly but for the rounding of m^2. */
static inline imp_model imp_sqr(imp_model x)
{
    imp_interval range = imp_model_range(&x);
    if (imp_is_point(&x)) {
        imp_model p = imp_mul_point_(&x, &x);
        p.lo = imp_larger(p.lo, 0);
        return p;
    }
    imp_series s = imp_series_around(range);
    s.c[0] = s.m * s.m;
    s.c[1] = 2 * s.m;
    s.c[2] = 1;
    s.e = s.r < INFINITY ? IMP_U * s.c[0] + IMP_TINY : INFINITY;
    return imp_compose(&x, &s, imp_interval_sqr(range), 2 * imp_interval_mag(range));
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
    return imp_known(y, (rounding + sizes.slope * t->e) * IMP_SLACK);
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

#define IMP_POLY_MAX 24 /* coefficients; longer ones use Horner's rule */

/* Taylor coefficients w_k of the polynomial at m, by repeated division; the answer bounds |P'|.
 * A term of w_k passes at most 2 n roundings, so the errors of all w_k r^k together are
 * below 2 n u times the polynomial of magnitudes at |m| + r; likewise for P'. */
static inline double imp_series_poly_(imp_series *s, const double *coef, size_t n)
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
    imp_series_taylor(s, 1, t, (tail + unit * sizes.value) * IMP_SLACK, 0, 0);
    return (slope + unit * sizes.slope) * IMP_SLACK;
}

/* sum_k coef[k] t^k; n coefficients, lowest first. */
static inline imp_model imp_poly(const double *coef, size_t n, imp_model t)
{
    if (n < 2) return imp_num(n > 0 ? coef[0] : 0);
    if (n == 2) return imp_shift(imp_scale(t, coef[1]), coef[0]);
    if (imp_is_point(&t)) return imp_poly_point_(coef, n, &t);
    if (n > IMP_POLY_MAX) return imp_poly_horner_(coef, n, t);
    imp_series s = imp_series_around(imp_model_range(&t));
    double slope = imp_series_poly_(&s, coef, n);
    imp_interval range = imp_series_range_(&s);
    if (!imp_series_is_sharp_(&s))
        range = imp_interval_intersect(range, imp_poly_interval_(coef, n, imp_model_range(&t)));
    return imp_compose(&t, &s, range, slope);
}

/* x^n, n >= 3, m of any sign. t_k = C(n, k) m^(n-k); the rest after the fourth is below C(n, 5)
 * (|m| + r)^(n-5) r^5 (Lagrange). The powers of m are one call of libm and at most four products,
 * the binomials are within 4 u: (L) + 8 u. Should a power underflow, by less than 2^-1070, then t_k
 * y^k is off by at most c4 (1 + r^2)^2 times that. */
static inline void imp_series_powi_(imp_series *s, int n)
{
    double power = n > 4 ? imp_libm_pow(s->m, n - 4) : 1, tail = 0, t[5] = {0, 0, 0, 0, 0};
    double c2 = (double)n * (n - 1.) / 2, c3 = c2 * (n - 2.) / 3, c4 = c3 * (n - 3.) / 4;
    const double binomial[5] = {1, (double)n, c2, c3, c4};
    for (int k = n < 4 ? n : 4; k >= 0; k--) {
        t[k] = binomial[k] * power;
        power *= s->m;
    }
    if (n > 4) {
        double far = imp_libm_up(imp_libm_pow(imp_sum_up(fabs(s->m) + s->r), n - 5));
        tail = c4 * (n - 4.) / 5 * far * imp_power5_(s->r) * (1 + 0x1p-40);
        tail += IMP_TINY * c4 * (1 + s->r * s->r) * (1 + s->r * s->r);
    }
    imp_series_taylor(s, 1, t, tail, 18, 20);
}

/* x^n at a point: |x| differs from |x.a| by less than 2^-30 of it, so x^(n-1) by less than 1 in
 * 100, while n < 2^20. */
static inline imp_model imp_powi_point_(const imp_model *x, int n)
{
    double y = imp_libm_pow(x->a, n);
    return x->a == 0 ? *x : imp_point_(x, y, 1.01 * n * fabs(y / x->a));
}

/* n >= 3. */
static inline imp_model imp_powi_positive_(imp_model x, int n)
{
    imp_interval range = imp_model_range(&x);
    if (imp_is_point(&x) && n < 1 << 20) return imp_powi_point_(&x, n);
    double top = imp_interval_pow(imp_interval_abs(range), n - 1).hi;
    imp_series s = imp_series_around(range);
    imp_series_powi_(&s, n);
    return imp_compose(&x, &s, imp_interval_powi(range, n), imp_round_up(top * n));
}

/* --- Quotients -------------------------------------------------------------------------------- */

/* x / y at a point: |x / y - a / a'| <= (e + |a / a'| e') / min |y|. A product that underflows is
 * within IMP_TINY, which `least` may enlarge. */
static inline imp_model imp_div_point_(const imp_model *x, const imp_model *y)
{
    double a = x->a / y->a, least = imp_interval_mig(imp_model_range(y));
    double inherited = (x->e + (imp_round_up(fabs(a)) * y->e + IMP_TINY)) / least;
    return imp_known(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

/* The terms up to degree 2 of the power series of (quadratic of x) / (quadratic of y): an
 * approximation without a bound. */
static inline imp_model imp_quotient_guess_(const imp_model *x, const imp_model *y, double inverse)
{
    imp_model z = imp_model_zero();
    double zz[6];
    z.a = x->a * inverse;
    for (int j = 0; j < 3; j++) z.b[j] = (x->b[j] - z.a * y->b[j]) * inverse;
    imp_square_terms_(z.b, y->b, zz);
    for (int k = 0; k < 6; k++) z.q[k] = (x->q[k] - z.a * y->q[k] - zz[k]) * inverse;
    z.hi = imp_model_size(&z) * IMP_SLACK;
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
    double rho = imp_model_size(&w), size = fabs(y->a) + swing;
    double rounding = 8 * rho + imp_model_size(r) * size;
    double rest = w.e + x->e + swing * (rho * fabs(inverse));
    double residual = rest + (IMP_U * rounding + IMP_TINY * (1 + size));
    r->e = (residual / least + IMP_TINY) * IMP_SLACK;
}

/* x / k where k is exact: each of the ten quotients is rounded once. */
static inline imp_model imp_div_exact_(imp_model x, double k)
{
    imp_interval at = imp_interval_div(imp_model_range(&x), imp_interval_make(k, k));
    x.a /= k;
    x.lo = at.lo;
    x.hi = at.hi;
    for (int j = 0; j < 3; j++) {
        x.b[j] /= k;
        x.rate[j] = imp_round_up(x.rate[j] / fabs(k));
    }
    for (int j = 0; j < 6; j++) x.q[j] /= k;
    x.e = (x.e / fabs(k) + (IMP_U * imp_model_size(&x) + IMP_TINY)) * IMP_SLACK;
    imp_finish_(&x);
    return x;
}

/* The rate of a quotient: (|x'| + |x / y| |y'|) / |y|, underflow as at a point. */
static inline imp_model imp_div(imp_model x, imp_model y)
{
    double least = imp_interval_mig(imp_model_range(&y));
    if (imp_is_exact(&x) && x.a == 0 && least > 0) return x;
    if (imp_is_point(&x) && imp_is_point(&y) && least > 0) return imp_div_point_(&x, &y);
    if (imp_is_exact(&y) && least > 0) return imp_div_exact_(x, y.a);
    imp_model r;
    imp_interval range = imp_interval_div(imp_model_range(&x), imp_model_range(&y));
    imp_quotient_(&x, &y, least, &r);
    for (int j = 0; j < 3; j++) {
        double change = x.rate[j] + (imp_interval_mag(range) * y.rate[j] + IMP_TINY);
        r.rate[j] = (change / least + IMP_TINY) * IMP_SLACK;
    }
    r.lo = range.lo;
    r.hi = range.hi;
    r.depends = x.depends | y.depends;
    r.reserved = 0;
    imp_finish_(&r);
    return r;
}

/* x^n for any whole n > -2^31; x != 0 if n < 0. */
static inline imp_model imp_powi(imp_model x, int n)
{
    if (n < -INT32_MAX) return imp_unbounded(x.depends);
    imp_model r = n > 2 || n < -2 ? imp_powi_positive_(x, n < 0 ? -n : n)
                  : n == 0        ? imp_num(1)
                  : n % 2 == 0    ? imp_sqr(x)
                                  : x;
    return n < 0 ? imp_div(imp_num(1), r) : r;
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_FUNCTIONS_H */
