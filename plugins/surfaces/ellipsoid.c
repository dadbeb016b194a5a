/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { RADII, CENTER };

static const imp_parameter parameters[] = {
    [RADII] =
        IMP_ROW_POSITIVE_VECTOR("radii", "length", "[1,0.75,0.5]", "half axes along x, y and z"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct ellipsoid_instance {
    double radii[3], center[3];
} ellipsoid_instance;

static imp_status ellipsoid_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    ellipsoid_instance *s = malloc(sizeof *s);
    if (s == NULL) return IMP_INTERNAL;
    imp_copy_vector(s->radii, &values[RADII]);
    imp_copy_vector(s->center, &values[CENTER]);
    *self = s;
    return IMP_OK;
}

static void ellipsoid_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -IMP_HALF_PI_UPPER, IMP_HALF_PI_UPPER);
}

static void ellipsoid_formula(const void *self, imp_model u, imp_model v, imp_model t,
                              imp_model out[3])
{
    const ellipsoid_instance *s = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    out[0] = imp_shift(imp_scale(imp_mul(cos_v, cos_u), s->radii[0]), s->center[0]);
    out[1] = imp_shift(imp_scale(imp_mul(cos_v, sin_u), s->radii[1]), s->center[1]);
    out[2] = imp_shift(imp_scale(sin_v, s->radii[2]), s->center[2]);
}
IMP_SURFACE_FORMULA(ellipsoid_formula)

static const imp_surface_type ellipsoid = {
    IMP_SURFACE_FIELDS(ellipsoid, ellipsoid_formula),
    .summary = "ellipsoid with its axes along x, y and z",
    .equation = "center + (a cos v cos u, b cos v sin u, c sin v), radii = [a,b,c], u in [0,2pi], "
                "v in [-pi/2,pi/2]",
    .source = NULL,
    .example = "ellipsoid radii=1,2,3",
};

PUBLISH_SURFACE(ellipsoid);
