/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_COURSE_LINE_H
#define CORE_SURFACE_COURSE_LINE_H

#include "core/surface/surface.h"

/* Estimates of how one surface moves as another sees it, for surface_course.c, which proves it.
 * Nothing here is a bound. */

/* x = turn y + shift. */
typedef struct rigid_numbers {
    double turn[3][3], shift[3];
} rigid_numbers;

/* Computes what the maps of s from number `inner` on do at t, which are rigid. False: a callback
 * refuses. */
bool course_place_at(const surface *s, size_t inner, double t, rigid_numbers *place);

/* Sines below this give a line that is mostly rounding. */
#define SINE_LEAST 0x1p-6

/* Estimates the axis of the rotation from m0 to m1. Returns the sine of its angle: the larger, the
 * more accurate is the axis. 0: there is no rotation, and the axis is not set. */
double course_line_between(const rigid_numbers *m0, const rigid_numbers *m1, double center[3],
                           double axis[3]);

/* Whether poses at three of the times look like shifts, or like turns about lines of one direction:
 * few motions do, and to bound the course costs a hundred times as much. What b sees of a is of the
 * same kind. */
bool course_is_likely(const surface *a, const surface *b, const imp_region *times);

#endif
