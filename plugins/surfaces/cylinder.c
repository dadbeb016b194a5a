/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Only the lateral surface, without end discs: a thin body can pass through. */

enum { RADIUS, HEIGHT, CENTER };

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius"),
    [HEIGHT] = IMP_ROW_POSITIVE("height", "length", "2", "extent along the z axis"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "middle of the axis"),
};

typedef struct cylinder_instance {
    double radius, height, center[3];
} cylinder_instance;

static imp_status cylinder_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    cylinder_instance *s = malloc(sizeof *s);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->radius = values[RADIUS].number[0];
    s->height = values[HEIGHT].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    *self = s;
    return IMP_STATUS_OK;
}

static void cylinder_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -0.5, 0.5);
}

static void cylinder_formula(const void *self, imp_model u, imp_model v, imp_model t,
                             imp_model out[3])
{
    const cylinder_instance *s = self;
    imp_model sin_u, cos_u;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    out[0] = imp_shift(imp_scale(cos_u, s->radius), s->center[0]);
    out[1] = imp_shift(imp_scale(sin_u, s->radius), s->center[1]);
    out[2] = imp_shift(imp_scale(v, s->height), s->center[2]);
}
IMP_SURFACE_FORMULA(cylinder_formula)

/* From the axis, less the radius: the distance from the endless cylinder. */
static imp_model cylinder_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const cylinder_instance *s = self;
    (void)z, (void)t;
    const imp_model m[2] = {imp_shift(x, -s->center[0]), imp_shift(y, -s->center[1])};
    return beyond_radius(sum_of_squares(m, 2), s->radius);
}
IMP_DISTANCE_FORMULA(cylinder_gap)

static imp_status cylinder_symmetry(const void *self, imp_symmetry *symmetry)
{
    const cylinder_instance *s = self;
    symmetry->kind = IMP_SYMMETRY_ALONG_LINE;
    symmetry->is_closed = 1;
    symmetry->axis[2] = 1;
    memcpy(symmetry->center, s->center, sizeof s->center);
    return IMP_STATUS_OK;
}

static const imp_surface_type cylinder = {
    IMP_SURFACE_FIELDS(cylinder, cylinder_formula),
    .distance = cylinder_gap_distance,
    .symmetry = cylinder_symmetry,
    .summary = "lateral surface of a cylinder about the z axis, open at both ends",
    .equation = "center + (radius cos u, radius sin u, height v), u in [0,2pi], v in [-1/2,1/2]",
    .source = NULL,
    .example = "cylinder radius=0.5 height=3",
};

PUBLISH_SURFACE(cylinder);
