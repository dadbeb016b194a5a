/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/sides.h"

#include <math.h>

typedef struct look {
    bound b;
    double reach[2];             /* what slopes by u and v leave open of n.x */
    double missed[CLAIM_CLOCKS]; /* how far clocks move n.x where slopes by them are not used */
} look;

static double half_width(range x) { return 0.5 * (x.hi - x.lo); }

static void add_look(void *context, const slope x[3], bool whole)
{
    look *l = context;
    double reach[SLOPE_VARIABLES] = {0}, moved[SLOPE_VARIABLES] = {0};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < SLOPE_VARIABLES; ++j) {
            if (!slope_has(&x[i], j)) continue;
            const double by = l->b.n[i] * half_width(x[i].offset[j]);
            reach[j] += fabs(by) * half_width(x[i].s[j]);
            moved[j] += by * range_middle(x[i].s[j]);
        }
    for (int j = 0; j < 2; ++j) {
        const double by = reach[j] + 1e-3 * fabs(moved[j]);
        l->reach[j] = by < INFINITY ? fmax(l->reach[j], by) : INFINITY; /* NaN, too */
    }
    for (int k = 0; k < CLAIM_CLOCKS && !whole; ++k)
        l->missed[k] = fmax(l->missed[k], reach[2 + k] + fabs(moved[2 + k]));
    leaf_add(&l->b, x, whole);
}

/* Where a slope is not bounded, the share of the surface's range counts. */
static bool is_longer_along_v(const look *l, const pair *p, const cell *c, int side)
{
    range all[2];
    if (l->reach[0] + l->reach[1] < INFINITY) return l->reach[1] > l->reach[0];
    leaf_box(p, side, c->first[side], all);
    return half_width(c->uv[side][1]) * half_width(all[0]) >
           half_width(c->uv[side][0]) * half_width(all[1]);
}

/* Encloses a part, and notes along what it is to be divided; false: it has no value. */
static bool enclose_part(sides *s, pair *p, int side, side_part *made, const int16_t axis[3])
{
    look l = {.b = {.n = {axis[0], axis[1], axis[2]}}};
    s->tests += 1;
    if (!leaf_visit(p, &made->of, side, add_look, &l)) return false;
    made->b = l.b;
    made->along = made->of.count[side] == 1 && is_longer_along_v(&l, p, &made->of, side);
    for (int k = 0; k < CLAIM_CLOCKS; ++k) made->missed[k] = l.missed[k];
    return true;
}

/* The bound of a side by its parts that are not divided; *worst: the part that has the end of p
 * which counts; *best: the end that parts without a size would have. */
static void gather(const sides *s, int side, bound *all, int *worst, double *best)
{
    const double sign = side == 0 ? 1 : -1;
    double most = -INFINITY;
    int open[SIDES_PARTS], count = 1;
    open[0] = side;
    *all = (bound){.n = {s->parts[side].b.n[0], s->parts[side].b.n[1], s->parts[side].b.n[2]}};
    *best = -INFINITY;
    while (count > 0) {
        const int k = open[--count];
        const side_part *q = &s->parts[k];
        if (q->half > 0) {
            open[count++] = q->half, open[count++] = q->half + 1;
            continue;
        }
        if (!q->b.some) continue;
        const double end = side == 0 ? q->b.p.hi : -q->b.p.lo;
        if (end > most) most = end, *worst = k;
        *best = fmax(*best, sign * range_middle(q->b.p));
        all->all = all->some ? range_hull(all->all, q->b.all) : q->b.all;
        all->p = all->some ? range_hull(all->p, q->b.p) : q->b.p;
        for (int i = 0; i < CLAIM_CLOCKS; ++i)
            all->s[i] = all->some ? range_hull(all->s[i], q->b.s[i]) : q->b.s[i];
        all->some = true;
    }
}

static bool divide(sides *s, pair *p, int side, int k, const int16_t axis[3])
{
    cell half[2];
    side_part *q = &s->parts[k];
    trees_split(p, &q->of, side, (size_t)q->along, NAN, half);
    q->half = s->count;
    for (int i = 0; i < 2; ++i) {
        side_part *made = &s->parts[s->count++];
        *made = (side_part){.of = half[i]};
        if (!enclose_part(s, p, side, made, axis)) return false;
    }
    return true;
}

/* How much the clocks take from the gap; *most: the clock that takes most. */
static double taken_by_clocks(const pair *p, const cell *c, const bound b[2], int *most)
{
    double all = 0, greatest = 0;
    *most = -1;
    for (size_t k = 0; k < p->of->clock_count; ++k) {
        const double lo = b[1].s[k].lo - b[0].s[k].hi, hi = b[1].s[k].hi - b[0].s[k].lo;
        const double takes = fmax(fabs(lo), fabs(hi)) * half_width(c->clocks[k]);
        all += takes;
        if (takes > greatest) greatest = takes, *most = (int)k;
    }
    return all;
}

bool sides_find(sides *s, pair *p, const cell *c, const int16_t axis[3])
{
    const double n[3] = {axis[0], axis[1], axis[2]};
    const double least = p->of->apart * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    s->count = 2, s->clock = -1, s->tests = 0;
    for (int side = 0; side < 2; ++side) {
        s->parts[side] = (side_part){.of = *c};
        if (!enclose_part(s, p, side, &s->parts[side], axis)) return false;
    }
    for (;;) {
        bound b[2];
        int worst[2] = {0, 1}, clock;
        double best[2];
        for (int side = 0; side < 2; ++side) gather(s, side, &b[side], &worst[side], &best[side]);
        if (leaf_holds(p, c, &b[0], &b[1])) return true;
        const double by_clocks = taken_by_clocks(p, c, b, &clock);
        const double room = -best[1] - best[0] - least;
        if (!(room > 0)) return false;
        const double loss[2] = {b[0].p.hi - best[0], -best[1] - b[1].p.lo};
        for (int k = 0; k < CLAIM_CLOCKS; ++k) {
            const double missed = s->parts[worst[0]].missed[k] + s->parts[worst[1]].missed[k];
            if (missed > 0.5 * (loss[0] + loss[1])) s->clock = k;
        }
        if (by_clocks > room && by_clocks < 2 * room && by_clocks > loss[0] + loss[1])
            s->clock = clock;
        if (s->clock >= 0 || s->count + 2 > SIDES_PARTS) return false;
        const int side = loss[1] > loss[0];
        const side_part *q = &s->parts[worst[side]];
        const range uv = q->of.uv[side][q->along];
        const double middle = range_middle(uv);
        const bool small = q->of.count[side] == 1 && !(uv.lo < middle && middle < uv.hi);
        if (small || !divide(s, p, side, worst[side], axis)) return false;
    }
}

static size_t write_part(const sides *s, int k, uint8_t *entries)
{
    const side_part *q = &s->parts[k];
    entries[0] = q->half > 0 ? (uint8_t)q->along : TREES_WHOLE;
    if (q->half == 0) return 1;
    const size_t first = write_part(s, q->half, entries + 1);
    return 1 + first + write_part(s, q->half + 1, entries + 1 + first);
}

size_t sides_write(const sides *s, int side, uint8_t entries[SIDES_PARTS])
{
    return write_part(s, side, entries);
}
