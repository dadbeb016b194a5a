/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/search.h"

#include <impinge/model.h>
#include <string.h>

#include "core/bounds/tuning.h"

/* --- Points ----------------------------------------------------------------------------------- */

void search_parameters(const search *g, int side, const double *y, double p[3])
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

imp_code search_fault(const surface *s, imp_status status, const double p[3], imp_error *error)
{
    point_fault(s, p, surface_status_message(s, status).text, error);
    return surface_set_code(status, error);
}

imp_code search_point_check(const surface *s, const double p[3], vec3 x, const double eval_error[3],
                            imp_error *error)
{
    if (!isfinite(vec3_norm1(x)))
        return point_fault(s, p, "eval gives a point that is infinite or NaN", error);
    for (int i = 0; eval_error != NULL && i < 3; ++i)
        if (!(eval_error[i] >= 0))
            return point_fault(s, p, "eval's error bound is negative or NaN", error);
    return IMP_SUCCESS;
}

imp_code search_point(const surface *s, const double *p, vec3 *x, double eval_error[3],
                      imp_error *error)
{
    const imp_status status = surface_eval(s, 1, p, x->x, eval_error);
    if (status != IMP_STATUS_OK) return search_fault(s, status, p, error);
    return search_point_check(s, p, *x, eval_error, error);
}

/* --- Derivatives ------------------------------------------------------------------------------ */

/* Whether the node's polynomial is too poor for derivatives in u and v: the node has no normal and
 * is not a nearly straight curve. */
static bool needs_differences(const node *n)
{
    return !node_has_normal(n) && node_blurs(n, TUNING_STRAIGHT_BLUR);
}

/* Computes the columns of J of one side and, weighted with D, its second derivatives. */
typedef struct derivatives {
    vec3 by[2];
    double second[2][2];
} derivatives;

static void derive_from_polynomial(const search *g, int side, const search_state *s,
                                   derivatives *out)
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

static imp_code derive_from_points(const search *g, int side, const search_state *s,
                                   derivatives *out, imp_error *error)
{
    memset(out, 0, sizeof *out);
    for (int j = 0; j < 2; ++j) {
        const int k = 2 * side + j;
        double y[NEWTON_UNKNOWNS], p[3];
        memcpy(y, s->y, sizeof y);
        y[k] += y[k] + DIFFERENCE_STEP <= g->y.hi[k] ? DIFFERENCE_STEP : -DIFFERENCE_STEP;
        if (y[k] < g->y.lo[k]) continue;
        search_parameters(g, side, y, p);
        if (p[j] == s->p[side][j]) continue;
        vec3 x;
        const imp_code code = search_point(g->nodes[side]->surface, p, &x, NULL, error);
        if (code != IMP_SUCCESS) return code;
        out->by[j] = vec3_scale(vec3_sub(x, s->x[side]), 1 / (y[k] - s->y[k]));
    }
    return IMP_SUCCESS;
}

/* Half-width of the region whose models give the derivatives at a point, as a part of the
 * node's. */
static const double LOCAL = 0x1p-10;

static imp_region region_around(const search *g, int side, const search_state *s)
{
    double lo[3], hi[3];
    lo[2] = hi[2] = g->t;
    for (int j = 0; j < 2; ++j) {
        const double x = s->p[side][j], half = LOCAL * g->nodes[side]->region.d[j];
        lo[j] = fmax(g->whole_lo[side][j], x - half);
        hi[j] = fmin(g->whole_hi[side][j], x + half);
    }
    return region_make(lo, hi);
}

/* Whether models have no slopes: a type or map with rates alone makes such. */
static bool are_constant(const imp_model m[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += fabs(m[i].b[0]) + fabs(m[i].b[1]);
    return !(sum > 0);
}

/* Copies the derivatives of the models over a small region around the point, scaled to the node's
 * half-widths. */
static imp_code derive_from_region(const search *g, int side, const search_state *s,
                                   derivatives *out, imp_error *error)
{
    const node *n = g->nodes[side];
    const imp_region r = region_around(g, side, s);
    double scale[2] = {0, 0}, at[2] = {0, 0};
    imp_model m[3];
    const imp_status status =
        surface_include_inner(n->surface, &r, surface_map_count(n->surface), m);
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
        return search_fault(n->surface, status, s->p[side], error);
    if (status == IMP_STATUS_UNBOUNDED || are_constant(m))
        return derive_from_points(g, side, s, out, error);
    memset(out, 0, sizeof *out);
    for (int j = 0; j < 2; ++j)
        if (r.d[j] > 0) {
            scale[j] = n->region.d[j] / r.d[j];
            at[j] = (s->p[side][j] - r.c[j]) / r.d[j];
        }
    for (int i = 0; i < 3; ++i) {
        const double *b = m[i].b, *q = m[i].q, d = s->apart.x[i];
        out->by[0].x[i] = scale[0] * (b[0] + 2 * q[IMP_UU] * at[0] + q[IMP_UV] * at[1]);
        out->by[1].x[i] = scale[1] * (b[1] + 2 * q[IMP_VV] * at[1] + q[IMP_UV] * at[0]);
        out->second[0][0] += 2 * d * q[IMP_UU] * scale[0] * scale[0];
        out->second[0][1] += d * q[IMP_UV] * scale[0] * scale[1];
        out->second[1][1] += 2 * d * q[IMP_VV] * scale[1] * scale[1];
    }
    out->second[1][0] = out->second[0][1];
    return IMP_SUCCESS;
}

imp_code search_derive(const search *g, const search_state *s, double gradient[NEWTON_UNKNOWNS],
                       double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], imp_error *error)
{
    derivatives d[2];
    vec3 column[NEWTON_UNKNOWNS];
    double second[2][2][2];
    for (int side = 0; side < 2; ++side) {
        imp_code code = IMP_SUCCESS;
        if (g->is_local)
            code = derive_from_region(g, side, s, &d[side], error);
        else if (needs_differences(g->nodes[side]))
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
