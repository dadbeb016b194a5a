/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "axis.h"
#include "plugin.h"
#include "polynomial.h"
#include "sinc.h"

#include <impinge/formula.h>

/* A straight rod becomes an arc
 * =============================
 * The rod lies along `along`, and n = axis x along is the side it bends to. With coordinates Y
 * along it and Z to that side, the bent part is L = Y limited to the range, its angle A = curvature
 * L, and what is beyond goes on straight:
 *
 *   Y' = sin A / curvature       - Z sin A + (Y - L) cos A
 *   Z' = (1 - cos A) / curvature + Z cos A + (Y - L) sin A
 *
 * With sinc A = sin A / A and cosc A = (1 - cos A) / A (sinc.h) and M = L - A Z the first terms are
 *
 *   Y' = M sinc A + (Y - L) cos A,   Z' = Z + M cosc A + (Y - L) sin A,
 *
 * right for no curvature too, and nothing cancels. Lipschitz but not smooth: where Z is not 0 both
 * ends of the range are kinks. */

enum { AXIS, ALONG, CENTER, RANGE, CURVATURE };

static const imp_parameter parameters[] = {
    [AXIS] = ROW_AXIS("axis", "[1,0,0]", "what it bends about, of any length but 0; right-handed"),
    [ALONG] = ROW_AXIS("along", "[0,1,0]",
                       "direction of the rod; what is parallel to the axis is taken out of it"),
    [CENTER] = ROW_VECTOR("center", "length", "[0,0,0]", 0,
                          "point of the rod that stays where it is, at coordinate 0"),
    [RANGE] = ROW_RANGE("[-1,1]", "what is bent, in coordinates along the rod"),
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

/* The three unit vectors; false: axis and rod are as good as parallel. */
static bool set_frame(bend_instance *s, const double axis[3], const double along[3])
{
    const bool aligned = is_aligned(axis) && is_aligned(along);
    imp_model k[3], rod[3], side[3];
    unit_vector_of(axis, k);
    unit_vector_of(along, rod);
    cross_product(k, rod, side);
    if (!(imp_dot3(side, side).lo > SINE_MIN * SINE_MIN)) return false;
    unit_vector(side, side);
    cross_product(side, k, rod);
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

static imp_status check(const imp_value *values, imp_complaint *why)
{
    imp_status status = check_axis(AXIS, values[AXIS].number, why);
    if (status == IMP_OK) status = check_axis(ALONG, values[ALONG].number, why);
    if (status == IMP_OK) status = check_range(RANGE, values[RANGE].number, why);
    return status;
}

static imp_status bend_create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check(values, why);
    if (status != IMP_OK) return status;
    bend_instance *s = malloc(sizeof *s + values[CURVATURE].count * sizeof(double));
    if (!s) return IMP_INTERNAL;
    if (!set_frame(s, values[AXIS].number, values[ALONG].number)) {
        free(s);
        return complain(why, ALONG, -1,
                        "parallel to axis; a rod bends about an axis across it only");
    }
    copy_vector(s->center, &values[CENTER]);
    s->lo = values[RANGE].number[0];
    s->hi = values[RANGE].number[1];
    s->curvature = polynomial_copy(&values[CURVATURE], 1, s->coefficients);
    *self = s;
    return IMP_OK;
}

/* Y and Z, to be replaced by Y' and Z'. */
static void bend_plane(const bend_instance *s, imp_model t, imp_model *y, imp_model *z)
{
    imp_model sine, cosine;
    imp_model bent = clamp_to_range(*y, s->lo, s->hi), beyond = imp_sub(*y, bent);
    imp_model angle = imp_mul(polynomial_at(&s->curvature, 0, t), bent);
    imp_model m = imp_sub(bent, imp_mul(angle, *z));
    *z = imp_add(*z, imp_mul(m, cosc(angle)));
    *y = imp_mul(m, sinc(angle));
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
    from_center(s->center, x, y, z, w);
    bent[0] = near_dot(s->axis, w);
    bent[1] = near_dot(s->along, w);
    bent[2] = near_dot(s->side, w);
    bend_plane(s, t, &bent[1], &bent[2]);
    for (int i = 0; i < 3; ++i) out[i] = near_dot(s->column[i], bent);
    add_center(s->center, out);
}
IMP_MAP_FORMULA(bend_formula)
MAP_AT_ALL_TIMES(bend)

static const imp_map_type bend = {
    MAP_CALLS(bend, bend_formula),
    .rate = bend_formula_rate,
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
