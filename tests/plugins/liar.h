/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_LIAR_H
#define TESTS_PLUGINS_LIAR_H

#include <impinge/formula.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "tiny.h"

/* A truthful surface, and a truthful map, for each plugin beside this file to tell one lie about:
 *
 *   (u, cos 3u sin 2v, v + sin(u + 2t)),   u, v in [0, 4]
 *   (x + sin 2y, y, z cos t)
 *
 * Each coordinate is a product or a function of one sum, so that its rates over tiny regions are as
 * good as exact: nothing that is low by a percent is covered by slack. */

static inline void wavy_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    (void)self;
    out[0] = u;
    out[1] = imp_mul(imp_cos(imp_scale(u, 3)), imp_sin(imp_scale(v, 2)));
    out[2] = imp_add(v, imp_sin(imp_add(u, imp_scale(t, 2))));
}
IMP_SURFACE_FORMULA(wavy_formula)

static inline void wavy_domain(const void *self, double lo[3], double hi[3])
{
    tiny_domain(self, lo, hi);
    hi[0] = hi[1] = 4;
}

static inline void skew_formula(const void *self, imp_model x, imp_model y, imp_model z,
                                imp_model t, imp_model out[3])
{
    (void)self;
    out[0] = imp_add(x, imp_sin(imp_scale(y, 2)));
    out[1] = y;
    out[2] = imp_mul(z, imp_cos(t));
}
IMP_MAP_FORMULA(skew_formula)

static inline void liar_times(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

/* Plugins called NAME with one type, so called too. */
#define LIAR_TYPE(NAME, CREATE, DESTROY, EVAL, RATE, INCLUDE, NET)                                 \
    static const imp_surface_type liar_type = {.struct_size = sizeof(imp_surface_type),            \
                                               .parameter_size = sizeof(imp_parameter),            \
                                               .name = NAME,                                       \
                                               .summary = "a liar",                                \
                                               .equation = "(u, cos 3u sin 2v, v + sin(u + 2t))",  \
                                               .example = NAME,                                    \
                                               .create = CREATE,                                   \
                                               .destroy = DESTROY,                                 \
                                               .domain = wavy_domain,                              \
                                               .eval = EVAL,                                       \
                                               .rate = RATE,                                       \
                                               .include = INCLUDE,                                 \
                                               .net = NET};                                        \
    TINY_PLUGIN(NAME, liar_type)

#define LIAR_SURFACE(NAME, CREATE, DESTROY, EVAL, RATE, INCLUDE)                                   \
    LIAR_TYPE(NAME, CREATE, DESTROY, EVAL, RATE, INCLUDE, NULL)

#define LIAR_MAP(NAME, EVAL, RATE, APPLY)                                                          \
    static const imp_map_type liar_type = {.struct_size = sizeof(imp_map_type),                    \
                                           .parameter_size = sizeof(imp_parameter),                \
                                           .name = NAME,                                           \
                                           .summary = "a liar",                                    \
                                           .equation = "(x + sin 2y, y, z cos t)",                 \
                                           .example = NAME,                                        \
                                           .create = tiny_create,                                  \
                                           .destroy = tiny_destroy,                                \
                                           .time_domain = liar_times,                              \
                                           .eval = EVAL,                                           \
                                           .rate = RATE,                                           \
                                           .apply = APPLY};                                        \
    IMPINGE_MAP_PLUGIN(NAME, "1.0", "Apache-2.0", "tests", liar_type)

/* Truthful but for the one named. */
#define LIAR_EVAL(NAME, EVAL)                                                                      \
    LIAR_SURFACE(NAME, tiny_create, tiny_destroy, EVAL, wavy_formula_rate, wavy_formula_include)
#define LIAR_RATE(NAME, RATE)                                                                      \
    LIAR_SURFACE(NAME, tiny_create, tiny_destroy, wavy_formula_eval, RATE, NULL)
#define LIAR_INCLUDE(NAME, INCLUDE)                                                                \
    LIAR_SURFACE(NAME, tiny_create, tiny_destroy, wavy_formula_eval, wavy_formula_rate, INCLUDE)

/* --- Rates taken from points of a region instead of all of it --------------------------------- */

/* The largest rates at n x n x n points, spread from end to end. */
static inline imp_status rate_of_grid(const void *self, const imp_region *region, int n,
                                      imp_rate_matrix *rates)
{
    memset(rates, 0, sizeof *rates);
    for (int k = 0; k < n * n * n; ++k) {
        const int at[3] = {k % n, k / n % n, k / n / n};
        double p[3];
        imp_rate_matrix here;
        for (int j = 0; j < 3; ++j)
            p[j] = at[j] == n - 1
                       ? region->hi[j]
                       : region->lo[j] + (region->hi[j] - region->lo[j]) * at[j] / (n - 1);
        const imp_region point = imp_region_between(p, p);
        const imp_status status = wavy_formula_rate(self, &point, &here);
        if (status != IMP_STATUS_OK) return status;
        for (int i = 0; i < 9; ++i)
            if (here.m[i / 3][i % 3] > rates->m[i / 3][i % 3])
                rates->m[i / 3][i % 3] = here.m[i / 3][i % 3];
    }
    return IMP_STATUS_OK;
}

/* The truth, times `factor` in the square of this side at (1.3, 2.1); the domain's side is 4. */
static inline imp_status rate_low_in_square(const void *self, const imp_region *region, double side,
                                            double factor, imp_rate_matrix *rates)
{
    const imp_status status = wavy_formula_rate(self, region, rates);
    const bool inside = region->lo[0] >= 1.3 && region->hi[0] <= 1.3 + side &&
                        region->lo[1] >= 2.1 && region->hi[1] <= 2.1 + side;
    for (int i = 0; inside && i < 9; ++i) rates->m[i / 3][i % 3] *= factor;
    return status;
}

#endif
