/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/curve.h"

#include "plugins/patch/patch_include.h"

#include <string.h>

imp_status curve_check(const imp_value *values, int points, int weights, imp_create_error *why)
{
    const size_t count = values[points].extent[0];
    if (count < 2 || count > PATCH_SIDE_MAX)
        return imp_reject(why, points, -1, "got %zu control points, must be 2 to %d", count,
                          PATCH_SIDE_MAX);
    if (imp_is_given(&values[weights]) && values[weights].extent[0] != count)
        return imp_reject(why, weights, -1, "got %zu weights for %zu control points",
                          values[weights].extent[0], count);
    return IMP_STATUS_OK;
}

patch *curve_new(const imp_value *points, const imp_value *weights)
{
    const size_t count = points->extent[0], width = points->extent[1];
    double place[3 * PATCH_SIDE_MAX] = {0};
    for (size_t k = 0; k < count; ++k)
        memcpy(place + 3 * k, points->number + width * k, width * sizeof place[0]);
    const patch_data data = {.degree = {(int)count - 1, 0},
                             .points = place,
                             .weights = imp_is_given(weights) ? weights->number : NULL};
    return patch_new(&data);
}

static void curve_at_number(const patch *f, double s, imp_model out[3])
{
    const double p[3] = {s, 0, 0};
    double x[3], error[3];
    patch_point(f, p, x, error);
    for (int i = 0; i < 3; ++i) out[i] = imp_known(x[i], error[i]);
}

/* Writes the model with u in the place of parameter j. */
static imp_model curve_of_parameter(const imp_model *x, int j)
{
    static const int square[3] = {IMP_UU, IMP_VV, IMP_TT};
    imp_model r = {.a = x->a, .e = x->e, .lo = x->lo, .hi = x->hi, .depends = 1u << j};
    r.b[j] = x->b[0];
    r.q[square[j]] = x->q[IMP_UU];
    r.rate[j] = x->rate[0];
    return r;
}

void curve_at(const patch *f, imp_model s, int j, imp_model out[3])
{
    const imp_region region = {{s.lo, 0, 0}, {s.hi, 0, 0}, {s.a, 0, 0}, {s.b[j], 0, 0}};
    if (!s.depends) {
        curve_at_number(f, s.a, out);
        return;
    }
    imp_model x[3];
    imp_status status = patch_include(f, &region, x);
    for (int i = 0; i < 3; ++i)
        out[i] = status == IMP_STATUS_OK ? curve_of_parameter(&x[i], j) : imp_unbounded(1u << j);
}
