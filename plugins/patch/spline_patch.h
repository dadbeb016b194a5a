/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_SPLINE_PATCH_H
#define PLUGINS_PATCH_SPLINE_PATCH_H

#include "plugins/patch/patch.h"

#include <impinge/quad.h>

/* A uniform bicubic B-spline patch
 * ================================
 * Made of 4 by 4 control points, on the stack, each time that something is asked of it:
 *
 *   f(u, v, t) = sum_ij N_i(u) N_j(v) (points_ij + t velocities_ij),   u and v in [0, 1],
 *
 * N: the four uniform cubic B-splines over one span. Point i, j is at index 4 i + j. The points need not
 * be known exactly: what follows holds for all that are within `slip` and `slip_motion` of them. */

enum { SPLINE_SIDE = 4, SPLINE_POINTS = SPLINE_SIDE * SPLINE_SIDE };

typedef struct spline_data {
    imp_quad points[SPLINE_POINTS], velocities[SPLINE_POINTS]; /* x, y, z, 0 */
    bool moves;                                                /* false: velocities are not read */
    double place[3], drift[3]; /* to be added to each point and each velocity */
    double slip[3], slip_motion[3];
} spline_data;

/* As imp_surface_type.eval, for one point; error may not be NULL. */
void spline_point(const spline_data *data, const double p[3], double x[3], double error[3]);

/* As imp_surface_type.include, and .net. */
imp_status spline_include(const spline_data *data, const imp_region *region, imp_model model[3]);
imp_status spline_net(const spline_data *data, const imp_region *region, imp_net *net);

#endif
