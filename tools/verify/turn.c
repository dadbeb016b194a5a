/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/turn.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "tools/proof/steps.h"

/* Time in the formula of a map; and the variables that stand for cos A and sin A. */
enum { TIME = 3, COSINE = 3, SINE = 4, LETTERS = 5 };

static bool is_wave(const step *s, int angle)
{
    return s->kind == STEP_FUNCTION && s->operand[0] == angle &&
           (s->function == jet_cos_ || s->function == jet_sin_);
}

/* Returns the formula with two numbers in place of cos A and sin A, in memory that the caller
 * frees; NULL: it depends on `variable` otherwise. Each step is marked in `depends` that does. */
static formula *put_numbers(const formula *f, int angle, int variable, bool depends[])
{
    const size_t size = offsetof(formula, steps) + (size_t)f->count * sizeof *f->steps;
    for (int k = 0; k < f->count; ++k) {
        const step *s = &f->steps[k];
        depends[k] = s->kind == STEP_VARIABLE && s->operand[0] == variable;
        for (int i = 0; i < s->count && !is_wave(s, angle); ++i)
            depends[k] = depends[k] || depends[s->operand[i]];
    }
    for (int i = 0; i < 3; ++i)
        if (depends[f->out[i]]) return NULL;
    formula *of = malloc(size);
    if (of == NULL) return NULL;
    memcpy(of, f, size);
    of->value = NULL;
    for (int k = 0; k < of->count; ++k) {
        step *s = &of->steps[k];
        if (!is_wave(s, angle)) continue;
        const int number = s->function == jet_cos_ ? COSINE : SINE;
        *s = (step){.kind = STEP_VARIABLE, .operand = {number}};
    }
    return of;
}

/* The numbers C and S, which are the last of these variables, are anything in [-2, 2]. */
static void take_numbers(ld_interval where[LETTERS])
{
    where[COSINE] = where[SINE] = ld_interval_make(-2, 2);
}

/* Whether the formula has a value everywhere in a box of its variables, and second derivatives that
 * are exactly 0, by the `count` variables from `first` on. */
static bool is_linear_in(const formula *of, const ld_interval where[LETTERS], int first, int count,
                         jet room[])
{
    jet variables[LETTERS], out[3];
    bool linear = true;
    for (int k = 0; k < LETTERS; ++k)
        variables[k] = k >= first && k < first + count ? jet_variable(count, k - first, where[k])
                                                       : jet_constant(count, where[k]);
    formula_jets_in(of, variables, room, out);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < count; ++k)
            for (int l = k; l < count; ++l)
                linear = linear && ld_interval_is(out[i].h[k][l], 0) && !out[i].is_undefined;
    return linear;
}

/* Computes the map of the unit vector c, or of 0 where c is 3. */
static void take_value(const formula *of, int c, double cosine, double sine, jet room[],
                       ld_interval x[3])
{
    const double at[LETTERS] = {c == 0, c == 1, c == 2, cosine, sine};
    jet variables[LETTERS], out[3];
    for (int k = 0; k < LETTERS; ++k) variables[k] = jet_constant(1, ld_interval_of(at[k]));
    formula_jets_in(of, variables, room, out);
    for (int i = 0; i < 3; ++i) x[i] = out[i].v;
}

static bool take_maps(const formula *of, jet room[], turning *to)
{
    ld_interval x[3][3][4]; /* at C and S of 0, C of 1, S of 1 */
    bool finite = true;
    for (int c = 3; c >= 0; --c)
        for (int m = 0; m < 3; ++m) {
            ld_interval value[3];
            take_value(of, c, m == 1, m == 2, room, value);
            for (int i = 0; i < 3; ++i) {
                x[m][i][c] = c < 3 ? ld_interval_sub(value[i], x[m][i][3]) : value[i];
                ld_interval *by = &to->m[m][i][c];
                *by = m > 0 ? ld_interval_sub(x[m][i][c], x[0][i][c]) : x[0][i][c];
                finite = finite && ld_interval_is_finite(*by);
            }
        }
    return finite;
}

/* How fast an angle changes, about: by its range over the times of the claim. */
static double rate_of(const part *p, int angle, const scene_clock *t, jet room[])
{
    jet variables[4], out[3];
    const double lo = proof_larger(p->lo[T], t->lo), hi = proof_smaller(p->hi[T], t->hi);
    for (int k = 0; k < TIME; ++k) variables[k] = jet_constant(1, ld_interval_of(0));
    variables[TIME] = jet_constant(1, ld_interval_make(lo < hi ? lo : hi, hi));
    formula_jets_in(p->f, variables, room, out);
    const double width = room[angle].v.hi - room[angle].v.lo;
    return lo < hi && width < INFINITY ? width / (hi - lo) : 0;
}

/* Lemma. Let cos A and sin A, of one step A that depends on t alone, be all by which a map depends
 * on t, and put any numbers C and S, |C|, |S| <= 2, in their place. If the second derivatives by x,
 * y and z are exactly 0 for all x, y, z, C and S, and so are those by C and S, and there is a value
 * everywhere, then the map is affine in (x, y, z) for each C and S, and affine in (C, S) for each
 * x, y, z. So it is m0 + C m1 + S m2, where m0 is the map at C = S = 0, m0 + m1 that at C = 1, S =
 * 0, and m0 + m2 that at C = 0, S = 1; these are affine, and found by where they take 0 and the
 * unit vectors. At each time at which A has a value, C = cos A and S = sin A. (Precondition: the
 * map has a value at all times of the part, as motion_prepare looks.) */
turning *turn_of_map(const part *p, const scene_clock *t, jet room[])
{
    const formula *f = p->f;
    const ld_interval all = ld_interval_entire();
    ld_interval where[LETTERS] = {all, all, all};
    bool *depends = calloc((size_t)f->count, sizeof *depends);
    turning *made = malloc(sizeof *made);
    bool found = false;
    take_numbers(where);
    for (int k = 0; k < f->count && depends != NULL && made != NULL && !found; ++k) {
        const int angle = f->steps[k].operand[0];
        if (!is_wave(&f->steps[k], angle) || f->steps[k].uses != 1U << TIME) continue;
        formula *of = put_numbers(f, angle, TIME, depends);
        if (of == NULL) continue;
        found = is_linear_in(of, where, 0, 3, room) && is_linear_in(of, where, COSINE, 2, room) &&
                take_maps(of, room, made);
        if (found) made->rate = rate_of(p, angle, t, room);
        free(of);
    }
    free(depends);
    if (!found) free(made);
    return found ? made : NULL;
}

/* Whether a shape has a value at all u, v and t of a part. */
static bool has_values(const part *p, jet room[])
{
    jet variables[VARIABLES], out[3];
    for (int k = 0; k < VARIABLES; ++k)
        variables[k] = jet_constant(1, ld_interval_make(p->lo[k], p->hi[k]));
    formula_jets_in(p->f, variables, room, out);
    return !out[0].is_undefined && !out[1].is_undefined && !out[2].is_undefined;
}

/* Lemma. Where a shape has a value at all u, v and t of a part, and depends on u through cos A and
 * sin A alone, A being a step that depends on u alone; and where, with numbers C and S in their
 * place, its second derivatives by C and S are exactly 0 for all v and t of the part: it is s0 + C
 * s1 + S s2, s0 being what it is at C = S = 0, s0 + s1 at C = 1, S = 0, s0 + s2 at C = 0, S = 1. */
circle *circle_of_part(const part *p, jet room[])
{
    const formula *f = p->f;
    ld_interval where[LETTERS];
    bool *depends = calloc((size_t)f->count, sizeof *depends);
    circle *made = calloc(1, sizeof *made);
    bool found = false;
    take_numbers(where);
    for (int k = 0; k < VARIABLES; ++k) where[k] = ld_interval_make(p->lo[k], p->hi[k]);
    const bool can_be = depends != NULL && made != NULL && has_values(p, room);
    for (int k = 0; k < f->count && can_be && !found; ++k) {
        const int angle = f->steps[k].operand[0];
        if (!is_wave(&f->steps[k], angle) || f->steps[k].uses != 1U << U) continue;
        free(made->with_numbers);
        made->with_numbers = put_numbers(f, angle, U, depends);
        found =
            made->with_numbers != NULL && is_linear_in(made->with_numbers, where, COSINE, 2, room);
    }
    free(depends);
    if (found) return made;
    circle_free(made);
    return NULL;
}

void circle_free(circle *c)
{
    if (c != NULL) free(c->with_numbers);
    free(c);
}

void circle_take(const circle *c, const box3 *where, const double at[3], jet room[],
                 jet wide[CIRCLE_PARTS][3], jet centre[CIRCLE_PARTS][3])
{
    jet over[LETTERS], middle_of_box[LETTERS];
    ld_interval offset[BOX_DIMS];
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(where->lo[j], where->hi[j]);
        over[j] = jet_variable(VARIABLES, j, all);
        middle_of_box[j] = jet_variable(VARIABLES, j, ld_interval_of(at[j]));
        middle_of_box[j].bends = 0;
        offset[j] = ld_interval_sub(all, ld_interval_of(at[j]));
    }
    for (int m = 0; m < CIRCLE_PARTS; ++m) {
        for (int k = COSINE; k <= SINE; ++k)
            over[k] = middle_of_box[k] =
                jet_constant(VARIABLES, ld_interval_of(m == 1 + k - COSINE));
        const formula_boxes given = {over, middle_of_box, offset, true, 0};
        formula_jets_about(c->with_numbers, &given, room, wide[m], centre[m]);
        for (int i = 0; i < 3 && m > 0; ++i) {
            wide[m][i] = jet_sub(&wide[m][i], &wide[0][i]);
            centre[m][i] = jet_sub(&centre[m][i], &centre[0][i]);
        }
    }
}
