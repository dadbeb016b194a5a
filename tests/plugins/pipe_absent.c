/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* Exists from t = 1/4 to 1/2, and answers for no other time. */
static void domain(const void *self, double lo[3], double hi[3])
{
    pipe_domain(self, lo, hi);
    lo[2] = 0.25, hi[2] = 0.5;
}

static imp_status distance(const void *self, const imp_model point[4], imp_model *g)
{
    if (point[3].lo < 0.25 || point[3].hi > 0.5) return IMP_STATUS_DOMAIN;
    return pipe_gap_distance(self, point, g);
}

static const imp_surface_type pipe_absent = {.struct_size = sizeof(imp_surface_type),
                                             .parameter_size = sizeof(imp_parameter),
                                             .flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES,
                                             .name = "pipe_absent",
                                             .summary = "a pipe, for a while",
                                             .equation = "(cos u, sin u, v), t in [1/4, 1/2]",
                                             .example = "pipe_absent",
                                             .create = tiny_create,
                                             .destroy = tiny_destroy,
                                             .domain = domain,
                                             .eval = pipe_formula_eval,
                                             .rate = pipe_formula_rate,
                                             .include = pipe_formula_include,
                                             .distance = distance};
TINY_PLUGIN("pipe_absent", pipe_absent);
