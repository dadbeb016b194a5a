/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/apart_internal.h"

enum { DEPTH_MAX = 400 };

static bool is_axis(const double n[3])
{
    const double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    return sum > 0 && sum < INFINITY;
}

/* --- A cell ----------------------------------------------------------------------------------- */

/* The clock whose values count for more than `most`; false: none does. */
static bool widest_clock(const prover *p, const apart_trial *tried, double most, cut *by)
{
    bool found = false;
    for (size_t k = 0; k < p->when.count; ++k) {
        const double lo = p->when.lo[k], hi = p->when.hi[k], mid = middle(lo, hi);
        if (k == p->when.main || !(lo < mid && mid < hi) || !(tried->clocks[k] > most)) continue;
        *by = (cut){3, (int)k, NAN};
        most = tried->clocks[k], found = true;
    }
    return found;
}

/* The variable that the bounds depend on most, for what can be divided; the widest of equals.
 * False: nothing can be divided. */
static bool widest(const prover *p, const cell *c, const apart_trial *tried, cut *by)
{
    double most = -1, width = 0;
    for (int side = 0; side < 3; ++side)
        for (int j = 0; j < (side < 2 ? 2 : 1); ++j) {
            const double lo = side < 2 ? c->lo[side][j] : c->t[0];
            const double hi = side < 2 ? c->hi[side][j] : c->t[1];
            const double here = side < 2 ? tried->size[side][j] : tried->time;
            const double mid = middle(lo, hi);
            if (!(lo < mid && mid < hi)) continue;
            if (!(here > most) && !(here == most && hi - lo > width)) continue;
            *by = (cut){side, j, NAN};
            most = here, width = hi - lo;
        }
    return widest_clock(p, tried, most, by) || width > 0;
}

/* The side of many pieces with the greater shadow, or time if the pieces depend on it more. */
static bool divide_many(const prover *p, const cell *c, const apart_trial *tried, cut *by)
{
    double size[2];
    for (int side = 0; side < 2; ++side) size[side] = c->count[side] > 1 ? tried->width[side] : -1;
    const int larger = size[1] > size[0];
    const double mid = middle(c->t[0], c->t[1]);
    const bool has_time = c->t[0] < mid && mid < c->t[1];
    *by = (cut){has_time && 2 * tried->time > size[larger] ? 2 : larger, 0, NAN};
    widest_clock(p, tried, proof_larger(0.5 * size[larger], tried->time), by);
    return true;
}

static bool divide_cell(const prover *p, const cell *c, const apart_trial *tried, cut *by)
{
    const bool is_single = c->count[0] == 1 && c->count[1] == 1;
    return is_single ? widest(p, c, tried, by) : divide_many(p, c, tried, by);
}

/* The least distance of some corners at one time, and an upper bound of it. */
static void take_distance(double a[8][3], double b[8][3], double off, double *least, double *upper)
{
    *least = INFINITY;
    for (int k = 0; k < 8; ++k)
        for (int l = k & 4; l < (k & 4) + 4; ++l) {
            double sum = 0;
            for (int i = 0; i < 3; ++i) sum += (b[l][i] - a[k][i]) * (b[l][i] - a[k][i]);
            *least = proof_smaller(*least, sqrt(sum));
        }
    *upper = *least * (1 + 0x1p-40) + off * (1 + 0x1p-40);
}

/* A cut by T or by another clock. */
static cut cut_of(const split *parts)
{
    if (parts->along == T) return (cut){2, 0, parts->at};
    return (cut){3, parts->along - VARIABLES, parts->at};
}

/* Whether two points, corners of the cell, are surely nearer, or a single piece has parts. */
static apart_outcome look_at_pieces(prover *p, const cell *c, cut *by, double *found)
{
    double corner[2][8][3], mid[3], off = 0, upper;
    bool is_known = true;
    for (int side = 0; side < 2; ++side) {
        place of;
        form x;
        split parts;
        const box3 where = cell_area(p, c, side, 0, &of);
        const enclosed result = look_net(p->known, &of, &where, &x, &parts);
        if (result == ENCLOSED_EMPTY) return APART;
        const char *why = shadow_why_unknown(result);
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
        *by = parts.along < T ? (cut){side, parts.along, parts.at} : cut_of(&parts);
        if (result == ENCLOSED_SPLIT) return DIVIDE;
        if (x.net != NULL) off += net_points(&x, corner[side], mid);
        is_known = is_known && x.net != NULL;
    }
    by->side = -1;
    if (!is_known) return DIVIDE;
    take_distance(corner[0], corner[1], off, found, &upper);
    return upper < p->apart ? apart_fail(p, c, *found, "two points of it are nearer") : DIVIDE;
}

/* Tries an axis, and keeps how to divide the cell by the best of them. */
static apart_outcome try_axis(prover *p, const cell *c, const double n[3], double *best, cut *by,
                              bool *some)
{
    apart_trial tried;
    if (!is_axis(n)) return DIVIDE;
    const apart_outcome o = apart_by_axis(p, c, n, &tried);
    if (o != DIVIDE) return o;
    if (tried.cut.along >= 0) {
        *by = cut_of(&tried.cut);
        *best = INFINITY, *some = true;
    } else if (tried.left > *best || !*some) {
        *best = tried.left;
        *some = divide_cell(p, c, &tried, by);
    }
    return o;
}

/* Tests the normal of a face; where it does not part the cell, it does not choose the cut. */
static apart_outcome apart_by_face(prover *p, const cell *c, const double n[3])
{
    apart_trial unused;
    return is_axis(n) ? apart_by_axis(p, c, n, &unused) : DIVIDE;
}

/* Tests an axis of a side that turns, for all angles. */
static apart_outcome apart_by_turn(prover *p, const cell *c, const double n[3])
{
    apart_trial unused;
    return is_axis(n) ? apart_by_orbit(p, c, n, &unused) : DIVIDE;
}

static apart_outcome test(prover *p, const cell *c, cut *by)
{
    const bool is_single = c->count[0] == 1 && c->count[1] == 1;
    double n[AXES][3], best = -INFINITY, found = INFINITY;
    apart_trial tried = {.left = -INFINITY, .cut = {.along = -1}};
    bool some = false;
    apart_outcome o = try_axis(p, c, p->axis, &best, by, &some);
    if (o != DIVIDE || best == INFINITY) return o;
    if (is_single) {
        cut parts;
        o = look_at_pieces(p, c, &parts, &found);
        if (o != DIVIDE) return o;
        if (parts.side >= 0) return *by = parts, DIVIDE;
        o = apart_by_centres(p, c, &tried);
        if (o != DIVIDE) return o;
        if (tried.left > -INFINITY) best = 0, some = divide_cell(p, c, &tried, by);
    }
    apart_find_axes(p, c, n);
    for (int m = 0; m < AXES && best < INFINITY; ++m) {
        if (m == 0 && best == -INFINITY)
            some = false; /* of the smallest cells, this axis is right */
        const bool is_face = m > 0 && m < AXES_AT_REST && c->count[m - 1] > 1;
        o = is_face             ? apart_by_face(p, c, n[m])
            : m >= AXES_AT_REST ? apart_by_turn(p, c, n[m])
                                : try_axis(p, c, n[m], &best, by, &some);
        if (o != DIVIDE) return o;
    }
    if (!some) some = divide_cell(p, c, &tried, by);
    return some ? DIVIDE : apart_fail(p, c, found, "it is too small to be divided");
}

/* --- Dividing --------------------------------------------------------------------------------- */

static bool prove(prover *p, const cell *c, int depth);

/* Proves the part of a cell at one time, or at one value of another clock. */
static bool prove_at(prover *p, const cell *c, size_t clock, double at, int depth)
{
    cell there = *c;
    if (clock == p->when.main) {
        there.t[0] = there.t[1] = at;
        return prove(p, &there, depth);
    }
    const values was = p->when;
    p->when.lo[clock] = p->when.hi[clock] = at;
    p->when.stamp = ++*p->stamps;
    const bool proved = prove(p, c, depth);
    p->when = was;
    return proved;
}

/* Proves a cell that is proved at values where it ends, and both surfaces may jump (jumps.h). All
 * parts that meet there are enclosed. Where a cell begins, another one ends, but for the first. */
static bool prove_ends(prover *p, const cell *c, int depth)
{
    bool proved = true;
    for (size_t k = 0; k < p->when.count && proved; ++k) {
        const bool is_main = k == p->when.main;
        const double lo = is_main ? c->t[0] : p->when.lo[k], hi = is_main ? c->t[1] : p->when.hi[k];
        if (!(lo < hi)) continue;
        if (jumps_has(p->jumps, k, hi)) proved = prove_at(p, c, k, hi, depth + 1);
        if (proved && lo == p->side[0].of->clocks[k].lo && jumps_has(p->jumps, k, lo))
            proved = prove_at(p, c, k, lo, depth + 1);
    }
    return proved;
}

static bool prove(prover *p, const cell *c, int depth)
{
    cut by;
    cell half[2];
    p->ran_out = ++p->tests > p->tests_most;
    if (p->ran_out) return apart_fail(p, c, INFINITY, "its effort ran out"), false;
    if (depth > DEPTH_MAX) return apart_fail(p, c, INFINITY, "it is divided too often"), false;
    const apart_outcome o = test(p, c, &by);
    if (o != DIVIDE) return o == APART && prove_ends(p, c, depth);
    if (!cell_split(p, c, &by, half))
        return apart_fail(p, c, INFINITY, "it is too small to be divided"), false;
    bool proved = true;
    for (int k = 0; k < 2 && proved; ++k) {
        const values_kept was = values_halve(p, &by, k);
        proved = prove(p, &half[k], depth + 1);
        values_restore(p, &by, &was);
    }
    return proved;
}

void prover_forget(prover *p)
{
    p->centre_count = 0;
    p->wasted = 0;
    p->spent = 0;
    p->round_spent = 0;
    p->round_helps = false;
    p->has_missed = false;
    p->kept[0].is_kept = p->kept[1].is_kept = false;
}

bool prove_apart(prover *p, const cell *c)
{
    p->tests = 0;
    p->has_guessed = p->ran_out = false;
    p->leaf = c;
    p->found = INFINITY;
    p->why = "";
    if (p->apart <= 0) return true; /* no distance is below 0 */
    return prove(p, c, 0);
}
