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

/* How much a side depends on each variable and clock, by the areas it has now; once for areas that
 * are kept. */
static void size_side(const prover *p, int side, const aim *a, const limits *r, kept_side *to)
{
    if (to->is_sized) return;
    memset(to->size, 0, sizeof to->size);
    memset(to->clocks, 0, sizeof to->clocks);
    for (size_t k = 0; k < p->areas[side].count; ++k) {
        double size[VARIABLES], clocks[CLOCKS_MAX];
        areas_sizes(&p->areas[side], k, a, size, clocks);
        for (size_t i = 0; i < p->when.count; ++i)
            to->clocks[i] = proof_larger(to->clocks[i], clocks[i]);
        for (int j = 0; j < VARIABLES; ++j) to->size[j] = proof_larger(to->size[j], size[j]);
    }
    to->width = r->upper[0] - r->least;
    to->is_sized = true;
}

/* Where an axis does it at one end of the time alone, what changes in between is due to time. Else
 * what is linear in time needs no division. */
static void take_trial(prover *p, const aim a[2], const limits r[2], double limit,
                       apart_trial *tried)
{
    const double before = r[0].ends[0] + r[1].ends[0], after = r[0].ends[1] + r[1].ends[1];
    const bool turns = (-before > limit) != (-after > limit);
    tried->time = turns && fabs(after - before) < INFINITY ? 0.5 * fabs(after - before) : 0;
    for (size_t k = 0; k < p->when.count; ++k) tried->clocks[k] = 0;
    for (int side = 0; side < 2; ++side) {
        kept_side *of = &p->kept[side];
        size_side(p, side, &a[side], &r[side], of);
        for (int j = 0; j < T; ++j) tried->size[side][j] = of->size[j];
        tried->time += of->size[T];
        for (size_t i = 0; i < p->when.count; ++i) tried->clocks[i] += of->clocks[i];
        tried->width[side] = of->width;
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

static bool is_same_centre(const centre *a, const centre *b)
{
    return a->is_line == b->is_line && memcmp(a->c, b->c, sizeof a->c) == 0 &&
           memcmp(a->d, b->d, sizeof a->d) == 0;
}

static bool asks_same(const kept_side *a, const kept_side *b)
{
    return a->piece == b->piece && a->stamp == b->stamp && a->aim.n[0] == b->aim.n[0] &&
           a->aim.n[1] == b->aim.n[1] && a->aim.lift == b->aim.lift &&
           (a->aim.n[1] == 0 || memcmp(a->aim.times, b->aim.times, sizeof a->aim.times) == 0) &&
           memcmp(&a->aim.at, &b->aim.at, sizeof a->aim.at) == 0 && a->aim.slip == b->aim.slip &&
           memcmp(&a->where, &b->where, sizeof a->where) == 0 &&
           is_same_centre(&a->about, &b->about);
}

/* Makes the areas of a side. Where the test before asked the same of it, they are those that it has
 * left: they cover the side, and their bounds do not depend on the other one. So the inside of a
 * bore is divided once for all strips of its shaft. */
static const char *begin_areas(prover *p, const cell *c, int side, const aim *a)
{
    const char *why = NULL;
    kept_side *last = &p->kept[side], now = {.is_kept = a->about != NULL};
    for (size_t k = 0; k < c->count[side] && why == NULL; ++k) {
        place of;
        box3 where = cell_area(p, c, side, k, &of);
        if (a->about != NULL) {
            if (!isnan(a->at)) where.lo[T] = where.hi[T] = a->at;
            now.piece = of.piece, now.where = where, now.stamp = p->when.stamp;
            now.about = *a->about, now.aim = *a;
            if (last->is_kept && asks_same(last, &now)) return NULL;
        }
        if (k == 0) areas_begin(&p->areas[side], p->known);
        why = areas_add(&p->areas[side], &of, &where, a);
    }
    *last = now;
    return why;
}

/* How much an aim's bounds differ by at other times, about; of a middle on the line, the root. */
static double rough_slip(const aim *a, const limits *r)
{
    if (a->n[1] == 0) return proof_smaller(0.5 * a->slip / fabs(r->ends[0]), sqrt(a->slip));
    return 0.5 * fabs(a->n[0]) * a->slip / a->radius + fabs(a->n[1]) * a->lift;
}

/* Divides an area. False: the test ends with *outcome; what lacks a part is not kept. */
static bool divide_area(prover *p, const cell *c, int side, size_t index, const aim *a,
                        apart_outcome *outcome)
{
    bool divided;
    areas *of = &p->areas[side];
    const char *why = areas_divide(of, index, a, &divided);
    *outcome = why != NULL ? apart_fail(p, c, INFINITY, why) : DIVIDE;
    if (why != NULL || of->cut.along >= 0) p->kept[side].is_kept = false;
    return why == NULL && of->cut.along < 0 && divided;
}

/* Lemma. |f(B) - f(A)| <= change |B - A| for n.x, which changes by |n| for a unit of length, and
 * for distances (round.c): where f(B) - f(A) >= change apart at each time of the cell, no two
 * points of it are nearer. f(A) is at most what A reaches, and -f(B) what B reaches in its own
 * direction. The sides are divided one by one, since neither bound depends on the other side. */
apart_outcome apart_try_aims(prover *p, const cell *c, const aim a[2], double change_upper,
                             apart_trial *tried)
{
    const double limit = ld_interval_mul(ld_interval_of(change_upper), ld_interval_of(p->apart)).hi;
    const bool is_round = aim_is_of_jets(&a[0]) || aim_is_of_jets(&a[1]);
    p->tried = *c;
    p->aim = a[0];
    p->is_round = a[0].is_round || a[1].is_round;
    tried->left = -INFINITY;
    tried->cut.along = -1;
    for (int side = 0; side < 2; ++side) {
        const char *why = begin_areas(p, c, side, &a[side]);
        if (why == NULL && p->areas[side].cut.along >= 0) tried->cut = p->areas[side].cut;
        if (why != NULL || p->areas[side].cut.along >= 0) p->kept[side].is_kept = false;
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
    }
    if (tried->cut.along >= 0) return DIVIDE;
    const size_t begun = c->count[0] + c->count[1];
    for (bool is_first = true;; is_first = false) {
        const size_t boxes = p->areas[0].count + p->areas[1].count;
        if (p->areas[0].count == 0 || p->areas[1].count == 0) return APART; /* it does not exist */
        const limits r[2] = {areas_limits(&p->areas[0]), areas_limits(&p->areas[1])};
        const margin m = take_margin(r, limit);
        if (m.low >= 0) return APART;
        if (is_first) {
            tried->left = m.most > 0 ? m.low / m.most : -INFINITY;
            tried->beyond = m.most > 0 ? 0 : -m.most;
            take_trial(p, a, r, limit, tried);
        }
        const double slips = rough_slip(&a[0], &r[0]) + rough_slip(&a[1], &r[1]);
        if (m.most > 0 && slips > 0.5 * m.most) return tried->time = INFINITY, DIVIDE;
        const int step = boxes > begun ? (int)(boxes - begun) : 0;
        if (!(m.most > 0) || is_hopeless(step, is_round, m.low, m.most)) return DIVIDE;
        double lacks[2];
        for (int side = 0; side < 2; ++side)
            lacks[side] =
                r[side].upper[m.worst] -
                (r[side].ends[0] + (r[side].ends[1] - r[side].ends[0]) * m.worst / (NET_TIMES - 1));
        const int side = lacks[1] > lacks[0];
        apart_outcome outcome;
        if (!divide_area(p, c, side, r[side].worst[m.worst], &a[side], &outcome)) return outcome;
    }
}

/* Makes the aims along an axis; returns an upper bound of its length. */
static double aims_along(const double n[3], aim a[2])
{
    ld_interval square = ld_interval_of(0);
    for (int side = 0; side < 2; ++side) a[side] = (aim){.about = NULL};
    for (int i = 0; i < 3; ++i) {
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(n[i])));
        a[0].n[i] = n[i], a[1].n[i] = -n[i];
    }
    return ld_interval_sqrt(square).hi;
}

apart_outcome apart_by_axis(prover *p, const cell *c, const double n[3], apart_trial *tried)
{
    aim a[2];
    const double length_upper = aims_along(n, a);
    return apart_by_angles(p, c, a, length_upper, tried);
}

apart_outcome apart_by_orbit(prover *p, const cell *c, const double n[3], apart_trial *tried)
{
    aim a[2];
    const double length_upper = aims_along(n, a);
    return apart_by_all_angles(p, c, a, length_upper, tried);
}
