/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_FORMULA_H
#define IMPINGE_FORMULA_H

#include <impinge/model.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One formula, three answers
 * ==========================
 *
 * Write the surface, or the map, once, in the operations of <impinge/model.h>:
 *
 *   static void ball_formula(const void *self, imp_model u, imp_model v, imp_model t,
 *                            imp_model out[3]);
 *   IMP_SURFACE_FORMULA(ball_formula)
 *
 *   static void spin_formula(const void *self, imp_model x, imp_model y, imp_model z,
 *                            imp_model t, imp_model out[3]);
 *   IMP_MAP_FORMULA(spin_formula)
 *
 * The macros define ball_formula_eval, ball_formula_rate, ball_formula_include, and
 * spin_formula_eval, spin_formula_rate, spin_formula_apply: the callbacks of imp_surface_type and
 * imp_map_type, with proved bounds. A point is evaluated by running the formula on constants, which
 * gives the value and a bound of its rounding error.
 *
 * For a map that is rigid, write its pose instead, which depends on time alone:
 *
 *   static void swing_pose(const void *self, imp_model t, imp_pose *pose);
 *   IMP_RIGID_FORMULA(swing_pose)
 *
 * It defines swing_pose_eval, swing_pose_rate, swing_pose_apply and swing_pose_rigid.
 *
 * The optional distance of a point from the surface (imp_surface_type.distance) can be a formula
 * too:
 *
 *   static imp_model ball_gap(const void *self, imp_model x, imp_model y, imp_model z,
 *                             imp_model t);
 *   IMP_DISTANCE_FORMULA(ball_gap)
 *
 * defines ball_gap_distance. */

typedef void (*imp_surface_formula)(const void *self, imp_model u, imp_model v, imp_model t,
                                    imp_model out[3]);
typedef void (*imp_map_formula)(const void *self, imp_model x, imp_model y, imp_model z,
                                imp_model t, imp_model out[3]);
typedef imp_model (*imp_distance_formula)(const void *self, imp_model x, imp_model y, imp_model z,
                                          imp_model t);

/* Values and errors of a point's three constants. A value that is not finite: IMP_STATUS_DOMAIN. */
static inline imp_status imp_formula_point_(const imp_model out[3], double *x, double *error)
{
    for (int i = 0; i < 3; i++) {
        if (!(out[i].e < INFINITY)) return IMP_STATUS_DOMAIN;
        x[i] = out[i].a;
        if (error != NULL) error[i] = out[i].e;
    }
    return IMP_STATUS_OK;
}

/* What include and apply return for these models: IMP_STATUS_UNBOUNDED where anything is infinite,
 * else IMP_STATUS_OK. */
static inline imp_status imp_models_status(const imp_model out[3])
{
    imp_status status = IMP_STATUS_OK;
    for (int i = 0; i < 3; i++) {
        double size = out[i].e + (out[i].hi - out[i].lo);
        double rate = out[i].rate[0] + out[i].rate[1] + out[i].rate[2];
        if (!(size < INFINITY && rate < INFINITY)) status = IMP_STATUS_UNBOUNDED;
    }
    return status;
}

static inline imp_status imp_surface_formula_eval_(imp_surface_formula f, const void *self,
                                                   size_t n, const double *p, double *x,
                                                   double *error)
{
    imp_model out[3];
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < n && status == IMP_STATUS_OK; k++) {
        f(self, imp_num(p[3 * k]), imp_num(p[3 * k + 1]), imp_num(p[3 * k + 2]), out);
        status = imp_formula_point_(out, x + 3 * k, error != NULL ? error + 3 * k : NULL);
    }
    return status;
}

static inline imp_status imp_surface_formula_include_(imp_surface_formula f, const void *self,
                                                      const imp_region *region, imp_model model[3])
{
    f(self, imp_param(region, 0), imp_param(region, 1), imp_param(region, 2), model);
    return imp_models_status(model);
}

static inline imp_status imp_surface_formula_rate_(imp_surface_formula f, const void *self,
                                                   const imp_region *region, imp_rate_matrix *rates)
{
    imp_model out[3];
    imp_status status = IMP_STATUS_OK;
    f(self, imp_param(region, 0), imp_param(region, 1), imp_param(region, 2), out);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            rates->m[i][j] = out[i].rate[j];
            if (!(out[i].rate[j] < INFINITY)) status = IMP_STATUS_UNBOUNDED;
        }
    }
    return status;
}

static inline imp_status imp_map_formula_eval_(imp_map_formula f, const void *self, size_t n,
                                               const double *p, double *x, double *error)
{
    imp_model out[3];
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < n && status == IMP_STATUS_OK; k++) {
        const double *at = p + 4 * k;
        f(self, imp_num(at[0]), imp_num(at[1]), imp_num(at[2]), imp_num(at[3]), out);
        status = imp_formula_point_(out, x + 3 * k, error != NULL ? error + 3 * k : NULL);
    }
    return status;
}

static inline imp_status imp_map_formula_apply_(imp_map_formula f, const void *self,
                                                const imp_model in[4], imp_model out[3])
{
    f(self, in[0], in[1], in[2], in[3], out);
    return imp_models_status(out);
}

static inline imp_status imp_distance_formula_(imp_distance_formula f, const void *self,
                                               const imp_model point[4], imp_model *distance)
{
    *distance = f(self, point[0], point[1], point[2], point[3]);
    return distance->e < INFINITY ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* A region with these bounds: c is inside, d reaches both ends. */
static inline imp_region imp_region_between(const double lo[3], const double hi[3])
{
    imp_region r;
    for (int j = 0; j < 3; j++) {
        imp_interval x = imp_interval_make(lo[j], hi[j]);
        r.lo[j] = lo[j];
        r.hi[j] = hi[j];
        r.c[j] = imp_interval_mid(x);
        r.d[j] = lo[j] == hi[j] ? 0 : imp_interval_radius_upper(x, r.c[j]);
    }
    return r;
}

/* Models have three parameters and a map has four, so there are two passes. In the first x, y, z
 * vary and t is an unknown constant in its bounds; in the second t varies and x, y, z are unknown
 * constants. Each pass bounds the change for every fixed value of the others, so together they
 * bound the change along a path that moves first in space and then in time. */
static inline imp_status imp_map_formula_rate_(imp_map_formula f, const void *self,
                                               const imp_box4 *over, imp_map_rates *rates)
{
    imp_model space[3], time[3];
    imp_region region = imp_region_between(over->lo, over->hi);
    imp_region moment = imp_region_between(over->lo + 1, over->hi + 1);
    imp_status status = IMP_STATUS_OK;
    f(self, imp_param(&region, 0), imp_param(&region, 1), imp_param(&region, 2),
      imp_between(over->lo[3], over->hi[3]), space);
    f(self, imp_between(over->lo[0], over->hi[0]), imp_between(over->lo[1], over->hi[1]),
      imp_between(over->lo[2], over->hi[2]), imp_param(&moment, 2), time);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            rates->m[i][j] = j < 3 ? space[i].rate[j] : time[i].rate[2];
            if (!(rates->m[i][j] < INFINITY)) status = IMP_STATUS_UNBOUNDED;
        }
    }
    return status;
}

#if defined(__GNUC__)
#define IMP_UNUSED_ __attribute__((unused))
#else
#define IMP_UNUSED_
#endif

#define IMP_SURFACE_FORMULA(FORMULA)                                                               \
    static IMP_UNUSED_ imp_status FORMULA##_eval(const void *self, size_t n, const double *p,      \
                                                 double *x, double *error)                         \
    {                                                                                              \
        return imp_surface_formula_eval_(FORMULA, self, n, p, x, error);                           \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_rate(const void *self, const imp_region *region,       \
                                                 imp_rate_matrix *rates)                           \
    {                                                                                              \
        return imp_surface_formula_rate_(FORMULA, self, region, rates);                            \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_include(const void *self, const imp_region *region,    \
                                                    imp_model model[3])                            \
    {                                                                                              \
        return imp_surface_formula_include_(FORMULA, self, region, model);                         \
    }

#define IMP_DISTANCE_FORMULA(FORMULA)                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_distance(const void *self, const imp_model point[4],   \
                                                     imp_model *distance)                          \
    {                                                                                              \
        return imp_distance_formula_(FORMULA, self, point, distance);                              \
    }

#define IMP_MAP_FORMULA(FORMULA)                                                                   \
    static IMP_UNUSED_ imp_status FORMULA##_eval(const void *self, size_t n, const double *p,      \
                                                 double *x, double *error)                         \
    {                                                                                              \
        return imp_map_formula_eval_(FORMULA, self, n, p, x, error);                               \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_rate(const void *self, const imp_box4 *box,            \
                                                 imp_map_rates *rates)                             \
    {                                                                                              \
        return imp_map_formula_rate_(FORMULA, self, box, rates);                                   \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_apply(const void *self, const imp_model in[4],         \
                                                  imp_model out[3])                                \
    {                                                                                              \
        return imp_map_formula_apply_(FORMULA, self, in, out);                                     \
    }

/* --- Rigid maps ------------------------------------------------------------------------------- */

/* The pose of a map that moves nothing; what turns or moves is set after it. */
static inline void imp_pose_at_rest(imp_pose *pose)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) pose->turn[i][j] = imp_num(i == j);
        pose->shift[i] = imp_num(0);
        pose->pivot[i] = 0;
    }
}

/* IMP_STATUS_UNBOUNDED where anything is infinite. */
static inline imp_status imp_pose_status(const imp_pose *pose)
{
    imp_status status = imp_models_status(pose->shift);
    for (int i = 0; i < 3; i++)
        if (imp_models_status(pose->turn[i]) != IMP_STATUS_OK) status = IMP_STATUS_UNBOUNDED;
    return status;
}

/* The image of the point (x, y, z) = `at`. */
static inline void imp_pose_apply(const imp_pose *pose, const imp_model at[3], imp_model out[3])
{
    imp_model w[3];
    for (int i = 0; i < 3; i++) w[i] = imp_shift(at[i], -pose->pivot[i]);
    for (int i = 0; i < 3; i++) out[i] = imp_add(imp_dot3(pose->turn[i], w), pose->shift[i]);
}

#define IMP_RIGID_FORMULA(FORMULA)                                                                 \
    static IMP_UNUSED_ imp_status FORMULA##_rigid(const void *self, const imp_model *t,            \
                                                  imp_pose *pose)                                  \
    {                                                                                              \
        FORMULA(self, *t, pose);                                                                   \
        return imp_pose_status(pose);                                                              \
    }                                                                                              \
    static void FORMULA##_moved_(const void *self, imp_model x, imp_model y, imp_model z,          \
                                 imp_model t, imp_model out[3])                                    \
    {                                                                                              \
        imp_pose pose;                                                                             \
        const imp_model at[3] = {x, y, z};                                                         \
        FORMULA(self, t, &pose);                                                                   \
        imp_pose_apply(&pose, at, out);                                                            \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_eval(const void *self, size_t n, const double *p,      \
                                                 double *x, double *error)                         \
    {                                                                                              \
        return imp_map_formula_eval_(FORMULA##_moved_, self, n, p, x, error);                      \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_rate(const void *self, const imp_box4 *box,            \
                                                 imp_map_rates *rates)                             \
    {                                                                                              \
        return imp_map_formula_rate_(FORMULA##_moved_, self, box, rates);                          \
    }                                                                                              \
    static IMP_UNUSED_ imp_status FORMULA##_apply(const void *self, const imp_model in[4],         \
                                                  imp_model out[3])                                \
    {                                                                                              \
        return imp_map_formula_apply_(FORMULA##_moved_, self, in, out);                            \
    }

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_FORMULA_H */
