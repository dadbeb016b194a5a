/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"

/* A point has no extent in u and v: its domain there is the single value 0. */

enum { POSITION, VELOCITY };

static const imp_parameter parameters[] = {
    [POSITION] = ROW_NEAR_VECTOR("position", "length", "[0,0,0]", 0, "position at t = 0"),
    [VELOCITY] = ROW_NEAR_VECTOR("velocity", "length/time", "[0,0,0]", 0, "constant velocity"),
};

static imp_status point_fill(linear *f, const imp_value *values, imp_create_error *why)
{
    (void)why;
    for (int i = 0; i < 3; ++i) {
        f->still[LINEAR_1][i] = values[POSITION].number[i];
        f->motion[LINEAR_1][i] = values[VELOCITY].number[i];
    }
    linear_finish(f);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(point, linear)

static void point_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 0, 0, 0);
}

static const imp_surface_type point = {
    IMP_SURFACE_FIELDS(point, linear),
    .renew = point_renew,
    .net = linear_net,
    .summary = "a single point, at rest or moving along a straight line",
    .equation = "position + t velocity; u = v = 0",
    .source = NULL,
    .formula = "u in [0, 0]; v in [0, 0]; position0 + velocity0*t; position1 + velocity1*t; "
               "position2 + velocity2*t",
    .example = "point position=1,2,3 velocity=0,0,-1",
};

PUBLISH_SURFACE(point);
