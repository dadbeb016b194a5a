/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/enclose.h"

#include <math.h>
#include <stdlib.h>

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
