/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The pipe of pipe.h, once with its true distance and symmetry, and with lies about them that show
 * in few places: far away, late, in a narrow spot, along an axis. */

static bool is_beyond(const imp_model point[4], double radius)
{
    return point[0].a * point[0].a + point[1].a * point[1].a > radius * radius;
}

/* The true distance, times `factor`. */
static imp_status scaled(const void *self, const imp_model point[4], imp_model *g, double factor)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    *g = imp_scale(*g, factor);
    return status;
}

/* 1 % too large from 4 radii outward. */
static imp_status far_distance(const void *self, const imp_model point[4], imp_model *g)
{
    return scaled(self, point, g, is_beyond(point, 4) ? 1.01 : 1);
}

/* 10 % too large beyond 30 radii. */
static imp_status farther_distance(const void *self, const imp_model point[4], imp_model *g)
{
    return scaled(self, point, g, is_beyond(point, 30) ? 1.1 : 1);
}

/* A ten-millionth too large beyond a thousand radii. */
static imp_status farthest_distance(const void *self, const imp_model point[4], imp_model *g)
{
    return scaled(self, point, g, is_beyond(point, 1000) ? 1 + 1e-7 : 1);
}

/* 5 % too large after t = 50. */
static imp_status late_distance(const void *self, const imp_model point[4], imp_model *g)
{
    return scaled(self, point, g, point[3].a > 50 ? 1.05 : 1);
}

/* 5 % too large before t = -50. */
static imp_status early_distance(const void *self, const imp_model point[4], imp_model *g)
{
    return scaled(self, point, g, point[3].a < -50 ? 1.05 : 1);
}

/* 10 % too large within 0.03 of one point of the pipe: beside one part in 3,500 of it. */
static imp_status spot_distance(const void *self, const imp_model point[4], imp_model *g)
{
    const bool inside =
        fabs(point[0].a - 1) < 0.03 && fabs(point[1].a) < 0.03 && fabs(point[2].a - 1.2) < 0.03;
    return scaled(self, point, g, inside ? 1.1 : 1);
}

/* Beyond the pipe's ends the axial distance is added twice. */
static imp_status axial_distance(const void *self, const imp_model point[4], imp_model *g)
{
    const imp_status status = pipe_gap_distance(self, point, g);
    if (point[2].a > 20) *g = imp_add(*g, imp_scale(point[2], 2));
    return status;
}

static const imp_symmetry axis = {.kind = IMP_SYMMETRY_ALONG_LINE, .axis = {0, 0, 1}};

static imp_status symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    *found = axis;
    return IMP_STATUS_OK;
}

/* Claims that the pipe can be moved across its axis, like a flat plate. */
static imp_status plate_symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    *found = axis;
    found->kind = IMP_SYMMETRY_ACROSS_LINE;
    return IMP_STATUS_OK;
}

/* An axis that is off by a millionth. */
static imp_status leaning_symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    *found = axis;
    found->axis[0] = 1e-6;
    return IMP_STATUS_OK;
}

/* Far from the axis the true distance from the pipe, which ends: less is known beside it than
 * beyond its ends, and so nothing moves along the axis. */
static imp_status ended_distance(const void *self, const imp_model point[4], imp_model *g)
{
    if (point[2].a < 100) return pipe_gap_distance(self, point, g);
    *g = imp_shift(point[2], -2);
    return IMP_STATUS_OK;
}

/* Half of the pipe, y >= 0, and its true distance, that from its edges where y < 0. It says that it
 * can be turned. */
static void half_domain(const void *self, double lo[3], double hi[3])
{
    pipe_domain(self, lo, hi);
    hi[0] = IMP_PI_UPPER;
}

static imp_status half_distance(const void *self, const imp_model point[4], imp_model *g)
{
    if (point[1].hi > 0) return pipe_gap_distance(self, point, g);
    const imp_model from[3] = {imp_shift(imp_abs(point[0]), -1), point[1], imp_num(0)};
    *g = imp_sqrt(imp_dot3(from, from));
    return g->e < INFINITY ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* Claims of a pipe that goes three quarters around that its rotations take it to itself. */
static void open_domain(const void *self, double lo[3], double hi[3])
{
    pipe_domain(self, lo, hi);
    hi[0] = 1.5 * IMP_PI_UPPER;
}

static imp_status closed_symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    *found = axis;
    found->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    return IMP_STATUS_OK;
}

/* Claims that turning about the axis takes points along it to each other. */
static imp_status orbit_symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    *found = axis;
    found->is_closed = IMP_SYMMETRY_ORBIT_V;
    return IMP_STATUS_OK;
}

static const imp_surface_type symmetry_open_type = {.struct_size = sizeof(imp_surface_type),
                                                    .parameter_size = sizeof(imp_parameter),
                                                    .name = "symmetry_open",
                                                    .summary = "a pipe with a slit",
                                                    .equation = "(cos u, sin u, v)",
                                                    .example = "symmetry_open",
                                                    .create = tiny_create,
                                                    .destroy = tiny_destroy,
                                                    .domain = open_domain,
                                                    .eval = pipe_formula_eval,
                                                    .rate = pipe_formula_rate,
                                                    .include = pipe_formula_include,
                                                    .distance = pipe_gap_distance,
                                                    .symmetry = closed_symmetry};

static const imp_surface_type symmetry_half_type = {.struct_size = sizeof(imp_surface_type),
                                                    .parameter_size = sizeof(imp_parameter),
                                                    .name = "symmetry_half",
                                                    .summary = "half a pipe",
                                                    .equation = "(cos u, sin u, v)",
                                                    .example = "symmetry_half",
                                                    .create = tiny_create,
                                                    .destroy = tiny_destroy,
                                                    .domain = half_domain,
                                                    .eval = pipe_formula_eval,
                                                    .rate = pipe_formula_rate,
                                                    .include = pipe_formula_include,
                                                    .distance = half_distance,
                                                    .symmetry = symmetry};

static void zone_domain(const void *self, double lo[3], double hi[3])
{
    pipe_domain(self, lo, hi);
    lo[1] = 0;
    hi[1] = 0.5 * IMP_PI_UPPER;
}

static void zone_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    imp_model sine[2], cosine[2];
    (void)self, (void)t;
    imp_sincos(u, &sine[0], &cosine[0]);
    imp_sincos(v, &sine[1], &cosine[1]);
    out[0] = imp_mul(cosine[1], cosine[0]);
    out[1] = imp_mul(cosine[1], sine[0]);
    out[2] = sine[1];
}
IMP_SURFACE_FORMULA(zone_formula)

static imp_model zone_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const imp_model m[3] = {x, y, z};
    (void)self, (void)t;
    return imp_shift(imp_sqrt(imp_dot3(m, m)), -1);
}
IMP_DISTANCE_FORMULA(zone_gap)

static imp_status zone_symmetry(const void *self, imp_symmetry *symmetry)
{
    (void)self;
    symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = IMP_SYMMETRY_ZONE;
    symmetry->axis[0] = 1;
    return IMP_STATUS_OK;
}

static const imp_surface_type symmetry_zone_type = {.struct_size = sizeof(imp_surface_type),
                                                    .parameter_size = sizeof(imp_parameter),
                                                    .name = "symmetry_zone",
                                                    .summary = "half a sphere, about another axis",
                                                    .equation = "(cos v cos u, cos v sin u, sin v)",
                                                    .example = "symmetry_zone",
                                                    .create = tiny_create,
                                                    .destroy = tiny_destroy,
                                                    .domain = zone_domain,
                                                    .eval = zone_formula_eval,
                                                    .rate = zone_formula_rate,
                                                    .include = zone_formula_include,
                                                    .distance = zone_gap_distance,
                                                    .symmetry = zone_symmetry};

#define MISTAKEN(NAME, DISTANCE, SYMMETRY)                                                         \
    static const imp_surface_type NAME##_type = PIPE_TYPE(#NAME, DISTANCE, SYMMETRY)
MISTAKEN(distance_no_mistake, pipe_gap_distance, closed_symmetry);
MISTAKEN(distance_far, far_distance, NULL);
MISTAKEN(distance_farther, farther_distance, NULL);
MISTAKEN(distance_farthest, farthest_distance, NULL);
MISTAKEN(distance_late, late_distance, NULL);
MISTAKEN(distance_early, early_distance, NULL);
MISTAKEN(distance_spot, spot_distance, NULL);
MISTAKEN(distance_axial, axial_distance, symmetry);
MISTAKEN(symmetry_plate, pipe_gap_distance, plate_symmetry);
MISTAKEN(symmetry_orbit, pipe_gap_distance, orbit_symmetry);
MISTAKEN(symmetry_leaning, pipe_gap_distance, leaning_symmetry);
MISTAKEN(symmetry_ended, ended_distance, symmetry);

static const imp_surface_type *const types[] = {
    &distance_no_mistake_type, &distance_far_type,   &distance_farther_type,
    &distance_farthest_type,   &distance_late_type,  &distance_early_type,
    &distance_spot_type,       &distance_axial_type, &symmetry_plate_type,
    &symmetry_leaning_type,    &symmetry_ended_type, &symmetry_half_type,
    &symmetry_open_type,       &symmetry_orbit_type, &symmetry_zone_type};
static const imp_surface_factory factory = {sizeof factory, sizeof types / sizeof *types, types};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_SURFACE_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("mistakes_distance", "1.0", "Apache-2.0", "tests", get_factory);
