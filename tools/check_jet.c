/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_jet.h"

#include <math.h>

jet jet_constant(int n, span value) { return (jet){.n = n, .v = value}; }

jet jet_variable(int n, int j, span where)
{
    jet x = jet_constant(n, where);
    x.d[j] = span_of(1);
    return x;
}

/* --- Sums and products ---------------------------------------------------------------------- */

jet jet_neg(const jet *x)
{
    jet r = {.n = x->n, .v = span_neg(x->v)};
    for (int j = 0; j < x->n; ++j) {
        r.d[j] = span_neg(x->d[j]);
        for (int k = j; k < x->n; ++k) r.h[j][k] = span_neg(x->h[j][k]);
    }
    return r;
}

jet jet_add(const jet *x, const jet *y)
{
    jet r = {.n = x->n, .v = span_add(x->v, y->v)};
    for (int j = 0; j < x->n; ++j) {
        r.d[j] = span_add(x->d[j], y->d[j]);
        for (int k = j; k < x->n; ++k) r.h[j][k] = span_add(x->h[j][k], y->h[j][k]);
    }
    return r;
}

jet jet_sub(const jet *x, const jet *y)
{
    const jet minus = jet_neg(y);
    return jet_add(x, &minus);
}

jet jet_scale(const jet *x, span k)
{
    jet r = {.n = x->n, .v = span_mul(x->v, k)};
    for (int j = 0; j < x->n; ++j) {
        r.d[j] = span_mul(x->d[j], k);
        for (int l = j; l < x->n; ++l) r.h[j][l] = span_mul(x->h[j][l], k);
    }
    return r;
}

/* (x y)'' = x'' y + x' y' + y' x' + x y'' */
static span product_curvature(const jet *x, const jet *y, int j, int k)
{
    const span outer = span_add(span_mul(x->h[j][k], y->v), span_mul(x->v, y->h[j][k]));
    const span inner = span_add(span_mul(x->d[j], y->d[k]), span_mul(x->d[k], y->d[j]));
    return span_add(outer, inner);
}

jet jet_mul(const jet *x, const jet *y)
{
    jet r = {.n = x->n, .v = span_mul(x->v, y->v)};
    for (int j = 0; j < x->n; ++j) {
        r.d[j] = span_add(span_mul(x->d[j], y->v), span_mul(x->v, y->d[j]));
        for (int k = j; k < x->n; ++k) r.h[j][k] = product_curvature(x, y, j, k);
    }
    return r;
}

/* --- Functions of one number ---------------------------------------------------------------- */

/* g(x)'' = g'' x' x' + g' x''. What x does not depend on stays 0, however steep g is. */
static jet composed(const jet *x, const span g[3])
{
    jet r = {.n = x->n, .v = g[0]};
    for (int j = 0; j < x->n; ++j) {
        r.d[j] = span_mul(g[1], x->d[j]);
        for (int k = j; k < x->n; ++k) {
            const span both = j == k ? span_sqr(x->d[j]) : span_mul(x->d[j], x->d[k]);
            r.h[j][k] = span_add(span_mul(g[2], both), span_mul(g[1], x->h[j][k]));
        }
    }
    return r;
}

jet jet_apply(jet_function *g, const jet *x)
{
    span values[3];
    g(x->v, values);
    return composed(x, values);
}

/* --- Functions of several ------------------------------------------------------------------- */

static void inverse_(span x, span g[3])
{
    g[0] = span_inverse(x);
    g[1] = span_neg(span_sqr(g[0]));
    g[2] = span_scale(span_whole_power(g[0], 3), 2);
}

jet jet_div(const jet *x, const jet *y)
{
    const jet inverse = jet_apply(inverse_, y);
    jet r = jet_mul(x, &inverse);
    r.v = span_div(x->v, y->v);
    return r;
}

/* One of two, or between them: slopes are of either, and where they meet there is a kink. */
static jet either(const jet *x, const jet *y, span value)
{
    jet r = {.n = x->n, .v = value};
    for (int j = 0; j < x->n; ++j) r.d[j] = span_hull(x->d[j], y->d[j]);
    for (int j = 0; j < x->n; ++j)
        for (int k = j; k < x->n; ++k)
            if (!span_is(r.d[j], 0) && !span_is(r.d[k], 0)) r.h[j][k] = span_whole();
    return r;
}

jet jet_min(const jet *x, const jet *y)
{
    if (x->v.hi < y->v.lo) return *x;
    if (y->v.hi < x->v.lo) return *y;
    return either(x, y, span_min(x->v, y->v));
}

jet jet_max(const jet *x, const jet *y)
{
    if (x->v.lo > y->v.hi) return *x;
    if (y->v.lo > x->v.hi) return *y;
    return either(x, y, span_max(x->v, y->v));
}

static bool is_fixed(const jet *x)
{
    for (int j = 0; j < x->n; ++j)
        if (!span_is(x->d[j], 0)) return false;
    return true;
}

/* k x^(k-1), k (k-1) x^(k-2); the factors are whole, so what is 0 is exactly 0. */
static jet whole_power(const jet *x, int n)
{
    const span slope = span_scale(span_whole_power(x->v, n - 1), n);
    const span bend = n == 1
                          ? span_of(0)
                          : span_mul(span_scale(span_whole_power(x->v, n - 2), n), span_of(n - 1));
    return composed(x, (span[3]){span_whole_power(x->v, n), slope, bend});
}

static jet fixed_power(const jet *x, span k)
{
    const span less = span_sub(k, span_of(1));
    const span slope = span_mul(k, span_power(x->v, less));
    const span bend = span_mul(span_mul(k, less), span_power(x->v, span_sub(k, span_of(2))));
    return composed(x, (span[3]){span_power(x->v, k), slope, bend});
}

/* x^k for fixed k, whole or not; else exp(y log x). */
jet jet_power(const jet *x, const jet *y)
{
    const long double k = y->v.lo;
    if (is_fixed(y) && span_is(y->v, k) && floorl(k) == k && fabsl(k) < 1e9L)
        return k == 0 ? jet_constant(x->n, span_of(1)) : whole_power(x, (int)k);
    if (is_fixed(y)) return fixed_power(x, y->v);
    const jet log = jet_apply(jet_log_, x), exponent = jet_mul(y, &log);
    return jet_apply(jet_exp_, &exponent);
}

/* sqrt(sum x_i^2). Lemma: its slope by j is no longer than the vector of slopes of the x_i, also
 * where all are 0 (triangle inequality); there, it has a kink. */
jet jet_length(const jet *const x[], int count)
{
    jet sum = jet_constant(x[0]->n, span_of(0));
    for (int i = 0; i < count; ++i) {
        const jet square = jet_apply(jet_sqr_, x[i]);
        sum = jet_add(&sum, &square);
    }
    jet r = jet_apply(jet_sqrt_, &sum);
    for (int j = 0; j < r.n; ++j) {
        span slopes = span_of(0);
        for (int i = 0; i < count; ++i) slopes = span_add(slopes, span_sqr(x[i]->d[j]));
        r.d[j] = span_meet(r.d[j], span_plus_minus(span_sqrt(slopes).hi));
    }
    return r;
}

/* y' x / r^2 - x' y / r^2, differentiated once more by the rules for products. Where the angle is
 * not continuous over the box, nothing is known. */
jet jet_angle(const jet *y, const jet *x)
{
    const jet y2 = jet_apply(jet_sqr_, y), x2 = jet_apply(jet_sqr_, x), r2 = jet_add(&x2, &y2);
    const jet a = jet_div(x, &r2), b = jet_div(y, &r2);
    jet r = {.n = x->n, .v = span_angle(y->v, x->v)};
    const bool known = r.v.lo > -INFINITY;
    for (int j = 0; j < r.n; ++j) {
        r.d[j] = span_sub(span_mul(a.v, y->d[j]), span_mul(b.v, x->d[j]));
        if (!known) r.d[j] = span_whole();
        for (int k = j; k < r.n; ++k) {
            const span first = span_add(span_mul(a.d[k], y->d[j]), span_mul(a.v, y->h[j][k]));
            const span second = span_add(span_mul(b.d[k], x->d[j]), span_mul(b.v, x->h[j][k]));
            r.h[j][k] = known ? span_sub(first, second) : span_whole();
        }
    }
    return r;
}

/* Where the sign changes it may jump, for all that intervals can tell: nothing is known. */
jet jet_copysign(const jet *x, const jet *y)
{
    const jet size = jet_apply(jet_abs_, x);
    if (y->v.lo >= 0) return size;
    if (y->v.hi < 0) return jet_neg(&size);
    jet r = {.n = x->n, .v = span_whole()};
    for (int j = 0; j < r.n; ++j) r.d[j] = span_whole();
    for (int j = 0; j < r.n; ++j)
        for (int k = j; k < r.n; ++k) r.h[j][k] = span_whole();
    return r;
}

/* --- Over a box ----------------------------------------------------------------------------- */

/* At least a x + b x^2 for |x| <= r. Lemma: it is at most |a| |x| + b.hi x^2, which grows with |x|
 * if b.hi >= 0 or 2 |b.hi| r <= |a|, and else is greatest at |x| = |a| / (2 |b.hi|). */
static long double parabola_upper(span a, span b, long double r)
{
    const span slope = span_of(span_mag(a)), bend = span_of(b.hi), end = span_of(r);
    const span at_end = span_add(span_mul(slope, end), span_mul(bend, span_sqr(end)));
    if (b.hi >= 0 || span_scale(span_mul(bend, end), -2).hi <= slope.lo) return at_end.hi;
    return span_div(span_sqr(slope), span_scale(bend, -4)).hi;
}

/* a x + b x^2 */
static span parabola(span a, span b, span x)
{
    const long double r = span_mag(x);
    return span_make(-parabola_upper(a, span_neg(b), r), parabola_upper(a, b, r));
}

/* f(c) + f'(box) x, and f(c) + f'(c) x + 1/2 f''(box) x x, for x from c into the box. */
span jet_values(const jet *box, const jet *centre, const span offset[BOX_DIMS])
{
    span first = centre->v, second = centre->v;
    for (int j = 0; j < box->n; ++j) {
        const span bend = span_scale(box->h[j][j], 0.5L);
        first = span_add(first, span_mul(box->d[j], offset[j]));
        second = span_add(second, parabola(centre->d[j], bend, offset[j]));
        for (int k = j + 1; k < box->n; ++k) {
            const span both = span_mul(offset[j], offset[k]);
            second = span_add(second, span_mul(box->h[j][k], both));
        }
    }
    return span_meet(box->v, span_meet(first, second));
}

span jet_slopes(const jet *box, const jet *centre, const span offset[BOX_DIMS], int j)
{
    span first = centre->d[j];
    for (int k = 0; k < box->n; ++k) {
        const span bend = j <= k ? box->h[j][k] : box->h[k][j];
        first = span_add(first, span_mul(bend, offset[k]));
    }
    return span_meet(box->d[j], first);
}
