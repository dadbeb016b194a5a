/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/sides.h"

#include <math.h>
#include <string.h>

typedef struct look {
    bound b;
    double reach[2];           /* what slopes by u and v leave open of n.x */
    double blur[CLAIM_CLOCKS]; /* what those by a clock leave open of it */
} look;

static double half_width(range x) { return 0.5 * (x.hi - x.lo); }

static void add_look(void *context, const slope x[3], const range shift[CLAIM_CLOCKS])
{
    look *l = context;
    double reach[SLOPE_VARIABLES] = {0}, moved[2] = {0};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < SLOPE_VARIABLES; ++j) {
            if (!slope_has(&x[i], j)) continue;
            const range o = j < 2 ? x[i].offset[j] : l->b.c->clocks[j - 2];
            const double by = l->b.n[i] * half_width(o);
            reach[j] += fabs(by) * half_width(x[i].s[j]);
            if (j < 2) moved[j] += by * range_middle(x[i].s[j]);
        }
    for (int j = 0; j < 2; ++j) {
        const double by = reach[j] + 1e-3 * fabs(moved[j]);
        l->reach[j] = by < INFINITY ? fmax(l->reach[j], by) : INFINITY; /* NaN, too */
    }
    for (int k = 0; k < CLAIM_CLOCKS; ++k) l->blur[k] = fmax(l->blur[k], reach[2 + k]);
    leaf_add(&l->b, x, shift);
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
static bool enclose_part(sides *s, pair *p, const cell *c, int side, side_part *made,
                         const int16_t axis[3])
{
    look l = {.b = {.p = p, .c = c, .n = {axis[0], axis[1], axis[2]}}};
    s->tests += 1;
    if (!leaf_visit(p, &made->of, side, add_look, &l)) return false;
    made->b = l.b;
    made->along = made->of.count[side] == 1 && is_longer_along_v(&l, p, &made->of, side);
    memcpy(made->blur, l.blur, sizeof made->blur);
    return true;
}

/* The bound of a side by its parts that are not divided. */
static void gather(const sides *s, int side, bound *all)
{
    int open[SIDES_PARTS], count = 1;
    open[0] = side;
    *all = s->parts[side].b;
    all->some = false;
    while (count > 0) {
        const side_part *q = &s->parts[open[--count]];
        if (q->half > 0) {
            open[count++] = q->half, open[count++] = q->half + 1;
            continue;
        }
        if (!q->b.some) continue;
        all->all = all->some ? range_hull(all->all, q->b.all) : q->b.all;
        for (unsigned k = 0; k >> q->b.p->of->clock_count == 0; ++k)
            all->at[k] = all->some ? range_hull(all->at[k], q->b.at[k]) : q->b.at[k];
        all->some = true;
    }
}

/* The part of a side that has the end which counts in a corner; *best: the end that parts without a
 * size would have. */
static int worst_part(const sides *s, int side, unsigned corner, double *best)
{
    const double sign = side == 0 ? 1 : -1;
    double most = -INFINITY;
    int worst = side;
    *best = -INFINITY;
    for (int k = 0; k < s->count; ++k) {
        const side_part *q = &s->parts[k];
        if (q->half > 0 || !q->b.some || q->side != side) continue;
        const double end = side == 0 ? q->b.at[corner].hi : -q->b.at[corner].lo;
        if (end > most) most = end, worst = k;
        *best = fmax(*best, sign * range_middle(q->b.at[corner]));
    }
    return worst;
}

static bool divide(sides *s, pair *p, const cell *c, int side, int k, const int16_t axis[3])
{
    cell half[2];
    side_part *q = &s->parts[k];
    trees_split(p, &q->of, side, (size_t)q->along, NAN, half);
    q->half = s->count;
    for (int i = 0; i < 2; ++i) {
        side_part *made = &s->parts[s->count++];
        *made = (side_part){.of = half[i], .side = side};
        if (!enclose_part(s, p, c, side, made, axis)) return false;
    }
    return true;
}

/* What an axis leaves between two sides whose bounds are known, in its worst corner. */
typedef struct gap {
    int worst[2];         /* part of each side */
    double loss[2], room; /* by the sizes of parts; without them */
    double mean;          /* of the room in all corners */
} gap;

static gap look_at_gap(const sides *s, const bound b[2], double least)
{
    gap g = {.mean = 0};
    const unsigned corners = 1U << b[0].p->of->clock_count;
    double lowest = INFINITY;
    for (unsigned corner = 0; corner < corners; ++corner) {
        double best[2];
        const int worst[2] = {worst_part(s, 0, corner, &best[0]),
                              worst_part(s, 1, corner, &best[1])};
        const double between = b[1].at[corner].lo - b[0].at[corner].hi;
        const double room = -best[1] - best[0] - least;
        g.mean += room / corners;
        if (!(between < lowest)) continue;
        lowest = between;
        g.room = room;
        for (int side = 0; side < 2; ++side) g.worst[side] = worst[side];
        g.loss[0] = b[0].at[corner].hi - best[0];
        g.loss[1] = -best[1] - b[1].at[corner].lo;
    }
    return g;
}

/* The clock that counts for most in two parts; *by: how much, by its size. */
static int worst_clock(const sides *s, const pair *p, const int parts[2], double *by)
{
    int clock = -1;
    *by = 0;
    for (int k = 0; k < (int)p->of->clock_count; ++k) {
        const double blur = s->parts[parts[0]].blur[k] + s->parts[parts[1]].blur[k];
        if (blur > *by) *by = blur, clock = k;
    }
    return clock;
}

/* The clock by which room differs most between the corners. */
static int moving_clock(const pair *p, const bound b[2])
{
    int clock = -1;
    double most = 0;
    for (unsigned k = 0; k < p->of->clock_count; ++k) {
        double moved = 0;
        for (unsigned corner = 0; corner >> p->of->clock_count == 0; ++corner) {
            const double sign = (corner >> k & 1) != 0 ? 1 : -1;
            moved += sign * (range_middle(b[1].at[corner]) - range_middle(b[0].at[corner]));
        }
        if (fabs(moved) > most) most = fabs(moved), clock = (int)k;
    }
    return clock;
}

bool sides_find(sides *s, pair *p, const cell *c, const int16_t axis[3])
{
    const double n[3] = {axis[0], axis[1], axis[2]};
    const double least = p->of->apart * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    s->count = 2, s->clock = -1, s->tests = 0;
    for (int side = 0; side < 2; ++side) {
        s->parts[side] = (side_part){.of = *c, .side = side};
        if (!enclose_part(s, p, c, side, &s->parts[side], axis)) return false;
    }
    for (;;) {
        bound b[2];
        double blur;
        for (int side = 0; side < 2; ++side) gather(s, side, &b[side]);
        if (leaf_holds(&b[0], &b[1])) return true;
        const gap g = look_at_gap(s, b, least);
        const int clock = worst_clock(s, p, g.worst, &blur);
        if (!(g.room > 0)) {
            if (g.mean > 0) s->clock = moving_clock(p, b);
            return false;
        }
        if (blur > (s->count < 12 ? 0.5 * (g.loss[0] + g.loss[1]) : g.room)) s->clock = clock;
        if (s->clock >= 0 || s->count + 2 > SIDES_PARTS) return false;
        /* What parts lose falls at least like 1 / count, as surfaces are smooth. */
        const double few = s->count / (double)SIDES_PARTS;
        if (s->count >= 12 && (g.loss[0] + g.loss[1]) * few > g.room) return false;
        const int side = g.loss[1] > g.loss[0], worst = g.worst[side];
        const side_part *q = &s->parts[worst];
        const range uv = q->of.uv[side][q->along];
        const double middle = range_middle(uv);
        const bool small = q->of.count[side] == 1 && !(uv.lo < middle && middle < uv.hi);
        if (small || !divide(s, p, c, side, worst, axis)) return false;
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
