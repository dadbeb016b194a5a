/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "tools/verify/motion_internal.h"
#include "tools/verify/turn.h"

/* Lemma. A second derivative by two of x, y and z that is exactly 0 for all x, y and z (the whole
 * line), for all of which the map is defined, makes the map affine in them. */
static bool is_affine(const part *p, jet room[])
{
    jet variables[4] = {[3] = jet_constant(3, ld_interval_make(p->lo[T], p->hi[T]))}, out[3];
    bool is_one = true;
    for (int k = 0; k < 3; ++k) variables[k] = jet_variable(3, k, ld_interval_entire());
    formula_jets_in(p->f, variables, room, out);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            for (int l = k; l < 3; ++l) is_one = is_one && ld_interval_is(out[i].h[k][l], 0);
    return is_one && !out[0].is_undefined && !out[1].is_undefined && !out[2].is_undefined;
}

/* Notes what a shape is. A part without an end in time is looked at while the claim lasts. */
static void prepare_shape(const scene_clock *t, part *p, jet room[])
{
    const double lo[3] = {p->lo[U], p->lo[V], p->lo[T] > t->lo ? p->lo[T] : t->lo};
    const double hi[3] = {p->hi[U], p->hi[V], p->hi[T] < t->hi ? p->hi[T] : t->hi};
    p->is_moving = formula_depends(p->f, T);
    if (lo[T] <= hi[T]) p->net = net_of_formula(p->f, lo, hi);
    if (p->net == NULL && room != NULL) p->circle = circle_of_part(p, room);
}

void motion_prepare(statement *s)
{
    jet *room = malloc(((size_t)s->steps + 1) * sizeof *room);
    for (size_t k = 0; k < s->stage_count; ++k)
        for (size_t i = 0; i < s->stages[k].count; ++i)
            for (size_t j = 0; j < s->stages[k].pieces[i].count; ++j) {
                part *p = &s->stages[k].pieces[i].parts[j];
                if (!s->stages[k].is_map) prepare_shape(&s->clocks[s->stages[k].clock], p, room);
                p->is_affine = s->stages[k].is_map && room != NULL && is_affine(p, room);
                if (p->is_affine && formula_depends(p->f, T + 1))
                    p->turn = turn_of_map(p, &s->clocks[s->stages[k].clock], room);
            }
    free(room);
}

/* Steps that depend on time alone are computed once. */
void affine_take(const part *p, double lo, double hi, jet room[], affine *a)
{
    jet wide[4], centre[4], out[3], out_centre[3];
    const ld_interval t = ld_interval_make(lo, hi), at = ld_interval_of(middle(lo, hi));
    *a = (affine){.offset = {ld_interval_sub(t, at)}};
    wide[3] = jet_variable(1, 0, t), centre[3] = jet_variable(1, 0, at);
    centre[3].bends = 0;
    for (int c = 3; c >= 0; --c) {
        for (int i = 0; i < 3; ++i) wide[i] = centre[i] = jet_constant(1, ld_interval_of(i == c));
        const formula_boxes given = {wide, centre, a->offset, c == 3, 7};
        formula_jets_about(p->f, &given, room, out, out_centre);
        for (int i = 0; i < 3; ++i) {
            a->wide[i][c] = c < 3 ? jet_sub(&out[i], &a->wide[i][3]) : out[i];
            a->centre[i][c] = c < 3 ? jet_sub(&out_centre[i], &a->centre[i][3]) : out_centre[i];
        }
    }
}

static jet sum_of_products(const jet l[4], const jet r[3][4], int c, bool shifts)
{
    jet sum = jet_mul(&l[0], &r[0][c]);
    for (int k = 1; k < 3; ++k) {
        const jet term = jet_mul(&l[k], &r[k][c]);
        sum = jet_add(&sum, &term);
    }
    return c == 3 && shifts ? jet_add(&sum, &l[3]) : sum;
}

void affine_compose(const affine *then, affine *first, bool shifts)
{
    const affine was = *first;
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            first->wide[i][c] = sum_of_products(then->wide[i], was.wide, c, shifts);
            first->centre[i][c] = sum_of_products(then->centre[i], was.centre, c, shifts);
            jet_narrow(&first->wide[i][c], &first->centre[i][c], first->offset);
        }
}
