/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_CURVE_H
#define PLUGINS_CURVE_H

#include "patch_include.h"
#include "plugin.h"

#include <impinge/model.h>

/* Bezier curves, polynomial or rational, in the plane or in space
 * ===============================================================
 * A curve is a patch of degrees n and 0 (patch.h). It is used inside a formula: curve_at answers
 * the models of its coordinates for a parameter of the region, or for a number. */

#define ROW_CURVE(NAME, UNIT, PRESET, WIDTH, DOC)                                                  \
    {                                                                                              \
        .name = NAME, .unit = UNIT, .preset = PRESET, .doc = DOC, .kind = IMP_NUMBER, .rank = 2,   \
        .extent = {0, WIDTH}, .min = -PATCH_FAR, .max = PATCH_FAR                                  \
    }
#define ROW_CURVE_WEIGHTS(NAME, CURVE)                                                             \
    {                                                                                              \
        .name = NAME, .unit = "1",                                                                 \
        .doc = "one per point of " CURVE ", for a rational curve; left "                           \
               "out: all 1",                                                                       \
        .kind = IMP_NUMBER, .flags = IMP_OPTIONAL, .rank = 1, .min = 1 / PATCH_HEAVY,              \
        .max = PATCH_HEAVY                                                                         \
    }

/* From 2 control points on, and as many weights, if any. */
static inline imp_status curve_check(const imp_value *values, int points, int weights,
                                     imp_complaint *why)
{
    const size_t count = values[points].extent[0];
    if (count < 2 || count > PATCH_SIDE_MAX)
        return complain(why, points, -1, "found %zu control points, allowed 2 to %d", count,
                        PATCH_SIDE_MAX);
    if (is_given(&values[weights]) && values[weights].extent[0] != count)
        return complain(why, weights, -1, "found %zu weights for %zu control points",
                        values[weights].extent[0], count);
    return IMP_OK;
}

/* A curve of checked values; in the plane, the third coordinate is 0. NULL: no memory. free() it.
 */
static inline patch *curve_new(const imp_value *points, const imp_value *weights)
{
    const size_t count = points->extent[0], width = points->extent[1];
    double place[3 * PATCH_SIDE_MAX] = {0};
    for (size_t k = 0; k < count; ++k)
        memcpy(place + 3 * k, points->number + width * k, width * sizeof place[0]);
    const patch_data data = {.degree = {(int)count - 1, 0},
                             .points = place,
                             .weights = is_given(weights) ? weights->number : NULL};
    return patch_new(&data);
}

static inline void curve_at_number(const patch *f, double s, imp_model out[3])
{
    const double p[3] = {s, 0, 0};
    double x[3], error[3];
    patch_point(f, p, x, error);
    for (int i = 0; i < 3; ++i) out[i] = imp_known(x[i], error[i]);
}

/* The same model with u in the place of parameter j. */
static inline imp_model curve_of_parameter(const imp_model *x, int j)
{
    static const int square[3] = {IMP_UU, IMP_VV, IMP_TT};
    imp_model r = {.a = x->a, .e = x->e, .lo = x->lo, .hi = x->hi, .depends = 1u << j};
    r.b[j] = x->b[0];
    r.q[square[j]] = x->q[IMP_UU];
    r.rate[j] = x->rate[0];
    return r;
}

/* s is an exact number, or u (j = 0) or v (j = 1) over a region: within [0, 1]. */
static inline void curve_at(const patch *f, imp_model s, int j, imp_model out[3])
{
    const imp_region region = {{s.lo, 0, 0}, {s.hi, 0, 0}, {s.a, 0, 0}, {s.b[j], 0, 0}};
    if (!s.depends) {
        curve_at_number(f, s.a, out);
        return;
    }
    imp_model x[3];
    imp_status status = patch_include(f, &region, x);
    for (int i = 0; i < 3; ++i)
        out[i] = status == IMP_OK ? curve_of_parameter(&x[i], j) : imp_unbounded(1u << j);
}

#endif
