/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/enclose.h"

#include <math.h>
#include <stdlib.h>

/* --- Parts ------------------------------------------------------------------------------------ */

static bool holds(const part *p, const box3 *b)
{
    for (int j = 0; j < VARIABLES; ++j)
        if (!(p->lo[j] <= b->lo[j] && b->hi[j] <= p->hi[j])) return false;
    return true;
}

/* Finds the end of a part that is strictly inside of the box and nearest to its middle, so that a
 * table of many parts is divided in halves; false: there is none. */
static bool divides(const piece *p, const box3 *b, split *divide)
{
    double best = INFINITY;
    for (size_t k = 0; k < p->count; ++k)
        for (int j = 0; j < VARIABLES; ++j)
            for (int side = 0; side < 2; ++side) {
                const double end = side == 0 ? p->parts[k].lo[j] : p->parts[k].hi[j];
                const double off = fabs(0.5 * b->lo[j] + 0.5 * b->hi[j] - end);
                if (!(b->lo[j] < end && end < b->hi[j]) || !(off < best)) continue;
                *divide = (split){j, end};
                best = off;
            }
    return best < INFINITY;
}

const piece *enclose_piece(const place *p, size_t stage_index)
{
    const stage *g = &p->of->stages[p->chain->stages[stage_index]];
    return &g->pieces[stage_index == 0 ? p->piece : 0];
}

box3 place_box(const place *p, size_t stage_index, const box3 *where)
{
    const size_t clock = p->of->stages[p->chain->stages[stage_index]].clock;
    box3 own = *where;
    if (clock != p->when->main) own.lo[T] = p->when->lo[clock], own.hi[T] = p->when->hi[clock];
    return own;
}

/* Finds the part of a piece in which the whole box is. Lemma. Where there is none and no end of a
 * part is inside of the box, each part has at most a face in common with it; then neighbouring
 * boxes hold that face, since parts have a size (statement_stage.c), or it is an end of the claim's
 * times (touches_end), or nothing is there. */
enclosed enclose_choose_part(const piece *all, const box3 *own, const part **found, split *divide)
{
    for (size_t k = 0; k < all->count; ++k)
        if (holds(&all->parts[k], own)) return *found = &all->parts[k], ENCLOSED;
    return divides(all, own, divide) ? ENCLOSED_SPLIT : ENCLOSED_EMPTY;
}

enclosed enclose_choose(const place *p, size_t stage_index, const box3 *where, const part **found,
                        split *divide)
{
    const box3 own = place_box(p, stage_index, where);
    const enclosed result = enclose_choose_part(enclose_piece(p, stage_index), &own, found, divide);
    if (result == ENCLOSED_SPLIT && divide->along == T && !place_follows_main(p, stage_index))
        divide->along = VARIABLES + (int)p->of->stages[p->chain->stages[stage_index]].clock;
    return result;
}

/* Returns the next part after `p` that the whole box is in, or NULL: boxes without a size, and ends
 * that are known to an ulp, may be in several. */
const part *enclose_next_part(const piece *all, const part *p, const box3 *b)
{
    for (++p; p < all->parts + all->count; ++p)
        if (holds(p, b)) return p;
    return NULL;
}

/* Whether the part ends (side 1) or begins (0) at a time within the claim's, and no part of the
 * piece goes on there for all of its u and v. */
static bool ends_within(const piece *all, const part *p, const scene_clock *clock, int side)
{
    const double at = side == 1 ? p->hi[T] : p->lo[T];
    bool goes_on = false;
    for (size_t k = 0; k < all->count && !goes_on; ++k) {
        const part *q = &all->parts[k];
        goes_on = side == 1 ? q->lo[T] <= at && at < q->hi[T] : q->lo[T] < at && at <= q->hi[T];
        for (int j = 0; j < T; ++j)
            goes_on = goes_on && q->lo[j] <= p->lo[j] && p->hi[j] <= q->hi[j];
    }
    return clock->lo < at && at < clock->hi && !goes_on;
}

static bool begins_at(const stage *g, const scene_clock *clock, double at)
{
    for (size_t k = 0; k < g->count; ++k)
        for (size_t i = 0; i < g->pieces[k].count; ++i) {
            const part *p = &g->pieces[k].parts[i];
            if (p->lo[T] == at && ends_within(&g->pieces[k], p, clock, 0)) return true;
        }
    return false;
}

static bool ends_where_begins(const stage *a, const stage *b, const scene_clock *clock, double *at)
{
    for (size_t k = 0; k < a->count; ++k)
        for (size_t i = 0; i < a->pieces[k].count; ++i) {
            const part *p = &a->pieces[k].parts[i];
            *at = p->hi[T];
            if (ends_within(&a->pieces[k], p, clock, 1) && begins_at(b, clock, *at)) return true;
        }
    return false;
}

/* Lemma. Cells meet in a value of a clock, at which one cell may hold all of A and the other all of
 * B. That leaves no pair of points out unless A is not in the second cell and B not in the first:
 * where parts go on, they are continuous, and their points at that value are in either cell. */
bool enclose_ends_meet(const statement *s, const chain *a, const chain *b, double *at)
{
    const stage *of[2] = {&s->stages[a->stages[0]], &s->stages[b->stages[0]]};
    const scene_clock *clock = &s->clocks[of[0]->clock];
    return of[0]->clock == of[1]->clock && (ends_where_begins(of[0], of[1], clock, at) ||
                                            ends_where_begins(of[1], of[0], clock, at));
}

/* Returns whether a part of a surface begins when the claim ends, or ends when it begins, and the
 * box has a face in common with it: no neighbouring box holds that face. */
static bool touches_end(const place *p, const piece *all, const box3 *b)
{
    const scene_clock *clock = &p->of->clocks[p->of->stages[p->chain->stages[0]].clock];
    for (size_t k = 0; k < all->count; ++k) {
        const part *q = &all->parts[k];
        bool meets = q->lo[T] == clock->hi || q->hi[T] == clock->lo;
        for (int j = 0; j < VARIABLES; ++j)
            meets = meets && q->lo[j] <= b->hi[j] && b->lo[j] <= q->hi[j];
        if (meets) return true;
    }
    return false;
}

enclosed enclose_part(const place *p, const box3 *where, const part **found, split *divide)
{
    const piece *all = enclose_piece(p, 0);
    const box3 own = place_box(p, 0, where);
    const enclosed result = enclose_choose(p, 0, where, found, divide);
    return result == ENCLOSED_EMPTY && touches_end(p, all, &own) ? ENCLOSED_UNSAID : result;
}

/* --- Chains ----------------------------------------------------------------------------------- */

/* Computes a formula of an instance over its own box. Steps whose variables have not changed since
 * the last time are not computed again: most steps of a motion depend on time alone. */
static void compute_part(const place *p, size_t stage_index, const formula *f, const box3 *where,
                         const double at[3], formula_boxes *given, jet out[3], jet centre[3])
{
    memo unkept = {.value = p->room}, *m = &unkept;
    if (p->memos != NULL) m = &p->memos[p->chain->stages[stage_index]];
    given->is_first = m->of != f;
    given->changed = stage_index > 0 ? 7 : 0; /* x, y, z */
    for (int j = 0; j < VARIABLES; ++j) {
        const bool same =
            m->where.lo[j] == where->lo[j] && m->where.hi[j] == where->hi[j] && m->at[j] == at[j];
        if (!same && stage_index == 0) given->changed |= 1u << j;
        if (!same && stage_index > 0 && j == T) given->changed |= 8;
    }
    if (given->is_first && m != &unkept) {
        jet *grown = realloc(m->value, 2 * (size_t)formula_steps(f) * sizeof *grown);
        if (grown == NULL) m = &unkept;
        if (grown != NULL) m->value = grown;
    }
    m->of = f;
    m->where = *where;
    for (int j = 0; j < VARIABLES; ++j) m->at[j] = at[j];
    formula_jets_about(f, given, m->value, out, centre);
}

/* Computes a stage from its first part that the box is in, and from all others that it is in.
 * Lemma. A t that is the constant jet of all values of a clock, in the box and at its point, makes
 * jets that hold for each of the values: what encloses a function does so for each constant. */
static void compute(const place *p, size_t stage_index, const part *first, const box3 *in,
                    const box3 *where, const double at[3], formula_boxes *given, jet out[3],
                    jet centre[3])
{
    const box3 own = place_box(p, stage_index, where), own_in = place_box(p, stage_index, in);
    const bool follows = place_follows_main(p, stage_index);
    const double own_at[3] = {at[0], at[1], follows ? at[2] : INFINITY};
    compute_part(p, stage_index, first->f, &own, own_at, given, out, centre);
    const piece *all = enclose_piece(p, stage_index);
    for (const part *q = enclose_next_part(all, first, &own_in); q != NULL;
         q = enclose_next_part(all, q, &own_in)) {
        jet out2[3], centre2[3];
        compute_part(p, stage_index, q->f, &own, own_at, given, out2, centre2);
        for (int i = 0; i < 3; ++i) {
            out[i] = jet_hull(&out[i], &out2[i]);
            centre[i] = jet_hull(&centre[i], &centre2[i]);
        }
    }
}

static bool is_undefined(const jet x[3])
{
    return x[0].is_undefined || x[1].is_undefined || x[2].is_undefined;
}

/* Lets x, y and z be anything. */
static void forget(jet x[3])
{
    const ld_interval all = ld_interval_entire();
    for (int i = 0; i < 3; ++i) {
        x[i].on = (1 << VARIABLES) - 1;
        x[i].v = all;
        for (int j = 0; j < VARIABLES; ++j) {
            x[i].d[j] = all;
            for (int k = j; k < VARIABLES; ++k) x[i].h[j][k] = all;
        }
    }
}

/* Whether a stage follows a clock that has several values. */
static bool has_blur(const place *p)
{
    for (size_t k = 0; k <= p->maps; ++k) {
        const size_t clock = p->of->stages[p->chain->stages[k]].clock;
        if (clock != p->when->main && p->when->lo[clock] < p->when->hi[clock]) return true;
    }
    return false;
}

/* The t of a stage, over the box and at its point. */
static void take_clock(const place *p, size_t stage_index, const box3 *where, const jet *wide_t,
                       const jet *narrow_t, jet *wide, jet *narrow)
{
    const box3 own = place_box(p, stage_index, where);
    *wide = *wide_t, *narrow = *narrow_t;
    if (place_follows_main(p, stage_index)) return;
    *wide = *narrow = jet_constant(VARIABLES, ld_interval_make(own.lo[T], own.hi[T]));
    narrow->bends = 0;
}

enclosed enclose(const place *p, const box3 *where, const double at[3], jet out[3], jet centre[3],
                 split *divide)
{
    jet wide[4], narrow[4];
    ld_interval offset[BOX_DIMS];
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(where->lo[j], where->hi[j]);
        wide[j] = jet_variable(VARIABLES, j, all);
        narrow[j] = jet_variable(VARIABLES, j, ld_interval_of(at[j]));
        narrow[j].bends = 0;
        offset[j] = ld_interval_sub(all, ld_interval_of(at[j]));
    }
    formula_boxes given = {wide, narrow, offset, true, 0};
    const part *found;
    enclosed result = enclose_part(p, where, &found, divide);
    if (result != ENCLOSED) return result;
    const jet wide_t = wide[T], narrow_t = narrow[T];
    take_clock(p, 0, where, &wide_t, &narrow_t, &wide[T], &narrow[T]);
    compute(p, 0, found, where, where, at, &given, out, centre);
    bool undefined = is_undefined(out);
    const box3 times = {{-INFINITY, -INFINITY, where->lo[T]}, {INFINITY, INFINITY, where->hi[T]}};
    for (size_t k = 1; k <= p->maps && !is_undefined(centre); ++k) {
        for (int i = 0; i < 3; ++i) wide[i] = out[i], narrow[i] = centre[i];
        take_clock(p, k, where, &wide_t, &narrow_t, &wide[3], &narrow[3]);
        result = enclose_choose(p, k, &times, &found, divide);
        if (result != ENCLOSED) return result == ENCLOSED_EMPTY ? ENCLOSED_UNSAID : result;
        compute(p, k, found, &times, where, at, &given, out, centre);
        undefined = undefined || is_undefined(out);
    }
    if (is_undefined(centre)) {
        if (!has_blur(p)) return ENCLOSED_UNDEFINED;
        forget(centre); /* perhaps only at some values of a clock */
        undefined = true;
    }
    if (undefined) forget(out);
    return ENCLOSED;
}

void piece_box(const place *p, box3 *all)
{
    const piece *whole = enclose_piece(p, 0);
    for (int j = 0; j < T; ++j) {
        all->lo[j] = INFINITY, all->hi[j] = -INFINITY;
        for (size_t k = 0; k < whole->count; ++k) {
            if (whole->parts[k].lo[j] < all->lo[j]) all->lo[j] = whole->parts[k].lo[j];
            if (whole->parts[k].hi[j] > all->hi[j]) all->hi[j] = whole->parts[k].hi[j];
        }
    }
}
