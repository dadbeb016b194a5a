/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/moving_point.h"

#include <float.h>
#include <impinge/formula.h>
#include <math.h>

/* --- A point that moves ----------------------------------------------------------------------- */

/* Polynomial of a model at s, in long double: 20 roundings at most, each of a partial sum below the
 * size. */
long double model_value(const imp_model *m, const double s[3])
{
    const long double u = s[0], v = s[1], t = s[2];
    return (long double)m->a + (m->b[0] * u + m->b[1] * v + m->b[2] * t) +
           (m->q[IMP_UU] * u * u + m->q[IMP_UV] * u * v + m->q[IMP_UT] * u * t) +
           (m->q[IMP_VV] * v * v + m->q[IMP_VT] * v * t + m->q[IMP_TT] * t * t);
}

/* Draws a model of a polynomial through `x` at s, whose reach is of any scale up to twice the size;
 * the point is up to `off` from it there. */
imp_model model_through(uint64_t *random, double x, double size, const double s[3])
{
    imp_model m = {.rate = {INFINITY, INFINITY, INFINITY}, .depends = 7};
    const double scale = draw_index(random, 4) > 0 ? size * random_power(random, -30, 1) : 0;
    const double bend = draw_index(random, 2) > 0 ? random_power(random, -12, 0) : 0;
    for (int j = 0; j < 3; ++j) m.b[j] = scale * draw_normalized(random);
    for (int k = 0; k < 6; ++k) m.q[k] = scale * bend * draw_normalized(random);
    const double off = draw_index(random, 2) > 0 ? scale * bend * draw_normalized(random) : 0;
    m.a = x - (double)model_value(&m, s) + off;
    m.e = fabs(off) + 0x1p-50 * (fabs(x) + imp_model_size(&m));
    const imp_interval range = imp_model_poly_range(&m);
    m.lo = range.lo;
    m.hi = range.hi;
    return m;
}

/* --- Judging ---------------------------------------------------------------------------------- */

bool distance_has_form(const subject *s, const imp_model *g)
{
    bool sane = g->e >= 0 && g->lo <= g->hi && !isnan(g->a);
    for (int j = 0; j < 3; ++j) sane = sane && !isnan(g->b[j]);
    for (int k = 0; k < 6; ++k) sane = sane && !isnan(g->q[k]);
    return sane ||
           answer_fail(s->answer, "the distance has a NaN, a remainder that is negative, or a "
                                  "range that is inverted");
}

long double distance_claimed(const imp_model *g, const double s[3])
{
    const long double value = model_value(g, s);
    const long double slack = 32 * LDBL_EPSILON * (imp_model_size(g) + fabs(g->lo) + fabs(g->hi));
    long double lo = value - g->e - slack, hi = value + g->e + slack;
    if (lo < g->lo) lo = g->lo;
    if (hi > g->hi) hi = g->hi;
    if (lo > hi) return (long double)INFINITY;
    return lo > 0 ? lo - slack : hi < 0 ? -hi - slack : 0;
}
