/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/linear.h"
#include "plugins/common/publish.h"

#include <impinge/formula_text.h>

/* A segment has no extent in v: its domain there is the single value 0. */

enum { POINTS, VELOCITIES };

static const imp_parameter parameters[] = {
    [POINTS] = ROW_CORNERS("points", "length", "[[0,0,0],[1,0,0]]", 2, 0,
                           "both ends [x,y,z] at t = 0; equal ends: a point"),
    [VELOCITIES] = ROW_CORNERS("velocities", "length/time", NULL, 2, IMP_PARAMETER_OPTIONAL,
                               "velocity of each end; default: at rest"),
};

static void set_ends(double term[LINEAR_TERMS][4], const double *ends)
{
    for (int i = 0; i < 3; ++i) {
        term[LINEAR_1][i] = ends[i];
        term[LINEAR_U][i] = ends[3 + i] - ends[i];
    }
}

static imp_status segment_fill(linear *f, const imp_value *values, imp_create_error *why)
{
    (void)why;
    set_ends(f->still, values[POINTS].number);
    if (imp_is_given(&values[VELOCITIES])) set_ends(f->motion, values[VELOCITIES].number);
    linear_finish(f);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(segment, linear)

static void segment_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 0);
}

/* The host has no numbers for velocities that were not given. */
static imp_status segment_write_formula(const void *self, const imp_text_sink *to)
{
    const linear *f = self;
    const bool moves = ((f->depends[0] | f->depends[1] | f->depends[2]) >> 2 & 1) != 0;
    imp_add_text(to, moves ? "u in [0, 1]; v in [0, 0]; (1 - u)*(points0 + velocities0*t) + "
                             "u*(points3 + velocities3*t); (1 - u)*(points1 + velocities1*t) + "
                             "u*(points4 + velocities4*t); (1 - u)*(points2 + velocities2*t) + "
                             "u*(points5 + velocities5*t)"
                           : "u in [0, 1]; v in [0, 0]; (1 - u)*points0 + u*points3; (1 - "
                             "u)*points1 + u*points4; (1 - u)*points2 + u*points5");
    return IMP_STATUS_OK;
}

static const imp_surface_type segment = {
    IMP_SURFACE_FIELDS(segment, linear),
    .renew = segment_renew,
    .net = linear_net,
    .write_formula = segment_write_formula,
    .summary = "straight segment between two ends that move linearly (edge-edge queries)",
    .equation = "(1-u) p_0(t) + u p_1(t), p_k(t) = points_k + t velocities_k, u in [0,1], v = 0",
    .source = NULL,
    .example = "segment points=[[0,0,0],[2,0,0]] velocities=[[0,0,0],[0,1,0]]",
};

PUBLISH_SURFACE(segment);
