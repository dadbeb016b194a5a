/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_ROUGH_POINTS_H
#define PLUGINS_PATCH_ROUGH_POINTS_H

#include "plugins/patch/patch.h"

#include <impinge/quad.h>

/* Control points of a spline that are known but for a slip
 * ========================================================
 * From them a patch is made on the stack each time that something is asked of it: a uniform bicubic
 * B-spline (spline_patch.h) or a quartic box spline (box_patch.h). Both are means of their control
 * points, so what holds of the spline of these points holds of all whose points are within `slip`
 * and `slip_motion` of them, once it is widened by as much. */

enum { ROUGH_POINTS_MAX = 16 };

typedef struct rough_points {
    imp_quad points[ROUGH_POINTS_MAX], velocities[ROUGH_POINTS_MAX]; /* x, y, z, 0 */
    bool moves;                /* false: velocities are not read */
    double place[3], drift[3]; /* to be added to each point and each velocity */
    double slip[3], slip_motion[3];
} rough_points;

/* Differences of control points next to each other, which a derivative is a mean of, are off by so
 * many slips at most. Beyond a border points are p + q - r of others: along it, a difference is one
 * of four points and of two more. */
enum { ROUGH_SLOPE = 6 };

/* Sets all of a patch but degrees, net and what comes of these: lanes, place, drift, their radii
 * and `most` are of the first `count` points, units is 2. `net` gets the points less their middle,
 * of all lanes. A point may itself be the difference of two, which the caller counts. */
void rough_begin(const rough_points *data, int count, patch *f, imp_quad *net);

/* At least |exact - patch| where |t| <= late: the points' slip, and the rounding of place and
 * drift. */
double rough_slip_upper(const rough_points *data, const patch *f, int axis, double late);

/* At least, for one lane group, the greatest slope of the splines whose points are meant, from that
 * of the points as they are. */
imp_quad rough_slope_upper(const rough_points *data, const patch *f, int group, imp_quad slope);

/* Makes bounds of the patch such of the splines that are meant. */
void rough_widen_model(const rough_points *data, const patch *f, const imp_region *region,
                       imp_model model[3]);
void rough_widen_net(const rough_points *data, const patch *f, const imp_region *region,
                     imp_net *net);

#endif
