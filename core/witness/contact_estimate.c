/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/contact_estimate.h"

#include <math.h>
#include <string.h>

#include "core/bounds/tuning.h"
#include "core/witness/contact_paraboloid.h"
#include "core/witness/net_eval.h"
#include "core/witness/newton.h"

/* --- The distance ----------------------------------------------------------------------------- */

typedef struct marcher {
    newton_bounds bounds;
    double t;
    net_points points[2];
    vec3 places; /* of b, from a */
} marcher;

typedef struct stand {
    double y[NEWTON_UNKNOWNS];
    net_derivatives side[2];
    vec3 apart;
    double gap;
} stand;

static void marcher_go(marcher *m, const net *const nets[2], double t)
{
    m->t = t;
    for (int side = 0; side < 2; ++side) net_points_take(nets[side], t, &m->points[side]);
    m->places = places_apart(nets[0], nets[1], t);
}

static void stand_at(const marcher *m, const double *y, stand *s)
{
    memcpy(s->y, y, sizeof s->y);
    net_eval_at(m->points, y, s->side);
    for (int i = 0; i < 3; ++i)
        s->apart.x[i] = s->side[1].by[NET_VALUE][i] - s->side[0].by[NET_VALUE][i] + m->places.x[i];
    s->gap = vec3_norm(s->apart);
}

static vec3 jet_part(const net_derivatives *x, int part)
{
    return (vec3){{x->by[part][0], x->by[part][1], x->by[part][2]}};
}

/* Computes how the vector between the points changes with the unknowns. */
static void columns_of(const stand *s, vec3 by[NEWTON_UNKNOWNS])
{
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k)
        by[k] = vec3_scale(jet_part(&s->side[k / 2], NET_U + k % 2), k < 2 ? -1 : 1);
}

static void derive(const stand *s, newton_way *way)
{
    vec3 by[NEWTON_UNKNOWNS];
    double second[2][2][2];
    columns_of(s, by);
    for (int side = 0; side < 2; ++side) {
        const net_derivatives *x = &s->side[side];
        second[side][0][0] = vec3_dot(s->apart, jet_part(x, NET_UU));
        second[side][0][1] = second[side][1][0] = vec3_dot(s->apart, jet_part(x, NET_UV));
        second[side][1][1] = vec3_dot(s->apart, jet_part(x, NET_VV));
    }
    newton_of_gap(s->apart, by, second, way->gradient, way->hessian);
}

/* Predicts by how much the step to `next` reduces half the squared gap, as half of step times
 * gradient. Patches are cheap to evaluate, so this suffices; newton_promise, which uses the Hessian
 * too, costs more and saves no pairs. */
static double promise(const newton_way *way, const stand *s, const double *next)
{
    double slope = 0;
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) slope -= way->gradient[k] * (next[k] - s->y[k]);
    return 0.5 * slope;
}

/* Above this damping, the predicted reduction is unreliable. */
static const double DAMPED = 0x1p-10;

/* Takes one step from s to `to`; *way keeps the derivatives at s. False: no step reduces the gap,
 * or the predicted reduction is below `gain` of it. */
static bool step_down(const marcher *m, double gain, const stand *s, newton_way *way, stand *to)
{
    bool is_better = false;
    derive(s, way);
    for (double next[NEWTON_UNKNOWNS]; !is_better; newton_judge(way, is_better)) {
        if (!newton_try(way, s->y, next)) return false;
        if (way->damping < DAMPED && promise(way, s, next) < gain * s->gap * s->gap) return false;
        stand_at(m, next, to);
        is_better = to->gap < s->gap;
    }
    return true;
}

/* Descends to the nearest points at one time, until the gap is at most `enough` or the predicted
 * reduction of a step is below `gain` of it; *way keeps the last derivatives. */
static void descend(const marcher *m, double enough, double gain, stand *s, newton_way *way)
{
    stand room, *at = s, *next = &room;
    *way = newton_begin(&m->bounds);
    while (way->steps < TUNING_NEWTON_STEPS && at->gap > enough &&
           step_down(m, gain, at, way, next)) {
        stand *last = at;
        at = next;
        next = last;
    }
    if (at != s) *s = *at;
}

static vec3 velocity_of(const net *const nets[2], const stand *s)
{
    return vec3_sub(net_velocity_at(nets[1], s->y + 2), net_velocity_at(nets[0], s->y));
}

/* Predicts the nearest points after the time `wait`, by a Newton step that cancels the change of
 * the gradient that the velocity causes. */
static void foresee(const stand *s, newton_way *way, vec3 velocity, double wait, double *y)
{
    vec3 by[NEWTON_UNKNOWNS];
    columns_of(s, by);
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) way->gradient[k] += wait * vec3_dot(by[k], velocity);
    if (!newton_try(way, s->y, y)) memcpy(y, s->y, sizeof s->y);
}

/* --- In time ---------------------------------------------------------------------------------- */

/* Returns how far the surface extends around a node, in the node's half-widths, but at most
 * `most`. */
static void bounds_of(const node *n, double most, double *lo, double *hi)
{
    const node *whole = n;
    while (whole->parent != NULL && whole->parent->many == NULL) whole = whole->parent;
    for (int j = 0; j < 2; ++j) {
        const double d = n->region.d[j], c = n->region.c[j];
        lo[j] = d > 0 ? fmax((whole->region.lo[j] - c) / d, -most) : 0;
        hi[j] = d > 0 ? fmin((whole->region.hi[j] - c) / d, most) : 0;
    }
}

/* Returns the next time; a NaN if the gap does not shrink or will not be closed within the window.
 * A step goes over only a part of the predicted time to contact: the gap may shrink faster later,
 * and nearest points after the contact do not show when it was. */
static double time_after(const marcher *m, const stand *s, double gap, double speed, double end)
{
    const double wait = (s->gap - gap) / speed;
    const double next =
        m->t + (s->gap > TUNING_MARCH_NEAR * gap ? TUNING_MARCH_STRIDE * wait : wait);
    return speed > 0 && next > m->t && m->t + wait <= end ? next : NAN;
}

/* The search ends at this multiple of the gap that is sought. */
static const double ENOUGH = 1.125;

/* A search starts at this part of the way from the node's middle to its lowest control point. */
static const double START = 0.7;

/* Finds where along u and v the lowest control point along an axis is. */
static void lowest_at(const net_points *f, vec3 axis, double *y)
{
    const int n = f->net->degree[0], m = f->net->degree[1];
    double height[IMP_QUAD * QUADS_MAX], least = INFINITY;
    int lowest = -1;
    y[0] = y[1] = 0;
    if (!(vec3_norm1(axis) > 0)) return;
    net_heights_along(f, axis, height);
    for (int k = 0; k < (n + 1) * (m + 1); ++k) {
        if (!(height[k] < least)) continue;
        least = height[k];
        lowest = k;
    }
    if (lowest < 0) return;
    y[0] = n > 0 ? START * (2.0 * (lowest / (m + 1)) / n - 1) : 0;
    y[1] = m > 0 ? START * (2.0 * (lowest % (m + 1)) / m - 1) : 0;
}

/* Begins a search; points stay within `most` half-widths of the nodes' middles. */
static void begin(marcher *m, const node *const nodes[2], const net *const nets[2], double most,
                  vec3 axis, double t, stand *s)
{
    double y[NEWTON_UNKNOWNS];
    for (int side = 0; side < 2; ++side)
        bounds_of(nodes[side], most, m->bounds.lo + 2 * side, m->bounds.hi + 2 * side);
    marcher_go(m, nets, t);
    lowest_at(&m->points[0], vec3_scale(axis, -1), y);
    lowest_at(&m->points[1], axis, y + 2);
    stand_at(m, y, s);
}

/* The separating paraboloid where the surfaces stand, which moves at the mean of both points'
 * velocities. */
static net_paraboloid paraboloid_at(const marcher *m, const net *const nets[2], const stand *s)
{
    net_paraboloid d = {.time = m->t};
    contact_side sides[2];
    for (int side = 0; side < 2; ++side) {
        sides[side].of = &s->side[side];
        for (int j = 0; j < 2; ++j) {
            const int k = 2 * side + j;
            sides[side].is_free[j] = m->bounds.lo[k] < s->y[k] && s->y[k] < m->bounds.hi[k];
        }
    }
    contact_paraboloid_choose(sides, s->apart, &d);
    const vec3 at = vec3_add(jet_part(&s->side[0], NET_VALUE), vec3_scale(s->apart, 0.5));
    const vec3 place = vec3_add(vec3_from(nets[0]->place),
                                vec3_scale(vec3_from(nets[0]->drift), m->t - nets[0]->time));
    d.at = vec3_add(at, place);
    d.velocity = vec3_scale(
        vec3_add(net_velocity_at(nets[0], s->y), net_velocity_at(nets[1], s->y + 2)), 0.5);
    return d;
}

bool contact_estimate_find(const node *a, const node *b, vec3 axis, const time_window *window,
                           double gap, contact_estimate *found)
{
    const net *const nets[2] = {node_net_made(a), node_net_made(b)};
    marcher m;
    stand s;
    begin(&m, (const node *const[2]){a, b}, nets, INFINITY, axis, window->lo, &s);
    for (int k = 0; k < TUNING_MARCH_STEPS; ++k) {
        const bool is_far = s.gap > TUNING_MARCH_NEAR * gap;
        newton_way way;
        double y[NEWTON_UNKNOWNS];
        descend(&m, ENOUGH * gap, is_far ? TUNING_MARCH_GAIN : TUNING_NEWTON_GAIN, &s, &way);
        const vec3 velocity = velocity_of(nets, &s);
        const double speed = -vec3_dot(velocity, s.apart) / s.gap;
        if (s.gap < ENOUGH * gap) {
            *found = (contact_estimate){
                .t = m.t, .speed = speed, .paraboloid = paraboloid_at(&m, nets, &s)};
            memcpy(found->y, s.y, sizeof found->y);
            return true;
        }
        const double next = time_after(&m, &s, gap, speed, window->hi);
        if (isnan(next)) return false;
        foresee(&s, &way, velocity, next - m.t, y);
        marcher_go(&m, nets, next);
        stand_at(&m, y, &s);
    }
    return false;
}

/* In half-widths from the node's middle: points may leave the node by one only, since outside the
 * node the surface may leave the net, for example across a knot. */
static const double NEAREST_REACH = 2;

void net_nearest(const node *const nodes[2], vec3 axis, double t, double enough, double gain,
                 double y[4])
{
    const net *const nets[2] = {node_net_made(nodes[0]), node_net_made(nodes[1])};
    marcher m;
    stand s;
    newton_way way;
    begin(&m, nodes, nets, NEAREST_REACH, axis, t, &s);
    descend(&m, enough, gain, &s, &way);
    memcpy(y, s.y, sizeof s.y);
}
