/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/apart.h"

#include <math.h>
#include <string.h>

#include "core/common/array.h"

enum { U, V, T, VARIABLES, DEPTH_MAX = 400, REFINEMENTS = 96 };

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

static size_t mixed(const place *of, const box3 *where)
{
    uint64_t bits[2 * VARIABLES], sum = (uintptr_t)of->chain + 31 * of->maps + 977 * of->piece;
    memcpy(bits, where, sizeof bits);
    for (int j = 0; j < 2 * VARIABLES; ++j)
        sum = (sum ^ bits[j] ^ bits[j] >> 29) * UINT64_C(0x9e3779b97f4a7c15);
    return sum >> 32 & (KEPT - 1);
}

/* Encloses a box of a piece, or finds that again; another call may overwrite it. */
static const kept *look(prover *p, const place *of, const box3 *where)
{
    kept *k = &p->kept[mixed(of, where)];
    if (k->chain == of->chain && k->piece == of->piece && k->maps == of->maps &&
        memcmp(&k->where, where, sizeof *where) == 0)
        return k;
    k->chain = of->chain;
    k->piece = of->piece;
    k->maps = of->maps;
    k->where = *where;
    for (int j = 0; j < VARIABLES; ++j) k->c[j] = middle(where->lo[j], where->hi[j]);
    k->result = enclose(of, where, k->c, k->box, k->centre, &k->divide);
    return k;
}

static box3 box_of(const cell *c, int side)
{
    return (box3){{c->lo[side][U], c->lo[side][V], c->t[0]},
                  {c->hi[side][U], c->hi[side][V], c->t[1]}};
}

/* --- Shadows on an axis ----------------------------------------------------------------------- */

/* Each side's own direction of an axis: n of A, -n of B. A line in time is subtracted, which both
 * sides have in common, so that it cancels. */
typedef struct aim {
    double n[3], slope, mid;
} aim;

/* n.x - slope (t - mid) over a box of one side. */
typedef struct shadow {
    double lo, hi;          /* bounds */
    double value;           /* at the centre, about */
    double size[VARIABLES]; /* how much it depends on each variable, about */
} shadow;

static jet along(const jet x[3], const double n[3])
{
    jet sum = jet_scale(&x[0], ld_interval_of(n[0]));
    for (int i = 1; i < 3; ++i) {
        const jet term = jet_scale(&x[i], ld_interval_of(n[i]));
        sum = jet_add(&sum, &term);
    }
    return sum;
}

static double value_of(ld_interval x) { return ld_interval_mid(x); }

static void subtract_line(jet *x, const aim *a, ld_interval t)
{
    const ld_interval slope = ld_interval_of(a->slope);
    const ld_interval since = ld_interval_sub(t, ld_interval_of(a->mid));
    x->v = ld_interval_sub(x->v, ld_interval_mul(slope, since));
    x->d[T] = ld_interval_sub(x->d[T], slope);
    x->on |= 1 << T;
}

/* Dependence on each variable by derivatives, about. No more is shared out among the variables than
 * what the values vary by; where derivatives have no bounds, it is shared by the variables' widths.
 */
static void find_sizes(const jet *over, const jet *at, const double half[VARIABLES], shadow *s)
{
    const double most = over->v.hi - over->v.lo;
    double sum = 0, width = 0;
    for (int j = 0; j < VARIABLES; ++j) {
        s->size[j] = fabs(value_of(at->d[j])) * half[j];
        for (int k = 0; k < VARIABLES; ++k) {
            const ld_interval bend = j <= k ? over->h[j][k] : over->h[k][j];
            if (half[j] > 0 && half[k] > 0)
                s->size[j] += 0.5 * ld_interval_mag(bend) * half[j] * half[k];
        }
        sum += s->size[j];
        width += half[j];
    }
    for (int j = 0; j < VARIABLES && !(sum <= most); ++j)
        s->size[j] = most * (sum < INFINITY ? s->size[j] / sum : half[j] / width);
}

static shadow cast(const kept *k, const aim *a)
{
    jet over = along(k->box, a->n), at = along(k->centre, a->n);
    ld_interval offset[BOX_DIMS];
    double half[VARIABLES];
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(k->where.lo[j], k->where.hi[j]);
        offset[j] = ld_interval_sub(all, ld_interval_of(k->c[j]));
        half[j] = 0.5 * (all.hi - all.lo);
    }
    subtract_line(&over, a, ld_interval_make(k->where.lo[T], k->where.hi[T]));
    subtract_line(&at, a, ld_interval_of(k->c[T]));
    const ld_interval all = jet_values(&over, &at, offset);
    shadow s = {all.lo, all.hi, value_of(at.v), {0, 0, 0}};
    find_sizes(&over, &at, half, &s);
    return s;
}

/* --- Areas ------------------------------------------------------------------------------------ */

/* A box of a piece of one side, which may be divided while the other side is not. */
struct area {
    place of;
    box3 where;
    shadow s;
};

typedef enum outcome { APART, DIVIDE, STUCK } outcome;

static outcome fail(prover *p, const cell *c, double found, const char *why)
{
    p->worst = *c;
    p->found = found;
    p->why = why;
    return STUCK;
}

static const char left_open[] = "a formula leaves open what is there at these times";

static bool add_area(prover *p, int side, const place *of, const box3 *where, const aim *a);

static bool add_halves(prover *p, int side, const place *of, const box3 *where, const aim *a,
                       const split *by)
{
    box3 half[2] = {*where, *where};
    half[0].hi[by->along] = half[1].lo[by->along] = by->at;
    return add_area(p, side, of, &half[0], a) && add_area(p, side, of, &half[1], a);
}

/* False: p->why tells. */
static bool add_area(prover *p, int side, const place *of, const box3 *where, const aim *a)
{
    const kept *k = look(p, of, where);
    if (k->result == ENCLOSED_EMPTY) return true;
    if (k->result == ENCLOSED_SPLIT)
        return add_halves(p, side, of, where, a, &(split){k->divide.along, k->divide.at});
    area *grown = array_reserve(p->areas[side], p->count[side], &p->room[side], sizeof *grown);
    if (grown != NULL) p->areas[side] = grown;
    p->why = grown == NULL ? "memory ran out" : left_open;
    if (grown == NULL || k->result == ENCLOSED_UNSAID) return false;
    grown[p->count[side]++] = (area){*of, *where, cast(k, a)};
    return true;
}

static box3 area_of(const prover *p, const cell *c, int side, size_t k, place *of)
{
    box3 where = box_of(c, side);
    *of = piece_at(p, side, c->first[side] + k);
    if (c->count[side] > 1) piece_box(of, &where);
    return where;
}

/* Divides an area along what it depends on most. False: it cannot be divided, or p->why tells. */
static bool divide_area(prover *p, int side, size_t index, const aim *a)
{
    const area was = p->areas[side][index];
    split by = {-1, 0};
    for (int j = 0; j < VARIABLES; ++j) {
        const double lo = was.where.lo[j], hi = was.where.hi[j], mid = middle(lo, hi);
        if (!(lo < mid && mid < hi)) continue;
        if (by.along < 0 || was.s.size[j] > was.s.size[by.along]) by = (split){j, mid};
    }
    if (by.along < 0) return false;
    p->areas[side][index] = p->areas[side][--p->count[side]];
    return add_halves(p, side, &was.of, &was.where, a, &by);
}

/* How far a side reaches in its own direction. */
typedef struct reach {
    double bound, value; /* of all boxes, and at their centres, about */
    size_t worst;        /* the area that has the bound */
} reach;

static reach reach_of(const prover *p, int side)
{
    reach r = {-INFINITY, -INFINITY, 0};
    for (size_t k = 0; k < p->count[side]; ++k) {
        const shadow *s = &p->areas[side][k].s;
        if (!(s->hi <= r.bound)) r.bound = s->hi, r.worst = k;
        if (s->value > r.value) r.value = s->value;
    }
    return r;
}

/* --- An axis ---------------------------------------------------------------------------------- */

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
    const kept *k = look(p, &of, &where);
    double slope = 0;
    for (int i = 0; i < 3 && k->result == ENCLOSED; ++i)
        slope += n[i] * value_of(k->centre[i].d[T]);
    if (!(fabs(slope) < INFINITY)) slope = 0;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;
        a[side] =
            (aim){{sign * n[0], sign * n[1], sign * n[2]}, sign * slope, middle(c->t[0], c->t[1])};
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
    const reach a = reach_of(p, 0), b = reach_of(p, 1);
    const double most = -(a.value + b.value) - limit, low = -(a.bound + b.bound) - limit;
    tried->left = most > 0 ? low / most : -INFINITY;
    for (int side = 0; side < 2; ++side) {
        double lo = INFINITY, *size = tried->size[side];
        memset(size, 0, sizeof tried->size[side]);
        for (size_t k = 0; k < p->count[side]; ++k) {
            const shadow *s = &p->areas[side][k].s;
            lo = proof_smaller(lo, s->lo);
            for (int j = 0; j < VARIABLES; ++j) size[j] = proof_larger(size[j], s->size[j]);
        }
        tried->width[side] = (side == 0 ? a.bound : b.bound) - lo;
    }
}

/* Bounds lose what they lack, most - low, about as 1 / step where two variables are divided: gives
 * up where they will lack too much, or cost too much, when they are done. */
static bool is_hopeless(int step, double low, double most)
{
    const double lacks = (most - low) / most;
    return step >= REFINEMENTS || (step >= 4 && lacks * step > 2 * REFINEMENTS);
}

/* Lemma. |n.(B - A)| <= |n| |B - A|: where n.(B - A) >= |n| apart over the cell, no two points of
 * it are nearer. n.A is at most what A reaches along n, and -n.B what B reaches along -n. The sides
 * are divided one by one, since neither bound depends on the other side. */
static outcome try_axis(prover *p, const cell *c, const double n[3], trial *tried)
{
    const ld_interval x[3] = {ld_interval_of(n[0]), ld_interval_of(n[1]), ld_interval_of(n[2])};
    const double limit = ld_interval_mul(length_of(x), ld_interval_of(p->apart)).hi;
    aim a[2];
    take_aims(p, c, n, a);
    for (int side = 0; side < 2; ++side) {
        p->count[side] = 0;
        for (size_t k = 0; k < c->count[side]; ++k) {
            place of;
            const box3 where = area_of(p, c, side, k, &of);
            if (!add_area(p, side, &of, &where, &a[side])) return fail(p, c, INFINITY, p->why);
        }
    }
    take_trial(p, limit, tried);
    for (int step = 0;; ++step) {
        if (p->count[0] == 0 || p->count[1] == 0) return APART; /* it does not exist */
        const reach r[2] = {reach_of(p, 0), reach_of(p, 1)};
        const ld_interval sum =
            ld_interval_add(ld_interval_of(r[0].bound), ld_interval_of(r[1].bound));
        if (-sum.hi >= limit) return APART;
        const double most = -(r[0].value + r[1].value) - limit, low = -sum.hi - limit;
        if (!(most > 0) || is_hopeless(step, low, most)) return DIVIDE;
        const int side = r[1].bound - r[1].value > r[0].bound - r[0].value;
        p->why = NULL;
        if (!divide_area(p, side, r[side].worst, &a[side]))
            return p->why != NULL ? fail(p, c, INFINITY, p->why) : DIVIDE;
    }
}

/* --- A cell ----------------------------------------------------------------------------------- */

/* du x dv of one side at the centre. */
static void normal(const jet x[3], double n[3])
{
    double u[3], v[3];
    for (int i = 0; i < 3; ++i) u[i] = value_of(x[i].d[U]), v[i] = value_of(x[i].d[V]);
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
        const kept *at = look(p, &of, &where);
        for (int i = 0; i < 3 && at->result == ENCLOSED; ++i) {
            const double v = value_of(at->centre[i].v);
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
        const kept *k = look(p, &of, &where);
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
        const kept *k = look(p, &of, &where);
        const split *parts = &k->divide;
        if (k->result == ENCLOSED_EMPTY) return APART;
        if (k->result == ENCLOSED_UNSAID) return fail(p, c, INFINITY, left_open);
        *by = (cut){parts->along == T ? 2 : side, parts->along % T, parts->at};
        if (k->result == ENCLOSED_SPLIT) return DIVIDE;
        for (int i = 0; i < 3; ++i) x[side][i] = k->centre[i].v;
    }
    for (int i = 0; i < 3; ++i) x[0][i] = ld_interval_sub(x[1][i], x[0][i]);
    const ld_interval length = length_of(x[0]);
    *found = value_of(length);
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

bool prove_apart(prover *p, const cell *c)
{
    p->tests = 0;
    p->found = INFINITY;
    p->why = "";
    return prove(p, c, 0);
}
