/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/course.h"
#include "plugins/common/near.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>
#include <impinge/quad.h>

static const imp_parameter parameters[] = {
    [COURSE_RATE] = IMP_ROW_VECTOR("velocity", "length/time", NULL, IMP_PARAMETER_OPTIONAL,
                                   "constant velocity"),
    [COURSE_COEFFICIENTS] =
        IMP_ROW_VECTORS("offset", "length/time^k", NULL, 3, IMP_PARAMETER_OPTIONAL,
                        "instead: coefficients [x,y,z] of t^0, t^1, t^2 ... of the displacement"),
    [COURSE_TIMES] = COURSE_ROW_TIMES,
    [COURSE_VALUES] = IMP_ROW_VECTORS("positions", "length", NULL, 3, IMP_PARAMETER_OPTIONAL,
                                      "one [x,y,z] for each of times"),
    [COURSE_FILE] = COURSE_ROW_FILE,
    [COURSE_COLUMNS] = COURSE_ROW_COLUMNS("columns", 3, 0,
                                          "of the file: those of x, y and z, by name or by number "
                                          "from 1; default: the second to the fourth"),
    [COURSE_UNIT] = COURSE_ROW_SCENE_UNIT,
    [COURSE_INTERPOLATION] = COURSE_ROW_INTERPOLATION,
    [COURSE_HOLD] = COURSE_ROW_HOLD,
    [COURSE_VELOCITIES] = IMP_ROW_VECTORS("velocities", "length/time", NULL, 3,
                                          IMP_PARAMETER_OPTIONAL, COURSE_DOC_VELOCITIES),
    [COURSE_ACCELERATIONS] = IMP_ROW_VECTORS("accelerations", "length/time^2", NULL, 3,
                                             IMP_PARAMETER_OPTIONAL, COURSE_DOC_ACCELERATIONS),
};

static imp_status translate_create(const imp_value *values, void **self, imp_create_error *why)
{
    course *way = malloc(sizeof *way);
    if (way == NULL) return IMP_STATUS_INTERNAL;
    const imp_status status = course_read(way, values, 0, UNIT_LENGTH, why, parameters);
    if (status != IMP_STATUS_OK) return free(way), status;
    *self = way;
    return IMP_STATUS_OK;
}

static imp_status translate_renew(void *self, const imp_value *values, imp_create_error *why)
{
    return course_renew(self, values, 0, UNIT_LENGTH, why, parameters);
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

static void translate_span(const void *self, double *lo, double *hi) { course_span(self, lo, hi); }

/* --- At constant velocity --------------------------------------------------------------------- */

/* What most translations are: c0 + c1 t, or c0 alone. */
static bool is_steady(const course *way)
{
    return way->polynomial.count == 1 || way->polynomial.count == 2;
}

static bool moves_steadily(const course *way) { return way->polynomial.count == 2; }

static double speed_of(const course *way, size_t i)
{
    return way->polynomial.count > 1 ? way->polynomial.coefficient[2 * i + 1] : 0;
}

/* x k and x + k as imp_scale and imp_shift have them at points: rounded once, by u of the result,
 * unless exact. */
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

/* Whether the model of time is exact and linear in s_t alone, as over a region. */
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
            if (!(at.error < INFINITY && fabs(at.value) < INFINITY)) return IMP_STATUS_DOMAIN;
            x[3 * k + i] = at.value;
            if (error != NULL) error[3 * k + i] = at.error;
        }
    return IMP_STATUS_OK;
}

static imp_status steady_rate(const course *way, imp_map_rates *rates)
{
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) rates->m[i][j] = i == j;
        rates->m[i][3] = fabs(speed_of(way, i));
    }
    return IMP_STATUS_OK;
}

/* --- Three models at constant velocity, side by side ------------------------------------------ */

typedef struct moved_lanes {
    imp_quad a, slope, e, lo, hi, rate;
    imp_quad_mask is_told; /* the quadratic says more than the range alone */
} moved_lanes;

#define LANES(m, what) imp_quad_of((m)[0].what, (m)[1].what, (m)[2].what, 0)

IMP_QUAD_INLINE imp_quad round_down(imp_quad x)
{
    return x - (imp_quad_abs(x) * imp_quad_all(0x1p-52) + imp_quad_all(IMP_TINY));
}

IMP_QUAD_INLINE imp_quad round_up(imp_quad x)
{
    return x + (imp_quad_abs(x) * imp_quad_all(0x1p-52) + imp_quad_all(IMP_TINY));
}

IMP_QUAD_INLINE imp_quad sum_down(imp_quad x)
{
    return x - imp_quad_abs(x) * imp_quad_all(0x1p-52);
}

IMP_QUAD_INLINE imp_quad sum_up(imp_quad x) { return x + imp_quad_abs(x) * imp_quad_all(0x1p-52); }

/* Clips the ranges to those of quadratic and remainder, as imp_model_finish does. */
IMP_QUAD_INLINE void clip(moved_lanes *m, const imp_model x[3])
{
    const imp_quad half = imp_quad_all(0.5), infinite = imp_quad_all(INFINITY);
    const imp_quad b[3] = {imp_quad_abs(LANES(x, b[0])), imp_quad_abs(LANES(x, b[1])),
                           imp_quad_abs(m->slope)};
    const imp_quad q[3] = {LANES(x, q[IMP_UU]), LANES(x, q[IMP_VV]), LANES(x, q[IMP_TT])};
    const imp_quad twist = imp_quad_abs(LANES(x, q[IMP_UV])) + imp_quad_abs(LANES(x, q[IMP_UT])) +
                           imp_quad_abs(LANES(x, q[IMP_VT]));
    imp_quad lo = -(twist + m->e), hi = -lo, size = imp_quad_abs(m->a) + hi;
    for (int j = 0; j < 3; ++j) {
        lo += imp_quad_min(q[j] - b[j], -half * b[j]);
        hi += imp_quad_max(q[j] + b[j], half * b[j]);
        size += b[j] + imp_quad_abs(q[j]);
    }
    const imp_quad pad = imp_quad_all(0x1p-48) * size;
    lo = m->a + lo - pad;
    hi = m->a + hi + pad;
    lo = imp_quad_pick(lo > -infinite, lo, -infinite);
    hi = imp_quad_pick(hi < infinite, hi, infinite);
    m->lo = imp_quad_max(m->lo, lo);
    m->hi = imp_quad_min(m->hi, hi);
    m->is_told = (m->e <= half * (m->hi - m->lo)) & (hi - lo < infinite);
}

/* Lemma. Of x + c0 + c1 t, where t = c + d s exactly, the numbers c1 c, c0 + c1 c, c1 d and both
 * sums with what x has in their place are each rounded once, by u of the result. */
IMP_QUAD_INLINE moved_lanes lanes_moved(const imp_model x[3], const imp_model *t, imp_quad from,
                                        imp_quad speed)
{
    const imp_quad far = speed * imp_quad_all(t->a), way = from + far;
    const imp_quad slope = speed * imp_quad_all(t->b[2]);
    const imp_quad first = speed * imp_quad_all(t->lo), last = speed * imp_quad_all(t->hi);
    moved_lanes m = {.a = LANES(x, a) + way, .slope = LANES(x, b[2]) + slope};
    const imp_quad rounded = imp_quad_abs(far) + imp_quad_abs(way) + imp_quad_abs(slope) +
                             imp_quad_abs(m.a) + imp_quad_abs(m.slope);
    m.e = (LANES(x, e) + (imp_quad_all(IMP_U) * rounded + imp_quad_all(IMP_TINY))) *
          imp_quad_all(IMP_SLACK);
    m.lo = sum_down(LANES(x, lo) + sum_down(from + round_down(imp_quad_min(first, last))));
    m.hi = sum_up(LANES(x, hi) + sum_up(from + round_up(imp_quad_max(first, last))));
    m.rate = sum_up(LANES(x, rate[2]) + round_up(imp_quad_abs(speed) * imp_quad_all(t->rate[2])));
    clip(&m, x);
    return m;
}

IMP_QUAD_INLINE void move_steadily(const course *way, const imp_model in[4], imp_model out[3])
{
    const double *c = way->polynomial.coefficient;
    const moved_lanes m =
        lanes_moved(in, &in[3], imp_quad_of(c[0], c[2], c[4], 0), imp_quad_of(c[1], c[3], c[5], 0));
    for (int i = 0; i < 3; ++i) {
        if (c[2 * i + 1] == 0) {
            out[i] = imp_shift(in[i], c[2 * i]);
            continue;
        }
        out[i] = in[i];
        out[i].a = m.a[i], out[i].b[2] = m.slope[i], out[i].e = m.e[i];
        out[i].lo = m.lo[i], out[i].hi = m.hi[i];
        out[i].depends |= in[3].depends;
        out[i].rate[2] = out[i].depends >> 2 & 1 ? m.rate[i] : 0;
        if (!m.is_told[i]) out[i] = imp_model_collapse(out[i]);
    }
}

IMP_QUAD_NARROW static void move_steadily_narrow(const course *way, const imp_model in[4],
                                                 imp_model out[3])
{
    move_steadily(way, in, out);
}

IMP_QUAD_WIDE static void move_steadily_wide(const course *way, const imp_model in[4],
                                             imp_model out[3])
{
    move_steadily(way, in, out);
}

/* --- Any course ------------------------------------------------------------------------------- */

static void moved(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                  imp_model out[3])
{
    const imp_model at[3] = {x, y, z};
    imp_model by[3];
    course_at(self, 3, t, by);
    for (size_t i = 0; i < 3; ++i) out[i] = imp_add(at[i], by[i]);
}
IMP_MAP_FORMULA(moved)

static imp_status translate_eval(const void *self, size_t n, const double *p, double *x,
                                 double *error)
{
    for (size_t k = 0; k < n; ++k)
        if (!course_is_defined(self, p[4 * k + 3], p[4 * k + 3])) return IMP_STATUS_DOMAIN;
    return is_steady(self) ? steady_eval(self, n, p, x, error) : moved_eval(self, n, p, x, error);
}

static imp_status translate_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    if (!course_is_defined(self, box->lo[3], box->hi[3])) return IMP_STATUS_DOMAIN;
    return is_steady(self) ? steady_rate(self, rates) : moved_rate(self, box, rates);
}

static imp_status translate_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    if (!course_is_defined(self, in[3].lo, in[3].hi)) return IMP_STATUS_DOMAIN;
    if (!moves_steadily(self) || !is_linear(&in[3])) return moved_apply(self, in, out);
    if (imp_quad_is_wide())
        move_steadily_wide(self, in, out);
    else
        move_steadily_narrow(self, in, out);
    return imp_models_status(out);
}

/* Lemma (error). The displacement at the middle time, c0 + c1 c, and its sum with the place: 3
 * roundings of |place| + |c0| + |c1 c| at most; the drift, c1 added, 1 of its size, for d at
 * most. */
static imp_status translate_net(const void *self, const imp_region *region, imp_net *net)
{
    const course *way = self;
    const double middle = region->c[2];
    if (!is_steady(way)) return IMP_STATUS_UNBOUNDED;
    for (size_t i = 0; i < 3; ++i) {
        const double from = way->polynomial.coefficient[way->polynomial.count * i];
        const double speed = speed_of(way, i);
        const double size = fabs(net->place[i]) + fabs(from) + fabs(speed * middle);
        net->place[i] += from + speed * middle;
        net->drift[i] += speed;
        net->error[i] += (4 * size + 2 * fabs(net->drift[i]) * region->d[2]) * 0x1p-53 + IMP_TINY;
        net->error[i] *= 1 + 0x1p-50;
    }
    return IMP_STATUS_OK;
}

static imp_status translate_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    if (!course_is_defined(self, t->lo, t->hi)) return IMP_STATUS_DOMAIN;
    imp_pose_at_rest(pose);
    course_at(self, 3, *t, pose->shift);
    return imp_pose_status(pose);
}

static imp_status translate_write_formula(const void *self, const imp_text_sink *to)
{
    course_write(self, "a", "", "x + a0; y + a1; z + a2", to);
    return IMP_STATUS_OK;
}

static const imp_map_type translate = {
    IMP_MAP_FIELDS_OF("translate", translate, translate, translate_destroy, translate_rate),
    .net = translate_net,
    .flags = IMP_FLAG_TURNS_EXACTLY,
    .rigid = translate_rigid,
    .span = translate_span,
    .renew = translate_renew,
    .write_formula = translate_write_formula,
    .summary = "moves along a straight line, along a polynomial in time, or by a table",
    .equation = "(x,y,z) + velocity t, or (x,y,z) + sum_k offset_k t^k, or (x,y,z) + the "
                "table's value at t; to place a part once and for all: offset=[[x,y,z]]",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, appendix B.4",
    .example = "translate velocity=1,0,0",
};

PUBLISH_MAP(translate);
