/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { AXIS, CENTER, PITCH, RATE, ANGLE };

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "direction of the axis, any vector but 0; right-handed"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "a point of the axis"),
    [PITCH] = IMP_ROW_NUMBER("pitch", "length/turn", "1",
                             "distance along the axis per full turn; negative: against the axis"),
    [RATE] = ROW_TURNING_RATE("constant angular velocity"),
    [ANGLE] = ROW_TURNING_ANGLE,
};

typedef struct screw_instance {
    double center[3], direction[3];
    axis_frame axis;
    near_constant advance[3]; /* per radian */
    polynomial angle;
    double coefficients[];
} screw_instance;

/* pitch / (2 pi) times the unit vector of the axis. */
static void set_advance(screw_instance *s, double pitch, const double axis[3])
{
    imp_model k[3], two_pi = imp_scale(imp_const_pi(), 2);
    imp_model per_radian = imp_div(imp_num(pitch), two_pi);
    axis_unit_of(axis, k);
    for (int i = 0; i < 3; ++i) s->advance[i] = near_of(imp_mul(per_radian, k[i]));
}

static imp_status screw_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status == IMP_STATUS_OK) status = check_one_of(values, RATE, ANGLE, why, parameters);
    if (status != IMP_STATUS_OK) return status;
    size_t numbers = polynomial_count(&values[RATE], &values[ANGLE]);
    screw_instance *s = malloc(sizeof *s + numbers * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->axis = axis_frame_of(values[AXIS].number);
    imp_copy_vector(s->direction, &values[AXIS]);
    set_advance(s, values[PITCH].number[0], values[AXIS].number);
    imp_copy_vector(s->center, &values[CENTER]);
    s->angle = polynomial_read(&values[RATE], &values[ANGLE], 1, s->coefficients);
    *self = s;
    return IMP_STATUS_OK;
}

static void screw_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    const screw_instance *s = self;
    imp_model w[3], angle = polynomial_at(&s->angle, 0, t);
    axis_from_center(s->center, x, y, z, w);
    axis_turn(&s->axis, angle, w, out);
    for (int i = 0; i < 3; ++i) out[i] = imp_add(out[i], near_scale(angle, s->advance[i]));
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(screw_formula)
IMP_MAP_AT_ALL_TIMES(screw)

static imp_status screw_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const screw_instance *s = self;
    imp_model angle = polynomial_at(&s->angle, 0, axis_moment(box));
    return axis_turn_rates(&s->axis, s->center, s->advance, angle, box, rates);
}

static imp_status screw_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    const screw_instance *s = self;
    const imp_model angle = polynomial_at(&s->angle, 0, *t);
    axis_matrix(&s->axis, angle, pose->turn);
    for (int i = 0; i < 3; ++i) {
        pose->shift[i] = imp_shift(near_scale(angle, s->advance[i]), s->center[i]);
        pose->pivot[i] = s->center[i];
        pose->fixed[i] = s->direction[i];
    }
    return imp_pose_status(pose);
}

static imp_status screw_write_formula(const void *self, const imp_text_sink *to)
{
    const screw_instance *s = self;
    imp_add_text(to, AXIS_TEXT);
    polynomial_define(&s->angle, 0, "A", to);
    imp_add_text(to, "c = cos(A); s = sin(A); p = d + pitch*A/(2*pi); "
                     "center0 + k0*p + c*(w0 - k0*d) + s*(k1*w2 - k2*w1); "
                     "center1 + k1*p + c*(w1 - k1*d) + s*(k2*w0 - k0*w2); "
                     "center2 + k2*p + c*(w2 - k2*d) + s*(k0*w1 - k1*w0)");
    return IMP_STATUS_OK;
}

static const imp_map_type screw = {
    IMP_MAP_FIELDS_OF("screw", screw, screw_formula, free, screw_rate),
    .flags = IMP_FLAG_TURNS_EXACTLY,
    .rigid = screw_rigid,
    .write_formula = screw_write_formula,
    .summary = "turns about an axis and moves along it in proportion to the angle",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate t or sum_k angle_k t^k: center + "
                "k (k.w + pitch A / 2pi) + cos A (w - k (k.w)) + sin A (k x w)",
    .source = "Ball, A Treatise on the Theory of Screws, 1900",
    .example = "screw axis=0,0,1 pitch=0.5 rate=6",
};

PUBLISH_MAP(screw);
