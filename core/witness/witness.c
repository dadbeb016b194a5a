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
#include "core/witness/newton.h"

/* The unknowns are y = (s_u, s_v) of a and of b, relative to the nodes. Newton steps with the
 * Hessian J'J + D.D'' + damping minimise |D|^2 / 2, D = x_b - x_a; J and D'' come from the nodes'
 * polynomials (or from differences, if a node has none), points from the surfaces themselves. */

typedef struct search {
    const node *const *nodes;
    double t;
    newton_bounds y;                       /* of y */
    double whole_lo[2][3], whole_hi[2][3]; /* domains of the two surfaces */
} search;

typedef struct state {
    double y[NEWTON_UNKNOWNS];
    double p[2][3]; /* parameters (u, v, t) on each surface */
    vec3 x[2];
    vec3 apart; /* D */
    double gap;
} state;

/* Whether the node's polynomial is too poor for derivatives in u and v: the node has no normal and
 * is not a nearly straight curve. */
static bool needs_differences(const node *n)
{
    return !node_has_normal(n) && node_blurs(n, TUNING_STRAIGHT_BLUR);
}

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

static void side_parameters(const search *g, int side, const double *y, double p[3])
{
    const imp_region *r = &g->nodes[side]->region;
    const double *lo = g->whole_lo[side], *hi = g->whole_hi[side];
    for (int j = 0; j < 2; ++j) {
        const double x = r->c[j] + r->d[j] * y[2 * side + j];
        p[j] = x < lo[j] ? lo[j] : x > hi[j] ? hi[j] : x;
    }
    p[2] = g->t;
}

static imp_code point_fault(const surface *s, const double p[3], const char *what, imp_error *error)
{
    return surface_fault(s, error, "at u = %.17g, v = %.17g, t = %.17g: %s", p[0], p[1], p[2],
                         what);
}

static imp_code status_fault(const surface *s, imp_status status, const double p[3],
                             imp_error *error)
{
    point_fault(s, p, surface_status_message(s, status).text, error);
    return surface_set_code(status, error);
}

static imp_code point_check(const surface *s, const double p[3], vec3 x, const double eval_error[3],
                            imp_error *error)
{
    if (!isfinite(vec3_norm1(x)))
        return point_fault(s, p, "eval gives a point that is infinite or NaN", error);
    for (int i = 0; eval_error != NULL && i < 3; ++i)
        if (!(eval_error[i] >= 0))
            return point_fault(s, p, "eval's error bound is negative or NaN", error);
    return IMP_SUCCESS;
}

/* Evaluates the point at p and, unless eval_error is NULL, bounds of its errors. */
static imp_code point_at(const surface *s, const double *p, vec3 *x, double eval_error[3],
                         imp_error *error)
{
    const imp_status status = surface_eval(s, 1, p, x->x, eval_error);
    if (status != IMP_STATUS_OK) return status_fault(s, status, p, error);
    return point_check(s, p, *x, eval_error, error);
}

/* Evaluates n points with their errors. If that fails, the error names the first point that cannot
 * be evaluated by itself, or else the first of all. */
static imp_code points_at(const surface *s, size_t n, const double (*p)[3], vec3 *x,
                          double (*eval_error)[3], imp_error *error)
{
    const imp_status status = surface_eval(s, n, p[0], x->x, eval_error[0]);
    const imp_code together =
        status == IMP_STATUS_OK ? IMP_SUCCESS : status_fault(s, status, p[0], error);
    imp_code each = IMP_SUCCESS;
    for (size_t k = 0; k < n && each == IMP_SUCCESS; ++k)
        each = status == IMP_STATUS_OK ? point_check(s, p[k], x[k], eval_error[k], error)
                                       : point_at(s, p[k], &x[k], eval_error[k], error);
    return each == IMP_SUCCESS ? together : each;
}

static imp_code state_at(const search *g, const double *y, state *s, imp_error *error)
{
    memcpy(s->y, y, sizeof s->y);
    for (int side = 0; side < 2; ++side) {
        side_parameters(g, side, y, s->p[side]);
        imp_code code = point_at(g->nodes[side]->surface, s->p[side], &s->x[side], NULL, error);
        if (code == IMP_SUCCESS)
            code = bound_audit_holds_at(g->nodes[side]->surface, g->nodes[side], s->p[side],
                                        s->x[side].x, error);
        if (code != IMP_SUCCESS) return code;
    }
    s->apart = vec3_sub(s->x[1], s->x[0]);
    s->gap = vec3_norm(s->apart);
    return IMP_SUCCESS;
}

/* --- Derivatives ------------------------------------------------------------------------------ */

/* Computes the columns of J of one side and, weighted with D, its second derivatives. */
typedef struct derivatives {
    vec3 by[2];
    double second[2][2];
} derivatives;

static void derive_from_polynomial(const search *g, int side, const state *s, derivatives *out)
{
    const node *n = g->nodes[side];
    const quadratic3 *f = &n->f;
    const double su = s->y[2 * side], sv = s->y[2 * side + 1];
    const double st = n->region.d[2] > 0 ? (g->t - n->region.c[2]) / n->region.d[2] : 0;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 3; ++i) {
        out->by[0].x[i] = f->bu[i] + 2 * f->quu[i] * su + f->quv[i] * sv + f->qut[i] * st;
        out->by[1].x[i] = f->bv[i] + 2 * f->qvv[i] * sv + f->quv[i] * su + f->qvt[i] * st;
        out->second[0][0] += 2 * s->apart.x[i] * f->quu[i];
        out->second[0][1] += s->apart.x[i] * f->quv[i];
        out->second[1][1] += 2 * s->apart.x[i] * f->qvv[i];
    }
    out->second[1][0] = out->second[0][1];
}

static const double DIFFERENCE_STEP = 0x1p-8; /* of a half-width */

static imp_code derive_from_points(const search *g, int side, const state *s, derivatives *out,
                                   imp_error *error)
{
    memset(out, 0, sizeof *out);
    for (int j = 0; j < 2; ++j) {
        const int k = 2 * side + j;
        double y[NEWTON_UNKNOWNS], p[3];
        memcpy(y, s->y, sizeof y);
        y[k] += y[k] + DIFFERENCE_STEP <= g->y.hi[k] ? DIFFERENCE_STEP : -DIFFERENCE_STEP;
        if (y[k] < g->y.lo[k]) continue;
        side_parameters(g, side, y, p);
        if (p[j] == s->p[side][j]) continue;
        vec3 x;
        const imp_code code = point_at(g->nodes[side]->surface, p, &x, NULL, error);
        if (code != IMP_SUCCESS) return code;
        out->by[j] = vec3_scale(vec3_sub(x, s->x[side]), 1 / (y[k] - s->y[k]));
    }
    return IMP_SUCCESS;
}

/* Computes gradient and Hessian of |D|^2 / 2. */
static imp_code derive(const search *g, const state *s, double gradient[NEWTON_UNKNOWNS],
                       double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], imp_error *error)
{
    derivatives d[2];
    vec3 column[NEWTON_UNKNOWNS];
    double second[2][2][2];
    for (int side = 0; side < 2; ++side) {
        imp_code code = IMP_SUCCESS;
        if (needs_differences(g->nodes[side]))
            code = derive_from_points(g, side, s, &d[side], error);
        else
            derive_from_polynomial(g, side, s, &d[side]);
        if (code != IMP_SUCCESS) return code;
        for (int j = 0; j < 2; ++j)
            column[2 * side + j] = vec3_scale(d[side].by[j], side == 0 ? -1 : 1);
        memcpy(second[side], d[side].second, sizeof second[side]);
    }
    newton_of_gap(s->apart, column, second, gradient, hessian);
    return IMP_SUCCESS;
}

/* --- Steps ------------------------------------------------------------------------------------ */

/* Descends from *s until the predicted reduction of a step is mere rounding, or a step reduces the
 * gap by less than TUNING_NEWTON_GAIN of it, or by less than half while it is far above gamma. The
 * last condition is left out for two flat hulls, whose windows start at a contact. */
static imp_code descend(const search *g, double gamma, state *s, imp_error *error)
{
    newton_way way = newton_begin(&g->y);
    const double far = strategy_hulls_of(g->nodes[0], g->nodes[1]) == HULLS_FLAT
                           ? INFINITY
                           : TUNING_NEWTON_FAR * gamma;
    while (way.steps < TUNING_NEWTON_STEPS && s->gap > 0) {
        imp_code code = derive(g, s, way.gradient, way.hessian, error);
        if (code != IMP_SUCCESS) return code;
        state trial;
        bool is_better = false;
        for (double next[NEWTON_UNKNOWNS]; !is_better; newton_judge(&way, is_better)) {
            if (!newton_try(&way, s->y, next)) return IMP_SUCCESS;
            if (fabs(newton_promise(&way, s->y, next)) < TUNING_NEWTON_PROMISE * s->gap * s->gap)
                return IMP_SUCCESS;
            code = state_at(g, next, &trial, error);
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
static imp_code evaluate_gap(const search *g, const state *s, witness *found, imp_error *error)
{
    double eval_error = 0;
    for (int side = 0; side < 2; ++side) {
        vec3 x;
        double e[3];
        const imp_code code = point_at(g->nodes[side]->surface, s->p[side], &x, e, error);
        if (code != IMP_SUCCESS) return code;
        for (int i = 0; i < 3; ++i) eval_error += e[i];
        found->piece[side] = surface_piece_index(g->nodes[side]->surface);
        found->u[side] = s->p[side][0];
        found->v[side] = s->p[side][1];
        found->point[side] = s->x[side];
    }
    found->gap = s->gap;
    found->gap_upper = padded_upper(s->gap + eval_error, 16) + PRODUCTS_UNDERFLOW;
    found->has_normal = s->gap > NORMAL_FROM * eval_error && s->gap > NORMAL_LEAST;
    found->normal = found->has_normal ? vec3_scale(s->apart, 1 / s->gap) : (vec3){{0, 0, 0}};
    return IMP_SUCCESS;
}

static imp_code search_run(const node *const nodes[2], double t, double gamma, bool moving,
                           witness *found, imp_error *error)
{
    search g = {.nodes = nodes, .t = t};
    state s;
    search_begin(&g);
    imp_code code = state_at(&g, (double[NEWTON_UNKNOWNS]){0, 0, 0, 0}, &s, error);
    if (code == IMP_SUCCESS && moving) code = descend(&g, gamma, &s, error);
    return code == IMP_SUCCESS ? evaluate_gap(&g, &s, found, error) : code;
}

imp_code witness_seek(const node *const nodes[2], double t, double gamma, witness *found,
                      imp_error *error)
{
    return search_run(nodes, t, gamma, true, found, error);
}

/* Unlike in a search, y may be anywhere on the surfaces. */
imp_code witness_at(const node *const nodes[2], double t, const double y[4], witness *found,
                    imp_error *error)
{
    search g = {.nodes = nodes, .t = t};
    state s;
    search_begin(&g);
    const imp_code code = state_at(&g, y, &s, error);
    return code == IMP_SUCCESS ? evaluate_gap(&g, &s, found, error) : code;
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
