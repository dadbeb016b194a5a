/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/apart_internal.h"

/* Divisions of a side's boxes along one axis, or about a centre, about which all of a surface may
 * be proved at once. */
enum { STEPS = 96, STEPS_ROUND = 1024 };

apart_outcome apart_fail(prover *p, const cell *c, double found, const char *why)
{
    p->worst = *c;
    p->worst_when = p->when;
    p->found = found;
    p->why = why;
    return STUCK;
}

/* Where an axis does it at one end of the time alone, what changes in between is due to time. Else
 * what is linear in time needs no division. */
static void take_trial(const prover *p, const aim a[2], const limits r[2], double limit,
                       apart_trial *tried)
{
    const double before = r[0].ends[0] + r[1].ends[0], after = r[0].ends[1] + r[1].ends[1];
    const bool turns = (-before > limit) != (-after > limit);
    tried->time = turns && fabs(after - before) < INFINITY ? 0.5 * fabs(after - before) : 0;
    for (size_t k = 0; k < p->when.count; ++k) tried->clocks[k] = 0;
    for (int side = 0; side < 2; ++side) {
        double *most = tried->size[side], bend = 0, by_clocks[CLOCKS_MAX] = {0};
        most[U] = most[V] = 0;
        for (size_t k = 0; k < p->areas[side].count; ++k) {
            double size[VARIABLES], clocks[CLOCKS_MAX];
            areas_sizes(&p->areas[side], k, &a[side], size, clocks);
            for (size_t i = 0; i < p->when.count; ++i)
                by_clocks[i] = proof_larger(by_clocks[i], clocks[i]);
            for (int j = 0; j < T; ++j) most[j] = proof_larger(most[j], size[j]);
            bend = proof_larger(bend, size[T]);
        }
        tried->time += bend;
        for (size_t i = 0; i < p->when.count; ++i) tried->clocks[i] += by_clocks[i];
        tried->width[side] = r[side].upper[0] - r[side].least;
    }
}

/* Bounds lose what they lack, most - low, about as 1 / step where two variables are divided, and
 * distances from a centre, whose bounds are of third order, as step^-1.5: gives up where they will
 * lack too much, or cost too much, when they are done. */
static bool is_hopeless(int step, bool is_round, double low, double most)
{
    const double lacks = (most - low) / most;
    if (is_round)
        return step >= STEPS_ROUND || (step >= 64 && step * cbrt(lacks * lacks) > 2 * STEPS_ROUND);
    return step >= STEPS || (step >= 4 && step * lacks > 2 * STEPS);
}

/* What is left over between the sides, at least, and for the points that are known; and which
 * coefficient has the least. */
typedef struct margin {
    double low, most;
    int worst;
} margin;

/* Lemma. At each time, -(A + B) is a convex combination of its coefficients. */
static margin take_margin(const limits r[2], double limit)
{
    margin m = {INFINITY, INFINITY, 0};
    for (int k = 0; k < NET_TIMES; ++k) {
        const double sum = proof_up(r[0].upper[k] + r[1].upper[k]);
        if (!(-sum - limit >= m.low)) m.low = -sum - limit, m.worst = k;
    }
    for (int end = 0; end < 2; ++end)
        m.most = proof_smaller(m.most, -(r[0].ends[end] + r[1].ends[end]) - limit);
    return m;
}

static const char *begin_areas(prover *p, const cell *c, int side, const aim *a)
{
    const char *why = NULL;
    areas_begin(&p->areas[side], p->known);
    for (size_t k = 0; k < c->count[side] && why == NULL; ++k) {
        place of;
        box3 where = cell_area(p, c, side, k, &of);
        if (a->about != NULL && !isnan(a->at)) where.lo[T] = where.hi[T] = a->at;
        why = areas_add(&p->areas[side], &of, &where, a);
    }
    return why;
}

/* Lemma. |f(B) - f(A)| <= change |B - A| for n.x, which changes by |n| for a unit of length, and
 * for distances (round.c): where f(B) - f(A) >= change apart at each time of the cell, no two
 * points of it are nearer. f(A) is at most what A reaches, and -f(B) what B reaches in its own
 * direction. The sides are divided one by one, since neither bound depends on the other side. */
static apart_outcome try_aims(prover *p, const cell *c, const aim a[2], double change_upper,
                              apart_trial *tried)
{
    const double limit = ld_interval_mul(ld_interval_of(change_upper), ld_interval_of(p->apart)).hi;
    p->tried = *c;
    p->aim = a[0];
    tried->left = -INFINITY;
    tried->cut.along = -1;
    for (int side = 0; side < 2; ++side) {
        const char *why = begin_areas(p, c, side, &a[side]);
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
        if (p->areas[side].cut.along >= 0) tried->cut = p->areas[side].cut;
    }
    for (int step = 0;; ++step) {
        if (tried->cut.along >= 0) return DIVIDE;
        if (p->areas[0].count == 0 || p->areas[1].count == 0) return APART; /* it does not exist */
        const limits r[2] = {areas_limits(&p->areas[0]), areas_limits(&p->areas[1])};
        const margin m = take_margin(r, limit);
        if (m.low >= 0) return APART;
        if (step == 0) {
            tried->left = m.most > 0 ? m.low / m.most : -INFINITY;
            take_trial(p, a, r, limit, tried);
        }
        const double slips =
            0.5 * (a[0].slip / fabs(r[0].ends[0]) + a[1].slip / fabs(r[1].ends[0]));
        if (m.most > 0 && slips > 0.5 * m.most) return tried->time = INFINITY, DIVIDE;
        if (!(m.most > 0) || is_hopeless(step, a[0].about != NULL, m.low, m.most)) return DIVIDE;
        double lacks[2];
        for (int side = 0; side < 2; ++side)
            lacks[side] =
                r[side].upper[m.worst] -
                (r[side].ends[0] + (r[side].ends[1] - r[side].ends[0]) * m.worst / (NET_TIMES - 1));
        const int side = lacks[1] > lacks[0];
        bool divided;
        const char *why = areas_divide(&p->areas[side], r[side].worst[m.worst], &a[side], &divided);
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
        if (!divided) return DIVIDE;
    }
}

apart_outcome apart_by_axis(prover *p, const cell *c, const double n[3], apart_trial *tried)
{
    ld_interval square = ld_interval_of(0);
    aim a[2] = {{.about = NULL}, {.about = NULL}};
    for (int i = 0; i < 3; ++i) {
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(n[i])));
        a[0].n[i] = n[i], a[1].n[i] = -n[i];
    }
    return try_aims(p, c, a, ld_interval_sqrt(square).hi, tried);
}

/* Tests of a leaf before its surfaces' centres are guessed; and boxes that centres may waste. */
enum { TESTS_BEFORE_CENTRES = 6, WASTE_MOST = 1 << 15 };

static void guess_centres(prover *p, const cell *c)
{
    bool found = true;
    for (int side = 0; side < 2; ++side) {
        const place of = cell_piece(p, side, c->first[side]);
        found = found && centre_guess(p->known, &of, middle(c->t[0], c->t[1]), &p->centres[side]);
    }
    p->has_guessed = true;
    p->centre_count = found && centre_is_shared(&p->centres[0], &p->centres[1]) ? 2 : 0;
}

apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried)
{
    place of[2];
    box3 where[2];
    if (p->wasted > WASTE_MOST) return DIVIDE;
    if (!p->has_guessed && p->tests > TESTS_BEFORE_CENTRES) guess_centres(p, c);
    for (int side = 0; side < 2; ++side) where[side] = cell_area(p, c, side, 0, &of[side]);
    for (int k = 0; k < p->centre_count; ++k) {
        aim a[2];
        double change_upper;
        if (!centre_aims(p->known, &p->centres[k], of, where, a, &change_upper)) continue;
        const apart_outcome o = try_aims(p, c, a, change_upper, tried);
        p->wasted = o == APART ? 0 : p->wasted + p->areas[0].count + p->areas[1].count;
        if (o != DIVIDE) return o;
    }
    return DIVIDE;
}
