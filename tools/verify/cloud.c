/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/cloud.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double half_width(range x) { return 0.5 * (x.hi - x.lo); }

/* --- Points ----------------------------------------------------------------------------------- */

typedef struct patch {
    cell of;
    double size[2]; /* how far u and v move its points, by slopes */
} patch;

typedef struct sampling {
    cloud *to;
    int side;
    patch *of;
    int slot; /* of four points; -1: they are added */
} sampling;

/* Corners of parts are taken so far from their middles: where a surface is bent, those of its
 * tangents are outside of it. */
#define INWARD 0.5

/* Where coordinate i is at a corner of u and v (bits 0 and 1) and one of the clocks. */
static double place(const sampling *s, const slope *x, const range *shift, unsigned uv,
                    unsigned corner)
{
    double at = range_middle(x->c);
    for (int j = 0; j < SLOPE_VARIABLES; ++j) {
        if (!slope_has(x, j)) continue;
        const unsigned bit = j < 2 ? uv >> j & 1 : corner >> (j - 2) & 1;
        const double half = half_width(j < 2 ? x->offset[j] : s->to->of->clocks[j - 2]);
        const double away = j < 2 ? 0 : range_middle(shift[j - 2]);
        const double reach = j < 2 ? INWARD * half : half;
        at += range_middle(x->s[j]) * (away + (bit != 0 ? reach : -reach));
    }
    return at;
}

static void add_points(void *context, const slope x[3], const range shift[CLAIM_CLOCKS])
{
    const sampling *s = context;
    cloud *l = s->to;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i)
            if (slope_has(&x[i], j)) {
                const double widest = fmax(fabs(x[i].s[j].lo), fabs(x[i].s[j].hi));
                s->of->size[j] = fmax(s->of->size[j], widest * half_width(x[i].offset[j]));
            }
    const size_t first = s->slot >= 0 ? 4 * (size_t)s->slot : l->count[s->side];
    for (unsigned uv = 0; uv < 4 && first + 4 <= CLOUD_POINTS; ++uv) {
        const size_t k = first + uv;
        for (unsigned corner = 0; corner < l->corners; ++corner)
            for (int i = 0; i < 3; ++i)
                l->x[s->side][k][corner][i] = place(s, &x[i], shift, uv, corner);
    }
    if (first + 4 <= CLOUD_POINTS && first + 4 > l->count[s->side]) l->count[s->side] = first + 4;
}

static bool sample(cloud *l, pair *p, int side, patch *of, int slot)
{
    sampling s = {l, side, of, slot};
    of->size[0] = of->size[1] = 0;
    l->tests += 1;
    return leaf_visit(p, &of->of, side, add_points, &s);
}

/* Divides the part that is longest until there are enough, and takes their points. */
static bool take_side(cloud *l, pair *p, const cell *c, int side)
{
    patch parts[CLOUD_PARTS] = {{.of = *c}};
    int count = 1;
    if (c->count[side] > CLOUD_POINTS / 4) return false;
    if (c->count[side] > 1) return sample(l, p, side, &parts[0], -1);
    if (!sample(l, p, side, &parts[0], 0)) return false;
    while (count < CLOUD_PARTS) {
        int longest = 0;
        cell half[2];
        for (int k = 1; k < count; ++k)
            if (fmax(parts[k].size[0], parts[k].size[1]) >
                fmax(parts[longest].size[0], parts[longest].size[1]))
                longest = k;
        const patch *q = &parts[longest];
        trees_split(p, &q->of, side, q->size[1] > q->size[0], NAN, half);
        parts[longest].of = half[0];
        parts[count].of = half[1];
        if (!sample(l, p, side, &parts[longest], longest) ||
            !sample(l, p, side, &parts[count], count))
            return false;
        ++count;
    }
    return true;
}

/* --- The axis --------------------------------------------------------------------------------- */

/* The difference of two points, B - A, in corners from `first` on, that is least along n. */
static double lowest(const cloud *l, unsigned first, unsigned behind, const double n[3],
                     double least[3])
{
    double most = INFINITY;
    for (unsigned corner = first; corner < behind; ++corner) {
        size_t at[2] = {0, 0};
        double end[2] = {-INFINITY, -INFINITY};
        for (int side = 0; side < 2; ++side)
            for (size_t k = 0; k < l->count[side]; ++k) {
                const double along = dot(l->x[side][k][corner], n);
                const double x = side == 0 ? along : -along;
                if (x > end[side]) end[side] = x, at[side] = k;
            }
        if (!(-end[1] - end[0] < most)) continue;
        most = -end[1] - end[0];
        for (int i = 0; i < 3; ++i)
            least[i] = l->x[1][at[1]][corner][i] - l->x[0][at[0]][corner][i];
    }
    return most;
}

/* Gilbert's method: the point nearest to the origin among the differences, and those between.
 * Writes the direction that leaves most, of those seen; returns what it leaves. */
static double find_axis(const cloud *l, unsigned first, unsigned behind, double axis[3])
{
    enum { ROUNDS = 200 };
    double x[3] = {0, 0, 0}, y[3], best = -INFINITY;
    for (int i = 0; i < 3; ++i) x[i] = l->x[1][0][first][i] - l->x[0][0][first][i];
    for (int k = 0; k < ROUNDS; ++k) {
        double step[3];
        const double length = sqrt(dot(x, x));
        if (!(length > 0 && length < INFINITY)) break;
        const double leaves = lowest(l, first, behind, x, y) / length;
        if (leaves > best) {
            best = leaves;
            memcpy(axis, x, sizeof x);
        }
        for (int i = 0; i < 3; ++i) step[i] = y[i] - x[i];
        const double square = dot(step, step), by = square > 0 ? -dot(x, step) / square : 0;
        if (!(by > 1e-9) || length - leaves < 1e-3 * length) break;
        for (int i = 0; i < 3; ++i) x[i] += fmin(by, 1) * step[i];
    }
    return best;
}

void cloud_find(cloud *l, pair *p, const cell *c)
{
    double axis[3] = {0, 0, 0}, other[3];
    l->of = c;
    l->corners = 1U << p->of->clock_count;
    if (l->corners > CLOUD_CORNERS) l->corners = CLOUD_CORNERS;
    l->count[0] = l->count[1] = l->tests = 0;
    l->room = l->always = -INFINITY;
    for (int side = 0; side < 2; ++side)
        if (!take_side(l, p, c, side) || l->count[side] == 0) return;
    l->room = find_axis(l, 0, l->corners, axis) - p->of->apart;
    l->always = INFINITY;
    for (unsigned corner = 0; corner < l->corners; ++corner)
        l->always = fmin(l->always, find_axis(l, corner, corner + 1, other) - p->of->apart);
    const double most = fmax(fabs(axis[0]), fmax(fabs(axis[1]), fabs(axis[2])));
    if (!(most > 0 && most < INFINITY)) l->room = -INFINITY;
    for (int i = 0; i < 3 && l->room > -INFINITY; ++i)
        l->axis[i] = (int16_t)lrint(axis[i] / most * 32767);
}
