/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/subdivision.h"

#include "core/bounds/separation.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"

/* --- Properties of a pair --------------------------------------------------------------------- */

bool pair_has_cluster(const pair *p) { return p->a->many != NULL || p->b->many != NULL; }

static const node *side_of(const pair *p, int side) { return side == 0 ? p->a : p->b; }

/* Curvature of both surfaces at any one time. */
static double pair_curvature(const pair *p)
{
    double sum = 0;
    for (int side = 0; side < 2; ++side) {
        const quadratic3 *f = &side_of(p, side)->f;
        for (int i = 0; i < 3; ++i) sum += fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
    }
    return sum;
}

double pair_remainder(const pair *p)
{
    double sum = -3 * (p->a->ball + p->b->ball);
    for (int i = 0; i < 3; ++i) sum += p->a->e[i] + p->b->e[i];
    return sum;
}

double pair_extent(const pair *p)
{
    return p->a->extent[0] + p->a->extent[1] + p->b->extent[0] + p->b->extent[1];
}

#define UNBOUNDED_ORDER 0x1p900 /* above any squared distance that matters */

double pair_order(const pair *p, double t)
{
    if (!p->a->bounded || !p->b->bounded) return UNBOUNDED_ORDER * (0x1p53 - (double)p->serial);
    const double distance2 = separation_centres(p->a, p->b, t);
    return distance2 >= 0 ? distance2 : INFINITY;
}

bool pair_precision_ends(const pair *p, const candidate_pair *both, double room, double flat)
{
    const double eval_error = both->side[0]->eval_error + both->side[1]->eval_error;
    return TUNING_PRECISION_ROOM * eval_error >= room && pair_curvature(p) <= flat * eval_error &&
           pair_remainder(p) <= TUNING_PRECISION_REMAINDER * flat * eval_error;
}

/* --- The cut ---------------------------------------------------------------------------------- */

/* Keeps the cut of greater value. A node without bounds is cut before a bounded one. */
static inline void cut_consider(cut *best, const pair *p, int side, parameter j, double gain)
{
    if (best->side >= 0 && !(gain > best->gain)) return;
    if (side_of(p, side)->bounded && !side_of(p, !side)->bounded) return;
    if (region_can_split(&side_of(p, side)->region, j)) *best = (cut){side, j, gain};
}

cut cut_by_contribution(const pair *p)
{
    cut best = CUT_NONE;
    for (int side = 0; side < 2; ++side)
        for (int j = 0; j < 3; ++j)
            cut_consider(&best, p, side, (parameter)j, side_of(p, side)->extent[j]);
    return best;
}

/* Whether the half below (0) or above (1) a cut in time contains moments of the window that the
 * other does not. If the window only touches the cut, one half contains all of it, so that no pair
 * is made for a single moment that the other half covers, too. */
static bool half_is_needed(const time_window *window, double at, int half)
{
    if (window->lo >= at) return half == 1;
    if (window->hi <= at) return half == 0;
    return true;
}

/* Whether one half contains the whole window: a cut in time then makes one child. */
static bool is_one_half_enough(const time_window *window, double at)
{
    return !half_is_needed(window, at, 0) || !half_is_needed(window, at, 1);
}

bool cut_is_free(const cut *c, const pair *p, int *half)
{
    if (c->side < 0 || c->along != PARAMETER_T) return false;
    const double at = side_of(p, c->side)->region.c[PARAMETER_T];
    *half = half_is_needed(&p->window, at, 1);
    return is_one_half_enough(&p->window, at);
}

/* What the value of a cut depends on apart from the node. */
typedef struct view {
    double scale;
    bool is_tangent; /* surfaces are nearly parallel: fixed axes do not separate them */
    bool has_nets;
} view;

/* Whether time's share of the node's remainder matters beside the scale and beside the shares of u
 * and v in both nodes. */
static bool time_blurs(const pair *p, const node *n, const view *of)
{
    const double place = pair_remainder(p) - (p->a->time_remainder + p->b->time_remainder);
    const double part = of->has_nets ? TUNING_BLUR_BESIDE_NETS : TUNING_BLUR_OF_PLACE;
    return TUNING_BLUR_OF_GAMMA * n->time_remainder > of->scale && part * n->time_remainder > place;
}

/* The value of a cut in time. Linear motion costs nothing, so only nonlinear motion counts: more
 * where the cut makes one child, and most where that node's remainder comes from time. */
static double gain_in_time(const pair *p, const node *n, double bend, const view *of)
{
    if (!is_one_half_enough(&p->window, n->region.c[PARAMETER_T])) return TUNING_TIME_CUT * bend;
    if (time_blurs(p, n, of)) return INFINITY;
    return (of->has_nets ? TUNING_TIME_CUT : TUNING_FREE_TIME_CUT) * bend;
}

/* The value of a cut along u or v. For tangent nodes only curvature counts, so that a cylinder that
 * is too wide for the field is not cut in length; slopes decide where nothing bends. */
static double gain_in_place(const node *n, parameter j, double bend, bool tangent)
{
    return tangent ? TUNING_TANGENT_CUT * bend + TUNING_TANGENT_SLOPE * n->extent[j] : n->extent[j];
}

/* Tubes are cut along v, around them, once they are open, and before all else then. */
static void consider_side(cut *best, const pair *p, int side, const double bend[3], const view *of)
{
    const node *n = side_of(p, side);
    cut_consider(best, p, side, PARAMETER_U,
                 gain_in_place(n, PARAMETER_U, bend[PARAMETER_U], of->is_tangent));
    if (!(n->ball > 0))
        cut_consider(best, p, side, PARAMETER_V,
                     gain_in_place(n, PARAMETER_V, bend[PARAMETER_V], of->is_tangent));
    else if (p->tubes == TUBES_OPEN)
        cut_consider(best, p, side, PARAMETER_V, INFINITY);
    cut_consider(best, p, side, PARAMETER_T, gain_in_time(p, n, bend[PARAMETER_T], of));
}

/* Lines in the middle of tubes are nearest where neither leads towards the other, as surfaces are
 * where they are parallel. */
static bool is_tangent(const pair *p)
{
    if (p->tubes == TUBES_CLOSED && p->a->ball > 0 && p->b->ball > 0) return true;
    return !(vec3_norm1(p->axis) > 0) && strategy_is_tangent(p->a, p->b);
}

cut cut_by_spread(const pair *p, double scale, bool has_nets)
{
    const view of = {scale, is_tangent(p), has_nets};
    cut best = CUT_NONE;
    for (int side = 0; side < 2; ++side)
        consider_side(&best, p, side, side_of(p, side)->nonlinear_extent, &of);
    return best;
}

cut cut_alone(const pair *p, int side, const double bend[3], double scale)
{
    const view of = {scale, .is_tangent = true};
    cut best = CUT_NONE;
    consider_side(&best, p, side, bend, &of);
    return best;
}

/* Estimates how far points of a node leave linear motion within the window. */
static double bend_of(const pair *p, const node *n)
{
    const double part = 0.5 * (p->window.hi - p->window.lo) / n->region.d[PARAMETER_T];
    const double bend = fabs(n->f.qtt[0]) + fabs(n->f.qtt[1]) + fabs(n->f.qtt[2]);
    return n->time_remainder + (part < 1 ? part * part * bend : bend);
}

cut cut_by_bend(const pair *p, double scale)
{
    const double bend[2] = {bend_of(p, p->a), bend_of(p, p->b)}, all = bend[0] + bend[1];
    const double place =
        pair_curvature(p) + pair_remainder(p) - (p->a->time_remainder + p->b->time_remainder);
    cut best = CUT_NONE;
    if (!(all > scale && TUNING_BEND_OF_PLACE * all > place)) return best;
    for (int side = 0; side < 2; ++side) cut_consider(&best, p, side, PARAMETER_T, bend[side]);
    return best;
}

cut cut_in_time(const pair *p)
{
    cut best = CUT_NONE;
    for (int side = 0; side < 2; ++side)
        cut_consider(&best, p, side, PARAMETER_T, side_of(p, side)->region.d[PARAMETER_T]);
    return best;
}

/* --- The halves ------------------------------------------------------------------------------- */

imp_code cut_take(const cut *c, int half, const candidate_pair *both, pair *p, bool *some,
                  imp_stats *stats, imp_error *error)
{
    node **slot = c->side == 0 ? &p->a : &p->b;
    tree *t = both->side[c->side]->tree;
    const double at = (*slot)->region.c[c->along];
    *some = c->along != PARAMETER_T || half_is_needed(&p->window, at, half);
    if (!*some) return IMP_SUCCESS;
    tree_growth growth = {0};
    const imp_code code = node_child(t, *slot, c->along, half, slot, &growth, error);
    stats->nodes += growth.nodes;
    stats->bytes += growth.bytes;
    if (code != IMP_SUCCESS) return code;
    p->window = window_common(p->window, pair_times(p->a, p->b));
    *some = p->window.lo <= p->window.hi;
    return IMP_SUCCESS;
}

static imp_code take_half(pair *p, const net_half *h, bool is_last, const candidate_pair *both,
                          tree_growth *growth, imp_error *error)
{
    node **slot = h->side == 0 ? &p->a : &p->b;
    tree *t = both->side[h->side]->tree;
    return is_last ? node_child(t, *slot, h->along, h->half, slot, growth, error)
                   : node_child_bare(t, *slot, h->along, h->half, slot, growth, error);
}

imp_code pair_take_halves(pair *p, const net_half *halves, int count, const candidate_pair *both,
                          imp_stats *stats, imp_error *error)
{
    int last[2] = {-1, -1};
    tree_growth growth = {0};
    imp_code code = IMP_SUCCESS;
    for (int k = 0; k < count; ++k) last[halves[k].side] = k;
    for (int k = 0; k < count && code == IMP_SUCCESS; ++k)
        code = take_half(p, &halves[k], k == last[halves[k].side], both, &growth, error);
    stats->nodes += growth.nodes;
    stats->bytes += growth.bytes;
    return code;
}

imp_code pair_descend(pair *p, const candidate_pair *both, imp_stats *stats, imp_error *error)
{
    while (pair_has_cluster(p)) {
        const cut c = {p->a->many != NULL ? 0 : 1, PARAMETER_U, 0};
        pair half[2] = {*p, *p};
        double distance[2];
        for (int k = 0; k < 2; ++k) {
            bool some;
            const imp_code code = cut_take(&c, k, both, &half[k], &some, stats, error);
            if (code != IMP_SUCCESS) return code;
            distance[k] = half[k].a->bounded && half[k].b->bounded
                              ? separation_boxes_lower(half[k].a, half[k].b)
                              : INFINITY;
        }
        *p = half[distance[1] < distance[0] ? 1 : 0];
    }
    return IMP_SUCCESS;
}

/* The first n / 2 of the n pieces of a cluster, in the hierarchy's order, are those of its first
 * half. */
imp_code pair_descend_to(pair *p, const size_t piece[2], const candidate_pair *both,
                         imp_stats *stats, imp_error *error)
{
    for (int side = 0; side < 2; ++side) {
        const node *root = side_of(p, side);
        size_t count = surface_piece_count(root->surface), at = 0;
        if (root->many == NULL) continue;
        const uint32_t *order = hierarchy_order(root->many->of);
        while (at + 1 < count && order[at] != piece[side]) ++at;
        while (side_of(p, side)->many != NULL) {
            const cut c = {side, PARAMETER_U, 0};
            const int half = at >= count / 2;
            bool some;
            const imp_code code = cut_take(&c, half, both, p, &some, stats, error);
            if (code != IMP_SUCCESS) return code;
            at -= half == 1 ? count / 2 : 0;
            count = half == 1 ? count - count / 2 : count / 2;
        }
    }
    return IMP_SUCCESS;
}
