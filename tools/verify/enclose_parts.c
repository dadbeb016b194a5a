/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/enclose.h"

#include <math.h>

/* The parts of a formula: which of them a box is in, and where it has to be divided. */

static bool holds(const part *p, const box3 *b)
{
    for (int j = 0; j < VARIABLES; ++j)
        if (!(p->lo[j] <= b->lo[j] && b->hi[j] <= p->hi[j])) return false;
    return true;
}

/* Whether the part has points in common with the box beside its faces; where the box has no size,
 * at its face. */
static bool reaches_into(const part *p, const box3 *b)
{
    for (int j = 0; j < VARIABLES; ++j) {
        const bool has_size = b->lo[j] < b->hi[j];
        const double lo = proof_larger(p->lo[j], b->lo[j]), hi = proof_smaller(p->hi[j], b->hi[j]);
        if (has_size ? !(lo < hi) : !(lo <= hi)) return false;
    }
    return true;
}

/* Takes the end of a part that is strictly inside of the box, if it is nearer to its middle than
 * *best. */
static void take_nearer_end(const part *p, const box3 *b, split *divide, double *best)
{
    for (int j = 0; j < VARIABLES; ++j)
        for (int side = 0; side < 2; ++side) {
            const double end = side == 0 ? p->lo[j] : p->hi[j];
            const double off = fabs(0.5 * b->lo[j] + 0.5 * b->hi[j] - end);
            if (!(b->lo[j] < end && end < b->hi[j]) || !(off < *best)) continue;
            *divide = (split){j, end};
            *best = off;
        }
}

/* Finds the end of a part that is strictly inside of the box and nearest to its middle, so that a
 * table of many parts is divided in halves; false: there is none. */
static bool divides(const piece *p, const box3 *b, split *divide)
{
    double best = INFINITY;
    for (size_t k = 0; k < p->count; ++k) take_nearer_end(&p->parts[k], b, divide, &best);
    return best < INFINITY;
}

/* Finds such an end of those parts alone that reach into a box which another one holds. Lemma. A
 * part that reaches into the box holds it, or has an end strictly inside of it, along a variable of
 * which the box has a size. */
static bool divides_held(const piece *p, const box3 *b, split *divide)
{
    double best = INFINITY;
    for (size_t k = 0; k < p->count; ++k)
        if (reaches_into(&p->parts[k], b)) take_nearer_end(&p->parts[k], b, divide, &best);
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
 * times (touches_end), or nothing is there. Where there is one, others may reach into the box: of a
 * box without a size, such as a moment at which one part ends and a narrower one begins; beside an
 * end that is known to an ulp; or of curves. Then it is divided until each of them holds its box or
 * has at most a face in common with it. */
enclosed enclose_choose_part(const piece *all, const box3 *own, const part **found, split *divide)
{
    for (size_t k = 0; k < all->count; ++k) {
        if (!holds(&all->parts[k], own)) continue;
        *found = &all->parts[k];
        return divides_held(all, own, divide) ? ENCLOSED_SPLIT : ENCLOSED;
    }
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
