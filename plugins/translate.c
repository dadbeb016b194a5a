/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugin.h"
#include "polynomial.h"

#include <impinge/formula.h>

enum { VELOCITY, OFFSET };

static const imp_parameter parameters[] = {
    [VELOCITY] = ROW_VECTOR("velocity", "length/time", NULL, IMP_OPTIONAL, "constant velocity"),
    [OFFSET] = ROW_VECTORS("offset", "length/time^k", NULL, 3, IMP_OPTIONAL,
                           "instead: coefficients [x,y,z] of t^0, t^1, t^2 ... of the way"),
};

typedef struct translate_instance {
    polynomial way;
    double coefficients[];
} translate_instance;

static imp_status translate_create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check_one_of(values, VELOCITY, OFFSET, why, parameters);
    if (status != IMP_OK) return status;
    size_t numbers = 3 * polynomial_count(&values[VELOCITY], &values[OFFSET]);
    translate_instance *s = malloc(sizeof *s + numbers * sizeof(double));
    if (!s) return IMP_INTERNAL;
    s->way = polynomial_read(&values[VELOCITY], &values[OFFSET], 3, s->coefficients);
    *self = s;
    return IMP_OK;
}

static void translate_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                              imp_model out[3])
{
    const translate_instance *s = self;
    out[0] = imp_add(x, polynomial_at(&s->way, 0, t));
    out[1] = imp_add(y, polynomial_at(&s->way, 1, t));
    out[2] = imp_add(z, polynomial_at(&s->way, 2, t));
}
IMP_MAP_FORMULA(translate_formula)
MAP_AT_ALL_TIMES(translate)

static const imp_map_type translate = {
    MAP_CALLS(translate, translate_formula),
    .rate = translate_formula_rate,
    .summary = "moves along a straight line, or along a polynomial in time",
    .equation = "(x,y,z) + velocity t, or (x,y,z) + sum_k offset_k t^k",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.4",
    .example = "translate velocity=1,0,0",
};

PUBLISH_MAP(translate);
