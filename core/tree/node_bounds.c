/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/rounding.h"
#include "core/tree/node_model.h"
#include "core/tree/tree_internal.h"

/* --- Faults of plugins ------------------------------------------------------------------------ */

imp_code node_fault(const node *n, const char *what, imp_error *error)
{
    const imp_region *r = &n->region;
    return surface_fault(n->surface, error,
                         "over u [%.17g, %.17g], v [%.17g, %.17g], t [%.17g, %.17g]: %s", r->lo[0],
                         r->hi[0], r->lo[1], r->hi[1], r->lo[2], r->hi[2], what);
}

imp_code node_status_fault(const node *n, imp_status status, imp_error *error)
{
    node_fault(n, surface_status_message(n->surface, status).text, error);
    return surface_set_code(status, error);
}

/* --- Nodes of models -------------------------------------------------------------------------- */

/* Fills a tube from the line in its middle. *done false: it has none that has bounds. Lemma. Each
 * point of the surface is within the radius of the line's point of its u and t, and so it is under
 * maps that are rigid in exact arithmetic. */
static imp_code fill_from_line(node *n, bool *done, imp_error *error)
{
    imp_tube tube;
    imp_status status = surface_tube(n->surface, &n->region, &tube);
    if (status == IMP_STATUS_OK) status = surface_include_image(n->surface, &n->region, tube.line);
    *done = status == IMP_STATUS_OK;
    if (status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    if (!*done) return node_status_fault(n, status, error);
    const char *breach = node_take_model(n, tube.line, false);
    if (breach != NULL) return node_fault(n, breach, error);
    node_add_ball(n, tube.radius);
    return IMP_SUCCESS;
}

static imp_code fill_from_model(const tree *t, node *n, imp_error *error)
{
    imp_model model[3];
    bool done = false;
    if (posing_fill(n)) return IMP_SUCCESS;
    if (node_is_to_be_tube(n)) {
        const imp_code code = fill_from_line(n, &done, error);
        if (code != IMP_SUCCESS || done) return code;
    }
    if (n->many != NULL) cluster_models(n->many, &n->region, model);
    const imp_status status = n->many != NULL ? surface_include_image(t->surface, &n->region, model)
                                              : surface_include(n->surface, &n->region, model);
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
        return node_status_fault(n, status, error);
    const char *breach = node_take_model(n, model, status == IMP_STATUS_UNBOUNDED);
    return breach != NULL ? node_fault(n, breach, error) : IMP_SUCCESS;
}

/* --- Nodes of rates --------------------------------------------------------------------------- */

/* Computes half-widths and radius from the rate matrix in one of the paper's three forms. Roundings
 * of the longest chain, where a square root halves those of its argument and counts one:
 *
 *   Frobenius norm: square 1, sums 2 + 2, root    (1 + 2 + 2) / 2 + 1 <= 4
 *   |d|: square 1, sums 2, root                   (1 + 2) / 2 + 1     <= 3
 *   reach: their product                          4 + 3 + 1           = 8
 *   radius of the full form: reach 3 each, square 1, sums 2, root
 *                                                 3 + (1 + 2) / 2 + 1 <= 6 */
PAD_COVERS(32, 4 + 3 + 1);
static void reach_from_rates(node *n, tree_kind kind, const imp_rate_matrix *m)
{
    const double *d = n->region.d;
    double column[3] = {0, 0, 0}, all = 0, reach[3], radius = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) column[j] += m->m[i][j] * m->m[i][j];
    for (int j = 0; j < 3; ++j) {
        all += column[j];
        column[j] = sqrt(column[j]);
    }
    for (int i = 0; i < 3; ++i) {
        if (kind == TREE_RATES_FULL)
            reach[i] = m->m[i][0] * d[0] + m->m[i][1] * d[1] + m->m[i][2] * d[2];
        else if (kind == TREE_RATES_COLUMN)
            reach[i] = column[0] * d[0] + column[1] * d[1] + column[2] * d[2];
        else
            reach[i] = sqrt(all) * sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        radius += reach[i] * reach[i];
        n->e[i] += padded_upper(reach[i], 32) + ROOT_UNDERFLOW;
    }
    radius = kind == TREE_RATES_FULL ? sqrt(radius) : reach[0];
    n->radius += padded_upper(radius, 32) + ROOT_UNDERFLOW; /* its sums: separation_of_balls */
    for (int j = 0; j < 3; ++j) n->extent[j] = n->nonlinear_extent[j] = column[j] * d[j];
}

static void take_infinite(node *n)
{
    for (int i = 0; i < 3; ++i) {
        n->lo[i] = -INFINITY;
        n->e[i] = n->hi[i] = INFINITY;
        n->extent[i] = n->nonlinear_extent[i] = n->region.d[i];
    }
    n->radius = INFINITY;
    n->bounded = false;
}

/* Fills a cluster's node, which has no rates, with its box and the ball around that. Roundings of
 * the radius: half a side 2, square 1, sums 2, which the root halves, and its own: (2 * 2 + 1 + 2)
 * / 2 + 1 < 8
 * - 2. */
PAD_COVERS(8, 5);
static imp_code fill_from_box(const tree *t, node *n, imp_error *error)
{
    const imp_code code = fill_from_model(t, n, error);
    if (code != IMP_SUCCESS) return code;
    if (!n->bounded) return take_infinite(n), IMP_SUCCESS;
    memset(&n->f, 0, sizeof n->f);
    for (int i = 0; i < 3; ++i) {
        n->f.a[i] = 0.5 * n->lo[i] + 0.5 * n->hi[i];
        const double below = sum_upper(n->f.a[i], -n->lo[i]);
        const double above = sum_upper(n->hi[i], -n->f.a[i]);
        n->e[i] = below > above ? below : above;
        n->radius += n->e[i] * n->e[i];
    }
    n->radius = padded_upper(sqrt(n->radius), 8) + ROOT_UNDERFLOW;
    return IMP_SUCCESS;
}

static imp_code fill_from_rates(const tree *t, node *n, imp_error *error)
{
    imp_rate_matrix rates;
    imp_status status = surface_rate(n->surface, &n->region, &rates);
    if (status == IMP_STATUS_UNBOUNDED) return take_infinite(n), IMP_SUCCESS;
    if (status != IMP_STATUS_OK) return node_status_fault(n, status, error);
    status = surface_eval(n->surface, 1, n->region.c, n->f.a, n->e);
    if (status != IMP_STATUS_OK) return node_status_fault(n, status, error);
    n->bounded = true;
    for (int i = 0; i < 3; ++i) {
        if (!(n->e[i] >= 0 && isfinite(n->f.a[i])))
            return node_fault(n, "the centre's value or error is not a number", error);
        n->radius += n->e[i];
    }
    reach_from_rates(n, t->plan.kind, &rates);
    for (int i = 0; i < 3; ++i) {
        PAD_COVERS(2, 1); /* the error of the centre's value and the reach, summed */
        n->e[i] = padded_upper(n->e[i], 2);
        n->lo[i] = difference_lower(n->f.a[i], n->e[i]);
        n->hi[i] = sum_upper(n->f.a[i], n->e[i]);
        n->bounded = n->bounded && n->lo[i] > -INFINITY && n->hi[i] < INFINITY;
    }
    return IMP_SUCCESS;
}

bool node_bare_models(const node *n, imp_model bare[3])
{
    if (n->many != NULL)
        cluster_models(n->many, &n->region, bare);
    else if (surface_include_bare(n->surface, &n->region, bare) != IMP_STATUS_OK)
        return false;
    for (int i = 0; i < 3; ++i)
        if (!(bare[i].e < INFINITY) || (bare[i].depends >> PARAMETER_T & 1) != 0) return false;
    return true;
}

imp_code node_bounds_find(const tree *t, node *n, imp_error *error)
{
    if (t->plan.kind == TREE_MODELS) return fill_from_model(t, n, error);
    return n->many != NULL ? fill_from_box(t, n, error) : fill_from_rates(t, n, error);
}
