/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/strategy.h"

#include "core/base/rounding.h"
#include "core/bounds/tuning.h"

/* --- What nodes are like ---------------------------------------------------------------------- */

static const double ROUNDING = 0x1p-24; /* remainders below this part are mere rounding */

/* Whether a net may be tighter than the quadratic: false for a bilinear patch without remainder. */
static inline bool net_may_be_tighter(const node *n)
{
    return node_bends(n) || node_blurs(n, ROUNDING);
}

/* Whether the node is a point, or a curve that is nearly straight. */
static bool is_thin(const node *n)
{
    return !node_has_normal(n) && n->many == NULL && !node_blurs(n, TUNING_STRAIGHT_BLUR);
}

/* Whether both nodes are nearly flat, so that GJK decides at each moment and only time is left to
 * be searched: splitting u or v would not help. */
static bool are_flat(const node *a, const node *b)
{
    double bent = 0, extent = 0;
    const node *both[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        const quadratic3 *f = &both[k]->f;
        for (int i = 0; i < 3; ++i)
            bent += node_blur(both[k], i) + fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
        extent += both[k]->extent[PARAMETER_U] + both[k]->extent[PARAMETER_V];
    }
    return TUNING_FLAT * bent < extent;
}

/* Whether quadratics may be tighter than hulls: a hull is off by a part of the curvature, a
 * quadratic by its remainder. */
static bool are_quadratics_closer(const node *a, const node *b)
{
    double remainder = 0, bend = 0;
    const node *both[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        const quadratic3 *f = &both[k]->f;
        for (int i = 0; i < 3; ++i) {
            remainder += both[k]->e[i];
            bend += fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
        }
    }
    return TUNING_NET_BEND * remainder < bend;
}

bool strategy_is_tangent(const node *a, const node *b)
{
    const vec3 m = node_normal(a), n = node_normal(b);
    const double cosine = vec3_dot(m, n), least = TUNING_FIELD_COSINE;
    return cosine * cosine > least * least * vec3_dot(m, m) * vec3_dot(n, n);
}

/* --- Hulls of control nets -------------------------------------------------------------------- */

strategy_hulls strategy_hulls_of(const node *a, const node *b)
{
    const net *p = node_net_made(a), *q = node_net_made(b);
    if (p == NULL && q == NULL) return HULLS_NONE;
    if (!(p != NULL && net_may_be_tighter(a)) && !(q != NULL && net_may_be_tighter(b)))
        return HULLS_NONE;
    if (p == NULL || q == NULL) return HULLS_OF_ONE;
    return net_is_curved(p) || net_is_curved(q) ? HULLS_OF_BOTH : HULLS_FLAT;
}

bool strategy_wants_net(const node *n)
{
    return surface_offers_net(n->surface) && net_may_be_tighter(n);
}

bool strategy_wants_nets(const node *a, const node *b)
{
    return strategy_wants_net(a) || strategy_wants_net(b);
}

bool strategy_waits_for_nets(const node *a, const node *b)
{
    const node *const nodes[2] = {a, b};
    bool blurs = false;
    for (int side = 0; side < 2; ++side) {
        const node *n = nodes[side];
        if (node_bends(n) || node_blurs(n, TUNING_STRAIGHT_BLUR)) return false;
        if (!surface_offers_net(n->surface)) return false;
        blurs = blurs || node_blurs(n, ROUNDING);
    }
    return blurs;
}

bool strategy_has_close_nets(const node *a, const node *b, double room)
{
    return strategy_has_both_hulls(a, b) &&
           4 * (net_off(node_net_made(a)) + net_off(node_net_made(b))) <= room;
}

hull_plan strategy_of_hulls(strategy_hulls hulls)
{
    return hulls == HULLS_FLAT ? (hull_plan){TUNING_FLAT_NET_ROUNDS, TUNING_FLAT_NET_SHRINKS}
                               : (hull_plan){TUNING_WINDOW_ROUNDS, TUNING_NET_SHRINKS};
}

strategy_after_hulls strategy_after(strategy_hulls hulls, const node *a, const node *b, bool found)
{
    if (hulls == HULLS_OF_ONE) return are_flat(a, b) ? AFTER_HULLS_QUADRATICS : AFTER_HULLS_ONE_CUT;
    return found && !are_quadratics_closer(a, b) ? AFTER_HULLS_NOTHING : AFTER_HULLS_ONE_CUT;
}

/* --- Quadratics ------------------------------------------------------------------------------- */

quadratic_plan strategy_of_quadratics(const node *a, const node *b, strategy_goal goal)
{
    const bool across = goal == GOAL_CONTACT && !node_has_normal(a) && !node_has_normal(b);
    if (!across) return (quadratic_plan){0, false};
    const bool thin = is_thin(a) && is_thin(b);
    return (quadratic_plan){thin ? TUNING_THIN_ROUNDS : TUNING_CURVE_ROUNDS, thin};
}

search_plan strategy_of_searches(const node *a, const node *b, strategy_goal goal)
{
    return are_flat(a, b) ? (search_plan){TUNING_FLAT_ROUNDS, 2, goal == GOAL_CONTACT}
                          : (search_plan){TUNING_WINDOW_ROUNDS, TUNING_WINDOW_SHRINKS, false};
}

/* Whether fixed axes cut the start of the window: a turning axis then seldom shows more. */
static bool is_cut_at_start(const w_range *s) { return s->lo > -1; }

bool strategy_takes_turning(const w_range *s, trial_rate *turning)
{
    return !is_cut_at_start(s) || trial_rate_take(turning, TUNING_FIELD_SHARE, TUNING_FIELD_WAIT);
}

void strategy_note_turning(const w_range *before, const w_range *after, bool some,
                           trial_rate *turning)
{
    if (is_cut_at_start(before))
        trial_rate_note(turning, !some || after->lo > before->lo || after->hi < before->hi);
}

/* --- One-sided distances ---------------------------------------------------------------------- */

/* Motion along the normal below this part of all motion is rounding. */
#define ALONG_FACE 0x1p-30

static double motion_along(const quadratic3 *f, int i)
{
    PAD_COVERS(8, 3); /* three sums */
    return padded_upper(fabs(f->bt[i]) + 2 * fabs(f->qtt[i]) + fabs(f->qut[i]) + fabs(f->qvt[i]),
                        8);
}

bool strategy_slides_on_face(const node *own, const node *other)
{
    const quadratic3 *f = &own->f, *g = &other->f;
    const vec3 n = node_normal(other);
    double bt = 0, ut = 0, vt = 0, tt = 0, all = 0;
    if (other->many != NULL || !node_has_normal(other) || node_bends(other)) return false;
    for (int i = 0; i < 3; ++i) {
        bt += n.x[i] * (f->bt[i] - g->bt[i]);
        ut += n.x[i] * f->qut[i];
        vt += n.x[i] * f->qvt[i];
        tt += n.x[i] * (f->qtt[i] - g->qtt[i]);
        all += motion_along(f, i) + motion_along(g, i);
    }
    const double along = fabs(bt) + fabs(ut) + fabs(vt) + fabs(tt);
    return all > 0 && along <= ALONG_FACE * all * vec3_norm1(n);
}

/* Axes separate approaching surfaces from the start of their times: no distance is computed then. A
 * search for the minimum distance computes it wherever no axis separates the pair, or it slides on
 * a face; both do for two whole surfaces. */
bool strategy_takes_distances(const node *a, const node *b, const slide_signs *of,
                              strategy_goal goal)
{
    if (of->is_whole) return true;
    if (goal == GOAL_CONTACT && !of->is_parted)
        return of->slides || !(of->start > pair_times(a, b).lo);
    const bool may_slide = of->slides || !of->is_parted || strategy_slides_on_face(a, b) ||
                           strategy_slides_on_face(b, a);
    if (goal == GOAL_DISTANCE) return may_slide;
    return may_slide && trial_rate_take(of->sliding, TUNING_DISTANCE_SHARE, TUNING_DISTANCE_WAIT);
}

void strategy_note_distances(const slide_signs *of, bool pays)
{
    if (of->is_parted) trial_rate_note(of->sliding, pays);
}

bool strategy_is_small(const node *n)
{
    const double extent = n->extent[PARAMETER_U] + n->extent[PARAMETER_V];
    return n->e[0] + n->e[1] + n->e[2] - n->time_remainder < TUNING_DISTANCE_EXTENT * extent;
}

bool strategy_distance_pays(const node *a, const node *b, size_t common_maps)
{
    return common_maps == 0 || !strategy_is_small(a) || !strategy_is_small(b) ||
           strategy_is_tangent(a, b);
}
