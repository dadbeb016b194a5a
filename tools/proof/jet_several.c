/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tools/proof/jet_internal.h"

/* Functions of several numbers: quotients, hulls, powers, lengths and angles. */

static bool inverse_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_inverse(x);
    g[1] = ld_interval_neg(ld_interval_sqr(g[0]));
    g[2] = ld_interval_scale(ld_interval_integer_power(g[0], 3), 2);
    return ld_interval_excludes_0(x);
}

jet jet_div(const jet *x, const jet *y)
{
    const jet inverse = jet_apply(inverse_, y);
    jet r = jet_mul(x, &inverse);
    r.v = ld_interval_div(x->v, y->v);
    return r;
}

jet jet_hull(const jet *x, const jet *y)
{
    jet r = jet_joined(x, y, ld_interval_hull(x->v, y->v));
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_hull(x->d[j], y->d[j]);
        for (int k = j; k < r.bends; k = jet_next(&r, k))
            r.h[j][k] = ld_interval_hull(x->h[j][k], y->h[j][k]);
    }
    return r;
}

/* Returns the jet of the least or greatest of two where it may be either: its slopes are in the
 * range of both, and where the two meet there is a kink. */
static jet either(const jet *x, const jet *y, ld_interval value)
{
    jet r = jet_joined(x, y, value);
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j))
        r.d[j] = ld_interval_hull(x->d[j], y->d[j]);
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j))
        for (int k = j; k < r.bends; k = jet_next(&r, k))
            if (!ld_interval_is(r.d[j], 0) && !ld_interval_is(r.d[k], 0))
                r.h[j][k] = ld_interval_entire();
    return r;
}

/* x, which has no value where y has none. */
static jet alone(const jet *x, const jet *y)
{
    jet r = *x;
    r.is_undefined |= y->is_undefined;
    return r;
}

jet jet_min(const jet *x, const jet *y)
{
    if (x->v.hi < y->v.lo) return alone(x, y);
    if (y->v.hi < x->v.lo) return alone(y, x);
    return either(x, y, ld_interval_min(x->v, y->v));
}

jet jet_max(const jet *x, const jet *y)
{
    if (x->v.lo > y->v.hi) return alone(x, y);
    if (y->v.lo > x->v.hi) return alone(y, x);
    return either(x, y, ld_interval_max(x->v, y->v));
}

static bool is_fixed(const jet *x)
{
    for (int j = jet_first(x); j < x->n; j = jet_next(x, j))
        if (!ld_interval_is(x->d[j], 0)) return false;
    return true;
}

/* k x^(k-1), k (k-1) x^(k-2); the factors are whole, so what is 0 is exactly 0. */
static jet whole_power(const jet *x, int n)
{
    const ld_interval slope = ld_interval_scale(ld_interval_integer_power(x->v, n - 1), n);
    const ld_interval bend =
        n == 1 ? ld_interval_of(0)
               : ld_interval_mul(ld_interval_scale(ld_interval_integer_power(x->v, n - 2), n),
                                 ld_interval_of(n - 1));
    return jet_composed(x, (ld_interval[3]){ld_interval_integer_power(x->v, n), slope, bend});
}

/* Lemma. x^k is 0 for what counts as 0 (jet_is_from). Beside that, its slopes and bends are within
 * those of x >= 0, which contain 0, if k > 1; else it has a kink at 0. */
static jet fixed_power(const jet *x, ld_interval k)
{
    const ld_interval all = ld_interval_entire();
    if (x->v.lo < 0 && !(k.lo > 1))
        return jet_composed(x, (ld_interval[3]){ld_interval_power(x->v, k), all, all});
    const ld_interval less = ld_interval_sub(k, ld_interval_of(1));
    const ld_interval slope = ld_interval_mul(k, ld_interval_power(x->v, less));
    const ld_interval bend = ld_interval_mul(
        ld_interval_mul(k, less), ld_interval_power(x->v, ld_interval_sub(k, ld_interval_of(2))));
    return jet_composed(x, (ld_interval[3]){ld_interval_power(x->v, k), slope, bend});
}

/* An exponent known with an error, or one that varies, may be whole, and then negative numbers have
 * a power too. */
static bool may_be_whole(ld_interval k) { return floorl(k.hi) >= k.lo; }

static bool is_whole(const jet *y)
{
    const proof_real k = y->v.lo;
    return is_fixed(y) && ld_interval_is(y->v, k) && floorl(k) == k && proof_size(k) < 1e9F;
}

/* Returns whether x^y has values: of numbers below 0 for whole y only; 0^0 is 1. */
static bool has_power(ld_interval x, const jet *y)
{
    if (is_whole(y)) return y->v.lo >= 0 || ld_interval_excludes_0(x);
    return x.lo > 0 || (y->v.lo > 0 && jet_is_from(x, 0));
}

/* x^k for fixed k, whole or not; else exp(y log x). */
static jet power_of(const jet *x, const jet *y)
{
    const proof_real k = y->v.lo;
    if (is_whole(y)) return k == 0 ? jet_constant(x->n, ld_interval_of(1)) : whole_power(x, (int)k);
    const ld_interval all = ld_interval_entire();
    if (x->v.lo < 0 && may_be_whole(y->v)) {
        const jet by_base = jet_composed(x, (ld_interval[3]){all, all, all});
        if (is_fixed(y)) return by_base;
        const jet by_exponent = jet_composed(y, (ld_interval[3]){all, all, all});
        return jet_add(&by_base, &by_exponent);
    }
    if (is_fixed(y)) return fixed_power(x, y->v);
    const jet log = jet_apply(jet_log_, x), exponent = jet_mul(y, &log);
    return jet_apply(jet_exp_, &exponent);
}

jet jet_power(const jet *x, const jet *y)
{
    jet r = power_of(x, y);
    r.is_undefined |= x->is_undefined || y->is_undefined || !has_power(x->v, y);
    return r;
}

/* sqrt(sum x_i^2). Lemma: its slope by j is no longer than the vector of slopes of the x_i, also
 * where all are 0 (triangle inequality); there, it has a kink. */
jet jet_length(const jet *const x[], int count)
{
    jet sum = jet_constant(x[0]->n, ld_interval_of(0));
    for (int i = 0; i < count; ++i) {
        const jet square = jet_apply(jet_sqr_, x[i]);
        sum = jet_add(&sum, &square);
    }
    jet r = jet_apply(jet_sqrt_, &sum);
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        ld_interval slopes = ld_interval_of(0);
        for (int i = 0; i < count; ++i)
            slopes = ld_interval_add(slopes, ld_interval_sqr(x[i]->d[j]));
        r.d[j] = ld_interval_intersect(r.d[j], ld_interval_plus_minus(ld_interval_sqrt(slopes).hi));
    }
    return r;
}

/* y' x / r^2 - x' y / r^2, differentiated once more by the rules for products. If the angle is not
 * continuous over the box, the result is unbounded. */
jet jet_angle(const jet *y, const jet *x)
{
    const jet y2 = jet_apply(jet_sqr_, y), x2 = jet_apply(jet_sqr_, x), r2 = jet_add(&x2, &y2);
    const jet a = jet_div(x, &r2), b = jet_div(y, &r2);
    jet r = jet_joined(x, y, ld_interval_angle(y->v, x->v));
    const bool known = r.v.lo > -INFINITY;
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_sub(ld_interval_mul(a.v, y->d[j]), ld_interval_mul(b.v, x->d[j]));
        if (!known) r.d[j] = ld_interval_entire();
        for (int k = j; k < r.bends; k = jet_next(&r, k)) {
            const ld_interval first =
                ld_interval_add(ld_interval_mul(a.d[k], y->d[j]), ld_interval_mul(a.v, y->h[j][k]));
            const ld_interval second =
                ld_interval_add(ld_interval_mul(b.d[k], x->d[j]), ld_interval_mul(b.v, x->h[j][k]));
            r.h[j][k] = known ? ld_interval_sub(first, second) : ld_interval_entire();
        }
    }
    return r;
}

/* If the sign may change over the box, the function may jump: the result is unbounded. */
jet jet_copysign(const jet *x, const jet *y)
{
    const jet size = jet_apply(jet_abs_, x), minus = jet_neg(&size);
    if (y->v.lo >= 0) return alone(&size, y);
    if (y->v.hi < 0) return alone(&minus, y);
    jet r = jet_joined(x, y, ld_interval_entire());
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) r.d[j] = ld_interval_entire();
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j))
        for (int k = j; k < r.bends; k = jet_next(&r, k)) r.h[j][k] = ld_interval_entire();
    return r;
}
