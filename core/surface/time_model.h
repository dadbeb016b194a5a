/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_TIME_MODEL_H
#define CORE_SURFACE_TIME_MODEL_H

#include <impinge/model.h>

/* Products of models that depend on time alone
 * ============================================
 * A pose's turn and shift have no terms in u and v. Their products are those of
 * <impinge/model_arithmetic.h>, bit for bit, without the terms that are 0: a sum does not change by
 * adding 0, and the coefficients of a finished model are finite, so that 0 times one of them is 0.
 * What is left out only is a sign of zeros, of which no bound depends. */

/* Returns what imp_model_poly_range does. */
static inline imp_interval time_poly_range(const imp_model *x)
{
    const double b = x->b[2], q = x->q[IMP_TT];
    const double lo = imp_bow_lower_(b, q) - x->e, hi = imp_bow_upper_(b, q) + x->e;
    const double pad = 0x1p-48 * (fabs(x->a) + fabs(b) + fabs(q) + x->e);
    return imp_interval_make(x->a + lo - pad, x->a + hi + pad);
}

/* Does what imp_finish_ does. */
static inline void time_finish(imp_model *x)
{
    const imp_interval poly = time_poly_range(x);
    x->lo = imp_larger(x->lo, poly.lo);
    x->hi = imp_smaller(x->hi, poly.hi);
    x->rate[0] = x->rate[1] = 0;
    const double rate = x->rate[2] < INFINITY ? x->rate[2] : INFINITY;
    x->rate[2] = x->depends >> 2 & 1 ? rate : 0;
    if (!(x->e <= 0.5 * (x->hi - x->lo) && poly.hi - poly.lo < INFINITY)) imp_collapse_(x);
}

/* Does what imp_product_add_ does; *cubic is the coefficient of t^3. */
static inline double time_product_add(const imp_model *x, const imp_model *y, imp_model *r,
                                      double *cubic, double units, double *rounding)
{
    const double xb = x->b[2], yb = y->b[2], xq = x->q[IMP_TT], yq = y->q[IMP_TT];
    const double hx = 0.5 * xq, hy = 0.5 * yq;
    *cubic += xb * yq;
    *cubic += yb * xq;
    r->a += x->a * y->a - hx * hy;
    r->b[2] += x->a * yb + y->a * xb;
    r->q[IMP_TT] += ((x->a + hx) * yq + (y->a + hy) * xq) + xb * yb;
    const double x_mag = imp_interval_mag(imp_model_range(x));
    const double y_mag = imp_interval_mag(imp_model_range(y));
    const double inherited = x->e * y_mag + y->e * (x_mag + x->e);
    const double bx = fabs(xb), by = fabs(yb), qx = fabs(xq), qy = fabs(yq);
    const double nx = fabs(x->a) + bx + qx, ny = fabs(y->a) + by + qy;
    *rounding += units * nx * ny - 2 * fabs(x->a * y->a) + (bx + qx) * (by + qy);
    return imp_swing_upper_(x->q, qx) * imp_swing_upper_(y->q, qy) + inherited;
}

/* Does what imp_dot_ does, and imp_mul_ where n = 1. */
static inline imp_model time_products(const imp_model *const x[3], const imp_model *const y[3],
                                      int n)
{
    imp_model r = imp_model_zero();
    double cubic = 0, rest = 0, rounding = 0;
    for (int i = 0; i < n; i++)
        rest += time_product_add(x[i], y[i], &r, &cubic, n > 1 ? 8 : 4, &rounding);
    rest += 0.25 * fabs(cubic);
    r.b[2] += 0.75 * cubic;
    r.e = (rest + (IMP_U * rounding + IMP_TINY)) * IMP_SLACK;
    for (int i = 0; i < n; i++) {
        const imp_interval xr = imp_model_range(x[i]), yr = imp_model_range(y[i]);
        const imp_interval range = imp_interval_mul(xr, yr);
        const double x_mag = imp_interval_mag(xr), y_mag = imp_interval_mag(yr);
        const double rate = (x_mag * y[i]->rate[2] + y_mag * x[i]->rate[2] + IMP_TINY) * IMP_SLACK;
        r.rate[2] = n > 1 ? imp_sum_up(r.rate[2] + rate) : rate;
        r.lo = n > 1 ? imp_sum_down(r.lo + range.lo) : range.lo;
        r.hi = n > 1 ? imp_sum_up(r.hi + range.hi) : range.hi;
        r.depends |= x[i]->depends | y[i]->depends;
    }
    time_finish(&r);
    return r;
}

/* Returns x[0] y[0] + x[1] y[1] + x[2] y[2], as imp_dot3 does. All depend on time alone. */
static inline imp_model time_dot3(const imp_model x[3], const imp_model *const y[3])
{
    imp_model sum = imp_num(0);
    const imp_model *p[3], *q[3];
    int n = 0;
    for (int i = 0; i < 3; i++) {
        if (imp_mul_is_short_(&x[i], y[i]))
            sum = imp_add(sum, imp_mul(x[i], *y[i]));
        else
            p[n] = &x[i], q[n++] = y[i];
    }
    if (n == 0) return sum;
    const imp_model products = time_products(p, q, n);
    return n == 3 ? products : imp_add(sum, products);
}

/* Returns g, whose function is known to lie in the range, too, as imp_model_within does. */
static inline imp_model time_within(imp_model g, imp_interval range)
{
    g.lo = imp_larger(g.lo, range.lo);
    g.hi = imp_smaller(g.hi, range.hi);
    time_finish(&g);
    return g;
}

#endif
