/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/separation.h"

#include "core/base/rounding.h"
#include "core/bounds/fixed_axes.h"
#include "core/bounds/net_axis.h"
#include "core/bounds/net_model_axis.h"
#include "core/bounds/normal_field.h"
#include "core/bounds/tuning.h"

/* The w of `moment`, kept within the window. */
static double focus_of(const difference *r, double moment)
{
    const double w = r->half > 0 ? (moment - r->mid) / r->half : 0;
    return w < -1 ? -1 : w > 1 ? 1 : w;
}

/* Lemma. Outside the range s that is left, nodes are farther apart than gamma_clear; within it, no
 * nearer than the lines say, nor than the boxes. */
static void approach_take(approach *near, const difference *r, const gap_lines *lines, w_range s)
{
    double w;
    const double lower = gap_lines_lower(lines, s, &w);
    if (lower > near->lower) near->lower = lower;
    near->moment = r->mid + r->half * w;
}

/* Whether both nodes are nearly flat, so that GJK decides at each moment and only time is left to
 * be searched: halves would learn no more of u and v. */
static bool are_flat(const node *a, const node *b)
{
    double bent = 0, extent = 0;
    const node *both[2] = {a, b};
    for (int k = 0; k < 2; ++k) {
        const quadratic3 *f = &both[k]->f;
        for (int i = 0; i < 3; ++i)
            bent += both[k]->e[i] + fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
        extent += both[k]->extent[PARAMETER_U] + both[k]->extent[PARAMETER_V];
    }
    return TUNING_FLAT * bent < extent;
}

/* The axis that is best at the end of what is left: once two edges have crossed, the axis that was
 * best before is the wrong one. */
static bool cut_at_end(const node *a, const node *b, double gamma_clear, time_window *window)
{
    difference r;
    w_range s = {-1, 1};
    vec3 axis = {{0, 0, 0}};
    difference_at(a, b, window, &r);
    r.focus = 1;
    if (!fixed_axes_cut(&r, gamma_clear, &s, &axis, NULL)) return false;
    window_cut(window, r.mid, r.half, &s);
    return true;
}

static bool has_normal(const node *n) { return vec3_norm1(n->normal) > 0; }

/* A point, or a curve that is nearly straight. */
static bool is_thin(const node *n)
{
    return !has_normal(n) && n->many == NULL && !node_blurs(n, TUNING_STRAIGHT_BLUR);
}

/* Cuts the window of two nodes without normals along axes that need no search: perpendicular to
 * both, and the lines of centres, at either end of the window; again if that pays. */
static bool cut_across(const node *a, const node *b, double gamma_clear, time_window *window,
                       int rounds)
{
    bool pays = true;
    for (int round = 0; round < rounds && pays; ++round) {
        difference r;
        w_range s = {-1, 1};
        difference_at(a, b, window, &r);
        if (!fixed_axes_cut_along(&r, gamma_clear, &s, difference_offset(&r, -1))) return false;
        window_cut(window, r.mid, r.half, &s);
        pays = s.hi - s.lo < TUNING_CURVE_SHRINKS;
    }
    return true;
}

/* Cuts by an axis that turns. It shows more only where one surface lies in the other's concave
 * side, or nearly; there fixed axes seldom cut the start of a window. */
static bool cut_by_turning(const difference *r, double gamma_clear, w_range *s, trial_rate *turning,
                           gap_lines *lines)
{
    const w_range before = *s;
    const bool is_chance = s->lo > -1;
    if (is_chance && !trial_rate_take(turning, TUNING_FIELD_SHARE, TUNING_FIELD_WAIT)) return true;
    const bool some = normal_field_cut(r, gamma_clear, s, lines);
    const bool pays = !some || s->lo > before.lo || s->hi < before.hi;
    if (is_chance) trial_rate_note(turning, pays);
    return some;
}

/* `near` is NULL where only the window matters. */
static bool shrink(const node *a, const node *b, double gamma_clear, time_window *window,
                   vec3 *axis, trial_rate *turning, approach *near)
{
    const bool across = near == NULL && !has_normal(a) && !has_normal(b);
    const bool thin = across && is_thin(a) && is_thin(b);
    const int rounds = thin ? TUNING_THIN_ROUNDS : TUNING_CURVE_ROUNDS;
    if (across && !cut_across(a, b, gamma_clear, window, rounds)) return false;
    for (int round = 1;; ++round) {
        difference r;
        gap_lines lines;
        w_range s = {-1, 1};
        difference_at(a, b, window, &r);
        if (near != NULL) {
            gap_lines_begin(&lines);
            r.focus = focus_of(&r, near->moment);
            r.share = TUNING_GJK_GAP_OF_BOUND;
        }
        gap_lines *const kept = near != NULL ? &lines : NULL;
        if (!fixed_axes_cut(&r, gamma_clear, &s, axis, kept)) return false;
        if (!cut_by_turning(&r, gamma_clear, &s, turning, kept)) return false;
        window_cut(window, r.mid, r.half, &s);
        if (near != NULL) approach_take(near, &r, &lines, s);
        if (!(s.hi - s.lo < 2) || thin) return true;
        const bool flat = are_flat(a, b);
        if (flat && near == NULL && s.lo > -1 && !cut_at_end(a, b, gamma_clear, window))
            return false;
        if (round == (flat ? TUNING_FLAT_ROUNDS : TUNING_WINDOW_ROUNDS)) return true;
        if (!flat && !(s.hi - s.lo < TUNING_WINDOW_SHRINKS)) return true;
    }
}

/* --- Nets ------------------------------------------------------------------------------------- */

/* Whether a net tells more than the quadratic, as it does not for a bilinear patch without
 * remainder. Each pair asks for the net (pair_test.c), so that a test depends on its two nodes
 * alone. */
static bool has_useful_net(const node *n)
{
    return node_net_made(n) != NULL && node_gains_by_net(n);
}

/* Whether one of them has a useful net, which is enough. */
static bool have_nets(const node *a, const node *b)
{
    return a->bounded && b->bounded && (has_useful_net(a) || has_useful_net(b));
}

static bool have_both_nets(const node *a, const node *b)
{
    return node_net_made(a) != NULL && node_net_made(b) != NULL;
}

static bool seek_by_nets(const node *a, const node *b, double t, vec3 *axis)
{
    return have_both_nets(a, b) ? net_axis_seek(a, b, t, axis) : net_model_axis_seek(a, b, t, axis);
}

static bool cut_by_nets(const node *a, const node *b, vec3 axis, double gamma_clear,
                        time_window *window)
{
    return have_both_nets(a, b) ? net_axis_cut(a, b, axis, gamma_clear, window)
                                : net_model_axis_cut(a, b, axis, gamma_clear, window);
}

/* Curved surfaces come nearer than their hulls say: their quadratics, along the axis that the hulls
 * show, or any that can be found where the hulls meet. */
static bool cut_by_models(const node *a, const node *b, double gamma_clear, time_window *window,
                          vec3 *axis, trial_rate *turning, bool found)
{
    difference r;
    w_range s = {-1, 1};
    difference_at(a, b, window, &r);
    if (found ? !fixed_axes_cut_along(&r, gamma_clear, &s, *axis)
              : !fixed_axes_cut(&r, gamma_clear, &s, axis, NULL))
        return false;
    if (!cut_by_turning(&r, gamma_clear, &s, turning, NULL)) return false;
    window_cut(window, r.mid, r.half, &s);
    return true;
}

/* Whether quadratics may show more than hulls: a hull leaves its surface by a part of what bends, a
 * quadratic by its remainder. */
static bool are_models_closer(const node *a, const node *b)
{
    double remainder = 0, bend = 0;
    const node *both[2] = {a, b};
    if (!have_both_nets(a, b)) return true;
    for (int k = 0; k < 2; ++k) {
        const quadratic3 *f = &both[k]->f;
        for (int i = 0; i < 3; ++i) {
            remainder += both[k]->e[i];
            bend += fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
        }
    }
    return TUNING_NET_BEND * remainder < bend;
}

/* Cuts by hulls at the start of the window as long as that pays, then by quadratics. Flat nodes of
 * which one has no net get the full search, others one cut where quadratics may show more. */
static bool shrink_by_nets(const node *a, const node *b, double gamma_clear, time_window *window,
                           vec3 *axis, trial_rate *turning)
{
    bool found = true, pays = true;
    const bool flat = nodes_have_flat_nets(a, b);
    const int rounds = flat ? TUNING_FLAT_NET_ROUNDS : TUNING_WINDOW_ROUNDS;
    const double shrinks = flat ? TUNING_FLAT_NET_SHRINKS : TUNING_NET_SHRINKS;
    if (!(vec3_norm1(*axis) > 0)) *axis = vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a));
    for (int round = 0; round < rounds && found && pays; ++round) {
        const double length = window->hi - window->lo;
        found = seek_by_nets(a, b, window->lo, axis);
        if (found && !cut_by_nets(a, b, *axis, gamma_clear, window)) return false;
        pays = window->hi - window->lo < shrinks * length;
    }
    if (!have_both_nets(a, b) && are_flat(a, b))
        return shrink(a, b, gamma_clear, window, axis, turning, NULL);
    return (found && !are_models_closer(a, b)) ||
           cut_by_models(a, b, gamma_clear, window, axis, turning, found);
}

bool separation_without_nets(const node *a, const node *b, double gamma_clear, time_window *window,
                             vec3 *axis, trial_rate *turning)
{
    if (!a->bounded || !b->bounded) return true;
    return !separation_of_boxes(a, b, gamma_clear) &&
           shrink(a, b, gamma_clear, window, axis, turning, NULL);
}

bool separation_window(const node *a, const node *b, double gamma_clear, time_window *window,
                       vec3 *axis, trial_rate *turning)
{
    if (!have_nets(a, b)) return separation_without_nets(a, b, gamma_clear, window, axis, turning);
    return !separation_of_boxes(a, b, gamma_clear) &&
           shrink_by_nets(a, b, gamma_clear, window, axis, turning);
}

bool separation_first_look(const node *a, const node *b, double gamma_clear, time_window *window,
                           vec3 *axis, trial_rate *turning, bool *more)
{
    *more = have_nets(a, b) && vec3_norm1(*axis) > 0;
    return *more ? cut_by_nets(a, b, *axis, gamma_clear, window)
                 : separation_window(a, b, gamma_clear, window, axis, turning);
}

bool separation_approach(const node *a, const node *b, double gamma_clear, time_window *window,
                         vec3 *axis, approach *near)
{
    near->lower = 0;
    if (!a->bounded || !b->bounded) return true;
    near->lower = separation_boxes_lower(a, b);
    if (near->lower > gamma_clear) return false;
    return shrink(a, b, gamma_clear, window, axis, NULL, near) && !(near->lower > gamma_clear);
}

/* Boxes and balls. Roundings: difference 1, square 1, sums 2, root, which halves them and counts 1:
 * (2 * 1 + 1 + 2) / 2 + 1 < 4; of balls one more, the last difference, whose rounding is below that
 * of its first term. Written so that a NaN is never apart. A sum that overflows is at least
 * 2^1023. */
PAD_COVERS(16, 4 + 1);
PAD_COVERS(8, 3 + 1 + 1); /* reach: three errors, then the rest summed to a radius; the radii */

double separation_boxes_lower(const node *a, const node *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = b->lo[i] - a->hi[i], below = a->lo[i] - b->hi[i];
        const double gap = above > below ? above : below;
        if (gap > 0) sum += gap * gap;
    }
    return sum < INFINITY ? padded_lower(sqrt(sum), 16) : 0x1p511;
}

bool separation_of_boxes(const node *a, const node *b, double gamma_clear)
{
    return separation_boxes_lower(a, b) > gamma_clear;
}

bool separation_of_balls(const node *a, const node *b, double gamma_clear)
{
    if (!a->bounded || !b->bounded) return false;
    const vec3 apart = vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a));
    const double reach = a->radius + b->radius;
    return padded_lower(vec3_norm(apart), 16) - padded_upper(reach, 8) > gamma_clear;
}

double separation_farthest_of_boxes(const node *a, const node *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = b->hi[i] - a->lo[i], below = a->hi[i] - b->lo[i];
        const double far = above > below ? above : below;
        sum += far * far;
    }
    return sqrt(sum);
}

double separation_farthest_of_balls(const node *a, const node *b)
{
    return vec3_norm(vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a))) + a->radius + b->radius;
}

double separation_centres(const node *a, const node *b, double t)
{
    const imp_region *g = &a->region, *h = &b->region;
    const double s = g->d[2] > 0 ? (t - g->c[2]) / g->d[2] : 0;
    const double r = h->d[2] > 0 ? (t - h->c[2]) / h->d[2] : 0;
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double x = a->f.a[i] + (a->f.bt[i] + a->f.qtt[i] * s) * s;
        const double y = b->f.a[i] + (b->f.bt[i] + b->f.qtt[i] * r) * r;
        sum += (y - x) * (y - x);
    }
    return sum;
}
