/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_CLOSEST_H
#define TOOLS_SIMULATE_CLOSEST_H

#include "tools/simulate/chart.h"

/* The nearest points of two patches, by Newton's method from points that are near
 * ==============================================================================
 * Four unknowns, two for each patch. The distance changes little where both points move alike, and
 * much where they part; so after each step the second point is moved to where it is nearest to the
 * first. The search ends where the line between the points is normal to both surfaces, as far as
 * rounding tells. Nothing of this is part of what is promised. */

typedef struct closest {
    chart chart[2];
    spot spot[2];
    jet jet[2]; /* at the two points */
} closest;

/* `p` are the (u, v) to start from. Codes of the library; `why` says more. */
imp_code closest_find(closest *out, const placed at[2], const imp_place place[2],
                      const double p[2][2], imp_error *why);

double closest_gap(const closest *n);

/* Unit, from the first to the second: the direction between the points; where one surface is flat
 * at its point, or much flatter than the other, its own normal, which rounding changes less. Right
 * at edges and corners, too. */
vec closest_normal(const closest *n);

/* Returns whether the patch of side k bends away from the plane of contact in all directions: by
 * more than `sag` within a sixteenth of its size. Then it touches at a single point. */
bool closest_is_round(const closest *n, int k, double sag);

/* The point of one patch that is nearest to x, from (u, v) on, which it changes. */
imp_code closest_project(const chart *c, double p[2], vec x, vec *found, imp_error *why);

#endif
