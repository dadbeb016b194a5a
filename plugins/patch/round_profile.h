/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_ROUND_PROFILE_H
#define PLUGINS_PATCH_ROUND_PROFILE_H

#include "plugins/common/round_distance.h"

#include <stddef.h>

/* Profiles that are rational Bezier curves, and nearly straight lines or arcs of circles
 * ====================================================================================== */

/* Finds what a rational Bezier curve is that turns about the z axis. `points`: [r, z] of each of
 * the `count` control points, at most 21; weights, positive, may be NULL. Not kept. */
round_profile round_profile_of(const double *points, const double *weights, size_t count);

/* Adds another rational Bezier curve, given likewise, to a profile that is not ROUND_NONE: raises
 * `off` to what that curve is off by. */
void round_profile_widen(round_profile *p, const double *points, const double *weights,
                         size_t count);

#endif
