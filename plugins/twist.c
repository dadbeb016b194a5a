/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "axis.h"
#include "plugin.h"
#include "polynomial.h"

#include <impinge/formula.h>

enum { AXIS, CENTER, RATE };

static const imp_parameter parameters[] = {
    [AXIS] =
        ROW_AXIS("axis", "[0,0,1]", "direction of the axis, of any length but 0; right-handed"),
    [CENTER] =
        ROW_VECTOR("center", "length", "[0,0,0]", 0, "point of the axis that stays unturned"),
    [RATE] = ROW_IN_TIME("rate", "rad/length", "1", "angle per length along the axis"),
};

typedef struct twist_instance {
    double center[3];
    axis_frame axis;
    polynomial rate;
    double coefficients[];
} twist_instance;

static imp_status twist_create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check_axis(AXIS, values[AXIS].number, why);
    if (status != IMP_OK) return status;
    twist_instance *s = malloc(sizeof *s + values[RATE].count * sizeof(double));
    if (!s) return IMP_INTERNAL;
    s->axis = axis_frame_of(values[AXIS].number);
    copy_vector(s->center, &values[CENTER]);
    s->rate = polynomial_copy(&values[RATE], 1, s->coefficients);
    *self = s;
    return IMP_OK;
}

static void twist_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    const twist_instance *s = self;
    imp_model w[3];
    from_center(s->center, x, y, z, w);
    imp_model angle = imp_mul(polynomial_at(&s->rate, 0, t), near_dot(s->axis.unit, w));
    axis_turn(&s->axis, angle, w, out);
    add_center(s->center, out);
}
IMP_MAP_FORMULA(twist_formula)
MAP_AT_ALL_TIMES(twist)

static const imp_map_type twist = {
    MAP_CALLS(twist, twist_formula),
    .rate = twist_formula_rate,
    .summary = "turns about an axis, the farther along it the more; may change in time",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate (k.w), rate a polynomial in t: "
                "center + k (k.w) + cos A (w - k (k.w)) + sin A (k x w)",
    .source = "Barr, Global and Local Deformations of Solid Primitives, SIGGRAPH 1984",
    .example = "twist axis=0,0,1 rate=0.5",
};

PUBLISH_MAP(twist);
