/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/course.h"
#include "plugins/common/near.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

static const imp_parameter parameters[] = {
    [COURSE_RATE] =
        IMP_ROW_VECTOR("velocity", "length/time", NULL, IMP_OPTIONAL, "constant velocity"),
    [COURSE_COEFFICIENTS] =
        IMP_ROW_VECTORS("offset", "length/time^k", NULL, 3, IMP_OPTIONAL,
                        "instead: coefficients [x,y,z] of t^0, t^1, t^2 ... of the displacement"),
    [COURSE_TIMES] = COURSE_ROW_TIMES,
    [COURSE_VALUES] = IMP_ROW_VECTORS("positions", "length", NULL, 3, IMP_OPTIONAL,
                                      "one [x,y,z] for each of times"),
    [COURSE_FILE] = COURSE_ROW_FILE,
    [COURSE_COLUMNS] = COURSE_ROW_COLUMNS("columns", 3, 0,
                                          "of the file: those of x, y and z, by name or by number "
                                          "from 1; default: the second to the "
                                          "fourth"),
    [COURSE_INTERPOLATION] = COURSE_ROW_INTERPOLATION,
    [COURSE_HOLD] = COURSE_ROW_HOLD,
};

static imp_status translate_create(const imp_value *values, void **self, imp_create_error *why)
{
    course *way = malloc(sizeof *way);
    if (way == NULL) return IMP_INTERNAL;
    const imp_status status = course_read(way, values, 0, 3, why, parameters);
    if (status == IMP_OK)
        *self = way;
    else
        free(way);
    return status;
}

static void translate_destroy(void *self)
{
    course_clear(self);
    free(self);
}

static void translate_time_domain(const void *self, double *lo, double *hi)
{
    course_times(self, lo, hi);
}

/* --- At constant velocity ------------------------------------------------------------------------ */

/* What most translations are: c0 + c1 t, or c0 alone. */
static bool is_steady(const course *way)
{
    return way->polynomial.count == 1 || way->polynomial.count == 2;
}

static double speed_of(const course *way, size_t i)
{
    return way->polynomial.count > 1 ? way->polynomial.coefficient[2 * i + 1] : 0;
}

/* x k and x + k as imp_scale and imp_shift have them at points: rounded once, by u of the result, unless
 * exact. */
static near_constant point_scaled(double x, double k)
{
    const double a = x * k;
    if (k == 0 || k == 1 || k == -1) return near_exact(a);
    return (near_constant){a, (IMP_U * fabs(a) + IMP_TINY) * IMP_SLACK};
}

static near_constant point_shifted(near_constant x, double k)
{
    const double a = x.value + k;
    if (k == 0 || (x.value == 0 && x.error == 0)) return (near_constant){a, x.error};
    return (near_constant){a, (x.error + (IMP_U * fabs(a) + IMP_TINY)) * IMP_SLACK};
}

/* Lemma. Of x + c0 + c1 t, where t = c + d s exactly, the numbers c1 c, c0 + c1 c, c1 d and both sums with
 * what x has in their place are each rounded once, by u of the result. */
static imp_model steadily_moved(imp_model x, double from, double speed, const imp_model *t)
{
    const double far = speed * t->a, way = from + far, slope = speed * t->b[2];
    const imp_interval gone = imp_interval_scale(imp_model_range(t), speed);
    x.a += way;
    x.b[2] += slope;
    const double rounded = fabs(far) + fabs(way) + fabs(slope) + fabs(x.a) + fabs(x.b[2]);
    x.e = (x.e + (IMP_U * rounded + IMP_TINY)) * IMP_SLACK;
    x.lo = imp_sum_down(x.lo + imp_sum_down(from + gone.lo));
    x.hi = imp_sum_up(x.hi + imp_sum_up(from + gone.hi));
    x.rate[2] = imp_sum_up(x.rate[2] + imp_round_up(fabs(speed) * t->rate[2]));
    x.depends |= t->depends;
    return imp_model_finish(x);
}

/* Time as inclusions have it. */
static bool is_linear(const imp_model *t)
{
    bool bends = false;
    for (int k = 0; k < 6; ++k) bends = bends || t->q[k] != 0;
    return t->e == 0 && t->b[0] == 0 && t->b[1] == 0 && !bends;
}

/* One coordinate x at time t. What is exact is added last. */
static near_constant steady_at(const course *way, size_t i, double x, double t)
{
    const double from = way->polynomial.coefficient[way->polynomial.count * i];
    const near_constant moved = point_shifted(point_scaled(t, speed_of(way, i)), from);
    return moved.error == 0 ? point_shifted(near_exact(x), moved.value) : point_shifted(moved, x);
}

static imp_status steady_eval(const course *way, size_t n, const double *p, double *x,
                              double *error)
{
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < 3; ++i) {
            const near_constant at = steady_at(way, i, p[4 * k + i], p[4 * k + 3]);
            if (!(at.error < INFINITY && fabs(at.value) < INFINITY)) return IMP_DOMAIN;
            x[3 * k + i] = at.value;
            if (error != NULL) error[3 * k + i] = at.error;
        }
    return IMP_OK;
}

static imp_status steady_rate(const course *way, imp_map_rates *rates)
{
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) rates->m[i][j] = i == j;
        rates->m[i][3] = fabs(speed_of(way, i));
    }
    return IMP_OK;
}

/* --- Any course ---------------------------------------------------------------------------------- */

static void moved(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                  imp_model out[3])
{
    const course *way = self;
    const imp_model at[3] = {x, y, z};
    imp_model by[3];
    const bool steady = is_steady(way) && is_linear(&t);
    if (!steady) course_at(way, 3, t, by);
    for (size_t i = 0; i < 3; ++i) {
        const double from = steady ? way->polynomial.coefficient[way->polynomial.count * i] : 0;
        if (!steady)
            out[i] = imp_add(at[i], by[i]);
        else if (speed_of(way, i) == 0)
            out[i] = imp_shift(at[i], from);
        else
            out[i] = steadily_moved(at[i], from, speed_of(way, i), &t);
    }
}
IMP_MAP_FORMULA(moved)

static imp_status translate_eval(const void *self, size_t n, const double *p, double *x,
                                 double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (!course_is_defined(self, p[4 * k + 3], p[4 * k + 3])) return IMP_DOMAIN;
    return is_steady(self) ? steady_eval(self, n, p, x, error) : moved_eval(self, n, p, x, error);
}

static imp_status translate_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    if (!course_is_defined(self, box->lo[3], box->hi[3])) return IMP_DOMAIN;
    return is_steady(self) ? steady_rate(self, rates) : moved_rate(self, box, rates);
}

static imp_status translate_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    if (!course_is_defined(self, in[3].lo, in[3].hi)) return IMP_DOMAIN;
    return moved_apply(self, in, out);
}

/* Lemma (error). The displacement at the middle time, c0 + c1 c, and its sum with the place: 3 roundings
 * of |place| + |c0| + |c1 c| at most; the drift, c1 added, 1 of its size, for d at most. */
static imp_status translate_net(const void *self, const imp_region *region, imp_net *net)
{
    const course *way = self;
    const size_t count = way->polynomial.count;
    const double middle = region->c[2];
    if (count == 0 || count > 2) return IMP_UNBOUNDED;
    for (size_t i = 0; i < 3; ++i) {
        const double *c = way->polynomial.coefficient + i * count, speed = count > 1 ? c[1] : 0;
        const double size = fabs(net->place[i]) + fabs(c[0]) + fabs(speed * middle);
        net->place[i] += c[0] + speed * middle;
        net->drift[i] += speed;
        net->error[i] += (4 * size + 2 * fabs(net->drift[i]) * region->d[2]) * 0x1p-53 + IMP_TINY;
        net->error[i] *= 1 + 0x1p-50;
    }
    return IMP_OK;
}

static imp_status translate_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    if (!course_is_defined(self, t->lo, t->hi)) return IMP_DOMAIN;
    imp_pose_at_rest(pose);
    course_at(self, 3, *t, pose->shift);
    return imp_pose_status(pose);
}

static const imp_map_type translate = {
    IMP_MAP_FIELDS_OF("translate", translate, translate, translate_destroy, translate_rate),
    .net = translate_net,
    .rigid = translate_rigid,
    .summary = "moves along a straight line, along a polynomial in time, or by a table",
    .equation = "(x,y,z) + velocity t, or (x,y,z) + sum_k offset_k t^k, or (x,y,z) + the "
                "table's value at t",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.4",
    .example = "translate velocity=1,0,0",
};

PUBLISH_MAP(translate);
