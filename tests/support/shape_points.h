/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SHAPE_POINTS_H
#define TESTS_SUPPORT_SHAPE_POINTS_H

#include "core/surface/region.h"
#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/query_helpers.h"

/* Instances of our types, their points and their models. */

static imp_registry *registry;

static inline instance shape(const char *type, const char *parameters)
{
    uint64_t random = suite_seed();
    if (registry == NULL) registry = built_registry();
    return instance_make(registry, type, parameters, &random);
}

static inline void point_of(const instance *made, double u, double v, double t, double x[3])
{
    const double p[3] = {u, v, t};
    ck_assert_int_eq(made->surface->eval(made->self, 1, p, x, NULL), IMP_STATUS_OK);
}

static inline void models_of(const instance *made, const double lo[3], const double hi[3],
                             imp_model model[3])
{
    const imp_region region = region_make(lo, hi);
    ck_assert_int_eq(made->surface->include(made->self, &region, model), IMP_STATUS_OK);
}

/* G. Farin, B. Piper, A. Worsey, The octant of a sphere as a non-degenerate triangular Bezier
 * patch, 1987. As JSON, or as a pipeline. */
static inline const char *octant_text(bool as_pipeline)
{
    static char text[1200];
    const double a = (sqrt(3) - 1) / sqrt(3), b = (sqrt(3) + 1) / (2 * sqrt(3));
    const double c = 1 - (5 - sqrt(2)) * (7 - sqrt(3)) / 46;
    const double far = 4 * sqrt(3) * (sqrt(3) - 1), near = 3 * sqrt(2);
    const double inner = sqrt(2. / 3) * (3 + 2 * sqrt(2) - sqrt(3));
    const double p[15][4] = {{0, 0, 1, far},   {a, 0, 1, near}, {0, a, 1, near}, {b, 0, b, 4},
                             {c, c, 1, inner}, {0, b, b, 4},    {1, 0, a, near}, {1, c, c, inner},
                             {c, 1, c, inner}, {0, 1, a, near}, {1, 0, 0, far},  {1, a, 0, near},
                             {b, b, 0, 4},     {a, 1, 0, near}, {0, 1, 0, far}};
    FILE *out = fmemopen(text, sizeof text, "w");
    fputs(as_pipeline ? "bezier-triangle degree=4 points=[" : "{\"degree\": 4, \"points\": [", out);
    for (int k = 0; k < 15; ++k)
        fprintf(out, "%s[%.17g,%.17g,%.17g]", k > 0 ? "," : "", p[k][0], p[k][1], p[k][2]);
    fputs(as_pipeline ? "] weights=[" : "], \"weights\": [", out);
    for (int k = 0; k < 15; ++k) fprintf(out, "%s%.17g", k > 0 ? "," : "", p[k][3]);
    fputs(as_pipeline ? "]" : "]}", out);
    ck_assert_int_eq(fclose(out), 0);
    return text;
}

#endif
