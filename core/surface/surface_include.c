/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface_parts.h"

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

/* The inclusion that rates alone give: a = f(c), b = q = 0, e = error + M d. */
static imp_status model_from_rates(const surface *s, const imp_region *region,
                                   const imp_rate_matrix *rates, size_t maps, imp_model model[3])
{
    centred_box around;
    const imp_status status = surface_box_around(s, region, rates, maps, &around);
    if (status != IMP_OK) return status;
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
        const fp_mode mode = surface_call_begin(s->type->name, "include");
        return surface_call_end(mode, s->type->include(s->self, region, model));
    }
    imp_rate_matrix rates;
    const imp_status status = surface_type_rate(s, region, &rates);
    if (status == IMP_UNBOUNDED) model_unbounded(model);
    if (status != IMP_OK) return status;
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

/* t itself over the region: c + d s, exact but for d, which region_make rounded up. */
static imp_model model_of_time(const imp_region *region)
{
    imp_model t = {.a = region->c[2], .lo = region->lo[2], .hi = region->hi[2]};
    t.b[2] = region->d[2];
    t.rate[2] = region->d[2] > 0;
    t.depends = region->d[2] > 0 ? 1u << PARAMETER_T : 0;
    return t;
}

static imp_status include_by_chain_rule(const surface *s, size_t k, const imp_region *region,
                                        imp_model model[3])
{
    double lo[3], hi[3];
    imp_rate_matrix inner, rates;
    for (int i = 0; i < 3; ++i) {
        lo[i] = model[i].lo;
        hi[i] = model[i].hi;
        memcpy(inner.m[i], model[i].rate, sizeof inner.m[i]);
    }
    imp_box4 box;
    imp_map_rates p;
    if (!surface_box4_from(lo, hi, region, &box)) return IMP_UNBOUNDED;
    imp_status status = surface_map_rate(&s->maps[k], &box, &p);
    if (status == IMP_OK) status = surface_chain_rule(&p, &inner, &rates);
    if (status != IMP_OK) return status;
    return model_from_rates(s, region, &rates, k + 1, model);
}

/* One map on top of the models. `*unbounded` says that rates are no longer to be trusted, though
 * polynomials and ranges may still be. */
static imp_status include_through_map(const surface *s, size_t k, const imp_region *region,
                                      imp_model model[3], bool *unbounded)
{
    const mapping *map = &s->maps[k];
    imp_status status = IMP_UNBOUNDED;
    if (!models_are_sane(model, !*unbounded)) return SURFACE_BAD_MODEL;
    if (models_are_finite(model) && map->type->apply != NULL) {
        const imp_model in[4] = {model[0], model[1], model[2], model_of_time(region)};
        const fp_mode mode = surface_call_begin(map->type->name, "apply");
        status = map->type->apply(map->self, in, model);
        status = surface_call_end(mode, status);
    } else if (!*unbounded) {
        status = include_by_chain_rule(s, k, region, model);
        if (status == IMP_UNBOUNDED) model_unbounded(model);
    } else {
        model_unbounded(model);
    }
    if (status != IMP_UNBOUNDED) return status;
    *unbounded = true;
    return IMP_OK;
}

imp_status surface_include(const surface *s, const imp_region *region, imp_model model[3])
{
    imp_status status = include_type(s, region, model);
    bool unbounded = status == IMP_UNBOUNDED;
    if (unbounded) status = IMP_OK;
    for (size_t k = 0; k < s->map_count && status == IMP_OK; ++k)
        status = include_through_map(s, k, region, model, &unbounded);
    return status == IMP_OK && unbounded ? IMP_UNBOUNDED : status;
}
