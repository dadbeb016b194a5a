/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface_internal.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"

static void model_unbounded(imp_model model[3])
{
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        model[i].e = model[i].hi = INFINITY;
        model[i].lo = -INFINITY;
        for (int j = 0; j < 3; ++j) model[i].rate[j] = INFINITY;
        model[i].depends = 7;
    }
}

/* Makes the inclusion that rates alone give: a = f(c), b = q = 0, e = error + M d. */
static imp_status model_from_rates(const surface *s, const imp_region *region,
                                   const imp_rate_matrix *rates, size_t maps, imp_model model[3])
{
    centred_box around;
    const imp_status status = surface_box_around(s, region, rates, maps, &around);
    if (status != IMP_STATUS_OK) return status;
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        model[i].a = around.centre[i];
        model[i].e = around.reach[i];
        model[i].lo = difference_lower(around.centre[i], around.reach[i]);
        model[i].hi = sum_upper(around.centre[i], around.reach[i]);
        memcpy(model[i].rate, rates->m[i], sizeof model[i].rate);
        model[i].depends = 7;
    }
    return status;
}

static imp_status include_type(const surface *s, const imp_region *region, imp_model model[3])
{
    if (s->type->include != NULL) {
        const surface_call call = surface_call_begin(s->type->name, "include");
        return surface_call_end(call, s->type->include(s->self, region, model));
    }
    imp_rate_matrix rates;
    const imp_status status = surface_type_rate(s, region, &rates);
    if (status == IMP_STATUS_UNBOUNDED) model_unbounded(model);
    if (status != IMP_STATUS_OK) return status;
    return model_from_rates(s, region, &rates, 0, model);
}

static bool models_are_sane(const imp_model model[3], bool with_rates)
{
    bool sane = true;
    for (int i = 0; i < 3; ++i) {
        sane = sane && model[i].e >= 0 && model[i].lo <= model[i].hi;
        for (int j = 0; j < 3 && with_rates; ++j) sane = sane && model[i].rate[j] >= 0;
    }
    return sane;
}

static bool models_are_finite(const imp_model model[3])
{
    for (int i = 0; i < 3; ++i)
        if (!(model[i].lo > -INFINITY && model[i].hi < INFINITY && model[i].e < INFINITY))
            return false;
    return true;
}

imp_model surface_time(const imp_region *region)
{
    imp_model t = {.a = region->c[2], .lo = region->lo[2], .hi = region->hi[2]};
    t.b[2] = region->d[2];
    t.rate[2] = region->d[2] > 0;
    t.depends = region->d[2] > 0 ? 1u << PARAMETER_T : 0;
    return t;
}

/* Computes the rates of map k over the box of the models, and those of the composition. */
static imp_status rates_through_map(const surface *s, size_t k, const imp_region *region,
                                    const imp_model model[3], imp_box4 *box, imp_map_rates *p,
                                    imp_rate_matrix *rates)
{
    double lo[3], hi[3];
    imp_rate_matrix inner;
    for (int i = 0; i < 3; ++i) {
        lo[i] = model[i].lo;
        hi[i] = model[i].hi;
        memcpy(inner.m[i], model[i].rate, sizeof inner.m[i]);
    }
    if (!surface_box4_from(lo, hi, region, box)) return IMP_STATUS_UNBOUNDED;
    const imp_status status = surface_map_rate(&s->maps[k], box, p);
    return status == IMP_STATUS_OK ? surface_chain_rule(p, &inner, rates) : status;
}

/* Applies map k to the models by rates alone. */
typedef imp_status box_step(const surface *s, size_t k, const imp_region *region,
                            imp_model model[3]);

static imp_status include_by_chain_rule(const surface *s, size_t k, const imp_region *region,
                                        imp_model model[3])
{
    imp_box4 box;
    imp_map_rates p;
    imp_rate_matrix rates;
    const imp_status status = rates_through_map(s, k, region, model, &box, &p, &rates);
    return status == IMP_STATUS_OK ? model_from_rates(s, region, &rates, k + 1, model) : status;
}

/* Computes the inclusion of map k's image of the box of the models, for models of a set without a
 * known point. Lemma. The box is convex and holds its centre c, so a point of it maps to within
 * sum_j P_ij h_j of phi(c), h_j >= |x_j - c_j|; phi(c) is within `error` of what eval gives. Four
 * products, each of which goes through at most four sums. */
PAD_COVERS(16, 1 + 4);
static imp_status include_box(const surface *s, size_t k, const imp_region *region,
                              imp_model model[3])
{
    imp_box4 box;
    imp_map_rates p;
    imp_rate_matrix rates;
    double c[4], half[4], x[3], error[3];
    imp_status status = rates_through_map(s, k, region, model, &box, &p, &rates);
    if (status != IMP_STATUS_OK) return status;
    for (int j = 0; j < 4; ++j) {
        c[j] = 0.5 * box.lo[j] + 0.5 * box.hi[j];
        if (!(c[j] >= box.lo[j])) c[j] = box.lo[j];
        if (!(c[j] <= box.hi[j])) c[j] = box.hi[j];
        const double below = sum_upper(c[j], -box.lo[j]);
        const double above = sum_upper(box.hi[j], -c[j]);
        half[j] = below > above ? below : above;
    }
    const surface_call call = surface_call_begin(s->maps[k].type->name, "eval");
    status = surface_call_end(call, s->maps[k].type->eval(s->maps[k].self, 1, c, x, error));
    if (status != IMP_STATUS_OK) return status;
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        double sum = error[i];
        for (int j = 0; j < 4; ++j) sum += p.m[i][j] * half[j];
        model[i].a = x[i];
        model[i].e = padded_upper(sum, 16) + PRODUCTS_UNDERFLOW;
        model[i].lo = difference_lower(x[i], model[i].e);
        model[i].hi = sum_upper(x[i], model[i].e);
        memcpy(model[i].rate, rates.m[i], sizeof model[i].rate);
        model[i].depends = 7;
    }
    return IMP_STATUS_OK;
}

/* Applies one map to the models. *unbounded: rates are no longer valid, though polynomials and
 * ranges may still be. */
static imp_status include_through_map(const surface *s, size_t k, const imp_region *region,
                                      box_step *step, imp_model model[3], bool *unbounded)
{
    const mapping *map = &s->maps[k];
    imp_status status = IMP_STATUS_UNBOUNDED;
    if (!models_are_sane(model, !*unbounded)) return SURFACE_BAD_MODEL;
    if (models_are_finite(model) && map->type->apply != NULL) {
        const imp_model in[4] = {model[0], model[1], model[2], surface_time(region)};
        const surface_call call = surface_call_begin(map->type->name, "apply");
        status = map->type->apply(map->self, in, model);
        status = surface_call_end(call, status);
    } else if (!*unbounded) {
        status = step(s, k, region, model);
        if (status == IMP_STATUS_UNBOUNDED) model_unbounded(model);
    } else {
        model_unbounded(model);
    }
    if (status != IMP_STATUS_UNBOUNDED) return status;
    *unbounded = true;
    return IMP_STATUS_OK;
}

/* Applies the first `maps` maps to models whose inclusion returned `status`. */
static imp_status include_through_maps(const surface *s, const imp_region *region, size_t maps,
                                       box_step *step, imp_status status, imp_model model[3])
{
    bool unbounded = status == IMP_STATUS_UNBOUNDED;
    if (unbounded) status = IMP_STATUS_OK;
    for (size_t k = 0; k < maps && status == IMP_STATUS_OK; ++k)
        status = include_through_map(s, k, region, step, model, &unbounded);
    return status == IMP_STATUS_OK && unbounded ? IMP_STATUS_UNBOUNDED : status;
}

imp_status surface_include(const surface *s, const imp_region *region, imp_model model[3])
{
    const imp_status status = include_type(s, region, model);
    return include_through_maps(s, region, s->map_count, include_by_chain_rule, status, model);
}

imp_status surface_include_inner(const surface *s, const imp_region *region, size_t maps,
                                 imp_model model[3])
{
    imp_status status = include_type(s, region, model);
    status = include_through_maps(s, region, maps, include_by_chain_rule, status, model);
    return status == IMP_STATUS_OK && !models_are_sane(model, true) ? SURFACE_BAD_MODEL : status;
}

imp_status surface_include_bare(const surface *s, const imp_region *region, imp_model model[3])
{
    return surface_include_inner(s, region, 0, model);
}

imp_status surface_include_image(const surface *s, const imp_region *region, imp_model model[3])
{
    const imp_status status = models_are_finite(model) ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
    return include_through_maps(s, region, s->map_count, include_box, status, model);
}
