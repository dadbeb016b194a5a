/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/jet.h"

#include <math.h>

jet jet_constant(int n, ld_interval value) { return (jet){.n = n, .bends = n, .v = value}; }

jet jet_variable(int n, int j, ld_interval where)
{
    jet x = jet_constant(n, where);
    x.on = 1 << j;
    x.d[j] = ld_interval_of(1);
    return x;
}

/* The first variable after j that x may depend on, or n or more. */
static int next_of(const jet *x, int j)
{
    do ++j;
    while (j < x->n && !jet_has(x, j));
    return j;
}

static int first_of(const jet *x) { return next_of(x, -1); }

/* A jet of two others, whose derivatives are 0 so far. */
static jet joined(const jet *x, const jet *y, ld_interval value)
{
    return (jet){.n = x->n,
                 .bends = x->bends < y->bends ? x->bends : y->bends,
                 .on = x->on | y->on,
                 .is_undefined = x->is_undefined || y->is_undefined,
                 .v = value};
}

/* --- Sums and products ------------------------------------------------------------------------ */

jet jet_neg(const jet *x)
{
    jet r = {.n = x->n,
             .bends = x->bends,
             .on = x->on,
             .is_undefined = x->is_undefined,
             .v = ld_interval_neg(x->v)};
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_neg(x->d[j]);
        for (int k = j; k < r.bends; k = next_of(&r, k)) r.h[j][k] = ld_interval_neg(x->h[j][k]);
    }
    return r;
}

jet jet_add(const jet *x, const jet *y)
{
    jet r = joined(x, y, ld_interval_add(x->v, y->v));
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_add(x->d[j], y->d[j]);
        for (int k = j; k < r.bends; k = next_of(&r, k))
            r.h[j][k] = ld_interval_add(x->h[j][k], y->h[j][k]);
    }
    return r;
}

jet jet_sub(const jet *x, const jet *y)
{
    const jet minus = jet_neg(y);
    return jet_add(x, &minus);
}

jet jet_scale(const jet *x, ld_interval k)
{
    jet r = joined(x, x, ld_interval_mul(x->v, k));
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_mul(x->d[j], k);
        for (int l = j; l < r.bends; l = next_of(&r, l)) r.h[j][l] = ld_interval_mul(x->h[j][l], k);
    }
    return r;
}

/* sum + a b */
static ld_interval plus_product(ld_interval sum, ld_interval a, ld_interval b)
{
    return ld_interval_add(sum, ld_interval_mul(a, b));
}

/* (x y)'' = x'' y + x' y' + y' x' + x y'', of which are left out the terms that are 0 because x or
 * y does not depend on a variable. */
static ld_interval product_curvature(const jet *x, const jet *y, int j, int k)
{
    const int both = 1 << j | 1 << k;
    ld_interval sum = ld_interval_of(0);
    if ((x->on & both) == both) sum = ld_interval_mul(x->h[j][k], y->v);
    if ((y->on & both) == both) sum = plus_product(sum, x->v, y->h[j][k]);
    if (jet_has(x, j) && jet_has(y, k)) sum = plus_product(sum, x->d[j], y->d[k]);
    if (jet_has(x, k) && jet_has(y, j)) sum = plus_product(sum, x->d[k], y->d[j]);
    return sum;
}

static ld_interval product_slope(const jet *x, const jet *y, int j)
{
    if (!jet_has(y, j)) return ld_interval_mul(x->d[j], y->v);
    if (!jet_has(x, j)) return ld_interval_mul(x->v, y->d[j]);
    return plus_product(ld_interval_mul(x->d[j], y->v), x->v, y->d[j]);
}

jet jet_mul(const jet *x, const jet *y)
{
    jet r = joined(x, y, ld_interval_mul(x->v, y->v));
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = product_slope(x, y, j);
        for (int k = j; k < r.bends; k = next_of(&r, k)) r.h[j][k] = product_curvature(x, y, j, k);
    }
    return r;
}

/* --- Functions of one number ------------------------------------------------------------------ */

/* g(x)'' = g'' x' x' + g' x''. What x does not depend on stays 0, however steep g is. */
static jet composed(const jet *x, const ld_interval g[3])
{
    jet r = joined(x, x, g[0]);
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_mul(g[1], x->d[j]);
        for (int k = j; k < r.bends; k = next_of(&r, k)) {
            const ld_interval both =
                j == k ? ld_interval_sqr(x->d[j]) : ld_interval_mul(x->d[j], x->d[k]);
            r.h[j][k] =
                ld_interval_add(ld_interval_mul(g[2], both), ld_interval_mul(g[1], x->h[j][k]));
        }
    }
    return r;
}

jet jet_apply(jet_function *g, const jet *x)
{
    ld_interval values[3];
    const bool has_value = g(x->v, values);
    jet r = composed(x, values);
    r.is_undefined |= !has_value;
    return r;
}

/* --- Functions of several --------------------------------------------------------------------- */

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
    jet r = joined(x, y, ld_interval_hull(x->v, y->v));
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_hull(x->d[j], y->d[j]);
        for (int k = j; k < r.bends; k = next_of(&r, k))
            r.h[j][k] = ld_interval_hull(x->h[j][k], y->h[j][k]);
    }
    return r;
}

/* One of two, or between them: slopes are of either, and where they meet there is a kink. */
static jet either(const jet *x, const jet *y, ld_interval value)
{
    jet r = joined(x, y, value);
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j))
        r.d[j] = ld_interval_hull(x->d[j], y->d[j]);
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j))
        for (int k = j; k < r.bends; k = next_of(&r, k))
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
    for (int j = first_of(x); j < x->n; j = next_of(x, j))
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
    return composed(x, (ld_interval[3]){ld_interval_integer_power(x->v, n), slope, bend});
}

/* Lemma. x^k is 0 for what counts as 0 (jet_is_from). Beside that, its slopes and bends are within
 * those of x >= 0, which contain 0, if k > 1; else it has a kink at 0. */
static jet fixed_power(const jet *x, ld_interval k)
{
    const ld_interval all = ld_interval_entire();
    if (x->v.lo < 0 && !(k.lo > 1))
        return composed(x, (ld_interval[3]){ld_interval_power(x->v, k), all, all});
    const ld_interval less = ld_interval_sub(k, ld_interval_of(1));
    const ld_interval slope = ld_interval_mul(k, ld_interval_power(x->v, less));
    const ld_interval bend = ld_interval_mul(
        ld_interval_mul(k, less), ld_interval_power(x->v, ld_interval_sub(k, ld_interval_of(2))));
    return composed(x, (ld_interval[3]){ld_interval_power(x->v, k), slope, bend});
}

/* An exponent known with an error, or one that varies, may be whole, and then negative numbers have
 * a power too. */
static bool may_be_whole(ld_interval k) { return floorl(k.hi) >= k.lo; }

static bool is_whole(const jet *y)
{
    const proof_real k = y->v.lo;
    return is_fixed(y) && ld_interval_is(y->v, k) && floorl(k) == k && proof_size(k) < 1e9F;
}

/* Whether x^y has values: of numbers below 0 for whole y only; 0^0 is 1. */
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
        const jet by_base = composed(x, (ld_interval[3]){all, all, all});
        if (is_fixed(y)) return by_base;
        const jet by_exponent = composed(y, (ld_interval[3]){all, all, all});
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
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
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
    jet r = joined(x, y, ld_interval_angle(y->v, x->v));
    const bool known = r.v.lo > -INFINITY;
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) {
        r.d[j] = ld_interval_sub(ld_interval_mul(a.v, y->d[j]), ld_interval_mul(b.v, x->d[j]));
        if (!known) r.d[j] = ld_interval_entire();
        for (int k = j; k < r.bends; k = next_of(&r, k)) {
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
    jet r = joined(x, y, ld_interval_entire());
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j)) r.d[j] = ld_interval_entire();
    for (int j = first_of(&r); j < r.n; j = next_of(&r, j))
        for (int k = j; k < r.bends; k = next_of(&r, k)) r.h[j][k] = ld_interval_entire();
    return r;
}

/* --- Over a box ------------------------------------------------------------------------------- */

/* At least a x + b x^2 for |x| <= r. Lemma: it is at most |a| |x| + b.hi x^2, which grows with |x|
 * if b.hi >= 0 or 2 |b.hi| r <= |a|, and else is greatest at |x| = |a| / (2 |b.hi|). */
static proof_real parabola_upper(ld_interval a, ld_interval b, proof_real r)
{
    const ld_interval slope = ld_interval_of(ld_interval_mag(a)), bend = ld_interval_of(b.hi),
                      end = ld_interval_of(r);
    const ld_interval at_end =
        ld_interval_add(ld_interval_mul(slope, end), ld_interval_mul(bend, ld_interval_sqr(end)));
    if (b.hi >= 0 || ld_interval_scale(ld_interval_mul(bend, end), -2).hi <= slope.lo)
        return at_end.hi;
    return ld_interval_div(ld_interval_sqr(slope), ld_interval_scale(bend, -4)).hi;
}

/* a x + b x^2 */
static ld_interval parabola(ld_interval a, ld_interval b, ld_interval x)
{
    const proof_real r = ld_interval_mag(x);
    if (ld_interval_is(b, 0)) return ld_interval_mul(a, x);
    return ld_interval_make(-parabola_upper(a, ld_interval_neg(b), r), parabola_upper(a, b, r));
}

/* f(c) + f'(box) x, and f(c) + f'(c) x + 1/2 f''(box) x x, for x from c into the box. */
ld_interval jet_values(const jet *wide, const jet *centre, const ld_interval offset[BOX_DIMS])
{
    ld_interval first = centre->v, second = centre->v;
    for (int j = first_of(wide); j < wide->n; j = next_of(wide, j)) {
        const ld_interval bend = ld_interval_scale(wide->h[j][j], 0.5F);
        first = ld_interval_add(first, ld_interval_mul(wide->d[j], offset[j]));
        second = ld_interval_add(second, parabola(centre->d[j], bend, offset[j]));
        for (int k = next_of(wide, j); k < wide->n; k = next_of(wide, k)) {
            const ld_interval both = ld_interval_mul(offset[j], offset[k]);
            second = ld_interval_add(second, ld_interval_mul(wide->h[j][k], both));
        }
    }
    return ld_interval_intersect(wide->v, ld_interval_intersect(first, second));
}

ld_interval jet_slopes(const jet *wide, const jet *centre, const ld_interval offset[BOX_DIMS],
                       int j)
{
    ld_interval first = centre->d[j];
    for (int k = first_of(wide); k < wide->n; k = next_of(wide, k)) {
        const ld_interval bend = j <= k ? wide->h[j][k] : wide->h[k][j];
        first = ld_interval_add(first, ld_interval_mul(bend, offset[k]));
    }
    return ld_interval_intersect(wide->d[j], first);
}

void jet_narrow(jet *wide, const jet *centre, const ld_interval offset[BOX_DIMS])
{
    const ld_interval values = jet_values(wide, centre, offset);
    for (int j = first_of(wide); j < wide->n; j = next_of(wide, j))
        wide->d[j] = jet_slopes(wide, centre, offset, j);
    wide->v = values;
}
