/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/apart.h"

#include <math.h>
#include <string.h>

enum { U, V, T, DIMS = 5, TIME = 4, DEPTH_MAX = 400 };

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

static double middle(double lo, double hi)
{
    const double mid = 0.5 * lo + 0.5 * hi;
    return mid < lo ? lo : mid > hi ? hi : mid;
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

/* --- Enclosures ------------------------------------------------------------------------------- */

static void compute(const place *of, kept *k)
{
    k->result = enclose(of, &k->where, k->box, &k->divide);
    if (k->result != ENCLOSED) return;
    for (int j = 0; j < 3; ++j) k->c[j] = middle(k->where.lo[j], k->where.hi[j]);
    enclose_at(of, &k->where, k->c, k->centre);
}

static const kept *look(prover *p, int side, size_t index, const box3 *where)
{
    const place of = piece_at(p, side, index);
    for (int k = 0; k < KEPT; ++k) {
        const kept *have = &p->kept[side][k];
        if (have->is_set && have->piece == of.piece &&
            memcmp(&have->where, where, sizeof *where) == 0)
            return have;
    }
    kept *made = &p->kept[side][p->next[side]++ % KEPT];
    made->is_set = true;
    made->piece = of.piece;
    made->where = *where;
    compute(&of, made);
    return made;
}

static box3 box_of(const cell *c, int side)
{
    return (box3){{c->lo[side][U], c->lo[side][V], c->t[0]},
                  {c->hi[side][U], c->hi[side][V], c->t[1]}};
}

/* --- One piece and another -------------------------------------------------------------------- */

/* Variables of a cell: u and v of A, u and v of B, t. */
static int variable(int side, int j) { return j == T ? TIME : 2 * side + j; }

static jet spread(const jet *x, int side)
{
    jet y = jet_constant(DIMS, x->v);
    for (int j = 0; j < 3; ++j) {
        y.d[variable(side, j)] = x->d[j];
        for (int k = j; k < 3; ++k) y.h[variable(side, j)][variable(side, k)] = x->h[j][k];
    }
    return y;
}

/* B - A over a cell and at a point of it. */
typedef struct difference {
    jet box[3], centre[3];
    ld_interval offset[DIMS];
    double half[DIMS];  /* about half of the cell's size, */
    double width[2][3]; /* and of each side's box: only to choose by */
} difference;

static void subtract(const kept *const k[2], difference *d)
{
    for (int i = 0; i < 3; ++i) {
        const jet a = spread(&k[0]->box[i], 0), b = spread(&k[1]->box[i], 1);
        const jet c = spread(&k[0]->centre[i], 0), e = spread(&k[1]->centre[i], 1);
        d->box[i] = jet_sub(&b, &a);
        d->centre[i] = jet_sub(&e, &c);
        d->width[0][i] = (double)(a.v.hi - a.v.lo);
        d->width[1][i] = (double)(b.v.hi - b.v.lo);
    }
    for (int side = 0; side < 2; ++side)
        for (int j = 0; j < 3; ++j) {
            const box3 *w = &k[side]->where;
            d->offset[variable(side, j)] = ld_interval_sub(ld_interval_make(w->lo[j], w->hi[j]),
                                                           ld_interval_of(k[side]->c[j]));
            d->half[variable(side, j)] = 0.5 * (w->hi[j] - w->lo[j]);
        }
}

static jet along(const jet x[3], const double n[3])
{
    jet sum = jet_scale(&x[0], ld_interval_of(n[0]));
    for (int i = 1; i < 3; ++i) {
        const jet term = jet_scale(&x[i], ld_interval_of(n[i]));
        sum = jet_add(&sum, &term);
    }
    return sum;
}

static ld_interval length_of(const ld_interval x[3])
{
    const ld_interval sum = ld_interval_add(
        ld_interval_add(ld_interval_sqr(x[0]), ld_interval_sqr(x[1])), ld_interval_sqr(x[2]));
    return ld_interval_sqrt(sum);
}

/* An upper bound of |n| apart. */
static long double limit_upper(const prover *p, const double n[3])
{
    const ld_interval x[3] = {ld_interval_of(n[0]), ld_interval_of(n[1]), ld_interval_of(n[2])};
    return ld_interval_mul(length_of(x), ld_interval_of(p->apart)).hi;
}

/* Lemma. |n.(B - A)| <= |n| |B - A|: where n.(B - A) >= |n| apart over the cell, no two points of
 * it are nearer. Returns how much is left of n.(B - A), relative to |n|. */
static long double margin(const prover *p, const difference *d, const double n[3], jet *over,
                          jet *at)
{
    *over = along(d->box, n);
    *at = along(d->centre, n);
    const long double low = jet_values(over, at, d->offset).lo - limit_upper(p, n);
    return low / (fabsl(n[0]) + fabsl(n[1]) + fabsl(n[2]));
}

static bool is_axis(const double n[3])
{
    const double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    return sum > 0 && sum < INFINITY;
}

static double value_of(ld_interval x) { return (double)ld_interval_mid(x); }

/* du x dv of one side at the centre, so that it points from A to B. */
static void normal(const difference *d, int side, double n[3])
{
    double u[3], v[3], sign = 0;
    for (int i = 0; i < 3; ++i) {
        u[i] = value_of(d->centre[i].d[variable(side, U)]);
        v[i] = value_of(d->centre[i].d[variable(side, V)]);
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = u[j] * v[k] - u[k] * v[j];
        sign += n[i] * value_of(d->centre[i].v);
    }
    for (int i = 0; i < 3 && sign < 0; ++i) n[i] = -n[i];
}

/* How much n.(B - A) depends on a variable, about: by its derivatives, and no more than its part,
 * by size, of the values of the sides that it moves, since derivatives may have no bounds. */
static double dependence(const difference *d, const double n[3], const jet *over, const jet *at,
                         int j)
{
    double size = fabs(value_of(at->d[j])) * d->half[j], most = 0;
    for (int k = 0; k < DIMS; ++k) {
        const ld_interval bend = j <= k ? over->h[j][k] : over->h[k][j];
        const double both = d->half[j] * d->half[k];
        if (both > 0) size += 0.5 * (double)ld_interval_mag(bend) * both;
    }
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3 && (j == TIME || j / 2 == side); ++i)
            most += fabs(n[i]) * d->width[side][i];
    if (size <= most) return size;
    const int of = j == TIME ? 0 : 2 * (j / 2);
    return most * d->half[j] / (d->half[of] + d->half[of + 1] + d->half[TIME]);
}

/* The variable that n.(B - A) depends on most, for what can be divided, the widest of equals; -1:
 * none. */
static int widest(const difference *d, const double n[3], const jet *over, const jet *at)
{
    int best = -1;
    double most = -1;
    for (int j = 0; j < DIMS; ++j) {
        if (!(d->half[j] > 0)) continue;
        const double size = dependence(d, n, over, at, j);
        const bool is_wider = best >= 0 && size == most && d->half[j] > d->half[best];
        if (is_wider || !(size <= most)) best = j, most = size;
    }
    return best;
}

typedef enum outcome { APART, DIVIDE, STUCK } outcome;

static outcome fail(prover *p, const cell *c, double found, const char *why)
{
    p->worst = *c;
    p->found = found;
    p->why = why;
    return STUCK;
}

/* Whether two points, those of the centres, are surely nearer. */
static bool is_refuted(const prover *p, const difference *d, double *found)
{
    const ld_interval x[3] = {d->centre[0].v, d->centre[1].v, d->centre[2].v};
    const ld_interval length = length_of(x);
    *found = value_of(length);
    return length.hi < p->apart;
}

/* A box that is in no part is divided where one ends. */
static outcome divide_parts(const kept *k, int side, cut *by)
{
    *by = (cut){k->divide.along == T ? 2 : side, k->divide.along, k->divide.at};
    return DIVIDE;
}

static outcome test_pieces(prover *p, const cell *c, cut *by)
{
    const kept *k[2];
    difference d;
    double found;
    for (int side = 0; side < 2; ++side) {
        const box3 where = box_of(c, side);
        k[side] = look(p, side, c->first[side], &where);
        if (k[side]->result == ENCLOSED_EMPTY) return APART;
        if (k[side]->result == ENCLOSED_SPLIT) return divide_parts(k[side], side, by);
        if (k[side]->result == ENCLOSED_UNSAID)
            return fail(p, c, INFINITY, "a formula leaves open what is there at these times");
    }
    subtract(k, &d);
    if (is_refuted(p, &d, &found)) return fail(p, c, found, "two points of it are nearer");
    double axes[4][3];
    memcpy(axes[0], p->axis, sizeof axes[0]);
    for (int i = 0; i < 3; ++i) axes[1][i] = value_of(d.centre[i].v);
    normal(&d, 0, axes[2]);
    normal(&d, 1, axes[3]);
    long double best = -INFINITY;
    int wide = -1;
    for (int n = 0; n < 4; ++n) {
        jet over, at;
        if (!is_axis(axes[n])) continue;
        const long double left = margin(p, &d, axes[n], &over, &at);
        if (left >= 0) return APART;
        if (left <= best && wide >= 0) continue;
        best = left;
        wide = widest(&d, axes[n], &over, &at);
    }
    if (wide < 0)
        for (int j = 0; j < DIMS; ++j)
            if (d.half[j] > 0 && (wide < 0 || d.half[j] > d.half[wide])) wide = j;
    if (wide < 0) return fail(p, c, found, "it is too small to be divided");
    *by = (cut){wide == TIME ? 2 : wide / 2, wide % 2, NAN};
    return DIVIDE;
}

/* --- Many pieces ------------------------------------------------------------------------------ */

/* Bounds of n.x - slope (t - mid) over pieces of one side. */
typedef struct support {
    long double lo, hi;
    double slope;     /* chosen for the first piece */
    double middle[2]; /* least and greatest of the values at the pieces' centres */
} support;

static bool support_box(const prover *p, const place *of, const box3 *where, const double n[3],
                        double mid, support *s)
{
    kept k = {.where = *where};
    compute(of, &k);
    if (k.result == ENCLOSED_EMPTY) return true;
    if (k.result == ENCLOSED_UNSAID) return false;
    if (k.result == ENCLOSED_SPLIT) {
        box3 half[2] = {*where, *where};
        half[0].hi[k.divide.along] = half[1].lo[k.divide.along] = k.divide.at;
        return support_box(p, of, &half[0], n, mid, s) && support_box(p, of, &half[1], n, mid, s);
    }
    jet over = along(k.box, n), at = along(k.centre, n);
    ld_interval offset[BOX_DIMS];
    for (int j = 0; j < 3; ++j)
        offset[j] =
            ld_interval_sub(ld_interval_make(where->lo[j], where->hi[j]), ld_interval_of(k.c[j]));
    if (isnan(s->slope)) s->slope = value_of(at.d[T]);
    const ld_interval slope = ld_interval_of(s->slope), from = ld_interval_of(mid);
    jet line = jet_constant(
        3, ld_interval_mul(slope,
                           ld_interval_sub(ld_interval_make(where->lo[T], where->hi[T]), from)));
    line.d[T] = slope;
    over = jet_sub(&over, &line);
    line.v = ld_interval_mul(slope, ld_interval_sub(ld_interval_of(k.c[T]), from));
    at = jet_sub(&at, &line);
    const ld_interval all = jet_values(&over, &at, offset);
    const double value = value_of(at.v);
    if (!(all.lo >= s->lo)) s->lo = all.lo;
    if (!(all.hi <= s->hi)) s->hi = all.hi;
    if (value < s->middle[0]) s->middle[0] = value;
    if (value > s->middle[1]) s->middle[1] = value;
    return true;
}

static bool support_of(const prover *p, const cell *c, int side, const double n[3], support *s)
{
    *s = (support){INFINITY, -INFINITY, NAN, {INFINITY, -INFINITY}};
    for (size_t k = 0; k < c->count[side]; ++k) {
        const place of = piece_at(p, side, c->first[side] + k);
        box3 where = box_of(c, side);
        if (c->count[side] > 1) piece_box(&of, &where);
        if (!support_box(p, &of, &where, n, middle(c->t[0], c->t[1]), s)) return false;
    }
    return true;
}

/* Points at the middle of the first, the middle and the last piece, for an axis of centres. */
static bool centre_of(const prover *p, const cell *c, int side, double x[3])
{
    double lo[3], hi[3];
    bool some = false;
    const size_t count = c->count[side], step = count > 8 ? count / 8 : 1;
    for (size_t k = 0; k < count; k += step) {
        const place of = piece_at(p, side, c->first[side] + k);
        box3 where = box_of(c, side);
        if (count > 1) piece_box(&of, &where);
        double at[3];
        for (int j = 0; j < 3; ++j) at[j] = middle(where.lo[j], where.hi[j]);
        where.lo[T] = where.hi[T] = at[T] = middle(c->t[0], c->t[1]);
        for (int j = 0; j < 2; ++j) where.lo[j] = where.hi[j] = at[j];
        jet out[3];
        if (enclose_at(&of, &where, at, out) != ENCLOSED) continue;
        for (int i = 0; i < 3; ++i) {
            const double v = value_of(out[i].v);
            lo[i] = some && lo[i] < v ? lo[i] : v;
            hi[i] = some && hi[i] > v ? hi[i] : v;
        }
        some = true;
    }
    for (int i = 0; i < 3 && some; ++i) x[i] = 0.5 * lo[i] + 0.5 * hi[i];
    return some;
}

/* Lemma. n.(B - A) is at least the least of B less the greatest of A, and the difference of their
 * slopes times the time from the middle. */
static long double margin_of_many(const prover *p, const cell *c, const double n[3],
                                  const support s[2])
{
    const ld_interval t = ld_interval_sub(ld_interval_make(c->t[0], c->t[1]),
                                          ld_interval_of(middle(c->t[0], c->t[1])));
    if (!(s[0].lo <= s[0].hi && s[1].lo <= s[1].hi)) return INFINITY; /* one does not exist */
    const ld_interval slope =
        ld_interval_sub(ld_interval_of(s[1].slope), ld_interval_of(s[0].slope));
    const ld_interval gap = ld_interval_sub(ld_interval_of(s[1].lo), ld_interval_of(s[0].hi));
    return ld_interval_add(gap, ld_interval_mul(slope, t)).lo - limit_upper(p, n);
}

static void divide_many(const cell *c, const support s[2], cut *by)
{
    const double time = fabs(s[1].slope - s[0].slope) * 0.5 * (c->t[1] - c->t[0]);
    double size[2];
    for (int side = 0; side < 2; ++side)
        size[side] = c->count[side] > 1 ? (double)(s[side].hi - s[side].lo) : -1;
    const double blur = (double)(s[0].hi - s[0].lo + s[1].hi - s[1].lo) -
                        (s[0].middle[1] - s[0].middle[0] + s[1].middle[1] - s[1].middle[0]);
    const int larger = size[1] > size[0];
    if ((time > size[larger] || blur > 2 * size[larger]) && c->t[0] < c->t[1])
        *by = (cut){2, 0, NAN};
    else
        *by = (cut){larger, 0, NAN};
}

static outcome test_many(prover *p, const cell *c, cut *by)
{
    double axes[2][3] = {{p->axis[0], p->axis[1], p->axis[2]}}, x[2][3];
    const bool some = centre_of(p, c, 0, x[0]) && centre_of(p, c, 1, x[1]);
    for (int i = 0; i < 3; ++i) axes[1][i] = some ? x[1][i] - x[0][i] : 0;
    *by = (cut){c->count[0] > 1 ? 0 : 1, 0, NAN};
    for (int n = 0; n < 2; ++n) {
        support s[2];
        if (!is_axis(axes[n])) continue;
        if (!support_of(p, c, 0, axes[n], &s[0]) || !support_of(p, c, 1, axes[n], &s[1]))
            return fail(p, c, INFINITY, "a formula leaves open what is there at these times");
        if (margin_of_many(p, c, axes[n], s) >= 0) return APART;
        divide_many(c, s, by);
    }
    return DIVIDE;
}

/* --- Dividing --------------------------------------------------------------------------------- */

static bool prove(prover *p, const cell *c, int depth)
{
    cut by;
    cell half[2];
    if (++p->tests > p->tests_most || depth > DEPTH_MAX)
        return fail(p, c, INFINITY, "it is not proved within the effort allowed"), false;
    const bool single = c->count[0] == 1 && c->count[1] == 1;
    const outcome o = single ? test_pieces(p, c, &by) : test_many(p, c, &by);
    if (o != DIVIDE) return o == APART;
    if (!cell_split(p, c, &by, half))
        return fail(p, c, INFINITY, "it is too small to be divided"), false;
    return prove(p, &half[0], depth + 1) && prove(p, &half[1], depth + 1);
}

bool prove_apart(prover *p, const cell *c)
{
    p->tests = 0;
    p->found = INFINITY;
    p->why = "";
    return prove(p, c, 0);
}
