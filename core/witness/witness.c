/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/witness.h"

#include <assert.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "core/tree/bound_audit.h"
#include "core/witness/search.h"

/* Newton steps with the Hessian J'J + D.D'' + damping minimise |D|^2 / 2; points come from the
 * surfaces themselves. */

/* Sets the bounds of y: it may leave the node by one half-width, but not the surface. */
static void search_begin(search *g)
{
    for (int side = 0; side < 2; ++side)
        surface_domain(g->nodes[side]->surface, g->whole_lo[side], g->whole_hi[side]);
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        const imp_region *r = &g->nodes[k / 2]->region;
        const int j = k % 2;
        g->y.lo[k] = g->y.hi[k] = 0;
        if (!(r->d[j] > 0)) continue;
        g->y.lo[k] = fmax(-2, (g->whole_lo[k / 2][j] - r->c[j]) / r->d[j]);
        g->y.hi[k] = fmin(2, (g->whole_hi[k / 2][j] - r->c[j]) / r->d[j]);
    }
}

/* Evaluates n points with their errors. If that fails, the error names the first point that cannot
 * be evaluated by itself, or else the first of all. */
static imp_code points_at(const surface *s, size_t n, const double (*p)[3], vec3 *x,
                          double (*eval_error)[3], imp_error *error)
{
    const imp_status status = surface_eval(s, n, p[0], x->x, eval_error[0]);
    const imp_code together =
        status == IMP_STATUS_OK ? IMP_SUCCESS : search_fault(s, status, p[0], error);
    imp_code each = IMP_SUCCESS;
    for (size_t k = 0; k < n && each == IMP_SUCCESS; ++k)
        each = status == IMP_STATUS_OK ? search_point_check(s, p[k], x[k], eval_error[k], error)
                                       : search_point(s, p[k], &x[k], eval_error[k], error);
    return each == IMP_SUCCESS ? together : each;
}

static bool is_known(const search_state *from, int side, const double p[3])
{
    return from != NULL && p[0] == from->p[side][0] && p[1] == from->p[side][1];
}

/* Evaluates both points and, unless eval_error is NULL, bounds of their errors. `from`, unless
 * NULL, is a state of the search: a side that is at its parameters, such as a point or a corner
 * that holds it, keeps its point; eval_error is NULL then. */
static imp_code evaluate_at(const search *g, const double *y, const search_state *from,
                            search_state *s, double (*eval_error)[3], imp_error *error)
{
    memcpy(s->y, y, sizeof s->y);
    for (int side = 0; side < 2; ++side) {
        const surface *of = g->nodes[side]->surface;
        search_parameters(g, side, y, s->p[side]);
        if (is_known(from, side, s->p[side])) {
            s->x[side] = from->x[side];
            continue;
        }
        double *const bounds = eval_error != NULL ? eval_error[side] : NULL;
        imp_code code = search_point(of, s->p[side], &s->x[side], bounds, error);
        if (code == IMP_SUCCESS)
            code = bound_audit_holds_at(of, g->nodes[side], s->p[side], s->x[side].x, error);
        if (code != IMP_SUCCESS) return code;
    }
    s->apart = vec3_sub(s->x[1], s->x[0]);
    s->gap = vec3_norm(s->apart);
    return IMP_SUCCESS;
}

static imp_code state_at(const search *g, const double *y, const search_state *from,
                         search_state *s, imp_error *error)
{
    return evaluate_at(g, y, from, s, NULL, error);
}

/* --- Steps ------------------------------------------------------------------------------------ */

/* Descends from *s until the predicted reduction of a step is mere rounding, or a step reduces the
 * gap by less than TUNING_NEWTON_GAIN of it, or by less than half while it is far above gamma. The
 * last condition is left out for two flat hulls, whose windows start at a contact. */
static imp_code descend(const search *g, double gamma, search_state *s, imp_error *error)
{
    newton_way way = newton_begin(&g->y);
    const double far = strategy_hulls_of(g->nodes[0], g->nodes[1]) == HULLS_FLAT
                           ? INFINITY
                           : TUNING_NEWTON_FAR * gamma;
    while (way.steps < TUNING_NEWTON_STEPS && s->gap > 0) {
        imp_code code = search_derive(g, s, way.gradient, way.hessian, error);
        if (code != IMP_SUCCESS) return code;
        search_state trial;
        bool is_better = false;
        for (double next[NEWTON_UNKNOWNS]; !is_better; newton_judge(&way, is_better)) {
            if (!newton_try(&way, s->y, next)) return IMP_SUCCESS;
            if (fabs(newton_promise(&way, s->y, next)) < TUNING_NEWTON_PROMISE * s->gap * s->gap)
                return IMP_SUCCESS;
            code = state_at(g, next, s, &trial, error);
            if (code != IMP_SUCCESS) return code;
            is_better = trial.gap < s->gap;
        }
        const double gain = s->gap - trial.gap;
        const bool stale =
            gain < TUNING_NEWTON_GAIN * s->gap || (trial.gap > far && gain < 0.5 * s->gap);
        *s = trial;
        if (stale) return IMP_SUCCESS;
    }
    return IMP_SUCCESS;
}

/* The direction of D is mostly rounding if |D| is below this times the points' error bounds. */
static const double NORMAL_FROM = 64;
/* A normal of at least this length has a finite inverse. */
static const double NORMAL_LEAST = 0x1p-1000;

/* Lemma. The exact points are within the two error vectors of those computed, so their distance is
 * at most gap + |error_a|_1 + |error_b|_1. Roundings: of the gap differences 1, squares 1, sums 2
 * and the root, which halves them and counts 1, (2 * 1 + 1 + 2) / 2 + 1 < 4; of the errors 5 sums;
 * then their sum. A gap below 2^-1022 loses 2^-1075 more (vec3_norm). */
PAD_COVERS(16, 5 + 1);
static void finish(const search *g, const search_state *s, const double eval_error[2][3],
                   witness *found)
{
    double both = 0;
    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < 3; ++i) both += eval_error[side][i];
        found->piece[side] = surface_piece_index(g->nodes[side]->surface);
        found->u[side] = s->p[side][0];
        found->v[side] = s->p[side][1];
        found->point[side] = s->x[side];
    }
    found->gap = s->gap;
    found->gap_upper = padded_upper(s->gap + both, 16) + PRODUCTS_UNDERFLOW;
    found->has_normal = s->gap > NORMAL_FROM * both && s->gap > NORMAL_LEAST;
    found->normal = found->has_normal ? vec3_scale(s->apart, 1 / s->gap) : (vec3){{0, 0, 0}};
}

static imp_code evaluate_gap(const search *g, const search_state *s, witness *found,
                             imp_error *error)
{
    double eval_error[2][3];
    for (int side = 0; side < 2; ++side) {
        vec3 x;
        const imp_code code =
            search_point(g->nodes[side]->surface, s->p[side], &x, eval_error[side], error);
        if (code != IMP_SUCCESS) return code;
    }
    finish(g, s, (const double(*)[3])eval_error, found);
    return IMP_SUCCESS;
}

static imp_code search_run(const node *const nodes[2], double t, double gamma, bool moving,
                           witness *found, imp_error *error)
{
    search g = {.nodes = nodes, .t = t};
    search_state s;
    search_begin(&g);
    imp_code code = state_at(&g, (double[NEWTON_UNKNOWNS]){0, 0, 0, 0}, NULL, &s, error);
    if (code == IMP_SUCCESS && moving) code = descend(&g, gamma, &s, error);
    return code == IMP_SUCCESS ? evaluate_gap(&g, &s, found, error) : code;
}

imp_code witness_seek(const node *const nodes[2], double t, double gamma, witness *found,
                      imp_error *error)
{
    return search_run(nodes, t, gamma, true, found, error);
}

/* --- Poles ------------------------------------------------------------------------------------ */

/* At a pole all u are one point, from which only v descends, and only within the domain: with a
 * wrong u the search ends there. */

/* Two points are one pole if they are nearer than this part of the gap. */
#define SAME_POLE 0x1p-20

/* A point is at an edge of the domain if it is nearer than this part of the domain. */
#define AT_EDGE 0x1p-30

/* Moves the state to the other end of the line of v through the pole at which a side is: u by half
 * of its range. *is_pole false: the side is at none. */
static imp_code turn_at_pole(search *g, int side, const search_state *s, search_state *turned,
                             bool *is_pole, imp_error *error)
{
    const double *lo = g->whole_lo[side], *hi = g->whole_hi[side], *p = s->p[side];
    const imp_region *r = &g->nodes[side]->region;
    double y[NEWTON_UNKNOWNS];
    *is_pole = false;
    const double half = 0.5 * (hi[0] - lo[0]), edge = fmin(p[1] - lo[1], hi[1] - p[1]);
    if (!(edge <= AT_EDGE * (hi[1] - lo[1])) || !(r->d[0] > 0 && r->d[1] > 0)) return IMP_SUCCESS;
    memcpy(y, s->y, sizeof y);
    y[2 * side] += (p[0] + half <= hi[0] ? half : -half) / r->d[0];
    const imp_code code = state_at(g, y, s, turned, error);
    if (code != IMP_SUCCESS) return code;
    *is_pole = vec3_norm(vec3_sub(turned->x[side], s->x[side])) <= SAME_POLE * s->gap;
    for (int j = 0; j < 2 && *is_pole; ++j) {
        g->y.lo[2 * side + j] = (lo[j] - r->c[j]) / r->d[j];
        g->y.hi[2 * side + j] = (hi[j] - r->c[j]) / r->d[j];
    }
    return IMP_SUCCESS;
}

/* Descends from there, too, and keeps what is nearer. */
static imp_code descend_beyond_poles(search *g, search_state *s, imp_error *error)
{
    for (int side = 0; side < 2; ++side) {
        search_state turned;
        bool is_pole;
        imp_code code = turn_at_pole(g, side, s, &turned, &is_pole, error);
        if (code == IMP_SUCCESS && is_pole) code = descend(g, turned.gap, &turned, error);
        if (code != IMP_SUCCESS) return code;
        if (is_pole && turned.gap < s->gap) *s = turned;
    }
    return IMP_SUCCESS;
}

imp_code witness_polish(const node *const nodes[2], double t, witness *found, imp_error *error)
{
    search g = {.nodes = nodes, .t = t, .is_local = true};
    double y[NEWTON_UNKNOWNS];
    search_state s;
    search_begin(&g);
    for (int k = 0; k < NEWTON_UNKNOWNS; ++k) {
        const imp_region *r = &nodes[k / 2]->region;
        const double p = k % 2 == 0 ? found->u[k / 2] : found->v[k / 2];
        y[k] = r->d[k % 2] > 0 ? (p - r->c[k % 2]) / r->d[k % 2] : 0;
    }
    imp_code code = state_at(&g, y, NULL, &s, error);
    if (code == IMP_SUCCESS) code = descend(&g, s.gap, &s, error);
    if (code == IMP_SUCCESS) code = descend_beyond_poles(&g, &s, error);
    return code == IMP_SUCCESS ? evaluate_gap(&g, &s, found, error) : code;
}

/* Unlike in a search, y may be anywhere on the surfaces. */
imp_code witness_at(const node *const nodes[2], double t, const double y[4], witness *found,
                    imp_error *error)
{
    search g = {.nodes = nodes, .t = t};
    search_state s;
    double eval_error[2][3];
    search_begin(&g);
    const imp_code code = evaluate_at(&g, y, NULL, &s, eval_error, error);
    if (code == IMP_SUCCESS) finish(&g, &s, (const double(*)[3])eval_error, found);
    return code;
}

imp_code witness_eval_errors(const surface *s, size_t n, const double (*p)[3], double *eval_error,
                             vec3 *x, imp_error *error)
{
    double e[WITNESS_POINTS][3];
    assert(n <= WITNESS_POINTS);
    const imp_code code = points_at(s, n, p, x, e, error);
    for (size_t k = 0; k < n && code == IMP_SUCCESS; ++k)
        eval_error[k] = padded_upper(e[k][0] + e[k][1] + e[k][2], 8);
    return code;
}

imp_code witness_at_centres(const node *const nodes[2], double t, witness *found, imp_error *error)
{
    return search_run(nodes, t, 0, false, found, error);
}
