/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fp_mode.h"
#include "in_call.h"
#include "region.h"

typedef struct mapping {
    const imp_map_type *type;
    void *self;
} mapping;

enum { LABEL_MAX = 240 };

struct surface {
    const imp_surface_type *type;
    void *self;
    size_t map_count;
    mapping *maps;
    double lo[3], hi[3];   /* the domain */
    imp_status breach;     /* of who told the domain, else IMP_OK */
    char label[LABEL_MAX]; /* as on a command line, shortened */
};

enum { BATCH = 16 }; /* points a call to a map takes at once; keeps buffers on the stack */

/* Appends the text, or dots in its place: at the end of a label that is full. */
static void label_add(surface *s, const char *text)
{
    static const char dots[] = " ...";
    const size_t used = strlen(s->label), more = strlen(text);
    if (used + more + sizeof dots <= sizeof s->label)
        memcpy(s->label + used, text, more + 1);
    else if (used < sizeof dots || strcmp(s->label + used - (sizeof dots - 1), dots) != 0)
        memcpy(s->label + used, dots, sizeof dots);
}

static imp_status guarded(fp_mode before, imp_status status);

/* Domains are asked for once; one that is not finite in u and v, inverted or NaN is a breach. */
static void take_domain(surface *s)
{
    const fp_mode mode = fp_mode_read();
    in_call_begin(s->type->name, "domain");
    s->type->domain(s->self, s->lo, s->hi);
    bool good = s->lo[0] > -INFINITY && s->lo[1] > -INFINITY;
    good = good && s->hi[0] < INFINITY && s->hi[1] < INFINITY;
    for (int j = 0; j < 3; ++j) good = good && s->lo[j] <= s->hi[j];
    s->breach = guarded(mode, good ? IMP_OK : SURFACE_BAD_DOMAIN);
}

static void take_times(surface *s, const mapping *map)
{
    double start = -INFINITY, end = INFINITY;
    const fp_mode mode = fp_mode_read();
    in_call_begin(map->type->name, "time_domain");
    map->type->time_domain(map->self, &start, &end);
    s->breach = guarded(mode, start <= end ? IMP_OK : SURFACE_BAD_DOMAIN);
    if (start > s->lo[2]) s->lo[2] = start;
    if (end < s->hi[2]) s->hi[2] = end;
}

/* What destroy does to the floating-point mode is undone. */
static void destroy(const char *type, void (*destroy_it)(void *), void *self)
{
    const fp_mode mode = fp_mode_read();
    in_call_begin(type, "destroy");
    destroy_it(self);
    guarded(mode, IMP_OK);
}

surface *surface_new(const imp_surface_type *type, void *self)
{
    surface *s = malloc(sizeof *s);
    if (s == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *s = (surface){.type = type, .self = self};
    label_add(s, type->name);
    take_domain(s);
    return s;
}

imp_code surface_add_map(surface *s, const imp_map_type *type, void *self)
{
    mapping *maps = realloc(s->maps, (s->map_count + 1) * sizeof *maps);
    if (maps == NULL) {
        destroy(type->name, type->destroy, self);
        return IMP_ERROR_MEMORY;
    }
    s->maps = maps;
    maps[s->map_count] = (mapping){type, self};
    label_add(s, " ! ");
    label_add(s, type->name);
    take_times(s, &maps[s->map_count++]);
    return IMP_SUCCESS;
}

void surface_add_label(surface *s, const char *text) { label_add(s, text); }

void surface_free(surface *s)
{
    if (s == NULL) return;
    for (size_t k = 0; k < s->map_count; ++k)
        destroy(s->maps[k].type->name, s->maps[k].type->destroy, s->maps[k].self);
    free(s->maps);
    destroy(s->type->name, s->type->destroy, s->self);
    free(s);
}

const char *surface_label(const surface *s) { return s->label; }

imp_status surface_breach(const surface *s) { return s->breach; }

void surface_domain(const surface *s, double lo[3], double hi[3])
{
    memcpy(lo, s->lo, sizeof s->lo);
    memcpy(hi, s->hi, sizeof s->hi);
}

const char *surface_status_text(imp_status status)
{
    switch (status) {
    case IMP_DOMAIN:
        return "answers that a point or region of its domain is outside it";
    case IMP_UNBOUNDED:
        return "has no bounds there";
    case IMP_INTERNAL:
        return "reports an internal error";
    case SURFACE_CHANGED_MODE:
        return "changes the floating-point mode of its caller, which breaks every bound";
    case SURFACE_BAD_DOMAIN:
        return "has a domain that is empty, NaN, or infinite in u or v";
    case SURFACE_BAD_RATES:
        return "a rate is negative, infinite or NaN";
    case SURFACE_BAD_MODEL:
        return "a remainder is negative or NaN, a range inverted or NaN, or a rate negative or NaN";
    case SURFACE_CRASHED:
        return "crashes or ends its process, in which it runs isolated";
    case SURFACE_HUNG:
        return "does not answer within 5 s; it ran isolated, and its process was ended";
    default:
        return "answers a status that does not exist here";
    }
}

/* The mode is read once after all callbacks of a call: what they computed is thrown away then. */
static imp_status guarded(fp_mode before, imp_status status)
{
    in_call_end();
    return fp_mode_kept(before) ? status : SURFACE_CHANGED_MODE;
}

/* Rates as they come from a callback, before they are multiplied: there a negative one could hide.
 */
static imp_status checked_rates(imp_status status, const double *rates, int count)
{
    for (int k = 0; k < count && status == IMP_OK; ++k)
        if (!(rates[k] >= 0 && rates[k] < INFINITY)) return SURFACE_BAD_RATES;
    return status;
}

static imp_status type_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates)
{
    in_call_begin(s->type->name, "rate");
    return checked_rates(s->type->rate(s->self, region, rates), rates->m[0], 9);
}

static imp_status map_rate(const mapping *map, const imp_box4 *box, imp_map_rates *rates)
{
    in_call_begin(map->type->name, "rate");
    return checked_rates(map->type->rate(map->self, box, rates), rates->m[0], 12);
}

/* --- Points ------------------------------------------------------------------- */

/* Lemma. The map sees x, the exact point is within `inner` of it, coordinate by coordinate;
 * both lie in the box x -+ inner, where |phi_i| changes by at most sum_j P_ij inner_j. Adding
 * the map's own error at x bounds the whole. The sum of six non-negative terms is padded by
 * 2^-49 > (1 + 2^-53)^7 - 1. */
static imp_status error_through_map(const mapping *map, const double x[4], const double inner[3],
                                    double error[3])
{
    imp_box4 box;
    for (int j = 0; j < 3; ++j) {
        if (!(inner[j] < INFINITY)) return IMP_UNBOUNDED;
        box.lo[j] = nextafter(x[j] - inner[j], -INFINITY);
        box.hi[j] = nextafter(x[j] + inner[j], INFINITY);
    }
    box.lo[3] = box.hi[3] = x[3];
    imp_map_rates p;
    const imp_status status = map_rate(map, &box, &p);
    if (status != IMP_OK) return status;
    for (int i = 0; i < 3; ++i) {
        double sum = error[i];
        for (int j = 0; j < 3; ++j) sum += p.m[i][j] * inner[j];
        error[i] = sum + sum * 0x1p-49 + 0x1p-1070;
    }
    return IMP_OK;
}

static imp_status batch_through_map(const mapping *map, size_t n, const double *p, double *x,
                                    double *error)
{
    double in[4 * BATCH], own[3 * BATCH];
    for (size_t k = 0; k < n; ++k) {
        memcpy(in + 4 * k, x + 3 * k, 3 * sizeof *x);
        in[4 * k + 3] = p[3 * k + 2];
    }
    in_call_begin(map->type->name, "eval");
    imp_status status = map->type->eval(map->self, n, in, x, error == NULL ? NULL : own);
    if (status != IMP_OK || error == NULL) return status;
    for (size_t k = 0; k < n; ++k) {
        status = error_through_map(map, in + 4 * k, error + 3 * k, own + 3 * k);
        if (status == IMP_UNBOUNDED)
            own[3 * k] = own[3 * k + 1] = own[3 * k + 2] = INFINITY;
        else if (status != IMP_OK)
            return status;
    }
    memcpy(error, own, 3 * n * sizeof *own);
    return IMP_OK;
}

/* Under the first `maps` maps. */
static imp_status eval_under(const surface *s, size_t maps, size_t n, const double *p, double *x,
                             double *error)
{
    in_call_begin(s->type->name, "eval");
    imp_status status = s->type->eval(s->self, n, p, x, error);
    for (size_t k = 0; k < maps && status == IMP_OK; ++k)
        for (size_t from = 0; from < n && status == IMP_OK; from += BATCH) {
            const size_t count = n - from < BATCH ? n - from : BATCH;
            status = batch_through_map(&s->maps[k], count, p + 3 * from, x + 3 * from,
                                       error == NULL ? NULL : error + 3 * from);
        }
    return status;
}

imp_status surface_eval(const surface *s, size_t n, const double *p, double *x, double *error)
{
    const fp_mode mode = fp_mode_read();
    return guarded(mode, eval_under(s, s->map_count, n, p, x, error));
}

/* --- Rates ---------------------------------------------------------------------- */

/* A box around f over the region: the point f(c) with its error, give or take M d. */
typedef struct centred_box {
    double centre[3], reach[3];
} centred_box;

static imp_status box_around(const surface *s, const imp_region *region,
                             const imp_rate_matrix *rates, size_t maps, centred_box *box)
{
    double error[3];
    const imp_status status = eval_under(s, maps, 1, region->c, box->centre, error);
    if (status != IMP_OK) return status;
    for (int i = 0; i < 3; ++i) {
        const double reach = error[i] + region_reach_upper(region, rates->m[i]);
        box->reach[i] = reach + reach * 0x1p-52;
    }
    return status;
}

static bool box4_from(const double lo[3], const double hi[3], const imp_region *region,
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

/* One step of the chain rule (paper, section 5): M_g[:,j] = P M_f[:,j], + p_t for j = t. Sums of at
 * most four non-negative products, padded by 2^-49. */
static void rates_through_map(const imp_map_rates *p, const imp_rate_matrix *in,
                              imp_rate_matrix *out)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double sum = j == PARAMETER_T ? p->m[i][3] : 0;
            for (int k = 0; k < 3; ++k)
                if (p->m[i][k] > 0) sum += p->m[i][k] * in->m[k][j];
            out->m[i][j] = sum + sum * 0x1p-49;
        }
}

static imp_status rate_of(const surface *s, const imp_region *region, imp_rate_matrix *rates)
{
    imp_status status = type_rate(s, region, rates);
    for (size_t k = 0; k < s->map_count && status == IMP_OK; ++k) {
        centred_box around;
        status = box_around(s, region, rates, k, &around);
        if (status != IMP_OK) return status;
        double lo[3], hi[3];
        for (int i = 0; i < 3; ++i) {
            lo[i] = nextafter(around.centre[i] - around.reach[i], -INFINITY);
            hi[i] = nextafter(around.centre[i] + around.reach[i], INFINITY);
        }
        imp_box4 box;
        imp_map_rates p;
        const imp_rate_matrix inner = *rates;
        if (!box4_from(lo, hi, region, &box)) return IMP_UNBOUNDED;
        status = map_rate(&s->maps[k], &box, &p);
        if (status == IMP_OK) rates_through_map(&p, &inner, rates);
    }
    return status;
}

imp_status surface_rate(const surface *s, const imp_region *region, imp_rate_matrix *rates)
{
    const fp_mode mode = fp_mode_read();
    return guarded(mode, rate_of(s, region, rates));
}

/* --- Inclusions ------------------------------------------------------------------- */

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
    const imp_status status = box_around(s, region, rates, maps, &around);
    if (status != IMP_OK) return status;
    memset(model, 0, 3 * sizeof *model);
    for (int i = 0; i < 3; ++i) {
        model[i].a = around.centre[i];
        model[i].e = around.reach[i];
        model[i].lo = nextafter(around.centre[i] - around.reach[i], -INFINITY);
        model[i].hi = nextafter(around.centre[i] + around.reach[i], INFINITY);
        memcpy(model[i].rate, rates->m[i], sizeof model[i].rate);
        model[i].depends = 7;
    }
    return status;
}

static imp_status include_type(const surface *s, const imp_region *region, imp_model model[3])
{
    if (s->type->include != NULL) {
        in_call_begin(s->type->name, "include");
        return s->type->include(s->self, region, model);
    }
    imp_rate_matrix rates;
    const imp_status status = type_rate(s, region, &rates);
    if (status == IMP_UNBOUNDED) model_unbounded(model);
    if (status != IMP_OK) return status;
    return model_from_rates(s, region, &rates, 0, model);
}

/* As they come from a callback, before a map works on them: behind it a breach might not show. */
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
    if (!box4_from(lo, hi, region, &box)) return IMP_UNBOUNDED;
    const imp_status status = map_rate(&s->maps[k], &box, &p);
    if (status != IMP_OK) return status;
    rates_through_map(&p, &inner, &rates);
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
        in_call_begin(map->type->name, "apply");
        status = map->type->apply(map->self, in, model);
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
    const fp_mode mode = fp_mode_read();
    imp_status status = include_type(s, region, model);
    bool unbounded = status == IMP_UNBOUNDED;
    if (unbounded) status = IMP_OK;
    for (size_t k = 0; k < s->map_count && status == IMP_OK; ++k)
        status = include_through_map(s, k, region, model, &unbounded);
    return guarded(mode, status == IMP_OK && unbounded ? IMP_UNBOUNDED : status);
}
