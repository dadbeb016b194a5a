/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_spread.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/bounds/fixed_axes.h"
#include "core/solver/impact.h"

/* The ways of B - A, and a bound of the rest. */
typedef struct pair_ways {
    double way[SCENE_PARAMETERS_MAX][4];
    double rest; /* length */
} pair_ways;

/* Whether the trees of the pair are over the query's times. One that has trees of one moment is
 * searched there for all times, since its distance at the middle values stays: not so at others. */
static bool is_of_all_times(const impact *im, const candidate_pair *both)
{
    if (!(im->window.lo < im->window.hi)) return true;
    for (int side = 0; side < 2; ++side) {
        const imp_region *r = &tree_root(both->side[side]->tree)->region;
        if (!(r->lo[PARAMETER_T] < r->hi[PARAMETER_T])) return false;
    }
    return true;
}

static bool add_side(const query_spread *spread, const candidate *c, int side,
                     const spread_place *place, pair_ways *ways)
{
    if (c->left_out < spread->left_out || !spread->known[side][c->surface]) return false;
    return surface_spread_at(&spread->of[side][c->surface],
                             scene_surface(spread->scene, spread->body[side], c->surface), place,
                             side == 0 ? -1 : 1, ways->way, &ways->rest);
}

static void ways_begin(const query_spread *spread, pair_ways *ways)
{
    memset(ways->way, 0, spread->parameters * sizeof *ways->way);
    ways->rest = 0;
}

/* Sets the place of a node's points at time t: around that of its middle. Lemma. At t, with s that
 * of t, |s| <= 1, the polynomial less its terms in s alone is at most the sum of its other
 * coefficients' absolute values, to which the remainder is added. The place itself is off by less
 * than 2^-40 of its terms. Twelve sums, a root. */
PAD_COVERS(32, 12 + 4);
static void place_node(const node *n, spread_place *place)
{
    const quadratic3 *f = &n->f;
    const double d = n->region.d[PARAMETER_T];
    const double s = d > 0 ? (place->t - n->region.c[PARAMETER_T]) / d : 0;
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double size = fabs(f->a[i]) + fabs(f->bt[i]) + fabs(f->qtt[i]);
        const double reach = fabs(f->bu[i]) + fabs(f->bv[i]) + fabs(f->quu[i]) + fabs(f->quv[i]) +
                             fabs(f->qvv[i]) + fabs(f->qut[i]) + fabs(f->qvt[i]) + n->e[i] +
                             size * 0x1p-40;
        place->at[i] = f->a[i] + (f->bt[i] + f->qtt[i] * s) * s;
        sum += reach * reach;
    }
    place->radius = padded_upper(sqrt(sum), 32) + ROOT_UNDERFLOW;
}

/* Finds the ways over a window. */
static bool ways_over(const impact *im, const pair *p, const time_window *window, pair_ways *ways)
{
    const candidate_pair *both = &im->candidate_pairs[p->candidate_pair];
    const double mid = 0.5 * window->lo + 0.5 * window->hi;
    ways_begin(im->spread, ways);
    for (int side = 0; side < 2; ++side) {
        spread_place place = {.t = mid,
                              .half = window_half_upper(window, mid),
                              .left_out = both->side[side]->left_out};
        place_node(side == 0 ? p->a : p->b, &place);
        if (!add_side(im->spread, both->side[side], side, &place, ways)) return false;
    }
    return true;
}

/* Lemma. At values p of the box a point of A and one of B are y - x + sum_k s_k way_k + rest apart,
 * |s_k| <= 1 (surface_spread.h): so nodes whose difference with the ways is farther away than
 * gamma_clear + rest along an axis are farther apart than gamma_clear at all p. Maps that both
 * trees leave out keep distances at any values, since they turn exactly. */
static bool cut_window(const impact *im, const pair *p, time_window *window, bool *known)
{
    pair_ways ways;
    difference r;
    w_range s = {-1, 1};
    vec3 axis = p->axis;
    *known = ways_over(im, p, window, &ways);
    if (!*known) return true;
    difference_at(p->a, p->b, window, &r);
    r.ways = ways.way;
    r.way_count = im->spread->parameters;
    const double apart = sum_upper(im->spread->gamma_clear, ways.rest);
    if (!fixed_axes_cut(&r, apart, &s, &axis, NULL)) return false;
    window_cut(window, r.mid, r.half, &s);
    return true;
}

enum { ROUNDS = 8 };

/* Where the whole window is not excluded, its beginning is tried: over shorter times the ways turn
 * less. */
bool pair_spread_cut(const impact *im, pair *p)
{
    const candidate_pair *both = &im->candidate_pairs[p->candidate_pair];
    double length = p->window.hi - p->window.lo;
    bool known = true;
    if (im->spread == NULL || !p->a->bounded || !p->b->bounded) return true;
    if (!is_of_all_times(im, both)) return true;
    for (int round = 0; round < ROUNDS && known; ++round) {
        const double end = p->window.lo + length;
        const bool is_whole = !(end < p->window.hi);
        time_window part = {p->window.lo, is_whole ? p->window.hi : end};
        const bool some = cut_window(im, p, &part, &known);
        if (!some && is_whole) return false;
        if (is_whole && some) p->window.hi = part.hi;
        if (!some) length *= 2;
        p->window.lo = some ? part.lo : end;
        if (!(p->window.lo < p->window.hi)) return true;
        if (some) length = 0.25 * (part.hi - part.lo);
    }
    return true;
}

/* How much more than what the values move the points by, to first order, is no contact yet. */
static const double ENDS_BEYOND = 1.25;

bool pair_spread_ends(const impact *im, const pair *p, const witness *seen)
{
    const candidate_pair *both = &im->candidate_pairs[p->candidate_pair];
    const query_spread *spread = im->spread;
    pair_ways ways;
    if (!(seen->gap_upper <= im->gamma)) return false;
    if (spread == NULL || !seen->has_normal || !is_of_all_times(im, both)) return true;
    ways_begin(spread, &ways);
    for (int side = 0; side < 2; ++side) {
        const double *x = seen->point[side].x;
        const spread_place place = {
            {x[0], x[1], x[2]}, 0, p->window.lo, 0, both->side[side]->left_out};
        if (!add_side(spread, both->side[side], side, &place, &ways)) return true;
    }
    double moved = ways.rest;
    for (size_t k = 0; k < spread->parameters; ++k)
        moved += fabs(vec3_dot(seen->normal, vec3_from(ways.way[k])));
    return seen->gap_upper <= spread->gamma + ENDS_BEYOND * moved;
}
