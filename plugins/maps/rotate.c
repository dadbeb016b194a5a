/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/course.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Rotation about the axis (axis.h) with w = (x,y,z) - center. Its constants are computed once. */

enum { AXIS, CENTER, ANGLE }; /* from ANGLE on: the course of the angle */

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "direction of the axis, any vector but 0; right-handed"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "a point of the axis"),
    [ANGLE + COURSE_RATE] = ROW_TURNING_RATE("constant angular velocity"),
    [ANGLE + COURSE_COEFFICIENTS] = ROW_TURNING_ANGLE,
    [ANGLE + COURSE_TIMES] = COURSE_ROW_TIMES,
    [ANGLE + COURSE_VALUES] =
        IMP_ROW_NUMBERS("angles", "rad", NULL, IMP_PARAMETER_OPTIONAL, "one for each of times"),
    [ANGLE + COURSE_FILE] = COURSE_ROW_FILE,
    [ANGLE + COURSE_COLUMNS] = COURSE_ROW_COLUMNS("column", 1, IMP_PARAMETER_SCALAR_OK,
                                                  "of the file: that of the angle, by name or by "
                                                  "number from 1; default: the second"),
    [ANGLE + COURSE_UNIT] = COURSE_ROW_DEGREES,
    [ANGLE + COURSE_INTERPOLATION] = COURSE_ROW_INTERPOLATION,
    [ANGLE + COURSE_HOLD] = COURSE_ROW_HOLD,
    [ANGLE + COURSE_VELOCITIES] = IMP_ROW_NUMBERS("velocities", "rad/time", NULL,
                                                  IMP_PARAMETER_OPTIONAL, COURSE_DOC_VELOCITIES),
    [ANGLE + COURSE_ACCELERATIONS] = IMP_ROW_NUMBERS(
        "accelerations", "rad/time^2", NULL, IMP_PARAMETER_OPTIONAL, COURSE_DOC_ACCELERATIONS),
};

typedef struct rotate_instance {
    double center[3], direction[3];
    axis_frame axis;
    course angle;
} rotate_instance;

static void set_axis(rotate_instance *s, const imp_value *values)
{
    s->axis = axis_frame_of(values[AXIS].number);
    imp_copy_vector(s->direction, &values[AXIS]);
    imp_copy_vector(s->center, &values[CENTER]);
}

static imp_status rotate_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status != IMP_STATUS_OK) return status;
    rotate_instance *s = malloc(sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    status = course_read(&s->angle, values, ANGLE, UNIT_ANGLE, why, parameters);
    if (status != IMP_STATUS_OK) {
        free(s);
        return status;
    }
    set_axis(s, values);
    *self = s;
    return IMP_STATUS_OK;
}

static imp_status rotate_renew(void *self, const imp_value *values, imp_create_error *why)
{
    rotate_instance *s = self;
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status == IMP_STATUS_OK)
        status = course_renew(&s->angle, values, ANGLE, UNIT_ANGLE, why, parameters);
    if (status == IMP_STATUS_OK) set_axis(s, values);
    return status;
}

static void rotate_destroy(void *self)
{
    rotate_instance *s = self;
    course_clear(&s->angle);
    free(s);
}

static void rotate_time_domain(const void *self, double *lo, double *hi)
{
    const rotate_instance *s = self;
    course_times(&s->angle, lo, hi);
}

static void rotate_span(const void *self, double *lo, double *hi)
{
    const rotate_instance *s = self;
    course_span(&s->angle, lo, hi);
}

static void turned(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                   imp_model out[3])
{
    const rotate_instance *s = self;
    imp_model w[3], angle;
    course_at(&s->angle, 1, t, &angle);
    axis_from_center(s->center, x, y, z, w);
    axis_turn(&s->axis, angle, w, out);
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(turned)

/* Sets the angle at time t. */
static imp_status angle_at(const rotate_instance *s, double t, imp_model *angle)
{
    if (!course_is_defined(&s->angle, t, t)) return IMP_STATUS_DOMAIN;
    course_at(&s->angle, 1, imp_num(t), angle);
    return IMP_STATUS_OK;
}

/* Points of one time share the matrix. p holds x, y, z and t. */
static imp_status rotate_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const rotate_instance *s = self;
    axis_point_matrix matrix;
    double own[3];
    bool by_matrix = false;
    for (size_t k = 0; k < n; ++k, p += 4, x += 3) {
        double *off = error != NULL ? error + 3 * k : own;
        if (k == 0 || p[3] != p[-1]) {
            imp_model angle;
            const imp_status status = angle_at(s, p[3], &angle);
            if (status != IMP_STATUS_OK) return status;
            by_matrix = imp_is_point(&angle) || axis_is_point(&angle);
            if (by_matrix) matrix = axis_matrix_of_points(&s->axis, &angle);
        }
        if (by_matrix && axis_turn_point(&matrix, s->center, p, x, off)) continue;
        const imp_status status = turned_eval(s, 1, p, x, off);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status rotate_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const rotate_instance *s = self;
    const near_constant nowhere[3] = {{0, 0}, {0, 0}, {0, 0}};
    if (!course_is_defined(&s->angle, box->lo[3], box->hi[3])) return IMP_STATUS_DOMAIN;
    imp_model angle;
    course_at(&s->angle, 1, axis_moment(box), &angle);
    return axis_turn_rates(&s->axis, s->center, nowhere, angle, box, rates);
}

static imp_status rotate_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    const rotate_instance *s = self;
    if (!course_is_defined(&s->angle, in[3].lo, in[3].hi)) return IMP_STATUS_DOMAIN;
    return turned_apply(self, in, out);
}

static imp_status rotate_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    const rotate_instance *s = self;
    if (!course_is_defined(&s->angle, t->lo, t->hi)) return IMP_STATUS_DOMAIN;
    imp_model angle;
    course_at(&s->angle, 1, *t, &angle);
    axis_matrix(&s->axis, angle, pose->turn);
    for (int i = 0; i < 3; ++i) {
        pose->shift[i] = imp_num(s->center[i]);
        pose->pivot[i] = s->center[i];
        pose->fixed[i] = s->direction[i];
    }
    return imp_pose_status(pose);
}

static imp_status rotate_write_formula(const void *self, const imp_text_sink *to)
{
    const rotate_instance *s = self;
    course_write(&s->angle, "a", AXIS_TEXT, "A = a0; " AXIS_TURN_TEXT, to);
    return IMP_STATUS_OK;
}

static const imp_map_type rotate = {
    IMP_MAP_FIELDS_OF("rotate", rotate, rotate, rotate_destroy, rotate_rate),
    .flags = IMP_FLAG_TURNS_EXACTLY,
    .rigid = rotate_rigid,
    .span = rotate_span,
    .renew = rotate_renew,
    .write_formula = rotate_write_formula,
    .summary = "turns about an axis, at a constant rate, by a polynomial angle or by a table",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = rate t, sum_k angle_k t^k, or the "
                "table's value at t (between its times a line, or a spline): center + k (k.w) + "
                "cos A (w - k (k.w)) + sin A (k x w); to turn a part once and for all: "
                "axis=0,1,0 angle=1.5707963267948966",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.5",
    .example = "rotate axis=0,0,1 rate=2",
};

PUBLISH_MAP(rotate);
