/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/apart_internal.h"

/* Limits of divisions of a side's boxes, along one axis and about a centre. A centre may prove all
 * of a surface at once, and is worth more. */
enum { REFINEMENTS = 96, REFINEMENTS_ROUND = 1024 };

apart_outcome apart_fail(prover *p, const cell *c, double found, const char *why)
{
    p->worst = *c;
    p->found = found;
    p->why = why;
    return STUCK;
}

ld_interval apart_length(const ld_interval x[3])
{
    const ld_interval sum = ld_interval_add(
        ld_interval_add(ld_interval_sqr(x[0]), ld_interval_sqr(x[1])), ld_interval_sqr(x[2]));
    return ld_interval_sqrt(sum);
}

static void take_aims(prover *p, const cell *c, const double n[3], aim a[2])
{
    place of;
    const box3 where = cell_area(p, c, 0, 0, &of);
    const kept *k = kept_look(p->kept, &of, &where);
    double slope = 0;
    for (int i = 0; i < 3 && k->result == ENCLOSED; ++i)
        slope += n[i] * ld_interval_mid(k->centre[i].d[T]);
    if (!(fabs(slope) < INFINITY)) slope = 0;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;
        a[side] = (aim){
            {sign * n[0], sign * n[1], sign * n[2]}, sign * slope, middle(c->t[0], c->t[1]), NULL};
    }
}

static void take_trial(const prover *p, double limit, apart_trial *tried)
{
    const reach a = areas_reach(&p->areas[0]), b = areas_reach(&p->areas[1]);
    const double most = -(a.value + b.value) - limit, low = -(a.bound + b.bound) - limit;
    tried->left = most > 0 ? low / most : -INFINITY;
    for (int side = 0; side < 2; ++side) {
        double lo = INFINITY, *size = tried->size[side];
        memset(size, 0, sizeof tried->size[side]);
        for (size_t k = 0; k < p->areas[side].count; ++k) {
            const shadow *s = &p->areas[side].at[k].s;
            lo = proof_smaller(lo, s->lo);
            for (int j = 0; j < VARIABLES; ++j) size[j] = proof_larger(size[j], s->size[j]);
        }
        tried->width[side] = (side == 0 ? a.bound : b.bound) - lo;
    }
}

/* The excess of a bound, most - low, falls about as 1 / step where two variables are divided.
 * Returns whether it will still be too large, or cost too much, at the last step. */
static bool is_hopeless(int step, int steps_most, double low, double most)
{
    const double lacks = (most - low) / most;
    return step >= steps_most || (step >= 4 && lacks * step > 2 * steps_most);
}

/* Lemma. |f(B) - f(A)| <= change |B - A| for n.x, which changes by |n| for a unit of length, and
 * for distances (round.c): where f(B) - f(A) >= change apart over the cell, no two points of it are
 * nearer. f(A) is at most what A reaches, and -f(B) what B reaches in its own direction. The sides
 * are divided one by one, since neither bound depends on the other side. */
static apart_outcome try_aims(prover *p, const cell *c, const aim a[2], double change_upper,
                              apart_trial *tried)
{
    const double limit = ld_interval_mul(ld_interval_of(change_upper), ld_interval_of(p->apart)).hi;
    p->tried = *c;
    p->aim = a[0];
    for (int side = 0; side < 2; ++side) {
        p->areas[side].count = 0;
        p->areas[side].memory = p->kept;
        for (size_t k = 0; k < c->count[side]; ++k) {
            place of;
            const box3 where = cell_area(p, c, side, k, &of);
            const char *why = areas_add(&p->areas[side], &of, &where, &a[side]);
            if (why != NULL) return apart_fail(p, c, INFINITY, why);
        }
    }
    take_trial(p, limit, tried);
    const int steps = a[0].about != NULL ? REFINEMENTS_ROUND : REFINEMENTS;
    for (int step = 0;; ++step) {
        if (p->areas[0].count == 0 || p->areas[1].count == 0)
            return APART; /* the surface does not exist there */
        const reach r[2] = {areas_reach(&p->areas[0]), areas_reach(&p->areas[1])};
        const ld_interval sum =
            ld_interval_add(ld_interval_of(r[0].bound), ld_interval_of(r[1].bound));
        if (-sum.hi >= limit) return APART;
        const double most = -(r[0].value + r[1].value) - limit, low = -sum.hi - limit;
        if (!(most > 0) || is_hopeless(step, steps, low, most)) return DIVIDE;
        const int side = r[1].bound - r[1].value > r[0].bound - r[0].value;
        bool divided;
        const char *why = areas_divide(&p->areas[side], r[side].worst, &a[side], &divided);
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
        if (!divided) return DIVIDE;
    }
}

apart_outcome apart_by_axis(prover *p, const cell *c, const double n[3], apart_trial *tried)
{
    const ld_interval x[3] = {ld_interval_of(n[0]), ld_interval_of(n[1]), ld_interval_of(n[2])};
    aim a[2];
    take_aims(p, c, n, a);
    const apart_outcome o = try_aims(p, c, a, apart_length(x).hi, tried);
    p->boxes += p->areas[0].count + p->areas[1].count;
    return o;
}

/* Tests of a leaf before the centres of its surfaces are guessed; and how many boxes may be tested
 * about centres without a proof, in addition to 1 / WASTE_PART of all boxes tested along axes. */
enum { TESTS_BEFORE_CENTRES = 6, WASTE_MOST = 4096, WASTE_PART = 64 };

static void guess_centres(prover *p, const cell *c)
{
    p->has_guessed = true;
    p->centre_count = 0;
    for (int side = 0; side < 2; ++side) {
        const place of = cell_piece(p, side, c->first[side]);
        p->centre_count +=
            centre_guess(p->kept, &of, middle(c->t[0], c->t[1]), &p->centres[p->centre_count]);
    }
}

apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried)
{
    place of[2];
    box3 where[2];
    if (p->wasted > WASTE_MOST + p->boxes / WASTE_PART) return DIVIDE;
    if (!p->has_guessed && p->tests > TESTS_BEFORE_CENTRES) guess_centres(p, c);
    for (int side = 0; side < 2; ++side) where[side] = cell_area(p, c, side, 0, &of[side]);
    for (int k = 0; k < p->centre_count; ++k) {
        aim a[2];
        double change_upper;
        if (!centre_aims(p->kept, &p->centres[k], of, where, a, &change_upper)) continue;
        const apart_outcome o = try_aims(p, c, a, change_upper, tried);
        p->wasted = o == APART ? 0 : p->wasted + p->areas[0].count + p->areas[1].count;
        if (o != DIVIDE) return o;
    }
    return DIVIDE;
}
