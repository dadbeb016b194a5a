/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_NEAREST_H
#define TOOLS_CHECK_NEAREST_H

#include "tools/check/subject.h"

/* Points of a surface, and how far other points are from them
 * ===========================================================
 * A distance is refuted by one point of the surface that is nearer than it. */

typedef struct spot {
    double p[3], x[3]; /* u, v, t and the point there; length */
    double error;      /* of all three coordinates together, at most; length */
} spot;

/* The point at at->p. False, without a failure, if eval has no finite answer there. */
bool spot_evaluate(const subject *s, spot *at);

/* At least the distance of x from the exact point of the spot. */
long double spot_apart_upper(const spot *at, const double x[3]);

/* The nearest point at time t that a grid and a pattern search find; the nearest point of all may
 * be elsewhere. False, without a failure, if there is none. */
bool spot_nearest(const subject *s, const double x[3], double t, spot *at);

/* Moves the spot, with the same search, to where the surface is nearer to x. */
void spot_search(const subject *s, const double x[3], spot *at);

/* The middle of the surface at time t and half the diagonal of its box, as a grid shows them.
 * False, without a failure, if it has no points then. */
bool spot_extent(const subject *s, double t, double middle[3], double *radius);

#endif
