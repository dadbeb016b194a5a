/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "mistakes.h"

/* Each type is a surface in order, but not the one that is meant: only who states the formula and
 * the domain can tell. The last one is the tube itself. */

static void wrong_sign(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const tube *a = self;
    tube_formula(self, u, v, t, out);
    out[2] = imp_sub(imp_scale(v, 2), imp_poly(a->path, a->count, t));
}
IMP_SURFACE_FORMULA(wrong_sign)
MISTAKE_FORMULA(sign_wrong, wrong_sign);

static void degrees(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    tube_formula(self, imp_scale(u, 0.017453292519943295), v, t, out);
}
IMP_SURFACE_FORMULA(degrees)
MISTAKE_FORMULA(angle_in_degrees, degrees);

static void radius_one(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    tube a = *(const tube *)self;
    a.radius = 1;
    tube_formula(&a, u, v, t, out);
}
IMP_SURFACE_FORMULA(radius_one)
MISTAKE_FORMULA(radius_ignored, radius_one);

static void last_left_out(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    tube a = *(const tube *)self;
    if (a.count > 1) --a.count;
    tube_formula(&a, u, v, t, out);
}
IMP_SURFACE_FORMULA(last_left_out)
MISTAKE_FORMULA(list_read_too_short, last_left_out);

static void short_turn(const void *self, double lo[3], double hi[3])
{
    tube_domain(self, lo, hi);
    hi[0] = 6.28;
}
MISTAKE_DOMAIN(period_of_6_28, short_turn);

static void short_tube(const void *self, double lo[3], double hi[3])
{
    tube_domain(self, lo, hi);
    hi[1] = 1;
}
MISTAKE_DOMAIN(domain_too_short, short_tube);

MISTAKE_DOMAIN(no_mistake, tube_domain);

MISTAKES("mistakes_stated", &sign_wrong_type, &angle_in_degrees_type, &radius_ignored_type,
         &list_read_too_short_type, &period_of_6_28_type, &domain_too_short_type, &no_mistake_type);
