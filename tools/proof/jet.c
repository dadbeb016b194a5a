/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/jet_internal.h"

jet jet_constant(int n, ld_interval value) { return (jet){.n = n, .bends = n, .v = value}; }

jet jet_variable(int n, int j, ld_interval where)
{
    jet x = jet_constant(n, where);
    x.on = 1 << j;
    x.d[j] = ld_interval_of(1);
    return x;
}

/* --- Sums and products ------------------------------------------------------------------------ */

jet jet_neg(const jet *x)
{
    jet r = {.n = x->n,
             .bends = x->bends,
             .on = x->on,
             .is_undefined = x->is_undefined,
             .v = ld_interval_neg(x->v)};
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_neg(x->d[j]);
        for (int k = j; k < r.bends; k = jet_next(&r, k)) r.h[j][k] = ld_interval_neg(x->h[j][k]);
    }
    return r;
}

jet jet_add(const jet *x, const jet *y)
{
    jet r = jet_joined(x, y, ld_interval_add(x->v, y->v));
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_add(x->d[j], y->d[j]);
        for (int k = j; k < r.bends; k = jet_next(&r, k))
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
    jet r = jet_joined(x, x, ld_interval_mul(x->v, k));
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_mul(x->d[j], k);
        for (int l = j; l < r.bends; l = jet_next(&r, l))
            r.h[j][l] = ld_interval_mul(x->h[j][l], k);
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
    jet r = jet_joined(x, y, ld_interval_mul(x->v, y->v));
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = product_slope(x, y, j);
        for (int k = j; k < r.bends; k = jet_next(&r, k)) r.h[j][k] = product_curvature(x, y, j, k);
    }
    return r;
}

/* --- Functions of one number ------------------------------------------------------------------ */

jet jet_composed(const jet *x, const ld_interval g[3])
{
    jet r = jet_joined(x, x, g[0]);
    for (int j = jet_first(&r); j < r.n; j = jet_next(&r, j)) {
        r.d[j] = ld_interval_mul(g[1], x->d[j]);
        for (int k = j; k < r.bends; k = jet_next(&r, k)) {
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
    jet r = jet_composed(x, values);
    r.is_undefined |= !has_value;
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
    for (int j = jet_first(wide); j < wide->n; j = jet_next(wide, j)) {
        const ld_interval bend = ld_interval_scale(wide->h[j][j], 0.5F);
        first = ld_interval_add(first, ld_interval_mul(wide->d[j], offset[j]));
        second = ld_interval_add(second, parabola(centre->d[j], bend, offset[j]));
        for (int k = jet_next(wide, j); k < wide->n; k = jet_next(wide, k)) {
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
    for (int k = jet_first(wide); k < wide->n; k = jet_next(wide, k)) {
        const ld_interval bend = j <= k ? wide->h[j][k] : wide->h[k][j];
        first = ld_interval_add(first, ld_interval_mul(bend, offset[k]));
    }
    return ld_interval_intersect(wide->d[j], first);
}

void jet_narrow(jet *wide, const jet *centre, const ld_interval offset[BOX_DIMS])
{
    const ld_interval values = jet_values(wide, centre, offset);
    for (int j = jet_first(wide); j < wide->n; j = jet_next(wide, j))
        wide->d[j] = jet_slopes(wide, centre, offset, j);
    wide->v = values;
}
