/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/tube_search.h"

#include <string.h>

#include "core/witness/search.h"

/* The line of a node at a time, as a quadratic in s_u. */
typedef struct line {
    vec3 a, b, q;
} line;

static line line_at(const node *n, double t)
{
    const quadratic3 *f = &n->f;
    const double s = n->region.d[2] > 0 ? (t - n->region.c[2]) / n->region.d[2] : 0;
    line c;
    for (int i = 0; i < 3; ++i) {
        c.a.x[i] = f->a[i] + (f->bt[i] + f->qtt[i] * s) * s;
        c.b.x[i] = f->bu[i] + f->qut[i] * s;
        c.q.x[i] = f->quu[i];
    }
    return c;
}

static vec3 line_point(const line *c, double s)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = c->a.x[i] + (c->b.x[i] + c->q.x[i] * s) * s;
    return x;
}

/* The unknowns of a search: s_u of a, and of b; those of v are held at 0. */
typedef struct state {
    double y[NEWTON_UNKNOWNS];
    vec3 x[2], apart;
    double gap;
} state;

static state state_of(const line c[2], const double y[NEWTON_UNKNOWNS])
{
    state s = {.gap = 0};
    memcpy(s.y, y, sizeof s.y);
    for (int side = 0; side < 2; ++side) s.x[side] = line_point(&c[side], y[2 * side]);
    s.apart = vec3_sub(s.x[1], s.x[0]);
    s.gap = vec3_norm(s.apart);
    return s;
}

static void derive(const line c[2], const state *s, newton_way *way)
{
    vec3 by[NEWTON_UNKNOWNS];
    double second[2][2][2];
    memset(by, 0, sizeof by);
    memset(second, 0, sizeof second);
    for (int side = 0; side < 2; ++side) {
        const vec3 slope = vec3_add(c[side].b, vec3_scale(c[side].q, 2 * s->y[2 * side]));
        by[2 * side] = vec3_scale(slope, side == 0 ? -1 : 1);
        second[side][0][0] = 2 * vec3_dot(s->apart, c[side].q);
    }
    newton_of_gap(s->apart, by, second, way->gradient, way->hessian);
}

/* A step that reduces the gap by less than this part of it ends the search. */
#define GAIN 0x1p-44

static state nearest_of(const line c[2])
{
    const newton_bounds bounds = {{-1, 0, -1, 0}, {1, 0, 1, 0}};
    newton_way way = newton_begin(&bounds);
    state s = state_of(c, (double[NEWTON_UNKNOWNS]){0, 0, 0, 0});
    bool gains = true;
    while (gains) {
        derive(c, &s, &way);
        state trial = s;
        bool is_better = false;
        for (double next[NEWTON_UNKNOWNS]; !is_better; newton_judge(&way, is_better)) {
            if (!newton_try(&way, s.y, next)) return s;
            trial = state_of(c, next);
            is_better = trial.gap < s.gap;
            if (!is_better && fabs(newton_promise(&way, s.y, next)) < GAIN * s.gap * s.gap)
                return s;
        }
        gains = s.gap - trial.gap > GAIN * s.gap;
        s = trial;
    }
    return s;
}

#define TWO_PI 6.283185307179586

/* Estimates where, around the tube, the surface reaches farthest along `way`. */
static imp_code seek_around(const search *g, int side, vec3 way, double *y, imp_error *error)
{
    const node *n = g->nodes[side];
    const imp_region *r = &n->region;
    vec3 x[4];
    y[2 * side + 1] = 0;
    if (!(r->d[1] > 0)) return IMP_SUCCESS;
    for (int k = 0; k < 4; ++k) {
        double p[3];
        y[2 * side + 1] = 0.5 * k - 1;
        search_parameters(g, side, y, p);
        const imp_code code = search_point(n->surface, p, &x[k], NULL, error);
        if (code != IMP_SUCCESS) return code;
    }
    const double cosine = vec3_dot(vec3_sub(x[0], x[2]), way);
    const double sine = vec3_dot(vec3_sub(x[1], x[3]), way);
    const double turn = atan2(sine, cosine) / TWO_PI;
    y[2 * side + 1] = 2 * (turn < 0 ? turn + 1 : turn) - 1;
    return IMP_SUCCESS;
}

/* Whether nearest points of both lines, which are off by the nodes' remainders at most, are between
 * the ends of their nodes, so that surfaces that are all one radius from them are as near to each
 * other as these are less both radii. */
static bool are_inside(const double *y) { return fabs(y[0]) < 1 && fabs(y[2]) < 1; }

static double remainder_of(const node *n)
{
    return node_blur(n, 0) + node_blur(n, 1) + node_blur(n, 2);
}

imp_code witness_seek_in_tubes(const node *const nodes[2], double t, double gamma, witness *found,
                               bool *is_loose, imp_error *error)
{
    line c[2] = {line_at(nodes[0], t), line_at(nodes[1], t)};
    /* Far from the origin the points' own roundings would hide the way along the lines. */
    c[1].a = vec3_sub(c[1].a, c[0].a);
    c[0].a = (vec3){{0, 0, 0}};
    const state s = nearest_of(c);
    search g = {.nodes = nodes, .t = t};
    double y[NEWTON_UNKNOWNS];
    imp_code code = IMP_SUCCESS;
    *is_loose = false;
    memcpy(y, s.y, sizeof y);
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        surface_domain(nodes[side]->surface, g.whole_lo[side], g.whole_hi[side]);
        code = seek_around(&g, side, side == 0 ? s.apart : vec3_scale(s.apart, -1), y, error);
    }
    if (code == IMP_SUCCESS) code = witness_at(nodes, t, y, found, error);
    const double near = s.gap - (nodes[0]->ball + nodes[1]->ball);
    if (code != IMP_SUCCESS || found->gap_upper <= gamma || !(near <= gamma)) return code;
    code = witness_polish(nodes, t, found, error);
    const double off = remainder_of(nodes[0]) + remainder_of(nodes[1]);
    *is_loose = are_inside(s.y) && near + off <= gamma && !(found->gap_upper <= gamma);
    return code;
}
