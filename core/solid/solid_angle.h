/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SOLID_ANGLE_H
#define CORE_SOLID_SOLID_ANGLE_H

#include "core/tree/vec.h"

/* Solid angles: how much of the sky around a point a surface covers, positive where its normal
 * points away from the point. A closed surface covers 4 pi from inside, 0 from outside. */

#define FULL_ANGLE 12.566370614359172 /* 4 pi, steradians */

/* A number, and a bound of how far the exact one is from it. A NaN decides nothing. */
typedef struct enclosed_angle {
    double angle, error; /* steradians */
} enclosed_angle;

/* Adds the solid angle, seen from x, of the plane triangle a, b, c, whose points are exact. The
 * error becomes large where x is too near for doubles to tell on which side it is. */
void solid_angle_add_triangle(enclosed_angle *sum, vec3 x, vec3 a, vec3 b, vec3 c);

/* Adds an error bound. */
void solid_angle_add_error(enclosed_angle *sum, double error);

#endif
