/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_SLAB_H
#define TESTS_PLUGINS_SLAB_H

#include <impinge/surface.h>

/* A square that rises: f(u, v, t) = (u, v, height + t) for u, v in [-1, 1]. Every callback is in
 * order; each plugin beside this file takes all but one of them and commits its sin there. */

typedef struct slab {
    double height;
} slab;

static const imp_parameter slab_table[] = {
    {.name = "height",
     .unit = "length",
     .doc = "z at t = 0",
     .default_value = "0",
     .kind = IMP_KIND_NUMBER,
     .min = -INFINITY,
     .max = INFINITY},
};

static slab slab_instances[64];
static int slab_count;

static inline imp_status slab_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    slab *made = &slab_instances[slab_count++ % 64];
    made->height = values[0].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static inline void slab_destroy(void *self) { (void)self; }

static inline void slab_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int k = 0; k < 2; ++k) lo[k] = -1, hi[k] = 1;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

static inline imp_status slab_eval(const void *self, size_t n, const double *p, double *x,
                                   double *error)
{
    const slab *made = self;
    for (size_t k = 0; k < n; ++k) {
        x[3 * k] = p[3 * k];
        x[3 * k + 1] = p[3 * k + 1];
        x[3 * k + 2] = made->height + p[3 * k + 2];
    }
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0x1p-52 * fabs(x[k]);
    return IMP_STATUS_OK;
}

static inline imp_status slab_rate(const void *self, const imp_region *region,
                                   imp_rate_matrix *rates)
{
    (void)self, (void)region;
    for (int k = 0; k < 9; ++k) rates->m[k / 3][k % 3] = k / 3 == k % 3;
    return IMP_STATUS_OK;
}

static inline imp_status slab_include(const void *self, const imp_region *region,
                                      imp_model model[3])
{
    const slab *made = self;
    for (int i = 0; i < 3; ++i) {
        const double by = i == 2 ? made->height : 0;
        const double slack = 0x1p-50 * (fabs(by) + fabs(region->c[i]) + region->d[i]);
        model[i] = (imp_model){.a = by + region->c[i],
                               .e = slack,
                               .lo = by + region->lo[i] - slack,
                               .hi = by + region->hi[i] + slack,
                               .depends = 1u << i};
        model[i].b[i] = region->d[i];
        model[i].rate[i] = 1;
    }
    return IMP_STATUS_OK;
}

/* A type from its callbacks; INCLUDE may be NULL. */
#define SLAB_TYPE(NAME, CREATE, DOMAIN, EVAL, RATE, INCLUDE)                                       \
    {                                                                                              \
        .struct_size = sizeof(imp_surface_type), .parameter_count = 1,                             \
        .parameter_size = sizeof(imp_parameter), .name = (NAME), .summary = "a rising square",     \
        .equation = "(u, v, height + t)", .example = (NAME), .parameters = slab_table,             \
        .create = (CREATE), .destroy = slab_destroy, .domain = (DOMAIN), .eval = (EVAL),           \
        .rate = (RATE), .include = (INCLUDE),                                                      \
    }

#define SLAB_PLUGIN(NAME, TYPE) IMPINGE_SURFACE_PLUGIN(NAME, "1.0", "Apache-2.0", "tests", TYPE)

#endif
