/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"

#include <impinge/formula_text.h>

/* The square of u and v is mapped to the triangle by collapsing the edge u = 0 into corner 0. */

enum { POINTS, VELOCITIES };

static const imp_parameter parameters[] = {
    [POINTS] = ROW_CORNERS("points", "length", "[[0,0,0],[1,0,0],[0,1,0]]", 3, 0,
                           "three corners [x,y,z] at t = 0; collinear corners: a segment"),
    [VELOCITIES] = ROW_CORNERS("velocities", "length/time", NULL, 3, IMP_PARAMETER_OPTIONAL,
                               "velocity of each corner; default: at rest"),
};

static void set_corners(double term[LINEAR_TERMS][4], const double *corners)
{
    for (int i = 0; i < 3; ++i) {
        term[LINEAR_1][i] = corners[i];
        term[LINEAR_U][i] = corners[3 + i] - corners[i];
        term[LINEAR_UV][i] = corners[6 + i] - corners[3 + i];
    }
}

static imp_status triangle_fill(linear *f, const imp_value *values, imp_create_error *why)
{
    (void)why;
    set_corners(f->still, values[POINTS].number);
    if (imp_is_given(&values[VELOCITIES])) set_corners(f->motion, values[VELOCITIES].number);
    linear_finish(f);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(triangle, linear)

static void triangle_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

/* The host has no numbers for velocities that were not given. */
static imp_status triangle_write_formula(const void *self, const imp_text_sink *to)
{
    const linear *f = self;
    const bool moves = ((f->depends[0] | f->depends[1] | f->depends[2]) >> 2 & 1) != 0;
    imp_add_text(to, moves ? "u in [0, 1]; v in [0, 1]; (1 - u)*(points0 + velocities0*t) + "
                             "u*((1 - v)*(points3 + velocities3*t) + v*(points6 + "
                             "velocities6*t)); (1 - u)*(points1 + velocities1*t) + u*((1 - "
                             "v)*(points4 + velocities4*t) + v*(points7 + velocities7*t)); (1 - "
                             "u)*(points2 + velocities2*t) + u*((1 - v)*(points5 + "
                             "velocities5*t) + v*(points8 + velocities8*t))"
                           : "u in [0, 1]; v in [0, 1]; (1 - u)*points0 + u*((1 - v)*points3 + "
                             "v*points6); (1 - u)*points1 + u*((1 - v)*points4 + v*points7); (1 "
                             "- u)*points2 + u*((1 - v)*points5 + v*points8)");
    return IMP_STATUS_OK;
}

static const imp_surface_type triangle = {
    IMP_SURFACE_FIELDS(triangle, linear),
    .renew = triangle_renew,
    .net = linear_net,
    .write_formula = triangle_write_formula,
    .summary = "triangle whose corners move linearly (vertex-face queries)",
    .equation = "p_0(t) + u (p_1(t) - p_0(t) + v (p_2(t) - p_1(t))), p_k(t) = points_k + t "
                "velocities_k, u and v in [0,1]",
    .source = NULL,
    .example = "triangle points=[[0,0,0],[1,0,0],[0,1,0]] velocities=[[0,0,1],[0,0,1],[0,0,2]]",
};

PUBLISH_SURFACE(triangle);
