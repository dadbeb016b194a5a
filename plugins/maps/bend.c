/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/axis.h"
#include "plugins/common/polynomial.h"
#include "plugins/common/publish.h"
#include "plugins/common/sinc.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* A straight rod becomes an arc
 * =============================
 * The rod lies along `along`, and it bends towards n = axis x along. With coordinates Y along the
 * rod and Z along n, the bent part is L = Y limited to the range, and its angle is A = curvature L.
 * Beyond the range the rod continues straight:
 *
 *   Y' = sin A / curvature       - Z sin A + (Y - L) cos A
 *   Z' = (1 - cos A) / curvature + Z cos A + (Y - L) sin A
 *
 * With sinc A = sin A / A and cosc A = (1 - cos A) / A (sinc.h) and M = L - A Z the first terms are
 *
 *   Y' = M sinc A + (Y - L) cos A,   Z' = Z + M cosc A + (Y - L) sin A,
 *
 * which also hold for curvature 0 and have no cancellation. The map is Lipschitz but not smooth:
 * where Z is not 0, both ends of the range are kinks. */

enum { AXIS, ALONG, CENTER, RANGE, CURVATURE };

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[1,0,0]", "axis of the bending, any vector but 0; right-handed"),
    [ALONG] = ROW_AXIS("along", "[0,1,0]",
                       "direction of the rod; its component parallel to the axis is removed"),
    [CENTER] =
        IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "fixed point of the rod, at coordinate 0"),
    [RANGE] = ROW_RANGE("[-1,1]", "the bent part, in coordinates along the rod"),
    [CURVATURE] = ROW_IN_TIME("curvature", "rad/length", "1", "1 / radius of the bent rod"),
};

typedef struct bend_instance {
    double center[3], lo, hi;
    near_constant axis[3], along[3], side[3];
    near_constant column[3][3]; /* [i]: component i of axis, along, side */
    polynomial curvature;
    double coefficients[];
} bend_instance;

/* Least sine of the angle between axis and rod. */
#define SINE_MIN 1e-6

/* Exact if they are along x, y and z, all of them. */
static void set_vector(const imp_model vector[3], bool aligned, near_constant out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = aligned ? near_exact(rint(vector[i].a)) : near_of(vector[i]);
}

/* The three unit vectors; false: axis and rod are nearly parallel. */
static bool set_frame(bend_instance *s, const double axis[3], const double along[3])
{
    const bool aligned = axis_is_aligned(axis) && axis_is_aligned(along);
    imp_model k[3], rod[3], side[3];
    axis_unit_of(axis, k);
    axis_unit_of(along, rod);
    axis_cross(k, rod, side);
    if (!(imp_dot3(side, side).lo > SINE_MIN * SINE_MIN)) return false;
    axis_unit(side, side);
    axis_cross(side, k, rod);
    set_vector(k, aligned, s->axis);
    set_vector(rod, aligned, s->along);
    set_vector(side, aligned, s->side);
    for (int i = 0; i < 3; ++i) {
        s->column[i][0] = s->axis[i];
        s->column[i][1] = s->along[i];
        s->column[i][2] = s->side[i];
    }
    return true;
}

static imp_status check(const imp_value *values, imp_create_error *why)
{
    imp_status status = axis_check(AXIS, values[AXIS].number, why);
    if (status == IMP_STATUS_OK) status = axis_check(ALONG, values[ALONG].number, why);
    if (status == IMP_STATUS_OK) status = axis_check_range(RANGE, values[RANGE].number, why);
    return status;
}

static imp_status bend_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    bend_instance *s = malloc(sizeof *s + values[CURVATURE].count * sizeof(double));
    if (s == NULL) return IMP_STATUS_INTERNAL;
    if (!set_frame(s, values[AXIS].number, values[ALONG].number)) {
        free(s);
        return imp_reject(why, ALONG, -1, "parallel to axis; must be another direction");
    }
    imp_copy_vector(s->center, &values[CENTER]);
    s->lo = values[RANGE].number[0];
    s->hi = values[RANGE].number[1];
    s->curvature = polynomial_copy(&values[CURVATURE], 1, s->coefficients);
    *self = s;
    return IMP_STATUS_OK;
}

/* Y and Z, to be replaced by Y' and Z'. */
static void bend_plane(const bend_instance *s, imp_model t, imp_model *y, imp_model *z)
{
    imp_model sine, cosine;
    imp_model bent = axis_clamp(*y, s->lo, s->hi), beyond = imp_sub(*y, bent);
    imp_model angle = imp_mul(polynomial_at(&s->curvature, 0, t), bent);
    imp_model m = imp_sub(bent, imp_mul(angle, *z));
    *z = imp_add(*z, imp_mul(m, sinc_cosc(angle)));
    *y = imp_mul(m, sinc_of(angle));
    if (beyond.lo == 0 && beyond.hi == 0) return;
    imp_sincos(angle, &sine, &cosine);
    *y = imp_add(*y, imp_mul(beyond, cosine));
    *z = imp_add(*z, imp_mul(beyond, sine));
}

static void bend_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                         imp_model out[3])
{
    const bend_instance *s = self;
    imp_model w[3], bent[3];
    axis_from_center(s->center, x, y, z, w);
    bent[0] = axis_dot(s->axis, w);
    bent[1] = axis_dot(s->along, w);
    bent[2] = axis_dot(s->side, w);
    bend_plane(s, t, &bent[1], &bent[2]);
    for (int i = 0; i < 3; ++i) out[i] = axis_dot(s->column[i], bent);
    axis_add_center(s->center, out);
}
IMP_MAP_FORMULA(bend_formula)
IMP_MAP_AT_ALL_TIMES(bend)

/* A curvature that may be 0 has no formula without sin A / A, which the language lacks. */
static imp_status bend_write_formula(const void *self, const imp_text_sink *to)
{
    const bend_instance *s = self;
    if (s->curvature.count > 1 || s->curvature.coefficient[0] == 0) return IMP_STATUS_UNBOUNDED;
    imp_define(to, "c", s->curvature.coefficient[0]);
    imp_add_text(
        to, AXIS_TEXT
        "s0 = k1*along2 - k2*along1; s1 = k2*along0 - k0*along2; s2 = k0*along1 - k1*along0; "
        "m = hypot(s0, s1, s2); n0 = s0/m; n1 = s1/m; n2 = s2/m; "
        "a0 = n1*k2 - n2*k1; a1 = n2*k0 - n0*k2; a2 = n0*k1 - n1*k0; "
        "Y = a0*w0 + a1*w1 + a2*w2; Z = n0*w0 + n1*w1 + n2*w2; L = clamp(Y, range0, range1); "
        "A = c*L; p = sin(A)/c - Z*sin(A) + (Y - L)*cos(A); "
        "q = (1 - cos(A))/c + Z*cos(A) + (Y - L)*sin(A); center0 + k0*d + a0*p + n0*q; "
        "center1 + k1*d + a1*p + n1*q; center2 + k2*d + a2*p + n2*q");
    return IMP_STATUS_OK;
}

static const imp_map_type bend = {
    IMP_MAP_FIELDS(bend, bend_formula),
    .write_formula = bend_write_formula,
    .summary = "bends a rod into an arc within a range, straight beyond; may change in time",
    .equation =
        "w = (x,y,z) - center; k, a, n: unit vectors of axis, of along, of axis x along; Y = "
        "a.w, Z = n.w, L = Y limited to range, A = curvature L: center + k (k.w) + a (sin A "
        "/ curvature - Z sin A + (Y - L) cos A) + n ((1 - cos A) / curvature + Z cos A + "
        "(Y - L) sin A); curvature is a polynomial in t",
    .source = "Barr, Global and Local Deformations of Solid Primitives, SIGGRAPH 1984",
    .example = "bend axis=1,0,0 along=0,1,0 range=-1,1 curvature=[0,1]",
};

PUBLISH_MAP(bend);
