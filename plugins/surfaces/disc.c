/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/frame.h"
#include "plugins/common/publish.h"

enum { RADIUS, CENTER, AXIS };

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius"),
    [CENTER] = IMP_ROW_CENTER,
    [AXIS] = ROW_AXIS("axis", "[0,0,1]", "perpendicular to the disc; its length does not matter"),
};

typedef struct disc_instance {
    double radius, center[3], axis[3];
    frame frame;
} disc_instance;

static imp_status disc_fill(disc_instance *s, const imp_value *values, imp_create_error *why)
{
    const double *axis = values[AXIS].number;
    const imp_status status = axis_check(AXIS, axis, why);
    if (status != IMP_STATUS_OK) return status;
    s->radius = values[RADIUS].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    imp_copy_vector(s->axis, &values[AXIS]);
    s->frame =
        frame_about((const imp_model[]){imp_num(axis[0]), imp_num(axis[1]), imp_num(axis[2])});
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(disc, disc_instance)

static void disc_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, 0, 1);
}

/* v goes inward, so that f_u x f_v is along the axis. */
static void disc_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const disc_instance *s = self;
    (void)t;
    frame_ring(&s->frame, imp_scale(imp_shift(imp_neg(v), 1), s->radius), u, out);
    axis_add_center(s->center, out);
}
IMP_SURFACE_FORMULA(disc_formula)

/* k.(x - center), the signed distance from the plane, since |k| = 1. */
static imp_model disc_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const disc_instance *s = self;
    imp_model m[3];
    (void)t;
    axis_from_center(s->center, x, y, z, m);
    return axis_dot(s->frame.k, m);
}
IMP_DISTANCE_FORMULA(disc_gap)

static imp_status disc_symmetry(const void *self, imp_symmetry *symmetry)
{
    const disc_instance *s = self;
    symmetry->kind = IMP_SYMMETRY_ACROSS_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    memcpy(symmetry->center, s->center, sizeof s->center);
    memcpy(symmetry->axis, s->axis, sizeof s->axis);
    return IMP_STATUS_OK;
}

static imp_status disc_write_formula(const void *self, const imp_text_sink *to)
{
    const disc_instance *s = self;
    imp_add_text(to, "w0 = axis0; w1 = axis1; w2 = axis2; ");
    frame_write(&s->frame, to);
    imp_add_text(to, "u in [0, 2*pi]; v in [0, 1]; ring = (1 - v)*radius; center0 + "
                     "ring*(a0*cos(u) + b0*sin(u)); center1 + ring*(a1*cos(u) + b1*sin(u)); "
                     "center2 + ring*(a2*cos(u) + b2*sin(u))");
    return IMP_STATUS_OK;
}

static const imp_surface_type disc = {
    IMP_SURFACE_FIELDS(disc, disc_formula),
    .renew = disc_renew,
    .distance = disc_gap_distance,
    .symmetry = disc_symmetry,
    .write_formula = disc_write_formula,
    .summary = "flat disc across an axis",
    .equation =
        "center + (1-v) radius (a cos u + b sin u), u in [0,2pi], v in [0,1], where a, b and "
        "the axis are perpendicular to each other; a = x, b = y for the axis z",
    .source = NULL,
    .example = "disc radius=2 axis=1,0,1",
};

PUBLISH_SURFACE(disc);
