/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/aim.h"

#include <math.h>
#include <string.h>

/* A side of a cell: all of its points, the middle of what was visited, and how these depend on the
 * variables, by slopes times half widths. Of many pieces the greatest dependence counts. */
typedef struct shape {
    const cell *of;
    size_t count; /* visits */
    double lo[3], hi[3], centre[3];
    double way[SLOPE_VARIABLES][3];  /* half of the width of a variable moves it by so much, */
    double blur[SLOPE_VARIABLES][3]; /* more or less */
    bool is_unbounded;
} shape;

static double width_of(range x) { return x.hi - x.lo; }

static void add_visit(void *context, const slope x[3], const range shift[CLAIM_CLOCKS])
{
    shape *s = context;
    for (int i = 0; i < 3; ++i) {
        s->lo[i] = s->count > 0 ? fmin(s->lo[i], x[i].v.lo) : x[i].v.lo;
        s->hi[i] = s->count > 0 ? fmax(s->hi[i], x[i].v.hi) : x[i].v.hi;
        s->centre[i] = range_middle(x[i].c);
        for (int k = 0; k < CLAIM_CLOCKS; ++k)
            if (slope_has(&x[i], 2 + k))
                s->centre[i] += range_middle(x[i].s[2 + k]) * range_middle(shift[k]);
        for (int j = 0; j < SLOPE_VARIABLES; ++j) {
            if (!slope_has(&x[i], j)) continue;
            const double r = 0.5 * width_of(j < 2 ? x[i].offset[j] : s->of->clocks[j - 2]);
            const double way = range_middle(x[i].s[j]) * r, blur = 0.5 * width_of(x[i].s[j]) * r;
            if (!(fabs(way) < INFINITY) || !(blur < INFINITY)) s->is_unbounded = true;
            if (fabs(way) + blur <= fabs(s->way[j][i]) + s->blur[j][i]) continue;
            s->way[j][i] = way, s->blur[j][i] = blur;
        }
    }
    s->count += 1;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* --- Axes ------------------------------------------------------------------------------------- */

/* The difference B - A: its middle, and how it depends on u, v of A, u, v of B, and the clocks. */
enum { WAYS = 4 + CLAIM_CLOCKS };
typedef struct difference {
    double centre[3], way[WAYS][3], blur[WAYS][3];
} difference;

static void take_difference(const shape s[2], difference *d)
{
    for (int i = 0; i < 3; ++i) {
        d->centre[i] = s[1].centre[i] - s[0].centre[i];
        for (int j = 0; j < WAYS; ++j) {
            const int own = j < 4 ? j % 2 : j - 2;
            const double a = j < 2 || j >= 4 ? 1 : 0, b = j >= 2 ? 1 : 0;
            d->way[j][i] = b * s[1].way[own][i] - a * s[0].way[own][i];
            d->blur[j][i] = b * s[1].blur[own][i] + a * s[0].blur[own][i];
        }
    }
}

/* How far variable j moves n.(B - A), at most. */
static double reach(const difference *d, int j, const double n[3])
{
    const double size[3] = {fabs(n[0]), fabs(n[1]), fabs(n[2])};
    return fabs(dot(d->way[j], n)) + dot(d->blur[j], size);
}

#define SLANT_LEAST 0.1

/* What the axis leaves between the sides beyond `apart`, as a share of what it leaves between their
 * middles. An axis that is far from across them leaves little for ever, however small the cells. */
static double left_over(const difference *d, const double n[3], double apart)
{
    const double gap = dot(d->centre, n);
    double used = apart * sqrt(dot(n, n));
    for (int j = 0; j < WAYS; ++j) used += reach(d, j, n);
    const double length = sqrt(dot(n, n)), straight = sqrt(dot(d->centre, d->centre)) - apart;
    const bool is_slant = !(gap - apart * length > SLANT_LEAST * straight * length);
    return gap > used || (gap > 0 && !is_slant) ? 1 - used / gap : -INFINITY;
}

/* Gilbert's method: the point of centre + sum [-1, 1] way_j nearest to the origin, whose direction
 * is the axis that leaves most between two sides that are linear. */
static void find_nearest(const difference *d, double x[3])
{
    enum { ROUNDS = 30 };
    memcpy(x, d->centre, sizeof d->centre);
    for (int k = 0; k < ROUNDS; ++k) {
        double y[3], step[3];
        memcpy(y, d->centre, sizeof y);
        for (int j = 0; j < WAYS; ++j)
            for (int i = 0; i < 3; ++i)
                y[i] -= dot(d->way[j], x) > 0 ? d->way[j][i] : -d->way[j][i];
        for (int i = 0; i < 3; ++i) step[i] = y[i] - x[i];
        const double square = dot(step, step), by = square > 0 ? -dot(x, step) / square : 0;
        if (!(by > 1e-9)) return;
        for (int i = 0; i < 3; ++i) x[i] += fmin(by, 1) * step[i];
    }
}

/* Rounds an axis; false: it has no direction. */
static bool shorten(const double n[3], int16_t axis[3])
{
    const double most = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    if (!(most > 0 && most < INFINITY)) return false;
    for (int i = 0; i < 3; ++i) axis[i] = (int16_t)lrint(n[i] / most * 32767);
    return true;
}

/* Adds the axis to those worth a test if it leaves enough; keeps the one that leaves most. */
static void try_axis(const difference *d, const double n[3], double apart, aim *found,
                     double best[3], double *most)
{
    int16_t axis[3];
    if (!shorten(n, axis)) return;
    const double rounded[3] = {axis[0], axis[1], axis[2]}, left = left_over(d, rounded, apart);
    if (left > 0 && found->count == 0) memcpy(found->axes[found->count++], axis, sizeof axis);
    if (!(left > *most)) return;
    *most = left;
    memcpy(best, rounded, sizeof rounded);
}

static void cross(const double a[3], const double b[3], const double towards[3], double n[3])
{
    for (int i = 0; i < 3; ++i)
        n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    const double sign = dot(n, towards) < 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i) n[i] *= sign;
}

static void find_axes(const difference *d, double apart, const int16_t *const known[2], aim *found,
                      double best[3])
{
    double most = -INFINITY, n[3];
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 3; ++i) n[i] = known[k][i];
        try_axis(d, n, apart, found, best, &most);
    }
    find_nearest(d, n);
    try_axis(d, n, apart, found, best, &most);
    for (int side = 0; side < 2; ++side) {
        cross(d->way[2 * side], d->way[2 * side + 1], d->centre, n);
        try_axis(d, n, apart, found, best, &most);
    }
    try_axis(d, d->centre, apart, found, best, &most);
}

/* --- Divisions -------------------------------------------------------------------------------- */

static bool can_divide(range x)
{
    const double middle = range_middle(x);
    return x.lo < middle && middle < x.hi;
}

/* Chooses the variable that counts for most; `weight` of u, v of A, u, v of B, and the clocks. */
static aim_cut widest(const pair *p, const cell *c, const double weight[WAYS])
{
    aim_cut best = {-1, 0};
    double most = -1;
    for (int j = 0; j < 4 + (int)p->of->clock_count; ++j) {
        const int side = j < 4 ? j / 2 : 2;
        const size_t along = (size_t)(j < 4 ? j % 2 : j - 4);
        const bool is_many = side < 2 && c->count[side] > 1;
        if (is_many ? along > 0 : !can_divide(side < 2 ? c->uv[side][along] : c->clocks[along]))
            continue;
        if (weight[j] > most) most = weight[j], best = (aim_cut){side, along};
    }
    return best;
}

/* Nothing is known of the cell: what is widest by its whole range. */
static aim_cut widest_range(const pair *p, const cell *c)
{
    double weight[WAYS] = {0};
    for (int side = 0; side < 2; ++side) {
        range all[2];
        leaf_box(p, side, c->first[side], all);
        for (int j = 0; j < 2; ++j)
            weight[2 * side + j] = c->count[side] > 1 ? (double)c->count[side]
                                   : width_of(all[j]) > 0
                                       ? width_of(c->uv[side][j]) / width_of(all[j])
                                       : 0;
    }
    for (size_t k = 0; k < p->of->clock_count; ++k) {
        const double all = width_of(p->of->clocks[k].all);
        weight[4 + k] = all > 0 ? width_of(c->clocks[k]) / all : 0;
    }
    return widest(p, c, weight);
}

/* What counts for a side of many pieces is the length of its box. */
static aim_cut choose(const pair *p, const cell *c, const shape s[2], const difference *d,
                      const double n[3])
{
    double weight[WAYS];
    const double length = sqrt(dot(n, n));
    for (int j = 0; j < WAYS; ++j) weight[j] = reach(d, j, n) / length;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3 && c->count[side] > 1; ++i)
            weight[2 * side] = fmax(weight[2 * side], 0.5 * (s[side].hi[i] - s[side].lo[i]));
    return widest(p, c, weight);
}

/* The middles of the boxes of sides of many pieces stand for their points. */
static void centre_boxes(const cell *c, shape s[2])
{
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3 && c->count[side] > 1; ++i) {
            const double half = 0.5 * (s[side].hi[i] - s[side].lo[i]);
            s[side].centre[i] = s[side].lo[i] + half;
            memset(s[side].way[0], 0, 2 * sizeof *s[side].way);
            memset(s[side].blur[0], 0, 2 * sizeof *s[side].blur);
            s[side].blur[0][i] = half;
        }
}

void aim_take(pair *p, const cell *c, const int16_t *const known[2], aim *found)
{
    shape s[2] = {{.of = c}, {.of = c}};
    difference d;
    double best[3] = {0, 0, 0};
    *found = (aim){.count = 0};
    const bool seen =
        leaf_visit(p, c, 0, add_visit, &s[0]) && leaf_visit(p, c, 1, add_visit, &s[1]);
    if (!seen || s[0].count == 0 || s[1].count == 0 || s[0].is_unbounded || s[1].is_unbounded) {
        static const int16_t any[3] = {1, 0, 0};
        const int16_t *axis =
            known[0][0] != 0 || known[0][1] != 0 || known[0][2] != 0 ? known[0] : any;
        if (seen) memcpy(found->axes[found->count++], axis, sizeof any);
        double between[3];
        for (int i = 0; i < 3; ++i)
            between[i] = 0.5 * (s[1].lo[i] + s[1].hi[i]) - 0.5 * (s[0].lo[i] + s[0].hi[i]);
        if (!shorten(between, found->best)) memset(found->best, 0, sizeof found->best);
        found->cut = widest_range(p, c);
        return;
    }
    centre_boxes(c, s);
    take_difference(s, &d);
    find_axes(&d, p->of->apart, known, found, best);
    if (found->count == 0 && (c->count[0] > 1 || c->count[1] > 1) && shorten(best, found->axes[0]))
        found->count = 1;
    if (!shorten(best, found->best)) memset(found->best, 0, sizeof found->best);
    found->cut = choose(p, c, s, &d, best);
    if (found->cut.side < 0) found->cut = widest_range(p, c); /* no axis was good enough */
}
