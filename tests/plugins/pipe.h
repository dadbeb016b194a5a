/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_PIPE_H
#define TESTS_PLUGINS_PIPE_H

#include "liar.h"

/* A cylinder of radius 1, (cos u, sin u, v), v in [0, 2], and distances from it: for plugins beside
 * this file to lie about. */

static inline void pipe_domain(const void *self, double lo[3], double hi[3])
{
    tiny_domain(self, lo, hi);
    lo[0] = lo[1] = 0, hi[0] = IMP_TWO_PI_UPPER, hi[1] = 2;
}

static inline void pipe_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    (void)self, (void)t;
    imp_sincos(u, &out[1], &out[0]);
    out[2] = v;
}
IMP_SURFACE_FORMULA(pipe_formula)

static inline imp_model pipe_gap(const void *self, imp_model x, imp_model y, imp_model z,
                                 imp_model t)
{
    (void)self, (void)z, (void)t;
    return imp_shift(imp_sqrt(imp_add(imp_sqr(x), imp_sqr(y))), -1);
}
IMP_DISTANCE_FORMULA(pipe_gap)

/* Truthful but for its distances or its symmetry, perhaps. */
#define PIPE_TYPE(NAME, DISTANCE, SYMMETRY)                                                        \
    {                                                                                              \
        .struct_size = sizeof(imp_surface_type), .parameter_size = sizeof(imp_parameter),          \
        .name = NAME, .summary = "a liar", .equation = "(cos u, sin u, v)", .example = NAME,       \
        .create = tiny_create, .destroy = tiny_destroy, .domain = pipe_domain,                     \
        .eval = pipe_formula_eval, .rate = pipe_formula_rate, .include = pipe_formula_include,     \
        .distance = DISTANCE, .symmetry = SYMMETRY,                                                \
    }
#define LIAR_PIPE(NAME, DISTANCE, SYMMETRY)                                                        \
    static const imp_surface_type liar_type = PIPE_TYPE(NAME, DISTANCE, SYMMETRY);                 \
    TINY_PLUGIN(NAME, liar_type)
#define LIAR_TUBE(NAME, TUBE)                                                                      \
    static const imp_surface_type liar_type = {                                                    \
        .struct_size = sizeof(imp_surface_type),                                                   \
        .parameter_size = sizeof(imp_parameter),                                                   \
        .name = NAME,                                                                              \
        .summary = "a liar",                                                                       \
        .equation = "(cos u, sin u, v)",                                                           \
        .example = NAME,                                                                           \
        .create = tiny_create,                                                                     \
        .destroy = tiny_destroy,                                                                   \
        .domain = pipe_domain,                                                                     \
        .eval = pipe_formula_eval,                                                                 \
        .rate = pipe_formula_rate,                                                                 \
        .include = pipe_formula_include,                                                           \
        .tube = TUBE,                                                                              \
    };                                                                                             \
    TINY_PLUGIN(NAME, liar_type)
#define LIAR_DISTANCE(NAME, DISTANCE) LIAR_PIPE(NAME, DISTANCE, NULL)
#define LIAR_SYMMETRY(NAME, SYMMETRY) LIAR_PIPE(NAME, pipe_gap_distance, SYMMETRY)

#endif
