/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { AXIS, CENTER, RATE };

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "direction of the axis, any vector but 0; right-handed"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "point of the axis with angle 0"),
    [RATE] = ROW_IN_TIME("rate", "rad/length", "1", "angle per length along the axis"),
};

typedef struct twist_instance {
    double center[3];
    axis_frame axis;
    polynomial rate;
    double coefficients[];
} twist_instance;

static imp_status twist_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status != IMP_STATUS_OK) return status;
    twist_instance *s = malloc(sizeof *s + values[RATE].count * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->axis = axis_frame_of(values[AXIS].number);
    imp_copy_vector(s->center, &values[CENTER]);
    s->rate = polynomial_copy(&values[RATE], 1, s->coefficients);
    *self = s;
    return IMP_STATUS_OK;
}

static void twist_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    const twist_instance *s = self;
    imp_model w[3];
    axis_from_center(s->center, x, y, z, w);
    imp_model angle = imp_mul(polynomial_at(&s->rate, 0, t), axis_dot(s->axis.unit, w));
    axis_turn(&s->axis, angle, w, out);
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(twist_formula)
IMP_MAP_AT_ALL_TIMES(twist)

static imp_status twist_write_formula(const void *self, const imp_text_sink *to)
{
    const twist_instance *s = self;
    imp_add_text(to, AXIS_TEXT);
    polynomial_define(&s->rate, 0, "r", to);
    imp_add_text(to, "A = r*d; " AXIS_TURN_TEXT);
    return IMP_STATUS_OK;
}

static const imp_map_type twist = {
    IMP_MAP_FIELDS(twist, twist_formula),
    .write_formula = twist_write_formula,
    .summary = "turns about an axis, in proportion to the distance along it; may change in time",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate (k.w), rate a polynomial in t: "
                "center + k (k.w) + cos A (w - k (k.w)) + sin A (k x w)",
    .source = "Barr, Global and Local Deformations of Solid Primitives, SIGGRAPH 1984",
    .example = "twist axis=0,0,1 rate=0.5",
};

PUBLISH_MAP(twist);
