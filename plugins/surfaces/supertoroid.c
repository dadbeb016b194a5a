/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/superquadric.h"

#include <impinge/formula.h>

enum { MAJOR_RADIUS, MINOR_RADIUS, EXPONENTS, CENTER };

static const imp_parameter parameters[] = {
    [MAJOR_RADIUS] =
        IMP_ROW_POSITIVE("major_radius", "length", "1",
                         "radius of the ring, to the middle of the tube, along x and y"),
    [MINOR_RADIUS] = IMP_ROW_POSITIVE(
        "minor_radius", "length", "0.25",
        "radius of the tube; if greater than major_radius, the surface intersects itself"),
    [EXPONENTS] = ROW_EXPONENTS("[of the tube, of the ring] in (0,2]: 1 is round, near 0 square, "
                                "2 a bevel"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct supertoroid_instance {
    double major_radius, minor_radius, center[3];
    superellipse tube, ring;
} supertoroid_instance;

static imp_status supertoroid_fill(supertoroid_instance *s, const imp_value *values,
                                   imp_create_error *why)
{
    const imp_value *exponents = &values[EXPONENTS];
    imp_status status = superellipse_check_exponents(exponents, EXPONENTS, why);
    if (status != IMP_STATUS_OK) return status;
    s->major_radius = values[MAJOR_RADIUS].number[0];
    s->minor_radius = values[MINOR_RADIUS].number[0];
    imp_copy_vector(s->center, &values[CENTER]);
    s->tube = superellipse_of(exponents->number[0]);
    s->ring = superellipse_of(exponents->number[1]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(supertoroid, supertoroid_instance)

static void supertoroid_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, 0, IMP_TWO_PI_UPPER);
}

static void supertoroid_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    const supertoroid_instance *s = self;
    imp_model x, y, width, height;
    (void)t;
    superellipse_at(&s->ring, u, &x, &y);
    superellipse_at(&s->tube, v, &width, &height);
    imp_model ring = imp_shift(imp_scale(width, s->minor_radius), s->major_radius);
    out[0] = imp_shift(imp_mul(ring, x), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, y), s->center[1]);
    out[2] = imp_shift(imp_scale(height, s->minor_radius), s->center[2]);
}
IMP_SURFACE_FORMULA(supertoroid_formula)

static const imp_surface_type supertoroid = {
    IMP_SURFACE_FIELDS(supertoroid, supertoroid_formula),
    .renew = supertoroid_renew,
    .summary = "supertoroid: a torus whose ring and tube are superellipses",
    .equation =
        "center + ((R + r X_1(v)) X_2(u), (R + r X_1(v)) Y_2(u), r Y_1(v)), R = major_radius, "
        "r = minor_radius, (X_k, Y_k)(w) = (cos w, sin w) / (|cos w|^p + |sin w|^p)^(1/p), "
        "p = 2 / exponents_k, u and v in [0,2pi]",
    .source = "A. H. Barr, Superquadrics and angle-preserving transformations, IEEE CG&A 1 (1981)",
    /* No superellipse with p >= 1 is nearer to its centre than 1/sqrt(2): 0.5 is never reached, but
     * intervals of large regions know it by this. */
    .formula = "u in [0, 2*pi]; v in [0, 2*pi]; tube_power = 2/exponents0; tube = max(0.5, "
               "(abs(cos(v))^tube_power + abs(sin(v))^tube_power)^(1/tube_power)); ring_power "
               "= 2/exponents1; ring = max(0.5, (abs(cos(u))^ring_power + "
               "abs(sin(u))^ring_power)^(1/ring_power)); width = major_radius + "
               "minor_radius*cos(v)/tube; center0 + width*cos(u)/ring; center1 + "
               "width*sin(u)/ring; center2 + minor_radius*sin(v)/tube",
    .example = "supertoroid major_radius=1 minor_radius=0.3 exponents=0.5,1",
};

PUBLISH_SURFACE(supertoroid);
