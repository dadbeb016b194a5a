/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { FACTOR, FACTORS, CENTER };

static const imp_parameter parameters[] = {
    [FACTOR] =
        IMP_ROW_NUMBERS("factor", "1", NULL, IMP_PARAMETER_OPTIONAL | IMP_PARAMETER_SCALAR_OK,
                        "constant factor for all directions, or [x,y,z]; 0 flattens, negative "
                        "factors mirror"),
    [FACTORS] =
        IMP_ROW_VECTORS("factors", "1/time^k", NULL, 0, IMP_PARAMETER_OPTIONAL,
                        "instead: coefficients of t^0, t^1, t^2 ... of the factor, each of one "
                        "number or of three"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "the fixed point"),
};

typedef struct scale_instance {
    double center[3];
    polynomial factor; /* of three components */
    double coefficients[];
} scale_instance;

static imp_status check_width(int row, size_t width, imp_create_error *why)
{
    if (width == 1 || width == 3) return IMP_STATUS_OK;
    return imp_reject(why, row, -1,
                      "factors of %zu numbers; must be one for all directions, or three for x, y "
                      "and z",
                      width);
}

static imp_status scale_create(const imp_value *values, void **self, imp_create_error *why)
{
    const bool constant = imp_is_given(&values[FACTOR]);
    const imp_value *given = &values[constant ? FACTOR : FACTORS];
    const size_t count = constant ? 1 : given->extent[0], width = given->extent[!constant];
    imp_status status = check_one_of(values, FACTOR, FACTORS, why, parameters);
    if (status == IMP_STATUS_OK) status = check_width(constant ? FACTOR : FACTORS, width, why);
    if (status != IMP_STATUS_OK) return status;
    scale_instance *s = malloc(sizeof *s + 3 * count * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    imp_copy_vector(s->center, &values[CENTER]);
    s->factor = polynomial_spread(given->number, count, width, 3, s->coefficients);
    *self = s;
    return IMP_STATUS_OK;
}

static void scale_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    const scale_instance *s = self;
    imp_model w[3];
    axis_from_center(s->center, x, y, z, w);
    for (size_t i = 0; i < 3; ++i) out[i] = imp_mul(polynomial_at(&s->factor, i, t), w[i]);
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(scale_formula)
IMP_MAP_AT_ALL_TIMES(scale)

static imp_status scale_write_formula(const void *self, const imp_text_sink *to)
{
    const scale_instance *s = self;
    polynomial_define(&s->factor, 0, "f0", to);
    polynomial_define(&s->factor, 1, "f1", to);
    polynomial_define(&s->factor, 2, "f2", to);
    imp_add_text(to, "center0 + f0*(x - center0); center1 + f1*(y - center1); "
                     "center2 + f2*(z - center2)");
    return IMP_STATUS_OK;
}

static const imp_map_type scale = {
    IMP_MAP_FIELDS(scale, scale_formula),
    .write_formula = scale_write_formula,
    .summary = "scales by one factor or by one per axis; may change in time",
    .equation = "center + factor ((x,y,z) - center), component by component; factor = "
                "sum_k factors_k t^k",
    .source = "Barr, Global and Local Deformations of Solid Primitives, SIGGRAPH 1984",
    .example = "scale factors=[[1],[0.5]]",
};

PUBLISH_MAP(scale);
