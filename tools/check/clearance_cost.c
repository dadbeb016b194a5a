/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/clearance_cost.h"

#include <impinge/formula.h>

#include <math.h>
#include <string.h>

enum { SAMPLES = 512 };

/* Lowest and highest of what is sampled. */
typedef struct extent {
    double lo[3], hi[3];
} extent;

static bool sample(const subject *s, extent *e)
{
    static const double shift[BOX_DIMS] = {0.5, 0.5, 0.5, 0.5};
    double at[BOX_DIMS], p[BOX_DIMS], x[3], error[3];
    for (int i = 0; i < 3; ++i) e->lo[i] = INFINITY, e->hi[i] = -INFINITY;
    for (uint64_t k = 0; k < SAMPLES; ++k) {
        draw_spread(shift, k, s->n, at);
        const box point = draw_around(&s->domain, s->n, at, 0);
        memcpy(p, point.lo, sizeof p);
        if (subject_eval(s, 1, p, x, error) != IMP_STATUS_OK) return false;
        for (int i = 0; i < 3; ++i) {
            e->lo[i] = fmin(e->lo[i], x[i]);
            e->hi[i] = fmax(e->hi[i], x[i]);
        }
    }
    return true;
}

/* Greatest b s + q s^2 for s in [-1, 1]. */
static double hump(double b, double q)
{
    return q < 0 && fabs(b) < -2 * q ? b * b / (-4 * q) : fabs(b) + q;
}

/* Upper bound of sign * coordinate i by the model. */
static double model_reach(const imp_model *g, int i, double sign)
{
    const imp_model *m = &g[i];
    const double polynomial = sign * m->a + hump(m->b[0], sign * m->q[IMP_UU]) +
                              hump(m->b[1], sign * m->q[IMP_VV]) +
                              hump(m->b[2], sign * m->q[IMP_TT]) + fabs(m->q[IMP_UV]) +
                              fabs(m->q[IMP_UT]) + fabs(m->q[IMP_VT]) + m->e;
    return fmin(polynomial, sign > 0 ? m->hi : -m->lo);
}

/* Upper bound of sign * coordinate i over a region; NAN: no bound. *here is the value at its
 * middle, *widest the variable with the largest change. */
static double reach(const subject *s, const box *where, int i, double sign, double *here,
                    int *widest)
{
    const imp_region region = imp_region_between(where->lo, where->hi);
    double rate[3][BOX_DIMS], x[3], error[3], spread = 0, most = 0;
    imp_model model[3];
    if (subject_eval(s, 1, region.c, x, error) != IMP_STATUS_OK) return NAN;
    *here = sign * x[i];
    if (subject_rate(s, where, rate) != IMP_STATUS_OK) return NAN;
    for (int j = 0; j < 3; ++j) {
        const double change = rate[i][j] * region.d[j];
        spread += change;
        if (change > most) most = change, *widest = j;
    }
    if (s->instance->surface->include == NULL) return *here + error[i] + spread;
    return subject_include(s, &region, model) == IMP_STATUS_OK ? model_reach(model, i, sign) : NAN;
}

/* The widest variable where there is no bound. */
static int widest_of(const subject *s, const box *where)
{
    int widest = 0;
    double most = -1;
    for (int j = 0; j < 3; ++j) {
        const double share =
            (where->hi[j] - where->lo[j]) / (s->domain.hi[j] - s->domain.lo[j] + 0x1p-1000);
        if (share > most) most = share, widest = j;
    }
    return widest;
}

typedef struct waiting {
    box where;
    double far;
    int widest;
} waiting;

static size_t farthest(const waiting *w, size_t count)
{
    size_t best = 0;
    for (size_t k = 1; k < count; ++k)
        if (!(w[k].far <= w[best].far)) best = k; /* NAN first */
    return best;
}

/* Number of regions tested until sign * coordinate i is proved to stay within gap of the largest
 * value found. */
static double pairs_to_end(const subject *s, int i, double sign, double found, double gap)
{
    static waiting list[REACH_MOST + 2];
    size_t count = 0;
    double here = -INFINITY;
    waiting next[2] = {{.where = s->domain}};
    for (int pairs = 0, parts = 1; pairs < REACH_MOST; parts = 2) {
        for (int k = 0; k < parts; ++k, ++pairs) {
            next[k].widest = widest_of(s, &next[k].where);
            next[k].far = reach(s, &next[k].where, i, sign, &here, &next[k].widest);
            found = fmax(found, here);
            list[count++] = next[k];
        }
        const size_t best = farthest(list, count);
        const waiting w = list[best];
        if (w.far <= found + gap) return pairs;
        list[best] = list[--count];
        const double middle =
            w.where.lo[w.widest] + (w.where.hi[w.widest] - w.where.lo[w.widest]) / 2;
        next[0] = next[1] = w;
        next[0].where.hi[w.widest] = next[1].where.lo[w.widest] = middle;
    }
    return NAN;
}

double reach_pairs(const subject *s, double gap)
{
    extent e;
    double size = 0, sum = 0;
    if (s->n != 3 || !sample(s, &e)) return NAN;
    for (int i = 0; i < 3; ++i) size = fmax(size, e.hi[i] - e.lo[i]);
    for (int i = 0; i < 3; ++i)
        sum += pairs_to_end(s, i, 1, e.hi[i], gap * (size > 0 ? size : 1)) +
               pairs_to_end(s, i, -1, -e.lo[i], gap * (size > 0 ? size : 1));
    return sum / 6;
}
