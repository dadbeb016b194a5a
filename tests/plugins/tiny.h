/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_TINY_H
#define TESTS_PLUGINS_TINY_H

#include <impinge/surface.h>

/* The smallest legal surface: one point that stays at the origin. Each plugin beside this
 * file takes it and commits one sin. */

static int tiny_self;

static inline imp_status tiny_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = &tiny_self;
    return IMP_STATUS_OK;
}

static inline void tiny_destroy(void *self) { (void)self; }

static inline void tiny_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int k = 0; k < 2; ++k) lo[k] = 0, hi[k] = 1;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

static inline imp_status tiny_eval(const void *self, size_t n, const double *p, double *x,
                                   double *error)
{
    (void)self, (void)p;
    for (size_t k = 0; k < 3 * n; ++k) x[k] = 0;
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0;
    return IMP_STATUS_OK;
}

static inline imp_status tiny_rate(const void *self, const imp_region *region,
                                   imp_rate_matrix *rates)
{
    (void)self, (void)region;
    for (int k = 0; k < 9; ++k) rates->m[k / 3][k % 3] = 0;
    return IMP_STATUS_OK;
}

/* A type from its callbacks and, if COUNT > 0, its parameter table. */
#define TINY_TYPE(NAME, CREATE, EVAL, COUNT, TABLE)                                                \
    {                                                                                              \
        .struct_size = sizeof(imp_surface_type), .parameter_count = (COUNT),                       \
        .parameter_size = sizeof(imp_parameter), .name = (NAME), .summary = "a point",             \
        .equation = "(0, 0, 0)", .example = (NAME), .parameters = (TABLE), .create = (CREATE),     \
        .destroy = tiny_destroy, .domain = tiny_domain, .eval = (EVAL), .rate = tiny_rate,         \
    }

#define TINY_PLUGIN(NAME, TYPE) IMPINGE_SURFACE_PLUGIN(NAME, "1.0", "Apache-2.0", "tests", TYPE)

#endif
