/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_CURVE_H
#define PLUGINS_PATCH_CURVE_H

#include "plugins/patch/parameters.h"

#include <impinge/model.h>
#include <impinge/plugin.h>

/* Bezier curves, polynomial or rational, in the plane or in space
 * ===============================================================
 * A curve is a patch of degrees n and 0 (patch.h). It is used inside a formula: curve_at returns
 * the models of its coordinates for a parameter of the region, or for a number. */

#define ROW_CURVE_WEIGHTS(NAME, CURVE)                                                             \
    ROW_PATCH_WEIGHTS(NAME, "one per point of " CURVE ", for a rational curve; left out: all 1")

/* From 2 control points on, and as many weights, if any. */
imp_status curve_check(const imp_value *values, int points, int weights, imp_create_error *why);

/* A curve of checked values; in the plane, the third coordinate is 0. NULL: no memory. free() it.
 */
patch *curve_new(const imp_value *points, const imp_value *weights);

/* s is an exact number, or u (j = 0) or v (j = 1) over a region: within [0, 1]. */
void curve_at(const patch *f, imp_model s, int j, imp_model out[3]);

#endif
