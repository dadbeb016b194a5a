/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/publish.h"
#include "plugins/expression/motion_text.h"
#include "plugins/expression/type.h"

#include <impinge/formula.h>
#include <string.h>

/* Rigid motion by formulas in t
 * =============================
 * With k the axis' unit vector, c the center, A(t) the angle and f(t) the offset,
 *
 *   x  ->  c + R (x - c) + f,   R = k k^T + cos A (1 - k k^T) + sin A k x.
 *
 * Lemma (rigid). R is the rotation about k by A, whatever number A(t) is, and no text names a
 * coordinate. So the map is rigid at each time at which its texts are defined, in exact arithmetic:
 * IMP_FLAG_TURNS_EXACTLY.
 *
 * Lemma (pose). Over a span of times, expression_models encloses A and f by models of t; entries of
 * R are those of axis_matrix for the model of A, which depends on t alone, as the texts know no
 * other variable. c + f is imp_shift of the models of f. A text that is undefined, or without a
 * finite bound over the span, has a model whose error is infinite: the pose is unbounded there. */

enum { OFFSET, ANGLE, AXIS, CENTER, OWN_CONSTANTS, OWN_TIME };

static const imp_parameter parameters[] = {
    [OFFSET] =
        IMP_ROW_OF(IMP_KIND_STRING, "offset", "length", "[\"0\",\"0\",\"0\"]", 0, 1, 3, 0,
                   -INFINITY, INFINITY, "the displacement's x, y and z as formulas in t, texts"),
    [ANGLE] = IMP_ROW_OF(IMP_KIND_STRING, "angle", "rad", NULL, IMP_PARAMETER_OPTIONAL, 0, 0, 0,
                         -INFINITY, INFINITY,
                         "the angle of the turn about the axis, before the displacement, as a "
                         "formula in t; default: it does not turn"),
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "direction of the axis, any vector but 0; right-handed"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "a point of the axis"),
    [OWN_CONSTANTS] = ROW_CONSTANTS("offset and angle"),
    [OWN_TIME] = ROW_MAP_TIME,
};

typedef struct motion_instance {
    expression_program *offset, *angle; /* the angle three times; NULL: it does not turn */
    double center[3], direction[3];
    axis_frame axis;
    char *text;    /* what it prints */
    double lo, hi; /* times */
} motion_instance;

/* --- Text ------------------------------------------------------------------------------------- */

static void write_motion(const printed_values *p, const imp_text_sink *to)
{
    const imp_value *values = p->values;
    const motion_text text = {
        .constants = &values[OWN_CONSTANTS],
        .lo = *p->lo,
        .hi = *p->hi,
        .offset = values[OFFSET].string,
        .angle = imp_is_given(&values[ANGLE]) ? values[ANGLE].string[0] : NULL,
        .axis = values[AXIS].number,
        .center = values[CENTER].number,
    };
    motion_text_write(&text, to);
}

static imp_status motion_write_formula(const void *self, const imp_text_sink *to)
{
    imp_add_text(to, ((const motion_instance *)self)->text);
    return IMP_STATUS_OK;
}

/* --- Instances -------------------------------------------------------------------------------- */

/* Compiles the three texts of a row, or the one of the angle. */
static imp_status compile(const imp_value *values, int row, const motion_instance *s,
                          expression_program **program, imp_create_error *why)
{
    static const char *const names[] = {"t"};
    const imp_model whole = whole_range(s->lo, s->hi, 2);
    const char *const *given = values[row].string;
    const size_t last = values[row].count - 1;
    const char *const text[3] = {given[0], given[last > 0], given[last]};
    expression_scope scope = {.variable = names, .whole = &whole, .variable_count = 1};
    expression_error error;
    use_constants(&values[OWN_CONSTANTS], &scope);
    const imp_status status = expression_compile(&scope, text, program, &error);
    if (status != IMP_STATUS_PARAMETER) return status;
    if (error.at == EXPRESSION_AT_CONSTANTS)
        return imp_reject(why, OWN_CONSTANTS, -1, "%s", error.message);
    return imp_reject(why, row, row == OFFSET && error.at < 3 ? error.at : -1, "%s", error.message);
}

static void motion_destroy(void *self)
{
    motion_instance *s = self;
    expression_free(s->offset);
    expression_free(s->angle);
    free(s->text);
    free(s);
}

/* The texts know only t, but x, y and z are variables of the formula that is printed. */
static imp_status check_constants(const imp_value *constants, imp_create_error *why)
{
    for (size_t k = 0; k < constants->count; ++k) {
        const char *name = constants->string[k];
        if (strlen(name) == 1 && strchr("xyz", *name) != NULL)
            return imp_reject(why, OWN_CONSTANTS, -1,
                              "'%s' cannot be defined: it is a coordinate; take another name",
                              name);
    }
    return IMP_STATUS_OK;
}

static imp_status fill(const imp_value *values, motion_instance *s, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status == IMP_STATUS_OK) status = check_constants(&values[OWN_CONSTANTS], why);
    if (status == IMP_STATUS_OK) status = read_time(values, OWN_TIME, &s->lo, &s->hi, why);
    if (status == IMP_STATUS_OK) status = compile(values, OFFSET, s, &s->offset, why);
    if (status == IMP_STATUS_OK && imp_is_given(&values[ANGLE]))
        status = compile(values, ANGLE, s, &s->angle, why);
    if (status != IMP_STATUS_OK) return status;
    s->axis = axis_frame_of(values[AXIS].number);
    imp_copy_vector(s->direction, &values[AXIS]);
    imp_copy_vector(s->center, &values[CENTER]);
    s->text = keep_texts(write_motion, values, &s->lo, &s->hi);
    return s->text != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status motion_create(const imp_value *values, void **self, imp_create_error *why)
{
    motion_instance *s = calloc(1, sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    const imp_status status = fill(values, s, why);
    if (status == IMP_STATUS_OK)
        *self = s;
    else
        motion_destroy(s);
    return status;
}

static void motion_time_domain(const void *self, double *lo, double *hi)
{
    const motion_instance *s = self;
    *lo = s->lo, *hi = s->hi;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* The motion at one time: the displacement, within `off`, and the turn. */
typedef struct moment {
    double way[3], off[3]; /* length */
    axis_point_matrix matrix;
} moment;

static imp_status moment_at(const motion_instance *s, double t, moment *m)
{
    double angle[3], off[3];
    imp_status status = expression_point(s->offset, &t, m->way, m->off);
    if (status != IMP_STATUS_OK || s->angle == NULL) return status;
    status = expression_point(s->angle, &t, angle, off);
    if (status != IMP_STATUS_OK) return status;
    const imp_model known = imp_known(angle[0], off[0]);
    m->matrix = axis_matrix_of_points(&s->axis, &known);
    return IMP_STATUS_OK;
}

/* Lemma. The turned point is off by what axis_turn_point says, by 0 if there is no turn; the
 * displacement by `off`; their sum is rounded once, by u of the result, or not at all if the
 * displacement is 0. False: it is not finite. */
static bool move_point(const motion_instance *s, const moment *m, const double at[3], double x[3],
                       double error[3])
{
    bool finite = true;
    for (int i = 0; i < 3; ++i) x[i] = at[i], error[i] = 0;
    if (s->angle != NULL) finite = axis_turn_point(&m->matrix, s->center, at, x, error);
    for (int i = 0; i < 3; ++i) {
        if (m->way[i] == 0 && m->off[i] == 0) continue;
        x[i] += m->way[i];
        error[i] = (error[i] + (m->off[i] + IMP_U * fabs(x[i]))) * IMP_SLACK;
        finite = finite && error[i] < INFINITY;
    }
    return finite;
}

/* p holds x, y, z and t. Points of one time share the moment. */
static imp_status motion_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    moment m;
    double own[3];
    for (size_t k = 0; k < n; ++k, p += 4, x += 3) {
        const imp_status status =
            k == 0 || p[3] != p[-1] ? moment_at(self, p[3], &m) : IMP_STATUS_OK;
        if (status != IMP_STATUS_OK) return status;
        if (!move_point(self, &m, p, x, error != NULL ? error + 3 * k : own))
            return IMP_STATUS_DOMAIN;
    }
    return IMP_STATUS_OK;
}

/* --- Regions ---------------------------------------------------------------------------------- */

/* The models of the displacement, and of the angle if there is one. */
static void course_models(const motion_instance *s, const imp_model *t, imp_model way[3],
                          imp_model *angle)
{
    imp_model same[3];
    expression_models(s->offset, t, way);
    if (s->angle == NULL) return;
    expression_models(s->angle, t, same);
    *angle = same[0];
}

static void moved(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                  imp_model out[3])
{
    const motion_instance *s = self;
    imp_model at[3] = {x, y, z}, way[3], w[3], angle = imp_num(0);
    course_models(s, &t, way, &angle);
    if (s->angle != NULL) {
        axis_from_center(s->center, x, y, z, w);
        axis_turn(&s->axis, angle, w, at);
        axis_add_center(s->center, at);
    }
    for (int i = 0; i < 3; ++i)
        out[i] =
            angle.e < INFINITY ? imp_add(at[i], way[i]) : imp_unbounded(at[i].depends | t.depends);
}
IMP_MAP_FORMULA(moved)

static imp_status motion_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    static const near_constant nowhere[3] = {{0, 0}, {0, 0}, {0, 0}};
    const motion_instance *s = self;
    const imp_model t = axis_moment(box);
    imp_status status = IMP_STATUS_OK;
    imp_model way[3], angle;
    course_models(s, &t, way, &angle);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) rates->m[i][j] = i == j;
    if (s->angle != NULL) status = axis_turn_rates(&s->axis, s->center, nowhere, angle, box, rates);
    for (int i = 0; i < 3; ++i) {
        rates->m[i][3] = imp_sum_up(rates->m[i][3] + way[i].rate[2]);
        if (!(rates->m[i][3] < INFINITY)) status = IMP_STATUS_UNBOUNDED;
    }
    return status;
}

static imp_status motion_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    const motion_instance *s = self;
    imp_model angle;
    imp_pose_at_rest(pose);
    course_models(s, t, pose->shift, &angle);
    if (s->angle == NULL) return imp_pose_status(pose);
    if (!(angle.e < INFINITY)) return IMP_STATUS_UNBOUNDED;
    axis_matrix(&s->axis, angle, pose->turn);
    for (int i = 0; i < 3; ++i) {
        pose->shift[i] = imp_shift(pose->shift[i], s->center[i]);
        pose->pivot[i] = s->center[i];
        pose->fixed[i] = s->direction[i];
    }
    return imp_pose_status(pose);
}

static const imp_map_type motion_formula = {
    IMP_TYPE_FIELDS(imp_map_type, "motion-formula", motion, motion_destroy),
    .flags = IMP_FLAG_TURNS_EXACTLY,
    .time_domain = motion_time_domain,
    .eval = motion_eval,
    .rate = motion_rate,
    .apply = moved_apply,
    .rigid = motion_rigid,
    .write_formula = motion_write_formula,
    .summary = "any rigid motion about an axis and along a path, given by formulas in time",
    .equation = "w = (x,y,z) - center, k = axis/|axis|, A = angle(t): center + k (k.w) + cos A (w "
                "- k (k.w)) + sin A (k x w) + offset(t); texts in the language of the surface type "
                "formula",
    .source = NULL,
    .example = "motion-formula offset=[\"r*cos(3*t)\",\"r*sin(3*t)\",\"0\"] angle=sin(t) "
               "constants={\"r\":0.4}",
};

IMPINGE_MAP_PLUGIN("motion-formula", PLUGIN_VERSION, "Apache-2.0", "The Impinge authors",
                   motion_formula);
