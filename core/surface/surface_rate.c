/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface_internal.h"

#include <assert.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"

static imp_status checked_rates(imp_status status, const double *rates, int count)
{
    for (int k = 0; k < count && status == IMP_STATUS_OK; ++k)
        if (!(rates[k] >= 0 && rates[k] < INFINITY)) return SURFACE_BAD_RATES;
    return status;
}

imp_status surface_type_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates)
{
    const surface_call call = surface_call_begin(s->type->name, "rate");
    imp_status status = s->type->rate(s->self, region, rates);
    status = surface_call_end(call, status);
    return checked_rates(status, rates->m[0], 9);
}

imp_status surface_map_rate(const mapping *map, const imp_box4 *box, imp_map_rates *rates)
{
    const surface_call call = surface_call_begin(map->type->name, "rate");
    imp_status status = map->type->rate(map->self, box, rates);
    status = surface_call_end(call, status);
    return checked_rates(status, rates->m[0], 12);
}

enum { BATCH = 16 }; /* points per call to a map; keeps buffers on the stack */

/* --- Points ----------------------------------------------------------------------------------- */

/* Lemma. The map sees x, the exact point is within `inner` of it, coordinate by coordinate;
 * both lie in the box x -+ inner, where |phi_i| changes by at most sum_j P_ij inner_j. Adding
 * the map's own error at x bounds the whole. Each term is a product and goes through at
 * most three sums. */
PAD_COVERS(16, 1 + 3);
static imp_status error_through_map(const mapping *map, const double x[4], const double inner[3],
                                    double error[3])
{
    imp_box4 box;
    for (int j = 0; j < 3; ++j) {
        if (!(inner[j] < INFINITY)) return IMP_STATUS_UNBOUNDED;
        box.lo[j] = difference_lower(x[j], inner[j]);
        box.hi[j] = sum_upper(x[j], inner[j]);
    }
    box.lo[3] = box.hi[3] = x[3];
    imp_map_rates p;
    const imp_status status = surface_map_rate(map, &box, &p);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        double sum = error[i];
        for (int j = 0; j < 3; ++j) sum += p.m[i][j] * inner[j];
        error[i] = padded_upper(sum, 16) + PRODUCTS_UNDERFLOW;
    }
    return IMP_STATUS_OK;
}

static imp_status batch_through_map(const mapping *map, size_t n, const double *p, double *x,
                                    double *error)
{
    double in[4 * BATCH], own[3 * BATCH];
    for (size_t k = 0; k < n; ++k) {
        memcpy(in + 4 * k, x + 3 * k, 3 * sizeof *x);
        in[4 * k + 3] = p[3 * k + 2];
    }
    const surface_call call = surface_call_begin(map->type->name, "eval");
    imp_status status = map->type->eval(map->self, n, in, x, error == NULL ? NULL : own);
    status = surface_call_end(call, status);
    if (status != IMP_STATUS_OK || error == NULL) return status;
    for (size_t k = 0; k < n; ++k) {
        status = error_through_map(map, in + 4 * k, error + 3 * k, own + 3 * k);
        if (status == IMP_STATUS_UNBOUNDED)
            own[3 * k] = own[3 * k + 1] = own[3 * k + 2] = INFINITY;
        else if (status != IMP_STATUS_OK)
            return status;
    }
    memcpy(error, own, 3 * n * sizeof *own);
    return IMP_STATUS_OK;
}

/* Evaluates points under the first `maps` maps. */
static imp_status eval_under(const surface *s, size_t maps, size_t n, const double *p, double *x,
                             double *error)
{
    const surface_call call = surface_call_begin(s->type->name, "eval");
    imp_status status = s->type->eval(s->self, n, p, x, error);
    status = surface_call_end(call, status);
    for (size_t k = 0; k < maps && status == IMP_STATUS_OK; ++k)
        for (size_t from = 0; from < n && status == IMP_STATUS_OK; from += BATCH) {
            const size_t count = n - from < BATCH ? n - from : BATCH;
            status = batch_through_map(&s->maps[k], count, p + 3 * from, x + 3 * from,
                                       error == NULL ? NULL : error + 3 * from);
        }
    return status;
}

imp_status surface_eval(const surface *s, size_t n, const double *p, double *x, double *error)
{
    const imp_status status = eval_under(s, s->map_count, n, p, x, error);
    for (size_t k = 0; k < 3 * n && error != NULL && s->held_slip > 0; ++k)
        error[k] = sum_upper(error[k], s->held_slip);
    return status;
}

imp_status surface_move_outward(const surface *s, size_t maps, double t, size_t n, double *x)
{
    double p[3 * BATCH];
    imp_status status = IMP_STATUS_OK;
    assert(n <= BATCH);
    for (size_t j = 0; j < n; ++j) p[3 * j] = p[3 * j + 1] = 0, p[3 * j + 2] = t;
    for (size_t k = maps; k < s->map_count && status == IMP_STATUS_OK; ++k)
        status = batch_through_map(&s->maps[k], n, p, x, NULL);
    return status;
}

/* --- Rates ------------------------------------------------------------------------------------ */

imp_status surface_box_around(const surface *s, const imp_region *region,
                              const imp_rate_matrix *rates, size_t maps, centred_box *box)
{
    double error[3];
    const imp_status status = eval_under(s, maps, 1, region->c, box->centre, error);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        PAD_COVERS(2, 1);
        box->reach[i] = padded_upper(error[i] + region_reach_upper(region, rates->m[i]), 2);
    }
    return status;
}

bool surface_box4_from(const double lo[3], const double hi[3], const imp_region *region,
                       imp_box4 *box)
{
    for (int i = 0; i < 3; ++i) {
        box->lo[i] = lo[i];
        box->hi[i] = hi[i];
        if (!(lo[i] > -INFINITY && hi[i] < INFINITY)) return false;
    }
    box->lo[3] = region->lo[2];
    box->hi[3] = region->hi[2];
    return true;
}

/* Sums of at most four non-negative products. */
PAD_COVERS(16, 1 + 3);
imp_status surface_chain_rule(const imp_map_rates *p, const imp_rate_matrix *in,
                              imp_rate_matrix *out)
{
    bool finite = true;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double sum = j == PARAMETER_T ? p->m[i][3] : 0;
            for (int k = 0; k < 3; ++k)
                if (p->m[i][k] > 0) sum += p->m[i][k] * in->m[k][j];
            out->m[i][j] = padded_upper(sum, 16);
            finite = finite && out->m[i][j] < INFINITY;
        }
    return finite ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

imp_status surface_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates)
{
    imp_status status = surface_type_rate(s, region, rates);
    for (size_t k = 0; k < s->map_count && status == IMP_STATUS_OK; ++k) {
        centred_box around;
        status = surface_box_around(s, region, rates, k, &around);
        if (status != IMP_STATUS_OK) return status;
        double lo[3], hi[3];
        for (int i = 0; i < 3; ++i) {
            lo[i] = difference_lower(around.centre[i], around.reach[i]);
            hi[i] = sum_upper(around.centre[i], around.reach[i]);
        }
        imp_box4 box;
        imp_map_rates p;
        const imp_rate_matrix inner = *rates;
        if (!surface_box4_from(lo, hi, region, &box)) return IMP_STATUS_UNBOUNDED;
        status = surface_map_rate(&s->maps[k], &box, &p);
        if (status == IMP_STATUS_OK) status = surface_chain_rule(&p, &inner, rates);
    }
    return status;
}
