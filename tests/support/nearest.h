/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_NEAREST_H
#define TESTS_SUPPORT_NEAREST_H

#include "tests/support/type_oracle.h"

/* Distances of points from surfaces that have no closed form: from the nearest point that a search
 * finds. It is a point of the surface, and so no nearer than the nearest. */
number nearest_of_thread(const type_arguments *arguments, const number x[3]); /* endless */
number nearest_of_ellipsoid(const type_arguments *arguments, const number x[3]);

/* Points of these, about, from the centre: v is the height along the axis, or the latitude. */
void nearest_thread_point(const type_arguments *arguments, double u, double v, double x[3]);
void nearest_ellipsoid_point(const type_arguments *arguments, double u, double v, double x[3]);

#endif
