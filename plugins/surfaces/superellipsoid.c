/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/superquadric.h"

#include <impinge/formula.h>

enum { RADII, EXPONENTS, CENTER };

static const imp_parameter parameters[] = {
    [RADII] = IMP_ROW_POSITIVE_VECTOR("radii", "length", "[1,1,1]", "half axes along x, y and z"),
    [EXPONENTS] = ROW_EXPONENTS("[north-south, east-west] in (0,2]: 1 is round, near 0 square, "
                                "2 a bevel"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct superellipsoid_instance {
    double radii[3], center[3];
    superellipse meridian, parallel;
} superellipsoid_instance;

static imp_status superellipsoid_fill(superellipsoid_instance *s, const imp_value *values,
                                      imp_create_error *why)
{
    const imp_value *exponents = &values[EXPONENTS];
    imp_status status = superellipse_check_exponents(exponents, EXPONENTS, why);
    if (status != IMP_STATUS_OK) return status;
    imp_copy_vector(s->radii, &values[RADII]);
    imp_copy_vector(s->center, &values[CENTER]);
    s->meridian = superellipse_of(exponents->number[0]);
    s->parallel = superellipse_of(exponents->number[1]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(superellipsoid, superellipsoid_instance)

static void superellipsoid_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -IMP_HALF_PI_UPPER, IMP_HALF_PI_UPPER);
}

static void superellipsoid_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                   imp_model out[3])
{
    const superellipsoid_instance *s = self;
    imp_model x, y, ring, height;
    (void)t;
    superellipse_at(&s->parallel, u, &x, &y);
    superellipse_at(&s->meridian, v, &ring, &height);
    out[0] = imp_shift(imp_scale(imp_mul(ring, x), s->radii[0]), s->center[0]);
    out[1] = imp_shift(imp_scale(imp_mul(ring, y), s->radii[1]), s->center[1]);
    out[2] = imp_shift(imp_scale(height, s->radii[2]), s->center[2]);
}
IMP_SURFACE_FORMULA(superellipsoid_formula)

static const imp_surface_type superellipsoid = {
    IMP_SURFACE_FIELDS(superellipsoid, superellipsoid_formula),
    .renew = superellipsoid_renew,
    .summary = "superellipsoid, from boxes through ellipsoids to octahedra",
    .equation = "center + (a X_1(v) X_2(u), b X_1(v) Y_2(u), c Y_1(v)), radii = [a,b,c], (X_k, Y_k)"
                "(w) = (cos w, sin w) / (|cos w|^p + |sin w|^p)^(1/p), p = 2 / exponents_k, "
                "u in [0,2pi], v in [-pi/2,pi/2]",
    .source = "A. H. Barr, Superquadrics and angle-preserving transformations, IEEE CG&A 1 (1981)",
    /* No superellipse with p >= 1 is nearer to its centre than 1/sqrt(2): 0.5 is never reached, but
     * intervals of large regions know it by this. */
    .formula = "u in [0, 2*pi]; v in [-pi/2, pi/2]; meridian_power = 2/exponents0; meridian = "
               "max(0.5, (abs(cos(v))^meridian_power + "
               "abs(sin(v))^meridian_power)^(1/meridian_power)); parallel_power = "
               "2/exponents1; parallel = max(0.5, (abs(cos(u))^parallel_power + "
               "abs(sin(u))^parallel_power)^(1/parallel_power)); center0 + "
               "radii0*(cos(v)/meridian)*(cos(u)/parallel); center1 + "
               "radii1*(cos(v)/meridian)*(sin(u)/parallel); center2 + radii2*sin(v)/meridian",
    .example = "superellipsoid radii=1,1,2 exponents=0.3,1.5",
};

PUBLISH_SURFACE(superellipsoid);
