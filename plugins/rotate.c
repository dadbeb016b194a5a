/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "axis.h"
#include "plugin.h"
#include "polynomial.h"

#include <impinge/formula.h>

/* Turning about the axis (axis.h) with w = (x,y,z) - center: its constants are made once. */

enum { AXIS, CENTER, RATE, ANGLE };

static const imp_parameter parameters[] = {
    [AXIS] =
        ROW_AXIS("axis", "[0,0,1]", "direction of the axis, of any length but 0; right-handed"),
    [CENTER] = ROW_VECTOR("center", "length", "[0,0,0]", 0, "a point of the axis"),
    [RATE] = ROW_TURNING_RATE("constant angular velocity"),
    [ANGLE] = ROW_TURNING_ANGLE,
};

typedef struct rotate_instance {
    double center[3];
    axis_frame axis;
    polynomial angle;
    double coefficients[];
} rotate_instance;

static imp_status rotate_create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check_axis(AXIS, values[AXIS].number, why);
    if (status == IMP_OK) status = check_one_of(values, RATE, ANGLE, why, parameters);
    if (status != IMP_OK) return status;
    size_t numbers = polynomial_count(&values[RATE], &values[ANGLE]);
    rotate_instance *s = malloc(sizeof *s + numbers * sizeof(double));
    if (!s) return IMP_INTERNAL;
    s->axis = axis_frame_of(values[AXIS].number);
    copy_vector(s->center, &values[CENTER]);
    s->angle = polynomial_read(&values[RATE], &values[ANGLE], 1, s->coefficients);
    *self = s;
    return IMP_OK;
}

static void rotate_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                           imp_model out[3])
{
    const rotate_instance *s = self;
    imp_model w[3];
    from_center(s->center, x, y, z, w);
    axis_turn(&s->axis, polynomial_at(&s->angle, 0, t), w, out);
    add_center(s->center, out);
}
IMP_MAP_FORMULA(rotate_formula)
MAP_AT_ALL_TIMES(rotate)

static imp_status rotate_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const rotate_instance *s = self;
    const near_constant nowhere[3] = {{0, 0}, {0, 0}, {0, 0}};
    imp_model angle = polynomial_at(&s->angle, 0, moment_of(box));
    return axis_turn_rates(&s->axis, s->center, nowhere, angle, box, rates);
}

static const imp_map_type rotate = {
    MAP_CALLS(rotate, rotate_formula),
    .rate = rotate_rate,
    .summary = "turns about an axis, at a constant rate or by a polynomial angle",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate t or sum_k angle_k t^k: center + "
                "k (k.w) + cos A (w - k (k.w)) + sin A (k x w)",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.5",
    .example = "rotate axis=0,0,1 rate=2",
};

PUBLISH_MAP(rotate);
