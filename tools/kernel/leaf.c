/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

static range offset_of(range x) { return range_sub(x, range_of(range_middle(x))); }
static void add_product(range *sum, range x, range y) { *sum = range_add(*sum, range_mul(x, y)); }

static stage *stage_of(const pair *p, int side, size_t k)
{
    return &p->of->stages[p->side[side]->stages[k]];
}

static const piece *piece_of(const pair *p, int side, size_t place)
{
    const uint32_t *order = p->order[side];
    return &stage_of(p, side, 0)->pieces[order != NULL ? order[place] : place];
}

void leaf_box(const pair *p, int side, size_t place, range uv[2])
{
    const piece *all = piece_of(p, side, place);
    for (int j = 0; j < 2; ++j) {
        uv[j] = all->parts[0].uv[j];
        for (size_t k = 1; k < all->count; ++k) uv[j] = range_hull(uv[j], all->parts[k].uv[j]);
    }
}

typedef struct visit {
    pair *p;
    int side;
    const part *parts[CLAIM_STAGES]; /* a choice: one of each stage */
    range all[SLOPE_VARIABLES];      /* u, v and the clocks of the cell, or fewer: those at which */
    bool whole;                      /* all parts exist */
    leaf_visitor *visit;
    void *context;
} visit;

/* Computes the formulas of the parts that were chosen, one after the other. */
static bool compute(visit *v)
{
    slope in[4], *x = in;
    for (int j = 0; j < SLOPE_VARIABLES; ++j) v->p->of->offset[j] = offset_of(v->all[j]);
    for (int j = 0; j < 2; ++j) x[j] = slope_variable(j, v->all[j], v->p->of->offset);
    for (size_t k = 0; k < v->p->side[v->side]->count; ++k) {
        stage *of = stage_of(v->p, v->side, k);
        const int clock = 2 + (int)of->clock, first = k == 0 ? 0 : 3;
        x[k == 0 ? 2 : 3] = slope_variable(clock, v->all[clock], v->p->of->offset);
        if (!expression_compute(v->parts[k]->f, &of->last, first, x, x))
            return v->p->why = "memory ran out", false;
        if (x[0].is_undefined || x[1].is_undefined || x[2].is_undefined)
            return v->p->why = "a formula may have no value there", false;
    }
    v->visit(v->context, x, v->whole);
    return true;
}

/* Chooses a part of each stage from number k on (of the shape, of a piece), where they exist. */
static bool choose(visit v, const piece *all, size_t k)
{
    if (k == v.p->side[v.side]->count) return compute(&v);
    if (++v.p->choices > 1 << 24) return v.p->why = "it has too many parts", false;
    if (k > 0) all = stage_of(v.p, v.side, k)->pieces;
    for (size_t i = 0; i < all->count; ++i) {
        const part *q = &all->parts[i];
        visit next = v;
        range *when = &next.all[2 + stage_of(v.p, v.side, k)->clock];
        const range clock = *when;
        *when = range_both(clock, q->t);
        for (int j = 0; j < 2 && k == 0; ++j) next.all[j] = range_both(v.all[j], q->uv[j]);
        bool some = when->lo <= when->hi;
        for (int j = 0; j < 2; ++j) some = some && next.all[j].lo <= next.all[j].hi;
        next.parts[k] = q;
        next.whole = v.whole && when->lo == clock.lo && when->hi == clock.hi;
        if (some && !choose(next, NULL, k + 1)) return false;
    }
    return true;
}

bool leaf_visit(pair *p, const cell *c, int side, leaf_visitor *visitor, void *context)
{
    visit v = {.p = p, .side = side, .whole = true, .visit = visitor, .context = context};
    p->choices = 0;
    for (size_t k = 0; k < p->of->clock_count; ++k) v.all[2 + k] = c->clocks[k];
    for (size_t k = 0; k < c->count[side]; ++k) {
        leaf_box(p, side, c->first[side] + k, v.all);
        for (int j = 0; j < 2 && c->count[side] == 1; ++j) v.all[j] = c->uv[side][j];
        if (!choose(v, piece_of(p, side, c->first[side] + k), 0)) return false;
    }
    return true;
}

void leaf_add(void *context, const slope x[3], bool whole)
{
    bound *b = context;
    slope sum = slope_fixed(range_of(0));
    for (int i = 0; i < 3; ++i) {
        const slope by = slope_fixed(range_of(b->n[i])), term = slope_product(&by, &x[i]);
        sum = slope_sum(&sum, &term);
    }
    range p = whole ? sum.c : sum.v;
    for (int j = 0; j < 2 && whole; ++j)
        if (slope_has(&sum, j)) add_product(&p, sum.s[j], sum.offset[j]);
    whole = whole && p.hi - p.lo < sum.v.hi - sum.v.lo; /* slopes say more */
    if (!whole) p = sum.v;
    b->all = b->some ? range_hull(b->all, sum.v) : sum.v;
    b->p = b->some ? range_hull(b->p, p) : p;
    for (int k = 0; k < CLAIM_CLOCKS; ++k) {
        const range s = whole && slope_has(&sum, 2 + k) ? sum.s[2 + k] : range_of(0);
        b->s[k] = b->some ? range_hull(b->s[k], s) : s;
    }
    b->some = true;
}

/* Lemma. |B - A| >= n.(B - A) / |n|, whose squares are compared. Of the second bound, the motion
 * that both share is taken out. A side that does not exist is apart. */
bool leaf_holds(const pair *p, const cell *c, const bound *a, const bound *b)
{
    const range n[3] = {range_of(a->n[0]), range_of(a->n[1]), range_of(a->n[2])};
    const range apart = range_of(p->of->apart);
    const double least = range_mul(range_square(n), range_mul(apart, apart)).hi;
    range gap = range_sub(b->p, a->p);
    for (size_t k = 0; k < p->of->clock_count; ++k)
        add_product(&gap, range_sub(b->s[k], a->s[k]), offset_of(c->clocks[k]));
    const double lo = fmax(gap.lo, range_sub(b->all, a->all).lo);
    return !a->some || !b->some || (lo > 0 && range_mul(range_of(lo), range_of(lo)).lo >= least);
}

bool leaf_point(pair *p, int side, range x[3])
{
    const point *at = &p->of->points[side];
    cell c = {.first = {at->piece, at->piece}, .count = {1, 1}};
    for (int j = 0; j < 2; ++j) c.uv[side][j] = range_of(at->uv[j]);
    for (size_t k = 0; k < p->of->clock_count; ++k) c.clocks[k] = range_of(p->of->clocks[k].at);
    for (int i = 0; i < 3; ++i) {
        bound b = {.n = {i == 0, i == 1, i == 2}};
        if (!leaf_visit(p, &c, side, leaf_add, &b) || !b.some) return false;
        x[i] = b.all;
    }
    return true;
}
