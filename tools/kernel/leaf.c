/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

#include <string.h>

static range middle_of(range x) { return range_of(range_middle(x)); }
static range offset_of(range x) { return range_sub(x, middle_of(x)); }
static double width(range x) { return x.hi - x.lo; }
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
    const piece *shape;
    range all[SLOPE_VARIABLES]; /* u, v and the clocks, at which parts are visited */
    range shift[CLAIM_CLOCKS];  /* the cell's middles less those of the clocks in `all` */
    leaf_visitor *visit;
    void *context;
} visit;

/* Lemma. The hull of what two parts give, at equal values, contains both. Answers whether it is
 * hardly wider than each, as where the parts of a motion meet. */
static bool join(const slope *x, const slope *y, slope *both)
{
    *both = (slope){.on = x->on | y->on, .offset = x->on != 0 ? x->offset : y->offset};
    both->v = range_hull(x->v, y->v), both->c = range_hull(x->c, y->c);
    for (int j = 0; j < SLOPE_VARIABLES; ++j) both->s[j] = range_hull(x->s[j], y->s[j]);
    return width(both->v) <= 1.01 * fmin(width(x->v), width(y->v));
}

/* Visits what stages from number k on make of the slopes before: each part that exists at all of
 * these values. */
static bool apply(const visit *v, size_t k, const slope before[3])
{
    if (k == v->p->side[v->side]->count) return v->visit(v->context, before, v->shift), true;
    stage *of = stage_of(v->p, v->side, k);
    const piece *all = k == 0 ? v->shape : of->pieces;
    const int clock = 2 + (int)of->clock, first = k == 0 ? 0 : 3;
    range *offset = v->p->of->offset;
    slope in[4], x[3], both[3], some[3];
    bool any = false;
    for (int j = 0; j < 3 && k > 0; ++j) in[j] = before[j];
    in[k == 0 ? 2 : 3] = slope_variable(clock, v->all[clock], offset);
    for (const part *q = all->parts; q < all->parts + all->count; ++q) {
        bool exists = q->t.lo <= v->all[clock].lo && v->all[clock].hi <= q->t.hi;
        for (int j = 0; j < 2 && k == 0; ++j) {
            const range uv = range_both(v->all[j], q->uv[j]);
            exists = exists && uv.lo <= uv.hi;
            offset[j] = offset_of(uv);
            in[j] = slope_variable(j, uv, offset);
        }
        if (!exists) continue;
        if (++v->p->choices > 1 << 24) return v->p->why = "it has too many parts", false;
        if (!expression_compute(q->f, &of->last, first, in, x) || x[0].is_undefined ||
            x[1].is_undefined || x[2].is_undefined)
            return v->p->why = "a formula may have no value there, or memory ran out", false;
        bool near = any;
        for (int i = 0; i < 3 && near; ++i) near = join(&some[i], &x[i], &both[i]);
        if (any && !near && !apply(v, k + 1, some)) return false;
        memcpy(some, near ? both : x, sizeof some);
        any = k > 0; /* parts of a shape have offsets of their own */
        if (!any && !apply(v, 1, x)) return false;
    }
    return !any || apply(v, k + 1, some);
}

/* Returns the first end of a part, by a clock, that is `from` or above it. */
static double next_end(const visit *v, size_t clock, double from)
{
    double next = INFINITY;
    for (size_t k = 0; k < v->p->side[v->side]->count; ++k) {
        const stage *of = stage_of(v->p, v->side, k);
        const piece *all = k == 0 ? v->shape : of->pieces;
        for (size_t i = 0; i < all->count && of->clock == clock; ++i) {
            const range t = all->parts[i].t;
            next = fmin(next, t.lo >= from ? t.lo : t.hi >= from ? t.hi : INFINITY);
        }
    }
    return next;
}

/* Lemma. Each value of a clock is an end of a part, or is in a set from one end to the next, at all
 * of which the parts exist that exist at the value. So ends and such sets miss nothing. */
static bool divide(visit v, size_t k, const cell *c)
{
    if (k == v.p->of->clock_count) return apply(&v, 0, NULL);
    range *x = &v.all[2 + k], all = c->clocks[k];
    *x = range_of(all.lo);
    for (bool is_point = true;; is_point = !is_point) {
        if (!is_point || all.lo == all.hi || next_end(&v, k, x->lo) == x->lo) {
            v.p->of->offset[2 + k] = offset_of(*x);
            v.shift[k] = range_sub(middle_of(all), middle_of(*x));
            if (!divide(v, k + 1, c)) return false;
        }
        if (is_point && x->hi == all.hi) return true;
        x->lo = x->hi;
        if (is_point) x->hi = fmin(next_end(&v, k, nextafter(x->lo, INFINITY)), all.hi);
    }
}

bool leaf_visit(pair *p, const cell *c, int side, leaf_visitor *visitor, void *context)
{
    visit v = {.p = p, .side = side, .visit = visitor, .context = context};
    p->choices = 0;
    for (size_t k = 0; k < c->count[side]; ++k) {
        const size_t place = c->first[side] + k;
        v.shape = piece_of(p, side, place);
        leaf_box(p, side, place, v.all);
        for (int j = 0; j < 2 && c->count[side] == 1; ++j) v.all[j] = c->uv[side][j];
        if (!divide(v, 0, c)) return false;
    }
    return true;
}

/* Lemma. What is in c + sum_j s_j o_j, o_j being offsets from the middles of the values at which it
 * was visited, is in c + sum_k s_k shift_k + sum_j s_j o'_j, clocks' from the cell's middles.
 * Its ends are convex functions of these, and so is the greatest of several. At any values it is at
 * most the mean of what it is in the corners, with weights that depend on the values alone. */
void leaf_add(void *context, const slope x[3], const range shift[CLAIM_CLOCKS])
{
    bound *b = context;
    slope sum = slope_fixed(range_of(0));
    for (int i = 0; i < 3; ++i) {
        const slope by = slope_fixed(range_of(b->n[i])), term = slope_product(&by, &x[i]);
        sum = slope_sum(&sum, &term);
    }
    range p = sum.c;
    for (int j = 0; j < SLOPE_VARIABLES; ++j)
        if (slope_has(&sum, j)) add_product(&p, sum.s[j], j < 2 ? sum.offset[j] : shift[j - 2]);
    const bool is_useful = width(p) < width(sum.v); /* slopes say more */
    b->all = b->some ? range_hull(b->all, sum.v) : sum.v;
    for (unsigned corner = 0; corner >> b->p->of->clock_count == 0; ++corner) {
        range at = is_useful ? p : sum.v;
        for (int k = 0; k < CLAIM_CLOCKS && is_useful; ++k) {
            const range o = offset_of(b->c->clocks[k]);
            if (!slope_has(&sum, 2 + k)) continue;
            add_product(&at, sum.s[2 + k], range_of((corner >> k & 1) != 0 ? o.hi : o.lo));
        }
        b->at[corner] = b->some ? range_hull(b->at[corner], at) : at;
    }
    b->some = true;
}

/* Lemma. |B - A| >= n.(B - A) / |n|, whose squares are compared. A side that does not exist is
 * apart. */
bool leaf_holds(const bound *a, const bound *b)
{
    const range n[3] = {range_of(a->n[0]), range_of(a->n[1]), range_of(a->n[2])};
    const range apart = range_of(a->p->of->apart);
    const double least = range_mul(range_square(n), range_mul(apart, apart)).hi;
    double gap = INFINITY;
    for (unsigned corner = 0; corner >> a->p->of->clock_count == 0; ++corner)
        gap = fmin(gap, range_sub(b->at[corner], a->at[corner]).lo);
    const double lo = fmax(gap, range_sub(b->all, a->all).lo);
    return !a->some || !b->some || (lo > 0 && range_mul(range_of(lo), range_of(lo)).lo >= least);
}

bool leaf_point(pair *p, int side, range x[3])
{
    const point *at = &p->of->points[side];
    cell c = {.first = {at->piece, at->piece}, .count = {1, 1}};
    for (int j = 0; j < 2; ++j) c.uv[side][j] = range_of(at->uv[j]);
    for (size_t k = 0; k < p->of->clock_count; ++k) c.clocks[k] = range_of(p->of->clocks[k].at);
    for (int i = 0; i < 3; ++i) {
        bound b = {.p = p, .c = &c, .n = {i == 0, i == 1, i == 2}};
        if (!leaf_visit(p, &c, side, leaf_add, &b) || !b.some) return false;
        x[i] = b.all;
    }
    return true;
}
