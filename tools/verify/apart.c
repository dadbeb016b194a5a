/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/apart.h"

#include <math.h>
#include <string.h>

/* Divisions of a side's boxes along one axis, or about a centre, about which all of a surface may
 * be proved at once. */
enum { DEPTH_MAX = 400, REFINEMENTS = 96, REFINEMENTS_ROUND = 1024 };

/* --- Cells ------------------------------------------------------------------------------------ */

static place piece_at(const prover *p, int side, size_t k)
{
    place of = p->side[side];
    of.piece = p->order[side] != NULL ? p->order[side][k] : k;
    return of;
}

static void take_domain(const prover *p, cell *c, int side)
{
    const place of = piece_at(p, side, c->first[side]);
    box3 b;
    piece_box(&of, &b);
    for (int j = 0; j < 2; ++j) c->lo[side][j] = b.lo[j], c->hi[side][j] = b.hi[j];
}

void cell_begin(const prover *p, cell *c)
{
    for (int side = 0; side < 2; ++side)
        if (c->count[side] == 1) take_domain(p, c, side);
}

/* Sets the ends of both halves; false: the place is not inside. */
static bool halve(double lo, double hi, double at, double *first, double *second)
{
    *first = *second = isnan(at) ? middle(lo, hi) : at;
    return lo < *first && *first < hi;
}

bool cell_split(const prover *p, const cell *c, const cut *by, cell half[2])
{
    const int side = by->side, along = by->along;
    half[0] = half[1] = *c;
    if (side == 2) return halve(c->t[0], c->t[1], by->at, &half[0].t[1], &half[1].t[0]);
    if (c->count[side] > 1) {
        half[0].count[side] = c->count[side] / 2;
        half[1].first[side] += half[0].count[side];
        half[1].count[side] -= half[0].count[side];
        for (int k = 0; k < 2; ++k)
            if (half[k].count[side] == 1) take_domain(p, &half[k], side);
        return true;
    }
    return halve(c->lo[side][along], c->hi[side][along], by->at, &half[0].hi[side][along],
                 &half[1].lo[side][along]);
}

/* --- An axis ---------------------------------------------------------------------------------- */

typedef enum outcome { APART, DIVIDE, STUCK } outcome;

static outcome fail(prover *p, const cell *c, double found, const char *why)
{
    p->worst = *c;
    p->found = found;
    p->why = why;
    return STUCK;
}

static box3 box_of(const cell *c, int side)
{
    return (box3){{c->lo[side][U], c->lo[side][V], c->t[0]},
                  {c->hi[side][U], c->hi[side][V], c->t[1]}};
}

static box3 area_of(const prover *p, const cell *c, int side, size_t k, place *of)
{
    box3 where = box_of(c, side);
    *of = piece_at(p, side, c->first[side] + k);
    if (c->count[side] > 1) piece_box(of, &where);
    return where;
}

static ld_interval length_of(const ld_interval x[3])
{
    const ld_interval sum = ld_interval_add(
        ld_interval_add(ld_interval_sqr(x[0]), ld_interval_sqr(x[1])), ld_interval_sqr(x[2]));
    return ld_interval_sqrt(sum);
}

static bool is_axis(const double n[3])
{
    const double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    return sum > 0 && sum < INFINITY;
}

static void take_aims(prover *p, const cell *c, const double n[3], aim a[2])
{
    place of;
    const box3 where = area_of(p, c, 0, 0, &of);
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

/* What is known of an axis that does not do it, from the undivided pieces. */
typedef struct trial {
    double left;               /* what is missing, by what is left over between the centres */
    double size[2][VARIABLES]; /* a piece's dependence on the variables, at most, about */
    double width[2];           /* of the bounds of each side */
} trial;

static void take_trial(const prover *p, double limit, trial *tried)
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

/* Bounds lose what they lack, most - low, about as 1 / step where two variables are divided: gives
 * up where they will lack too much, or cost too much, when they are done. */
static bool is_hopeless(int step, int steps_most, double low, double most)
{
    const double lacks = (most - low) / most;
    return step >= steps_most || (step >= 4 && lacks * step > 2 * steps_most);
}

/* Lemma. |f(B) - f(A)| <= change |B - A| for n.x, which changes by |n| for a unit of length, and
 * for distances (round.c): where f(B) - f(A) >= change apart over the cell, no two points of it are
 * nearer. f(A) is at most what A reaches, and -f(B) what B reaches in its own direction. The sides
 * are divided one by one, since neither bound depends on the other side. */
static outcome try_aims(prover *p, const cell *c, const aim a[2], double change_upper, trial *tried)
{
    const double limit = ld_interval_mul(ld_interval_of(change_upper), ld_interval_of(p->apart)).hi;
    for (int side = 0; side < 2; ++side) {
        p->areas[side].count = 0;
        p->areas[side].memory = p->kept;
        for (size_t k = 0; k < c->count[side]; ++k) {
            place of;
            const box3 where = area_of(p, c, side, k, &of);
            const char *why = areas_add(&p->areas[side], &of, &where, &a[side]);
            if (why != NULL) return fail(p, c, INFINITY, why);
        }
    }
    take_trial(p, limit, tried);
    const int steps = a[0].about != NULL ? REFINEMENTS_ROUND : REFINEMENTS;
    for (int step = 0;; ++step) {
        if (p->areas[0].count == 0 || p->areas[1].count == 0) return APART; /* it does not exist */
        const reach r[2] = {areas_reach(&p->areas[0]), areas_reach(&p->areas[1])};
        const ld_interval sum =
            ld_interval_add(ld_interval_of(r[0].bound), ld_interval_of(r[1].bound));
        if (-sum.hi >= limit) return APART;
        const double most = -(r[0].value + r[1].value) - limit, low = -sum.hi - limit;
        if (!(most > 0) || is_hopeless(step, steps, low, most)) return DIVIDE;
        const int side = r[1].bound - r[1].value > r[0].bound - r[0].value;
        bool divided;
        const char *why = areas_divide(&p->areas[side], r[side].worst, &a[side], &divided);
        if (why != NULL) return fail(p, c, INFINITY, why);
        if (!divided) return DIVIDE;
    }
}

static outcome try_axis(prover *p, const cell *c, const double n[3], trial *tried)
{
    const ld_interval x[3] = {ld_interval_of(n[0]), ld_interval_of(n[1]), ld_interval_of(n[2])};
    aim a[2];
    take_aims(p, c, n, a);
    const outcome o = try_aims(p, c, a, length_of(x).hi, tried);
    p->boxes += p->areas[0].count + p->areas[1].count;
    return o;
}

/* Tests of a leaf before its surfaces' centres are guessed; and boxes that centres may waste,
 * beside 1 / WASTE_PART of all boxes of axes. */
enum { TESTS_BEFORE_CENTRES = 6, WASTE_MOST = 4096, WASTE_PART = 64 };

static void guess_centres(prover *p, const cell *c)
{
    p->has_guessed = true;
    p->centre_count = 0;
    for (int side = 0; side < 2; ++side) {
        const place of = piece_at(p, side, c->first[side]);
        p->centre_count +=
            centre_guess(p->kept, &of, middle(c->t[0], c->t[1]), &p->centres[p->centre_count]);
    }
}

/* Tries the centres of both surfaces of a cell of single pieces. */
static outcome try_centres(prover *p, const cell *c, trial *tried)
{
    place of[2];
    box3 where[2];
    if (p->wasted > WASTE_MOST + p->boxes / WASTE_PART) return DIVIDE;
    if (!p->has_guessed && p->tests > TESTS_BEFORE_CENTRES) guess_centres(p, c);
    for (int side = 0; side < 2; ++side) where[side] = area_of(p, c, side, 0, &of[side]);
    for (int k = 0; k < p->centre_count; ++k) {
        aim a[2];
        double change_upper;
        if (!centre_aims(p->kept, &p->centres[k], of, where, a, &change_upper)) continue;
        const outcome o = try_aims(p, c, a, change_upper, tried);
        p->wasted = o == APART ? 0 : p->wasted + p->areas[0].count + p->areas[1].count;
        if (o != DIVIDE) return o;
    }
    return DIVIDE;
}

/* --- A cell ----------------------------------------------------------------------------------- */

/* du x dv of one side at the centre. */
static void normal(const jet x[3], double n[3])
{
    double u[3], v[3];
    for (int i = 0; i < 3; ++i)
        u[i] = ld_interval_mid(x[i].d[U]), v[i] = ld_interval_mid(x[i].d[V]);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        n[i] = u[j] * v[l] - u[l] * v[j];
    }
}

/* The middle of the box around the centres of some pieces, which may not exist. */
static void centre_of(prover *p, const cell *c, int side, double x[3])
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    const size_t count = c->count[side], step = count > 8 ? count / 8 : 1;
    for (size_t k = 0; k < count; k += step) {
        place of;
        const box3 where = area_of(p, c, side, k, &of);
        const kept *at = kept_look(p->kept, &of, &where);
        for (int i = 0; i < 3 && at->result == ENCLOSED; ++i) {
            const double v = ld_interval_mid(at->centre[i].v);
            if (v < lo[i]) lo[i] = v;
            if (v > hi[i]) hi[i] = v;
        }
    }
    for (int i = 0; i < 3; ++i) x[i] = 0.5 * lo[i] + 0.5 * hi[i];
}

/* The hint, the direction of the centres, and the normals of single pieces, from A to B. */
enum { AXES = 4 };

static void find_axes(prover *p, const cell *c, double n[AXES][3])
{
    double x[2][3];
    memcpy(n[0], p->axis, sizeof n[0]);
    for (int side = 0; side < 2; ++side) centre_of(p, c, side, x[side]);
    for (int i = 0; i < 3; ++i) n[1][i] = x[1][i] - x[0][i];
    for (int side = 0; side < 2; ++side) {
        double *m = n[2 + side];
        place of;
        const box3 where = area_of(p, c, side, 0, &of);
        const kept *k = kept_look(p->kept, &of, &where);
        memset(m, 0, sizeof n[0]);
        if (c->count[side] == 1 && k->result == ENCLOSED) normal(k->centre, m);
        const double sign = m[0] * n[1][0] + m[1] * n[1][1] + m[2] * n[1][2];
        for (int i = 0; i < 3 && sign < 0; ++i) m[i] = -m[i];
    }
}

/* The variable that the shadows depend on most, for what can be divided; the widest of equals.
 * False: nothing can be divided. */
static bool widest(const cell *c, const trial *tried, cut *by)
{
    double most = -1, width = 0;
    const double time = proof_larger(tried->size[0][T], tried->size[1][T]);
    for (int side = 0; side < 3; ++side)
        for (int j = 0; j < (side < 2 ? 2 : 1); ++j) {
            const double lo = side < 2 ? c->lo[side][j] : c->t[0];
            const double hi = side < 2 ? c->hi[side][j] : c->t[1];
            const double here = side < 2 ? tried->size[side][j] : time;
            if (!(hi > lo) || (!(here > most) && !(here == most && hi - lo > width))) continue;
            *by = (cut){side, j, NAN};
            most = here, width = hi - lo;
        }
    return width > 0;
}

/* The side of many pieces with the greater shadow, or time if the pieces depend on it more. */
static bool divide_many(const cell *c, const trial *tried, cut *by)
{
    double size[2];
    for (int side = 0; side < 2; ++side) size[side] = c->count[side] > 1 ? tried->width[side] : -1;
    const int larger = size[1] > size[0];
    const double time = proof_larger(tried->size[0][T], tried->size[1][T]);
    *by = (cut){2 * time > size[larger] && c->t[0] < c->t[1] ? 2 : larger, 0, NAN};
    return true;
}

/* Whether two points, those of the centres, are surely nearer, or a single piece has parts. */
static outcome look_at_pieces(prover *p, const cell *c, cut *by, double *found)
{
    ld_interval x[2][3];
    for (int side = 0; side < 2; ++side) {
        place of;
        const box3 where = area_of(p, c, side, 0, &of);
        const kept *k = kept_look(p->kept, &of, &where);
        const split *parts = &k->divide;
        if (k->result == ENCLOSED_EMPTY) return APART;
        const char *why = shadow_why_unknown(k->result);
        if (why != NULL) return fail(p, c, INFINITY, why);
        *by = (cut){parts->along == T ? 2 : side, parts->along % T, parts->at};
        if (k->result == ENCLOSED_SPLIT) return DIVIDE;
        for (int i = 0; i < 3; ++i) x[side][i] = k->centre[i].v;
    }
    for (int i = 0; i < 3; ++i) x[0][i] = ld_interval_sub(x[1][i], x[0][i]);
    const ld_interval length = length_of(x[0]);
    *found = ld_interval_mid(length);
    by->side = -1;
    return length.hi < p->apart ? fail(p, c, *found, "two points of it are nearer") : DIVIDE;
}

static outcome test(prover *p, const cell *c, cut *by)
{
    const bool is_single = c->count[0] == 1 && c->count[1] == 1;
    double n[AXES][3], best = -INFINITY, found = INFINITY;
    outcome o = is_single ? look_at_pieces(p, c, by, &found) : DIVIDE;
    if (o != DIVIDE || (is_single && by->side >= 0)) return o;
    trial tried = {.left = -INFINITY};
    bool some = is_single ? widest(c, &tried, by) : divide_many(c, &tried, by);
    if (is_single) {
        o = try_centres(p, c, &tried);
        if (o != DIVIDE) return o;
        best = tried.left;
        if (best > -INFINITY) some = widest(c, &tried, by);
    }
    find_axes(p, c, n);
    for (int m = 0; m < AXES; ++m) {
        if (!is_axis(n[m])) continue;
        o = try_axis(p, c, n[m], &tried);
        if (o != DIVIDE) return o;
        if (!(tried.left > best)) continue;
        best = tried.left;
        some = is_single ? widest(c, &tried, by) : divide_many(c, &tried, by);
    }
    return some ? DIVIDE : fail(p, c, found, "it is too small to be divided");
}

/* --- Dividing --------------------------------------------------------------------------------- */

static bool prove(prover *p, const cell *c, int depth)
{
    cut by;
    cell half[2];
    if (++p->tests > p->tests_most || depth > DEPTH_MAX)
        return fail(p, c, INFINITY, "it is not proved within the effort allowed"), false;
    const outcome o = test(p, c, &by);
    if (o != DIVIDE) return o == APART;
    if (!cell_split(p, c, &by, half))
        return fail(p, c, INFINITY, "it is too small to be divided"), false;
    return prove(p, &half[0], depth + 1) && prove(p, &half[1], depth + 1);
}

void prover_forget(prover *p)
{
    p->centre_count = 0;
    p->boxes = p->wasted = 0;
}

bool prove_apart(prover *p, const cell *c)
{
    p->tests = 0;
    p->has_guessed = false;
    p->found = INFINITY;
    p->why = "";
    return prove(p, c, 0);
}
