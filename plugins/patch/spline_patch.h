/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_SPLINE_PATCH_H
#define PLUGINS_PATCH_SPLINE_PATCH_H

#include "plugins/patch/rough_points.h"

/* A uniform bicubic B-spline patch
 * ================================
 * Made of 4 by 4 control points, on the stack, each time that something is asked of it:
 *
 *   f(u, v, t) = sum_ij N_i(u) N_j(v) (points_ij + t velocities_ij),   u and v in [0, 1],
 *
 * N: the four uniform cubic B-splines over one span. Point i, j is at index 4 i + j. */

enum { SPLINE_SIDE = 4, SPLINE_POINTS = SPLINE_SIDE * SPLINE_SIDE };

/* Evaluates one point with the contract of imp_surface_type.eval; error may not be NULL. */
void spline_point(const rough_points *data, const double p[3], double x[3], double error[3]);

/* Implement imp_surface_type.include and .net. */
imp_status spline_include(const rough_points *data, const imp_region *region, imp_model model[3]);
imp_status spline_net(const rough_points *data, const imp_region *region, imp_net *net);

#endif
