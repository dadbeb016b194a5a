/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/orbit.h"

#include <math.h>

/* --- Chains ----------------------------------------------------------------------------------- */

/* The part of stage k that has all of the times, if that is one affine map which follows T. */
static const part *map_at(const place *p, size_t k, double lo, double hi)
{
    const box3 times = {{-INFINITY, -INFINITY, lo}, {INFINITY, INFINITY, hi}};
    const part *found;
    split unused;
    if (!place_follows_main(p, k)) return NULL;
    if (enclose_choose(p, k, &times, &found, &unused) != ENCLOSED) return NULL;
    const bool alone = enclose_next_part(enclose_piece(p, k), found, &times) == NULL;
    return alone && found->is_affine ? found : NULL;
}

double orbit_span(const place *p, double lo, double hi, size_t *stage_index)
{
    double most = 0;
    *stage_index = 0;
    for (size_t k = 1; k <= p->maps; ++k) {
        const piece *map = enclose_piece(p, k);
        for (size_t i = 0; i < map->count && place_follows_main(p, k); ++i) {
            const part *at = &map->parts[i];
            const bool is_there = at->lo[T] < hi && lo < at->hi[T];
            if (at->turn == NULL || !is_there || !(at->turn->rate > most)) continue;
            most = at->turn->rate, *stage_index = k;
        }
    }
    return most * (hi - lo);
}

static void set_part(const turning *of, int m, affine *x)
{
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c)
            x->wide[i][c] = x->centre[i][c] = jet_constant(1, of->m[m][i][c]);
}

/* The chain before all maps. */
static void begin_chain(double lo, double hi, affine *x)
{
    const ld_interval at = ld_interval_of(middle(lo, hi));
    x->offset[0] = ld_interval_sub(ld_interval_make(lo, hi), at);
    for (int j = 1; j < BOX_DIMS; ++j) x->offset[j] = ld_interval_of(0);
    affine_set(x, true);
}

/* Lemma. Let E be the maps before one that is m0 + C m1 + S m2, and x -> L x + d those after it.
 * All of them take x to L (m0 E x) + d + C L m1 E x + S L m2 E x, at each time. */
void orbit_take_by(const place *p, size_t stage_index, double lo, double hi, orbit *to)
{
    affine *n = to->n, next;
    *to = (orbit){.is_known = true};
    begin_chain(lo, hi, &n[0]);
    for (size_t k = 1; k <= p->maps; ++k) {
        const part *map = map_at(p, k, lo, hi);
        if (map == NULL) to->is_known = false;
        if (map == NULL) return;
        if (k == stage_index && map->turn != NULL) {
            to->turns = true, to->stage = k;
            n[1] = n[2] = n[0];
            for (int m = 0; m < 3; ++m) {
                set_part(map->turn, m, &next);
                affine_compose(&next, &n[m], true);
            }
        } else {
            affine_take(map, lo, hi, p->room, &next);
            for (int m = 0; m < (to->turns ? 3 : 1); ++m) affine_compose(&next, &n[m], m == 0);
        }
    }
}

void orbit_take(const place *p, double lo, double hi, orbit *to)
{
    size_t most;
    const double span = orbit_span(p, lo, hi, &most);
    orbit_take_by(p, most, lo, hi, to);
    to->span = span;
}

/* --- Along a direction ------------------------------------------------------------------------ */

/* A jet of time alone as one of u, v and t. */
static jet lifted(const jet *x)
{
    jet r = jet_constant(VARIABLES, x->v);
    r.bends = x->bends > 0 ? VARIABLES : 0;
    r.is_undefined = x->is_undefined;
    if (!jet_has(x, 0)) return r;
    r.on = 1 << T;
    r.d[T] = x->d[0];
    r.h[T][T] = x->h[0][0];
    return r;
}

static void take_row(const jet n[3][4], const double v[3], jet row[4])
{
    for (int c = 0; c < 4; ++c) {
        jet sum = jet_constant(1, ld_interval_of(0));
        for (int i = 0; i < 3; ++i) {
            const jet term = jet_scale(&n[i][c], ld_interval_of(v[i]));
            sum = jet_add(&sum, &term);
        }
        row[c] = lifted(&sum);
    }
}

void orbit_take_rows(const orbit *o, const double v[3], orbit_rows *to)
{
    for (int i = 0; i < 3; ++i) to->v[i] = v[i];
    for (int m = 0; m < (o->turns ? 3 : 1); ++m) {
        take_row(o->n[m].wide, v, to->wide[m]);
        take_row(o->n[m].centre, v, to->centre[m]);
    }
}

/* The row times a point, or, without the shift, a direction. */
static jet product(const jet row[4], const jet x[3], bool shifts)
{
    jet sum = jet_mul(&row[0], &x[0]);
    for (int c = 1; c < 3; ++c) {
        const jet term = jet_mul(&row[c], &x[c]);
        sum = jet_add(&sum, &term);
    }
    return shifts ? jet_add(&sum, &row[3]) : sum;
}

void orbit_take_parts(const jet rows[][4], int turns, const jet s[][3], int circles,
                      orbit_parts *to)
{
    to->turns = turns, to->circles = circles;
    for (int m = 0; m < turns; ++m)
        for (int k = 0; k < circles; ++k) to->at[m][k] = product(rows[m], s[k], k == 0);
}

static jet length_of(const jet *x, const jet *y)
{
    return jet_length((const jet *const[2]){x, y}, 2);
}

/* Lemma. C b + S c <= sqrt(b^2 + c^2) where C^2 + S^2 = 1, by Cauchy-Schwarz. C and S being those
 * of an angle A, and c and s those of B, also C (c p + s q) + S (c r + s w) is 1/2 (p + w) cos(A -
 * B) + 1/2 (r - q) sin(A - B) + 1/2 (p - w) cos(A + B) + 1/2 (r + q) sin(A + B), so at most half
 * the sum of the lengths of (p + w, r - q) and (p - w, r + q). */
static jet reach_of_both(const orbit_parts *r)
{
    const jet *p = &r->at[1][1], *q = &r->at[1][2], *x = &r->at[2][1], *w = &r->at[2][2];
    const jet sum[2] = {jet_add(p, w), jet_sub(x, q)}, rest[2] = {jet_sub(p, w), jet_add(x, q)};
    const jet a = length_of(&sum[0], &sum[1]), b = length_of(&rest[0], &rest[1]);
    const jet both = jet_add(&a, &b);
    return jet_scale(&both, ld_interval_of(0.5));
}

/* The sum of v.n[m] s[k] times 1, cos A or sin A, and times 1, cos B or sin B: each of its four
 * groups has a bound of its own. */
jet orbit_reach(const orbit_parts *r)
{
    jet sum = r->at[0][0];
    if (r->circles > 1) {
        const jet radius = length_of(&r->at[0][1], &r->at[0][2]);
        sum = jet_add(&sum, &radius);
    }
    if (r->turns > 1) {
        const jet radius = length_of(&r->at[1][0], &r->at[2][0]);
        sum = jet_add(&sum, &radius);
    }
    if (r->turns > 1 && r->circles > 1) {
        const jet radius = reach_of_both(r);
        sum = jet_add(&sum, &radius);
    }
    return sum;
}

/* --- Guesses ---------------------------------------------------------------------------------- */

static void take_column(const affine *n, int c, double to[3])
{
    for (int i = 0; i < 3; ++i) to[i] = ld_interval_mid(n->centre[i][c].v);
}

bool orbit_axis(const orbit *o, double axis[3])
{
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        double x[3], y[3], n[3], size = 0;
        take_column(&o->n[1], c, x);
        take_column(&o->n[2], c, y);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            n[i] = x[j] * y[k] - x[k] * y[j];
            size += n[i] * n[i];
        }
        if (!(size > most)) continue;
        most = size;
        for (int i = 0; i < 3; ++i) axis[i] = n[i] / sqrt(size);
    }
    return most > 1e-12;
}

static void apply(const affine *n, const double x[3], double to[3])
{
    take_column(n, 3, to);
    for (int c = 0; c < 3; ++c) {
        double column[3];
        take_column(n, c, column);
        for (int i = 0; i < 3; ++i) to[i] += column[i] * x[c];
    }
}

void orbit_points(const orbit *o, const double x[3], double centre[3], double radius[3])
{
    apply(&o->n[0], x, centre);
    apply(&o->n[1], x, radius);
}

bool orbit_is_about(const orbit *o, const double c[3], const double d[3], double size)
{
    double axis[3], off[3], unused[3], turned = 0, far = 0, square = 0;
    const double origin[3] = {0, 0, 0};
    if (!o->is_known || !o->turns || !orbit_axis(o, axis)) return false;
    orbit_points(o, origin, off, unused);
    for (int i = 0; i < 3; ++i) off[i] -= c[i];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double across = axis[j] * d[k] - axis[k] * d[j];
        const double away = axis[j] * off[k] - axis[k] * off[j];
        turned += across * across, far += away * away, square += d[i] * d[i];
    }
    return turned <= 1e-18 * square && far <= 1e-18 * size * size;
}
