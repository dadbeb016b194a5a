/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/linear_contact.h"

/* --- What is linear --------------------------------------------------------------------------- */

static bool is_straight(const node *n)
{
    double square = 0;
    for (int i = 0; i < 3; ++i) square += fabs(n->f.quu[i]) + fabs(n->f.qvv[i]) + fabs(n->f.qtt[i]);
    return n->bounded && n->many == NULL && square == 0;
}

bool linear_contact_is_of(const node *a, const node *b)
{
    const double *d = a->region.d, *e = b->region.d;
    const int unknowns = (d[0] > 0) + (d[1] > 0) + (e[0] > 0) + (e[1] > 0);
    return unknowns == 2 && is_straight(a) && is_straight(b);
}

/* --- The difference --------------------------------------------------------------------------- */

/* Coefficients of 1, of either unknown and of their product. */
enum { ONE, FIRST, SECOND, BOTH, TERMS };

/* A sum of terms at the window's start, and how it changes with time. */
typedef struct linear_form {
    vec3 at[TERMS], by[TERMS];
} linear_form;

/* The four corners of a flat net, of which some may be one: those of s_u = -1 first. */
static vec3 corner_of(const net *f, const double *numbers, int k)
{
    const int i = k / 2 * f->degree[0], j = k % 2 * f->degree[1];
    const double *x = numbers + i * (f->degree[1] + 1) + j;
    return (vec3){{x[0], x[f->stride], x[2 * f->stride]}};
}

/* Converts corners into coefficients of 1, s_u, s_v and s_u s_v. */
static void terms_of_corners(const net *f, const double *numbers, vec3 to[TERMS])
{
    vec3 x[4];
    for (int k = 0; k < 4; ++k) x[k] = corner_of(f, numbers, k);
    for (int i = 0; i < 3; ++i) {
        const double low = x[0].x[i] + x[1].x[i], high = x[2].x[i] + x[3].x[i];
        const double rise = x[1].x[i] - x[0].x[i], other = x[3].x[i] - x[2].x[i];
        to[ONE].x[i] = 0.25 * (low + high);
        to[FIRST].x[i] = 0.25 * (high - low);
        to[SECOND].x[i] = 0.25 * (rise + other);
        to[BOTH].x[i] = 0.25 * (other - rise);
    }
}

static void take_net(const net *f, double t, linear_form *to)
{
    const double tau = t - f->time;
    *to = (linear_form){{{{0}}}, {{{0}}}};
    terms_of_corners(f, f->numbers, to->at);
    if (f->is_moving) terms_of_corners(f, f->numbers + 3 * f->stride, to->by);
    to->by[ONE] = vec3_add(to->by[ONE], vec3_from(f->drift));
    to->at[ONE] = vec3_add(to->at[ONE], vec3_from(f->place));
    for (int k = 0; k < TERMS; ++k) to->at[k] = vec3_add(to->at[k], vec3_scale(to->by[k], tau));
}

static void take_model(const node *n, double t, linear_form *to)
{
    const quadratic3 *f = &n->f;
    const double d = n->region.d[PARAMETER_T], inverse = d > 0 ? 1 / d : 0;
    const double s = (t - n->region.c[PARAMETER_T]) * inverse;
    const double *const at[TERMS] = {f->a, f->bu, f->bv, f->quv};
    const double *const by[TERMS - 1] = {f->bt, f->qut, f->qvt};
    for (int k = 0; k < TERMS; ++k) {
        to->at[k] = vec3_from(at[k]);
        to->by[k] = (vec3){{0, 0, 0}};
        if (k == BOTH) continue;
        to->at[k] = vec3_add(to->at[k], vec3_scale(vec3_from(by[k]), s));
        to->by[k] = vec3_scale(vec3_from(by[k]), inverse);
    }
}

static void take_node(const node *n, double t, linear_form *to)
{
    const net *f = node_net_made(n);
    if (f != NULL && !net_is_curved(f))
        take_net(f, t, to);
    else
        take_model(n, t, to);
}

/* Puts both nodes' terms together: the unknowns are at[0] and at[1] of y. */
static void take_difference(const node *const nodes[2], double t, linear_form *d, int at[2])
{
    int count = 0;
    *d = (linear_form){{{{0}}}, {{{0}}}};
    for (int side = 0; side < 2; ++side) {
        linear_form own;
        const double sign = side == 0 ? -1 : 1, *half = nodes[side]->region.d;
        take_node(nodes[side], t, &own);
        int to[TERMS] = {ONE, FIRST, SECOND, BOTH}, taken = TERMS;
        for (int j = 0; j < 2; ++j) {
            if (!(half[j] > 0)) continue;
            to[FIRST + j] = FIRST + count;
            at[count++] = 2 * side + j;
        }
        if (!(half[0] > 0 && half[1] > 0)) taken = BOTH;
        for (int k = 0; k < taken; ++k) {
            if (k != ONE && k != BOTH && !(half[k - FIRST] > 0)) continue;
            d->at[to[k]] = vec3_add(d->at[to[k]], vec3_scale(own.at[k], sign));
            d->by[to[k]] = vec3_add(d->by[to[k]], vec3_scale(own.by[k], sign));
        }
    }
}

/* --- Newton steps ----------------------------------------------------------------------------- */

/* Both unknowns, and the time since the window's start. */
typedef struct linear_state {
    double x[2], tau;
    vec3 apart, slope[2], speed; /* D and its derivatives there */
} linear_state;

static void state_at(const linear_form *f, linear_state *s)
{
    vec3 term[TERMS];
    for (int k = 0; k < TERMS; ++k) term[k] = vec3_add(f->at[k], vec3_scale(f->by[k], s->tau));
    s->slope[0] = vec3_add(term[FIRST], vec3_scale(term[BOTH], s->x[1]));
    s->slope[1] = vec3_add(term[SECOND], vec3_scale(term[BOTH], s->x[0]));
    s->apart = vec3_add(vec3_add(term[ONE], vec3_scale(s->slope[0], s->x[0])),
                        vec3_scale(term[SECOND], s->x[1]));
    s->speed =
        vec3_add(vec3_add(f->by[ONE], vec3_scale(f->by[FIRST], s->x[0])),
                 vec3_scale(vec3_add(f->by[SECOND], vec3_scale(f->by[BOTH], s->x[0])), s->x[1]));
}

/* A search ends once a step moves no unknown by this, in half-widths: steps converge quadratically,
 * and two more follow. */
static const double CONVERGED = 0x1p-12;
/* The search is given up where unknowns are beyond this. Half-widths. */
static const double FAR = 4;
enum { STEPS = 10 };

/* Takes a step to where D is `target`, by Cramer's rule. *step is its size, in half-widths and
 * lengths of the window. False: it leads nowhere. */
static bool move(const linear_form *f, double length, vec3 target, linear_state *s, double *size)
{
    const vec3 rest = vec3_sub(target, s->apart), n = vec3_cross(s->slope[0], s->slope[1]);
    const vec3 side = vec3_cross(rest, s->speed);
    const double inverse = 1 / vec3_dot(n, s->speed);
    const double dx[2] = {inverse * vec3_dot(s->slope[1], vec3_scale(side, -1)),
                          inverse * vec3_dot(s->slope[0], side)};
    const double dt = inverse * vec3_dot(n, rest);
    s->x[0] += dx[0];
    s->x[1] += dx[1];
    s->tau += dt;
    *size = fabs(dx[0]) + fabs(dx[1]) + fabs(dt) / length;
    state_at(f, s);
    return fabs(s->x[0]) + fabs(s->x[1]) < FAR && fabs(s->tau) < FAR * length;
}

static bool find_root(const linear_form *f, double length, linear_state *s)
{
    double size = INFINITY;
    for (int k = 0; k < STEPS && size > CONVERGED; ++k)
        if (!move(f, length, (vec3){{0, 0, 0}}, s, &size)) return false;
    return size <= CONVERGED;
}

static bool is_inside(const linear_state *s, double length)
{
    return fabs(s->x[0]) <= 1 && fabs(s->x[1]) <= 1 && s->tau > 0 && s->tau <= length;
}

/* Sets *axis to the unit vector across both slopes along which the gap shrinks. False: none. */
static bool find_axis(const linear_state *s, vec3 *axis)
{
    const vec3 n = vec3_cross(s->slope[0], s->slope[1]);
    const double size = vec3_norm(n);
    *axis = vec3_scale(n, (vec3_dot(n, s->speed) > 0 ? -1 : 1) / size);
    return size > 0 && size < INFINITY;
}

/* From the root, or from where it nearly is so, steps lead to where the gap is as wanted; the axis
 * turns by little. */
enum { STEPS_BACK = 2 };

bool linear_contact_find(const node *a, const node *b, const time_window *window, double gap,
                         const linear_contact *near, linear_contact *found)
{
    const double length = window->hi - window->lo;
    linear_form f;
    linear_state s = {.tau = 0};
    int at[2];
    double size;
    take_difference((const node *const[2]){a, b}, window->lo, &f, at);
    if (near != NULL)
        s = (linear_state){.x = {near->y[at[0]], near->y[at[1]]}, .tau = near->t - window->lo};
    state_at(&f, &s);
    if (!(length > 0)) return false;
    if (near == NULL && !(find_root(&f, length, &s) && is_inside(&s, length))) return false;
    for (int k = 0; k < STEPS_BACK && gap > 0; ++k)
        if (!find_axis(&s, &found->axis) ||
            !move(&f, length, vec3_scale(found->axis, gap), &s, &size))
            return false;
    if (!is_inside(&s, length) || !find_axis(&s, &found->axis)) return false;
    for (int k = 0; k < 4; ++k) found->y[k] = 0;
    found->y[at[0]] = s.x[0];
    found->y[at[1]] = s.x[1];
    found->t = window->lo + s.tau;
    return found->t < window->hi;
}
