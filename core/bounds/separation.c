/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/separation.h"

#include "core/base/rounding.h"
#include "core/bounds/fixed_axes.h"
#include "core/bounds/net_axis.h"
#include "core/bounds/net_model_axis.h"
#include "core/bounds/normal_field.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "core/tree/triple.h"

#include <impinge/quad.h>

/* Returns the w of `moment`, clamped to the window. */
static double focus_of(const difference *r, double moment)
{
    const double w = r->half > 0 ? (moment - r->mid) / r->half : 0;
    return w < -1 ? -1 : w > 1 ? 1 : w;
}

/* Lemma. Outside the range s that is left, nodes are farther apart than gamma_clear; within it,
 * their distance is at least the lines' and the boxes' lower bounds. */
static void approach_take(approach *near, const difference *r, const gap_lines *lines, w_range s)
{
    double w;
    const double lower = gap_lines_lower(lines, s, &w);
    if (lower > near->lower) near->lower = lower;
    near->moment = r->mid + r->half * w;
}

/* Cuts along the axis that is best at the window's end: once two edges have crossed, the axis that
 * was best before no longer separates them. */
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

/* Cuts the window of two nodes without normals along axes that need no search, perpendicular to
 * both curves and along the lines of centres at either end of the window; repeats while that
 * pays. */
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

/* Cuts the range along turning axes, unless they seldom paid in this candidate pair. `axis` is a
 * fixed axis from which they may begin; 0: none is known. */
static bool cut_by_turning(const difference *r, vec3 axis, double gamma_clear, w_range *s,
                           trial_rate *turning, gap_lines *lines)
{
    const w_range before = *s;
    if (!strategy_takes_turning(&before, turning)) return true;
    const bool some = normal_field_cut(r, axis, gamma_clear, s, lines);
    strategy_note_turning(&before, s, some, turning);
    return some;
}

/* Cuts by quadratics alone: along axes that need no search, then for up to `more.rounds` windows
 * along fixed and turning axes. `near` is NULL where only the window matters. */
static bool shrink_by_quadratics(const node *a, const node *b, double gamma_clear,
                                 time_window *window, vec3 *axis, trial_rate *turning,
                                 approach *near)
{
    const strategy_goal goal = near == NULL ? GOAL_CONTACT : GOAL_DISTANCE;
    const quadratic_plan plan = strategy_of_quadratics(a, b, goal);
    search_plan more;
    if (!cut_across(a, b, gamma_clear, window, plan.rounds_across)) return false;
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
        if (!cut_by_turning(&r, *axis, gamma_clear, &s, turning, kept)) return false;
        window_cut(window, r.mid, r.half, &s);
        if (near != NULL) approach_take(near, &r, &lines, s);
        if (!(s.hi - s.lo < 2) || plan.is_thin) return true;
        if (round == 1) more = strategy_of_searches(a, b, goal);
        if (more.cuts_at_end && s.lo > -1 && !cut_at_end(a, b, gamma_clear, window)) return false;
        if (round == more.rounds || !(s.hi - s.lo < more.shrinks)) return true;
    }
}

/* --- Nets ------------------------------------------------------------------------------------- */

static bool seek_by_hulls(strategy_hulls hulls, const node *a, const node *b, double t, vec3 *axis)
{
    return hulls == HULLS_OF_ONE ? net_model_axis_seek(a, b, t, axis)
                                 : net_axis_seek(a, b, t, axis);
}

static bool cut_by_hulls(strategy_hulls hulls, const node *a, const node *b, vec3 axis,
                         double gamma_clear, time_window *window)
{
    return hulls == HULLS_OF_ONE ? net_model_axis_cut(a, b, axis, gamma_clear, window)
                                 : net_axis_cut(a, b, axis, gamma_clear, window);
}

/* Cuts by quadratics after hulls. Hulls of curved surfaces are nearer to each other than the
 * surfaces, so the quadratics are tried along the hulls' axis or, where the hulls intersect, along
 * the axis that GJK finds. Where none is found, the last axis stays in use if turning axes that
 * begin from it cut the start. */
static bool cut_by_models(const node *a, const node *b, double gamma_clear, time_window *window,
                          vec3 *axis, trial_rate *turning, bool found)
{
    difference r;
    w_range s = {-1, 1};
    const vec3 last = *axis;
    difference_at(a, b, window, &r);
    if (found ? !fixed_axes_cut_along(&r, gamma_clear, &s, *axis)
              : !fixed_axes_cut(&r, gamma_clear, &s, axis, NULL))
        return false;
    const double start = s.lo;
    if (!cut_by_turning(&r, last, gamma_clear, &s, turning, NULL)) return false;
    if (s.lo > start) *axis = last;
    window_cut(window, r.mid, r.half, &s);
    return true;
}

/* Cuts by hulls at the start of the window as long as that pays, then by quadratics. */
static bool shrink_by_hulls(strategy_hulls hulls, const node *a, const node *b, double gamma_clear,
                            time_window *window, vec3 *axis, trial_rate *turning)
{
    const hull_plan plan = strategy_of_hulls(hulls);
    bool found = true, pays = true;
    if (!(vec3_norm1(*axis) > 0)) *axis = vec3_sub(vec3_from(b->f.a), vec3_from(a->f.a));
    for (int round = 0; round < plan.rounds && found && pays; ++round) {
        const double length = window->hi - window->lo;
        found = seek_by_hulls(hulls, a, b, window->lo, axis);
        if (found && !cut_by_hulls(hulls, a, b, *axis, gamma_clear, window)) return false;
        pays = window->hi - window->lo < plan.shrinks * length;
    }
    switch (strategy_after(hulls, a, b, found)) {
    case AFTER_HULLS_QUADRATICS:
        return shrink_by_quadratics(a, b, gamma_clear, window, axis, turning, NULL);
    case AFTER_HULLS_ONE_CUT:
        return cut_by_models(a, b, gamma_clear, window, axis, turning, found);
    default:
        return true;
    }
}

/* --- Tests ------------------------------------------------------------------------------------ */

bool separation_without_nets(const node *a, const node *b, double gamma_clear, time_window *window,
                             vec3 *axis, trial_rate *turning)
{
    if (!a->bounded || !b->bounded) return true;
    return !separation_of_boxes(a, b, gamma_clear) &&
           shrink_by_quadratics(a, b, gamma_clear, window, axis, turning, NULL);
}

bool separation_window(const node *a, const node *b, double gamma_clear, time_window *window,
                       vec3 *axis, trial_rate *turning)
{
    const strategy_hulls hulls = strategy_hulls_of(a, b);
    if (hulls == HULLS_NONE)
        return separation_without_nets(a, b, gamma_clear, window, axis, turning);
    if (!a->bounded || !b->bounded) return true;
    return !separation_of_boxes(a, b, gamma_clear) &&
           shrink_by_hulls(hulls, a, b, gamma_clear, window, axis, turning);
}

bool separation_first_look(const node *a, const node *b, double gamma_clear, time_window *window,
                           vec3 *axis, trial_rate *turning, bool *more)
{
    const strategy_hulls hulls = vec3_norm1(*axis) > 0 ? strategy_hulls_of(a, b) : HULLS_NONE;
    *more = hulls != HULLS_NONE && a->bounded && b->bounded;
    return *more ? cut_by_hulls(hulls, a, b, *axis, gamma_clear, window)
                 : separation_window(a, b, gamma_clear, window, axis, turning);
}

bool separation_along(const node *a, const node *b, vec3 axis, double gamma_clear,
                      const time_window *window)
{
    const strategy_hulls hulls = strategy_hulls_of(a, b);
    time_window left = *window;
    difference r;
    w_range s = {-1, 1};
    if (!a->bounded || !b->bounded) return false;
    if (hulls != HULLS_NONE) return !cut_by_hulls(hulls, a, b, axis, gamma_clear, &left);
    difference_at(a, b, window, &r);
    return !fixed_axes_cut_along(&r, gamma_clear, &s, axis);
}

bool separation_approach(const node *a, const node *b, double gamma_clear, time_window *window,
                         vec3 *axis, approach *near)
{
    near->lower = 0;
    if (!a->bounded || !b->bounded) return true;
    near->lower = separation_boxes_lower(a, b);
    if (near->lower > gamma_clear) return false;
    return shrink_by_quadratics(a, b, gamma_clear, window, axis, NULL, near) &&
           !(near->lower > gamma_clear);
}

/* Roundings of boxes and balls: difference 1, square 1, sums 2, root, which halves them and counts
 * 1: (2 * 1 + 1 + 2) / 2 + 1 < 4; one more, the last difference, whose rounding is below that of
 * its first term. Squares that underflow change the root by less than ROOT_UNDERFLOW. A NaN is
 * never apart. A sum that overflows is at least 2^1023. */
PAD_COVERS(16, 4 + 1);
PAD_COVERS(8,
           3 + 1 + 1); /* a node's radius: three errors, its other terms; the sum of both radii */

double separation_boxes_lower(const node *a, const node *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double above = b->lo[i] - a->hi[i], below = a->lo[i] - b->hi[i];
        const double gap = above > below ? above : below;
        if (gap > 0) sum += gap * gap;
    }
    if (!(sum < INFINITY)) return 0x1p511;
    const double lower = padded_lower(sqrt(sum), 16) - ROOT_UNDERFLOW;
    return lower > 0 ? lower : 0;
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

/* The centre at the time s, relative to the region. */
static inline imp_quad centre_at(const quadratic3 *f, double time)
{
    const imp_quad s = imp_quad_all(time);
    return triple_load(f->a) + (triple_load(f->bt) + triple_load(f->qtt) * s) * s;
}

double separation_centres(const node *a, const node *b, double t)
{
    const imp_region *g = &a->region, *h = &b->region;
    const double s = g->d[2] > 0 ? (t - g->c[2]) / g->d[2] : 0;
    const double r = h->d[2] > 0 ? (t - h->c[2]) / h->d[2] : 0;
    const imp_quad apart = centre_at(&b->f, r) - centre_at(&a->f, s), square = apart * apart;
    return square[0] + square[1] + square[2];
}
