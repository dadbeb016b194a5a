/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SERIES_H
#define PLUGINS_SERIES_H

#include <impinge/model.h>

/* Functions of one number, from a short series
 * ============================================
 * For what <impinge/model.h> has no function: g follows a cubic around m,
 *
 *   | g(m + y) - (c0 + c1 y + c2 y^2 + c3 y^3) | <= e,   |y| <= r,
 *
 * as an author knows from derivatives at m and a bound of the next. On [-r, r], y^3 is 3/4 r^2 y
 * within r^3 / 4 (Chebyshev), which makes the cubic a quadratic; models do the rest. */

typedef struct series {
    double m, r; /* set by series_around */
    double c[4];
    double e;
    double slope; /* at least |g'|, for |y| <= r */
} series;

/* Around the middle of x's quadratic, or the end of the range that is nearest; x is finite. */
static inline series series_around(const imp_model *x)
{
    const imp_interval range = imp_interval_make(x->lo, x->hi);
    series s = {.m = imp_larger(x->lo, imp_smaller(x->a, x->hi))};
    s.r = imp_interval_radius_upper(range, s.m);
    return s;
}

/* The model of g(x), x being what s was made around. y and its square, which may serve many series
 * around the same x, are imp_shift(x, -m) and imp_sqr of that.
 *
 * Roundings: of c3 times 3/4 r^2, three products; of its sum with c1: below 8 u (|fold| + |c1|). */
static inline imp_model series_compose(const series *s, imp_model y, imp_model square)
{
    const double r = s->r, fold = 0.75 * s->c[3] * r * r;
    imp_model g = imp_add(imp_scale(y, s->c[1] + fold), imp_scale(square, s->c[2]));
    double rest = 0.25 * fabs(s->c[3]) * r * r * r + s->e;
    double rounding = fold != 0 ? 8 * IMP_U * (fabs(fold) + fabs(s->c[1])) * r : 0;
    double more = (rest + rounding + IMP_TINY * (1 + r)) * IMP_SLACK;
    g = imp_shift(g, s->c[0]);
    g.e = imp_sum_up(g.e + more);
    g.lo = imp_sum_down(g.lo - more);
    g.hi = imp_sum_up(g.hi + more);
    g.depends = y.depends;
    for (int j = 0; j < 3; ++j) g.rate[j] = imp_round_up(y.rate[j] * s->slope);
    return imp_model_finish(g);
}

/* Nothing outside the range is a value of g. */
static inline imp_model series_within(imp_model g, imp_interval range)
{
    g.lo = imp_larger(g.lo, range.lo);
    g.hi = imp_smaller(g.hi, range.hi);
    return imp_model_finish(g);
}

#endif
