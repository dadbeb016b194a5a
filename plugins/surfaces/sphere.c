/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { RADIUS, CENTER };

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct sphere_instance {
    double radius, center[3];
} sphere_instance;

static imp_status sphere_fill(sphere_instance *s, const imp_value *values, imp_create_error *why)
{
    (void)why;
    s->radius = values[RADIUS].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(sphere, sphere_instance)

/* The ranges of u and v are rounded outward, so that they cover the full turn and both poles,
 * without a gap. */
static void sphere_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -IMP_HALF_PI_UPPER, IMP_HALF_PI_UPPER);
}

static void sphere_formula(const void *self, imp_model u, imp_model v, imp_model t,
                           imp_model out[3])
{
    const sphere_instance *s = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    imp_model ring = imp_scale(cos_v, s->radius);
    out[0] = imp_shift(imp_mul(ring, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), s->center[1]);
    out[2] = imp_shift(imp_scale(sin_v, s->radius), s->center[2]);
}
IMP_SURFACE_FORMULA(sphere_formula)

/* From the centre, less the radius. */
static imp_model sphere_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const sphere_instance *s = self;
    (void)t;
    const imp_model m[3] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1]),
                            imp_shift(z, -s->center[2])};
    return beyond_radius(sum_of_squares(m, 3), s->radius);
}
IMP_DISTANCE_FORMULA(sphere_gap)

static imp_status sphere_symmetry(const void *self, imp_symmetry *symmetry)
{
    const sphere_instance *s = self;
    symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_ALL;
    symmetry->axis[2] = 1;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static const imp_surface_type sphere = {
    IMP_SURFACE_FIELDS(sphere, sphere_formula),
    .renew = sphere_renew,
    .distance = sphere_gap_distance,
    .symmetry = sphere_symmetry,
    .summary = "sphere by longitude u and latitude v",
    .equation =
        "center + radius (cos v cos u, cos v sin u, sin v), u in [0,2pi], v in [-pi/2,pi/2]",
    .source = NULL,
    .formula = "u in [0, 2*pi]; v in [-pi/2, pi/2]; center0 + radius*cos(v)*cos(u); "
               "center1 + radius*cos(v)*sin(u); center2 + radius*sin(v)",
    .example = "sphere radius=2 center=0,0,1",
};

PUBLISH_SURFACE(sphere);
