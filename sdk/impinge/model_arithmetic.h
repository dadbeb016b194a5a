/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_MODEL_ARITHMETIC_H
#define IMPINGE_MODEL_ARITHMETIC_H

#include <impinge/model_basics.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sums and products
 * =================
 *
 * The notation of the lemmas is that of <impinge/model_basics.h>. */

/* --- Sums ------------------------------------------------------------------------------------- */

static inline imp_model imp_neg(imp_model x)
{
    double lo = x.lo;
    x.a = -x.a;
    x.lo = -x.hi;
    x.hi = -lo;
    for (int j = 0; j < 3; j++) x.b[j] = -x.b[j];
    for (int j = 0; j < 6; j++) x.q[j] = -x.q[j];
    return x;
}

/* Each of the ten sums is rounded once, by u times its own magnitude. */
static inline imp_model imp_add_(const imp_model *x, const imp_model *y)
{
    imp_model r;
    r.a = x->a + y->a;
    for (int j = 0; j < 3; j++) {
        r.b[j] = x->b[j] + y->b[j];
        r.rate[j] = imp_sum_up(x->rate[j] + y->rate[j]);
    }
    for (int j = 0; j < 6; j++) r.q[j] = x->q[j] + y->q[j];
    r.e = (x->e + y->e + (IMP_U * imp_model_size(&r) + IMP_TINY)) * IMP_SLACK;
    r.lo = imp_sum_down(x->lo + y->lo);
    r.hi = imp_sum_up(x->hi + y->hi);
    r.depends = x->depends | y->depends;
    r.reserved = 0;
    imp_finish_(&r);
    return r;
}

static inline imp_model imp_add_point_(double a, double x_error, double y_error)
{
    return imp_known(a, (x_error + y_error + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

/* The last step without the rates, where x was finished before and quadratic and range moved alike:
 * they need not clip each other again. */
static inline void imp_finish_again_(imp_model *x)
{
    if (!(x->e <= 0.5 * (x->hi - x->lo) && x->hi - x->lo < INFINITY)) imp_finish_(x);
}

/* x + k where k is exact: rounds the middle only. */
static inline imp_model imp_shift(imp_model x, double k)
{
    if (k == 0) return x;
    if (imp_is_exact(&x) && x.a == 0) return imp_num(k);
    double a = x.a + k;
    if (imp_is_point(&x)) return imp_add_point_(a, x.e, 0);
    x.e = (x.e + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK;
    x.a = a;
    x.lo = imp_sum_down(x.lo + k);
    x.hi = imp_sum_up(x.hi + k);
    imp_finish_again_(&x);
    return x;
}

static inline imp_model imp_add(imp_model x, imp_model y)
{
    if (imp_is_exact(&y)) return imp_shift(x, y.a);
    if (imp_is_exact(&x)) return imp_shift(y, x.a);
    if (imp_is_point(&x) && imp_is_point(&y)) return imp_add_point_(x.a + y.a, x.e, y.e);
    return imp_add_(&x, &y);
}

static inline imp_model imp_sub(imp_model x, imp_model y) { return imp_add(x, imp_neg(y)); }

/* --- Products --------------------------------------------------------------------------------- */

/* x k at a point. */
static inline imp_model imp_scale_point_(double a, double k, double error)
{
    return imp_known(a * k, (error * fabs(k) + (IMP_U * fabs(a * k) + IMP_TINY)) * IMP_SLACK);
}

/* x k where k is exact: each of the ten products is rounded once, by u times its own magnitude. */
static inline imp_model imp_scale(imp_model x, double k)
{
    if (k == 0) return imp_num(0);
    if (k == 1 || k == -1) return k > 0 ? x : imp_neg(x);
    if (!(k - k == 0)) return imp_unbounded(x.depends);
    if (imp_is_point(&x)) return imp_scale_point_(x.a, k, x.e);
    imp_interval range = imp_interval_scale(imp_model_range(&x), k);
    x.a *= k;
    x.lo = range.lo;
    x.hi = range.hi;
    for (int j = 0; j < 3; j++) {
        x.b[j] *= k;
        x.rate[j] = imp_round_up(x.rate[j] * fabs(k));
    }
    for (int j = 0; j < 6; j++) x.q[j] *= k;
    x.e = (x.e * fabs(k) + (IMP_U * imp_model_size(&x) + IMP_TINY)) * IMP_SLACK;
    imp_tidy_rates_(&x);
    imp_finish_again_(&x);
    return x;
}

/* Adds the ten coefficients of L W to c; w: coefficients of the quadratic form W. */
static inline void imp_cubic_add_(const double b[3], const double w[6], double c[10])
{
    c[0] += b[0] * w[IMP_UU];
    c[1] += b[1] * w[IMP_VV];
    c[2] += b[2] * w[IMP_TT];
    c[3] += b[0] * w[IMP_UV] + b[1] * w[IMP_UU];
    c[4] += b[0] * w[IMP_UT] + b[2] * w[IMP_UU];
    c[5] += b[1] * w[IMP_UV] + b[0] * w[IMP_VV];
    c[6] += b[1] * w[IMP_VT] + b[2] * w[IMP_VV];
    c[7] += b[2] * w[IMP_UT] + b[0] * w[IMP_TT];
    c[8] += b[2] * w[IMP_VT] + b[1] * w[IMP_TT];
    c[9] += (b[0] * w[IMP_VT] + b[1] * w[IMP_UT]) + b[2] * w[IMP_UV];
}

/* Cubic terms go to the nearest polynomial of lower degree: on [-1, 1],
 *
 *   s^3       = 3/4 s   +- 1/4   (Chebyshev's T_3 = 4 s^3 - 3 s)
 *   s^2 s'    = 1/2 s'  +- 1/2
 *   s s' s''  = 0       +- 1
 *
 * linear[j] receives the coefficients of s_j, the answer is the bound of the rest. Order of c:
 * uuu vvv ttt uuv uut uvv vvt utt vtt uvt. */
static inline double imp_cubic_fold_(const double c[10], double linear[3])
{
    linear[0] = 0.75 * c[0] + 0.5 * (c[5] + c[7]);
    linear[1] = 0.75 * c[1] + 0.5 * (c[3] + c[8]);
    linear[2] = 0.75 * c[2] + 0.5 * (c[4] + c[6]);
    return 0.25 * (fabs(c[0]) + fabs(c[1]) + fabs(c[2])) + 0.5 * imp_sum_abs6_(c + 3) + fabs(c[9]);
}

/* The products b_j b'_k, as coefficients of s_j s_k. */
static inline void imp_square_terms_(const double b[3], const double bb[3], double q[6])
{
    q[IMP_UU] = b[0] * bb[0];
    q[IMP_UV] = b[0] * bb[1] + b[1] * bb[0];
    q[IMP_UT] = b[0] * bb[2] + b[2] * bb[0];
    q[IMP_VV] = b[1] * bb[1];
    q[IMP_VT] = b[1] * bb[2] + b[2] * bb[1];
    q[IMP_TT] = b[2] * bb[2];
}

/* Half the sum of the squares' coefficients: the middle of their values. */
static inline double imp_middle_(const double q[6])
{
    return 0.5 * (q[IMP_UU] + q[IMP_VV] + q[IMP_TT]);
}

/* At least |Q(s) - middle| where `size` is sum |q_jk|: a square's coefficient weighs half. The
 * rounding of `middle` and of the sums is below 9 u size. */
static inline double imp_swing_upper_(const double q[6], double size)
{
    double squares = fabs(q[IMP_UU]) + fabs(q[IMP_VV]) + fabs(q[IMP_TT]);
    return (size - 0.5 * squares) + 16 * IMP_U * size;
}

/* Adds to r the quadratic of x y, to `cubic` its cubic terms and to `rounding` the bound of their
 * rounding, in units of u: `units` N N' and some; the answer bounds the rest. See imp_products_.
 */
static inline double imp_product_add_(const imp_model *x, const imp_model *y, imp_model *r,
                                      double cubic[10], double units, double *rounding)
{
    double bb[6], hx = imp_middle_(x->q), hy = imp_middle_(y->q);
    double ax = x->a + hx, ay = y->a + hy;
    double bx = imp_sum_abs3_(x->b), by = imp_sum_abs3_(y->b);
    double qx = imp_sum_abs6_(x->q), qy = imp_sum_abs6_(y->q);
    imp_cubic_add_(x->b, y->q, cubic);
    imp_cubic_add_(y->b, x->q, cubic);
    imp_square_terms_(x->b, y->b, bb);
    r->a += x->a * y->a - hx * hy;
    for (int j = 0; j < 3; j++) r->b[j] += x->a * y->b[j] + y->a * x->b[j];
    for (int k = 0; k < 6; k++) r->q[k] += (ax * y->q[k] + ay * x->q[k]) + bb[k];
    double x_mag = imp_interval_mag(imp_model_range(x)),
           y_mag = imp_interval_mag(imp_model_range(y));
    double inherited = x->e * y_mag + y->e * (x_mag + x->e);
    double nx = fabs(x->a) + bx + qx, ny = fabs(y->a) + by + qy;
    *rounding += units * nx * ny - 2 * fabs(x->a * y->a) + (bx + qx) * (by + qy);
    return imp_swing_upper_(x->q, qx) * imp_swing_upper_(y->q, qy) + inherited;
}

/* Quadratic and remainder of x[0] y[0] + ... + x[n-1] y[n-1], n <= 3. With h = middle(Q), D = Q -
 * h, |D| <= swing, each product is
 *
 *   P P' = (a a' - h h') + (a L' + a' L) + ((a + h) Q' + (a' + h') Q + L L')
 *          + (L Q' + L' Q)   cubic: those of all products are folded as one, since they may cancel
 *          + D D'            at most swing swing'
 *   x y - P P' = delta y + delta' P,  |P| <= |x| + e
 *
 * Rounding. Let N = |a| + B + Q, and the same for x'. Every coefficient is a sum of products of
 * two. Roundings that a product passes through where n = 1: a a' 2; a b' 3; (a + h) q' 4; b b' 3;
 * h h' 2; a cubic one at most 5 on its way to b with weight 3/4, or 6 with weight 1/2, and at most
 * 4 on its way to the remainder, with the weight left: together below 5. As |h| <= Q / 2, the terms
 * in h amount to (4 + 2/4) Q Q'. So 4 N N' - 2 |a a'| + (B + Q)(B' + Q') units of u cover all. Each
 * further product adds one sum to every coefficient and two to the cubic ones: at most 4 N N' more
 * of each. */
static inline void imp_products_(const imp_model *x, const imp_model *y, int n, imp_model *r)
{
    double linear[3], cubic[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, rest = 0, rounding = 0;
    r->a = 0;
    for (int j = 0; j < 3; j++) r->b[j] = 0;
    for (int k = 0; k < 6; k++) r->q[k] = 0;
    for (int i = 0; i < n; i++)
        rest += imp_product_add_(&x[i], &y[i], r, cubic, n > 1 ? 8 : 4, &rounding);
    rest += imp_cubic_fold_(cubic, linear);
    for (int j = 0; j < 3; j++) r->b[j] += linear[j];
    r->e = (rest + (IMP_U * rounding + IMP_TINY)) * IMP_SLACK;
}

static inline void imp_product_(const imp_model *x, const imp_model *y, imp_model *r)
{
    imp_products_(x, y, 1, r);
}

/* (x y)' = x' y + x y'; two products and a sum. */
static inline void imp_product_rates_(const imp_model *x, const imp_model *y, imp_model *r)
{
    double x_mag = imp_interval_mag(imp_model_range(x)),
           y_mag = imp_interval_mag(imp_model_range(y));
    for (int j = 0; j < 3; j++)
        r->rate[j] = (x_mag * y->rate[j] + y_mag * x->rate[j] + IMP_TINY) * IMP_SLACK;
}

static inline imp_model imp_mul_(const imp_model *x, const imp_model *y)
{
    imp_model r;
    imp_interval range = imp_interval_mul(imp_model_range(x), imp_model_range(y));
    imp_product_(x, y, &r);
    imp_product_rates_(x, y, &r);
    r.lo = range.lo;
    r.hi = range.hi;
    r.depends = x->depends | y->depends;
    r.reserved = 0;
    imp_finish_(&r);
    return r;
}

/* (a + delta)(a' + delta') - a a' = delta a' + delta' (a + delta). */
static inline imp_model imp_mul_point_(const imp_model *x, const imp_model *y)
{
    double a = x->a * y->a;
    double inherited = x->e * fabs(y->a) + y->e * (fabs(x->a) + x->e);
    return imp_known(a, (inherited + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK);
}

static inline imp_model imp_mul(imp_model x, imp_model y)
{
    if (imp_is_exact(&y)) return imp_scale(x, y.a);
    if (imp_is_exact(&x)) return imp_scale(y, x.a);
    if (imp_is_point(&x) && imp_is_point(&y)) return imp_mul_point_(&x, &y);
    return imp_mul_(&x, &y);
}

/* x + t (y - x). */
static inline imp_model imp_lerp(imp_model x, imp_model y, imp_model t)
{
    return imp_add(x, imp_mul(t, imp_sub(y, x)));
}

/* At most three products at once. */
static inline imp_model imp_dot_(const imp_model *x, const imp_model *y, int n)
{
    imp_model r = imp_model_zero(), one;
    imp_products_(x, y, n, &r);
    for (int i = 0; i < n; i++) {
        imp_interval range = imp_interval_mul(imp_model_range(&x[i]), imp_model_range(&y[i]));
        imp_product_rates_(&x[i], &y[i], &one);
        for (int j = 0; j < 3; j++) r.rate[j] = imp_sum_up(r.rate[j] + one.rate[j]);
        r.lo = imp_sum_down(r.lo + range.lo);
        r.hi = imp_sum_up(r.hi + range.hi);
        r.depends |= x[i].depends | y[i].depends;
    }
    imp_finish_(&r);
    return r;
}

/* Does imp_mul have a fast path? */
static inline int imp_mul_is_short_(const imp_model *x, const imp_model *y)
{
    return imp_is_exact(x) || imp_is_exact(y) || (imp_is_point(x) && imp_is_point(y));
}

/* Tighter than the sum of three imp_mul: terms of third order may cancel. */
static inline imp_model imp_dot3(const imp_model x[3], const imp_model y[3])
{
    imp_model sum = imp_num(0), p[3], q[3];
    int n = 0;
    for (int i = 0; i < 3; i++) {
        if (imp_mul_is_short_(&x[i], &y[i])) {
            sum = imp_add(sum, imp_mul(x[i], y[i]));
        } else {
            p[n] = x[i];
            q[n++] = y[i];
        }
    }
    if (n == 0) return sum;
    return imp_add(sum, n == 1 ? imp_mul_(&p[0], &q[0]) : imp_dot_(p, q, n));
}

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_MODEL_ARITHMETIC_H */
