/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { MAJOR_RADIUS, MINOR_RADIUS, CENTER };

static const imp_parameter parameters[] = {
    [MAJOR_RADIUS] = IMP_ROW_POSITIVE("major_radius", "length", "1",
                                      "radius of the ring, to the middle of the tube"),
    [MINOR_RADIUS] = IMP_ROW_POSITIVE(
        "minor_radius", "length", "0.25",
        "radius of the tube; if greater than major_radius, the surface intersects itself"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct torus_instance {
    double major_radius, minor_radius, center[3];
} torus_instance;

static imp_status torus_fill(torus_instance *s, const imp_value *values, imp_create_error *why)
{
    (void)why;
    s->major_radius = values[MAJOR_RADIUS].number[0];
    s->minor_radius = values[MINOR_RADIUS].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(torus, torus_instance)

static void torus_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, 0, IMP_TWO_PI_UPPER);
}

static void torus_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const torus_instance *s = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    imp_model ring = imp_shift(imp_scale(cos_v, s->minor_radius), s->major_radius);
    out[0] = imp_shift(imp_mul(ring, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), s->center[1]);
    out[2] = imp_shift(imp_scale(sin_v, s->minor_radius), s->center[2]);
}
IMP_SURFACE_FORMULA(torus_formula)

/* From the middle of the tube, less its radius. Lemma. Let points of space have cylindrical
 * coordinates (q, phi, z), q >= 0. Two of them are at least as far apart as their (q, z) are. Where
 * minor <= major, those of the torus are the circle of that radius around (major, 0); it intersects
 * itself otherwise, and that circle is not all. */
static imp_model torus_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const torus_instance *s = self;
    (void)t;
    if (s->minor_radius > s->major_radius) return imp_unbounded(0);
    const imp_model m[2] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1])};
    const imp_model w[2] = {imp_shift(imp_sqrt(sum_of_squares(m, 2)), -s->major_radius),
                            imp_shift(z, -s->center[2])};
    return beyond_radius(sum_of_squares(w, 2), s->minor_radius);
}
IMP_DISTANCE_FORMULA(torus_gap)

static imp_status torus_symmetry(const void *self, imp_symmetry *symmetry)
{
    const torus_instance *s = self;
    symmetry->kind = IMP_SYMMETRY_ABOUT_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    symmetry->axis[2] = 1;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

/* The middle of the tube: each of its points is that radius from it, also if it intersects
 * itself. */
static imp_status torus_tube(const void *self, const imp_region *region, imp_tube *tube)
{
    const torus_instance *s = self;
    imp_model sin_u, cos_u;
    imp_sincos(imp_param(region, 0), &sin_u, &cos_u);
    tube->line[0] = imp_shift(imp_scale(cos_u, s->major_radius), s->center[0]);
    tube->line[1] = imp_shift(imp_scale(sin_u, s->major_radius), s->center[1]);
    tube->line[2] = imp_num(s->center[2]);
    tube->radius = s->minor_radius;
    return imp_models_status(tube->line);
}

static const imp_surface_type torus = {
    IMP_SURFACE_FIELDS(torus, torus_formula),
    .renew = torus_renew,
    .distance = torus_gap_distance,
    .symmetry = torus_symmetry,
    .tube = torus_tube,
    .summary = "torus around the z axis; u runs around the ring, v around the tube",
    .equation = "center + ((R + r cos v) cos u, (R + r cos v) sin u, r sin v), R = major_radius, "
                "r = minor_radius, u and v in [0,2pi]",
    .source = NULL,
    .formula = "u in [0, 2*pi]; v in [0, 2*pi]; ring = major_radius + minor_radius*cos(v); "
               "center0 + ring*cos(u); center1 + ring*sin(u); center2 + minor_radius*sin(v)",
    .example = "torus major_radius=1 minor_radius=0.3",
};

PUBLISH_SURFACE(torus);
