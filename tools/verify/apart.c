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

/* Computes the middle of the box around the centres of some of a side's pieces, of 8 to 15 if there
 * are more. Pieces without an enclosure are left out. */
static void centre_of(prover *p, const cell *c, int side, double x[3])
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    const size_t count = c->count[side], step = count > 8 ? count / 8 : 1;
    for (size_t k = 0; k < count; k += step) {
        place of;
        const box3 where = cell_area(p, c, side, k, &of);
        const kept *at = kept_look(p->kept, &of, &where);
        for (int i = 0; i < 3 && at->result == ENCLOSED; ++i) {
            const double v = ld_interval_mid(at->centre[i].v);
            if (v < lo[i]) lo[i] = v;
            if (v > hi[i]) hi[i] = v;
        }
    }
    for (int i = 0; i < 3; ++i) x[i] = 0.5 * lo[i] + 0.5 * hi[i];
}

/* The axes that are tried: the hint, the direction of the centres, and both normals of single
 * pieces; all from A to B. */
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
        const box3 where = cell_area(p, c, side, 0, &of);
        const kept *k = kept_look(p->kept, &of, &where);
        memset(m, 0, sizeof n[0]);
        if (c->count[side] == 1 && k->result == ENCLOSED) normal(k->centre, m);
        const double sign = m[0] * n[1][0] + m[1] * n[1][1] + m[2] * n[1][2];
        for (int i = 0; i < 3 && sign < 0; ++i) m[i] = -m[i];
    }
}

/* Finds the variable that the projections depend on most, among those that can be divided; the
 * widest of equals. False: none can be divided. */
static bool widest(const cell *c, const apart_trial *tried, cut *by)
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

/* Chooses the side of many pieces whose projection is longer, or time if the pieces depend on it
 * more. */
static bool divide_many(const cell *c, const apart_trial *tried, cut *by)
{
    double size[2];
    for (int side = 0; side < 2; ++side) size[side] = c->count[side] > 1 ? tried->width[side] : -1;
    const int larger = size[1] > size[0];
    const double time = proof_larger(tried->size[0][T], tried->size[1][T]);
    *by = (cut){2 * time > size[larger] && c->t[0] < c->t[1] ? 2 : larger, 0, NAN};
    return true;
}

/* Tests whether the points at the centres are surely too near, or a single piece has to be divided
 * at the end of a part. */
static apart_outcome look_at_pieces(prover *p, const cell *c, cut *by, double *found)
{
    ld_interval x[2][3];
    for (int side = 0; side < 2; ++side) {
        place of;
        const box3 where = cell_area(p, c, side, 0, &of);
        const kept *k = kept_look(p->kept, &of, &where);
        const split *parts = &k->divide;
        if (k->result == ENCLOSED_EMPTY) return APART;
        const char *why = shadow_why_unknown(k->result);
        if (why != NULL) return apart_fail(p, c, INFINITY, why);
        *by = (cut){parts->along == T ? 2 : side, parts->along % T, parts->at};
        if (k->result == ENCLOSED_SPLIT) return DIVIDE;
        for (int i = 0; i < 3; ++i) x[side][i] = k->centre[i].v;
    }
    for (int i = 0; i < 3; ++i) x[0][i] = ld_interval_sub(x[1][i], x[0][i]);
    const ld_interval length = apart_length(x[0]);
    *found = ld_interval_mid(length);
    by->side = -1;
    return length.hi < p->apart ? apart_fail(p, c, *found, "two points of it are nearer") : DIVIDE;
}

static apart_outcome test(prover *p, const cell *c, cut *by)
{
    const bool is_single = c->count[0] == 1 && c->count[1] == 1;
    double n[AXES][3], best = -INFINITY, found = INFINITY;
    apart_outcome o = is_single ? look_at_pieces(p, c, by, &found) : DIVIDE;
    if (o != DIVIDE || (is_single && by->side >= 0)) return o;
    apart_trial tried = {.left = -INFINITY};
    bool some = is_single ? widest(c, &tried, by) : divide_many(c, &tried, by);
    if (is_single) {
        o = apart_by_centres(p, c, &tried);
        if (o != DIVIDE) return o;
        best = tried.left;
        if (best > -INFINITY) some = widest(c, &tried, by);
    }
    find_axes(p, c, n);
    for (int m = 0; m < AXES; ++m) {
        if (!is_axis(n[m])) continue;
        o = apart_by_axis(p, c, n[m], &tried);
        if (o != DIVIDE) return o;
        if (!(tried.left > best)) continue;
        best = tried.left;
        some = is_single ? widest(c, &tried, by) : divide_many(c, &tried, by);
    }
    return some ? DIVIDE : apart_fail(p, c, found, "it is too small to be divided");
}

/* --- Dividing --------------------------------------------------------------------------------- */

static bool prove(prover *p, const cell *c, int depth)
{
    cut by;
    cell half[2];
    if (++p->tests > p->tests_most || depth > DEPTH_MAX)
        return apart_fail(p, c, INFINITY, "it is not proved within the effort allowed"), false;
    const apart_outcome o = test(p, c, &by);
    if (o != DIVIDE) return o == APART;
    if (!cell_split(p, c, &by, half))
        return apart_fail(p, c, INFINITY, "it is too small to be divided"), false;
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
