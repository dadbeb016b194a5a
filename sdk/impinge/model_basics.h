/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_BASICS_H
#define IMPINGE_MODEL_BASICS_H

#include <impinge/interval.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Constants, parameters, ranges
 * =============================
 *
 * Notation in the lemmas, beside that of <impinge/interval.h>: x = P + delta, P the quadratic of
 * x, |delta| <= e. P = a + L + Q, L linear, Q the quadratic terms; B = sum |b_j|, so |L| <= B;
 * |Q| <= sum |q_jk|, written Q too where a number is meant. x' belongs to a second operand.
 *
 * Errors are collected: an operation adds up bounds of its rounding and truncation errors, as
 * computed numbers >= 0, and adds the sum to e. Fewer than 100 roundings go into the computing of
 * any such bound, each changing it by a factor >= 1 - u, so the computed bound times IMP_SLACK = 1
 * + 128 u is at least the exact one. Contracting a product and a sum into one operation (fma) only
 * removes roundings.
 *
 * A name that ends in an underscore is internal. */

#define IMP_U 0x1p-53
#define IMP_SLACK (1 + 0x1p-46)

/* --- Constants and parameters ----------------------------------------------------------------- */

static inline imp_model imp_model_zero(void)
{
    imp_model r = {0, {0, 0, 0}, {0, 0, 0, 0, 0, 0}, 0, 0, 0, {0, 0, 0}, 0, 0};
    return r;
}

/* Nothing is known except the parameters that it may depend on. */
static inline imp_model imp_unbounded(uint32_t depends)
{
    imp_model r = imp_model_zero();
    r.e = INFINITY;
    r.lo = -INFINITY;
    r.hi = INFINITY;
    for (int j = 0; j < 3; j++) r.rate[j] = depends >> j & 1 ? INFINITY : 0;
    r.depends = depends;
    return r;
}

/* The number k, exactly. */
static inline imp_model imp_num(double k)
{
    if (!(k - k == 0)) return imp_unbounded(0);
    imp_model r = imp_model_zero();
    r.a = r.lo = r.hi = k;
    return r;
}

/* A number within e of a; e covers the rounding of a, so that an overflow of a makes e infinite or
 * NaN, and the number unbounded. */
static inline imp_model imp_known(double a, double e)
{
    if (!(e < INFINITY)) return imp_unbounded(0);
    imp_model r = imp_model_zero();
    r.a = a;
    r.e = e;
    r.lo = imp_sum_down(a - e);
    r.hi = imp_sum_up(a + e);
    return r;
}

static inline void imp_collapse_(imp_model *x)
{
    imp_interval range = imp_interval_make(x->lo, x->hi);
    if (!(x->lo <= x->hi)) {
        *x = imp_unbounded(x->depends);
        return;
    }
    int finite = imp_interval_is_finite(range);
    x->a = finite ? imp_interval_mid(range) : 0;
    x->e = finite ? imp_interval_radius_upper(range, x->a) : INFINITY;
    for (int j = 0; j < 3; j++) x->b[j] = 0;
    for (int j = 0; j < 6; j++) x->q[j] = 0;
}

/* The quadratic becomes the middle of the range: the last resort, and often a good one.
 * An empty range means that the formula was undefined. */
static inline imp_model imp_model_collapse(imp_model x)
{
    imp_collapse_(&x);
    return x;
}

/* A number of which only lo <= it <= hi is known. */
static inline imp_model imp_between(double lo, double hi)
{
    imp_model r = imp_model_zero();
    if (!(lo <= hi)) return imp_unbounded(0);
    r.lo = lo;
    r.hi = hi;
    return imp_model_collapse(r);
}

/* The parameter u (j = 0), v (1) or t (2): c + d s exactly, by definition of s. */
static inline imp_model imp_param(const imp_region *region, int j)
{
    imp_model r = imp_model_zero();
    r.a = region->c[j];
    r.b[j] = region->d[j];
    r.lo = region->lo[j];
    r.hi = region->hi[j];
    r.rate[j] = 1;
    r.depends = 1u << j;
    return r;
}

/* pi = IMP_PI_LOWER + 1.2246...e-16. */
static inline imp_model imp_const_pi(void)
{
    imp_model r = imp_num(IMP_PI_LOWER);
    r.e = 0x1.1a62633145c07p-53;
    r.hi = IMP_PI_UPPER;
    return r;
}

/* --- Queries and finishing -------------------------------------------------------------------- */

static inline imp_interval imp_model_range(const imp_model *x)
{
    imp_interval r;
    r.lo = x->lo;
    r.hi = x->hi;
    return r;
}

static inline double imp_sum_abs3_(const double b[3])
{
    return fabs(b[0]) + fabs(b[1]) + fabs(b[2]);
}

static inline double imp_sum_abs6_(const double q[6])
{
    return (fabs(q[0]) + fabs(q[1])) + (fabs(q[2]) + fabs(q[3])) + (fabs(q[4]) + fabs(q[5]));
}

/* |a| + sum |b_j| + sum |q_jk|: a bound of the quadratic, apart from rounding. */
static inline double imp_model_size(const imp_model *x)
{
    return fabs(x->a) + imp_sum_abs3_(x->b) + imp_sum_abs6_(x->q);
}

/* A constant known to fewer than 30 bits, for which interval arithmetic is better. */
static inline int imp_is_wide_(const imp_model *x) { return x->e > fabs(x->a) * 0x1p-30; }

/* A constant worth evaluating at its middle, which is one of the values it may have. */
static inline int imp_is_point(const imp_model *x)
{
    return !x->depends && !imp_is_wide_(x) && x->lo <= x->a && x->a <= x->hi;
}

static inline int imp_is_exact(const imp_model *x) { return !x->depends && x->e == 0; }

/* Bounds of b s + q s^2 over [-1, 1]. Lemma: the extremes are q +- b at the ends, 0 at s = 0 and,
 * if |b| < 2 |q|, the vertex -b^2 / 4q, which is nearer to 0 than |b| / 2 is. */
static inline double imp_bow_lower_(double b, double q)
{
    return imp_smaller(q - fabs(b), -0.5 * fabs(b));
}

static inline double imp_bow_upper_(double b, double q)
{
    return imp_larger(q + fabs(b), 0.5 * fabs(b));
}

/* Range of quadratic and remainder together, parameter by parameter. Lemma: the two sums have
 * 16 roundings at most, each of a partial sum that N = |a| + B + Q + e bounds; 2^-48 N =
 * 32 u N covers them and the computing of N. An infinite or NaN coefficient opens the range. */
static inline imp_interval imp_model_poly_range(const imp_model *x)
{
    double cross = fabs(x->q[IMP_UV]) + fabs(x->q[IMP_UT]) + fabs(x->q[IMP_VT]) + x->e;
    double lo = imp_bow_lower_(x->b[0], x->q[IMP_UU]) + imp_bow_lower_(x->b[1], x->q[IMP_VV]) +
                imp_bow_lower_(x->b[2], x->q[IMP_TT]) - cross;
    double hi = imp_bow_upper_(x->b[0], x->q[IMP_UU]) + imp_bow_upper_(x->b[1], x->q[IMP_VV]) +
                imp_bow_upper_(x->b[2], x->q[IMP_TT]) + cross;
    double pad = 0x1p-48 * (imp_model_size(x) + x->e);
    return imp_interval_make(x->a + lo - pad, x->a + hi + pad);
}

/* The rate by a parameter that g does not depend on is 0; a rate that could not be computed is
 * infinite. */
static inline void imp_tidy_rates_(imp_model *x)
{
    for (int j = 0; j < 3; j++) {
        double rate = x->rate[j] < INFINITY ? x->rate[j] : INFINITY;
        x->rate[j] = x->depends >> j & 1 ? rate : 0;
    }
}

/* Last step of every operation, and of a model made by hand: a, b, q, e, lo, hi, rate and depends
 * are set, each part sound by itself (a NaN says nothing). Range and quadratic clip each other;
 * when e exceeds half the range the quadratic tells nothing that the range does not, and goes, as
 * it does when a coefficient overflowed. */
static inline void imp_finish_(imp_model *x)
{
    imp_interval poly = imp_model_poly_range(x);
    x->lo = imp_larger(x->lo, poly.lo);
    x->hi = imp_smaller(x->hi, poly.hi);
    imp_tidy_rates_(x);
    if (!(x->e <= 0.5 * (x->hi - x->lo) && poly.hi - poly.lo < INFINITY)) imp_collapse_(x);
}

static inline imp_model imp_model_finish(imp_model x)
{
    imp_finish_(&x);
    return x;
}

/* Finishes a model whose function is known to lie in the range, too. */
static inline imp_model imp_model_within(imp_model g, imp_interval range)
{
    g.lo = imp_larger(g.lo, range.lo);
    g.hi = imp_smaller(g.hi, range.hi);
    imp_finish_(&g);
    return g;
}

/* The model that a value and rates alone give: g = a within a_error at the centre of the region
 * with half-widths d, and |dg/dp_j| <= rate[j] all over it. */
static inline imp_model imp_model_box(double a, double a_error, const double rate[3],
                                      const double d[3])
{
    imp_model r = imp_model_zero();
    r.a = a;
    r.e = ((rate[0] * d[0] + rate[1] * d[1] + rate[2] * d[2]) + a_error + IMP_TINY) * IMP_SLACK;
    r.lo = imp_sum_down(a - r.e);
    r.hi = imp_sum_up(a + r.e);
    for (int j = 0; j < 3; j++) {
        r.rate[j] = rate[j];
        r.depends |= rate[j] != 0 ? 1u << j : 0;
    }
    if (!(r.e < INFINITY)) imp_finish_(&r);
    return r;
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_BASICS_H */
