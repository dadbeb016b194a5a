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
            take_trial(p, a, r, limit, tried);
        }
        const double slips = rough_slip(&a[0], &r[0]) + rough_slip(&a[1], &r[1]);
        if (m.most > 0 && slips > 0.5 * m.most) return tried->time = INFINITY, DIVIDE;
        const int step = boxes > begun ? (int)(boxes - begun) : 0;
        if (!(m.most > 0) || is_hopeless(step, a[0].about != NULL, m.low, m.most)) return DIVIDE;
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

/* Tests of a leaf before its surfaces' centres are guessed; and boxes that may be wasted by centres
 * of both surfaces. */
enum { TESTS_BEFORE_CENTRES = 3, WASTE_MOST = 1 << 15 };

/* Boxes that the centre of one surface may take beyond GAINED for each cell that it parts. A ball
 * of radius 1 in a bore of 1.01 takes some 1,000 for its first cell, and few for those after it. */
enum { CREDIT = 1 << 12, GAINED = 1 << 8 };

static bool are_worth_it(const prover *p)
{
    return p->centre_count == 1 ? p->spent <= CREDIT : p->wasted <= WASTE_MOST;
}

/* Keeps the centres to be tried, and counts them: those of both surfaces if they are shared, such
 * as of a shaft and its bore; else that of a ball at rest, from which it is everywhere as far as it
 * can be; or the line of one at rest, if the other has none, such as a disc in a bore. Lines that
 * move part little: the leaves of an arm beside a fixture took twice the tests with them; and what
 * is beside a centre, not around it, is parted by axes: a box on rollers took 400 times as long. */
static int choose_centres(prover *p, const cell *c, const place of[2], const bool found[2])
{
    centre *all = p->centres;
    if (found[0] && found[1] && centre_is_shared(&all[0], &all[1])) return 2;
    for (int side = 0; side < 2; ++side) {
        if (!found[side] || (all[side].is_line && found[!side])) continue;
        place other;
        const cell *all_of_it = p->leaf->count[!side] == 1 ? p->leaf : c;
        const box3 where = cell_area(p, all_of_it, !side, 0, &other);
        if (!centre_rests(p->known, &of[side], c->t, &all[side]) ||
            !centre_is_amid(p->known, &all[side], &other, &where))
            continue;
        all[0] = all[side];
        return 1;
    }
    return 0;
}

static void guess_centres(prover *p, const cell *c)
{
    bool found[2];
    place of[2];
    for (int side = 0; side < 2; ++side) of[side] = cell_piece(p, side, c->first[side]);
    p->has_guessed = true;
    if (p->has_missed && p->missed[0] == of[0].piece && p->missed[1] == of[1].piece) return;
    const double t = middle(c->t[0], c->t[1]);
    for (int side = 0; side < 2; ++side)
        found[side] = centre_guess(p->known, &of[side], t, &p->centres[side]);
    p->centre_count = choose_centres(p, c, of, found);
    p->has_missed = !found[0] && !found[1];
    for (int side = 0; side < 2; ++side) p->missed[side] = of[side].piece;
}

/* Notes how many boxes a centre took. */
static void note_cost(prover *p, apart_outcome o, unsigned long cast)
{
    p->wasted = o == APART ? 0 : p->wasted + p->areas[0].count + p->areas[1].count;
    if (p->centre_count != 1) return;
    const size_t gained = o == APART ? GAINED : 0;
    p->spent = p->spent + cast > gained ? p->spent + cast - gained : 0;
}

apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried)
{
    place of[2];
    box3 where[2];
    apart_trial own;
    if (!p->has_guessed && p->tests > TESTS_BEFORE_CENTRES) guess_centres(p, c);
    if (!are_worth_it(p)) return DIVIDE;
    for (int side = 0; side < 2; ++side) where[side] = cell_area(p, c, side, 0, &of[side]);
    for (int k = 0; k < p->centre_count; ++k) {
        aim a[2];
        double change_upper;
        if (!centre_aims(p->known, &p->centres[k], of, where, p->apart, a, &change_upper)) continue;
        const unsigned long before = p->areas[0].cast + p->areas[1].cast;
        const apart_outcome o = try_aims(p, c, a, change_upper, &own);
        note_cost(p, o, p->areas[0].cast + p->areas[1].cast - before);
        /* One centre that does not part even the points that are known says not what to divide. */
        if (p->centre_count > 1 || own.left > -INFINITY) *tried = own;
        if (o != DIVIDE) return o;
    }
    return DIVIDE;
}
