/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_CHART_H
#define TOOLS_SIMULATE_CHART_H

#include "tools/simulate/placed.h"

/* Coordinates of a patch in which Newton's method works
 * =====================================================
 * The parameters (u, v) of a patch may be closed (the ends of a full turn are the same points), and
 * an end of one of them may be a single point about which the other makes a full turn: a pole, as
 * of a sphere. Near a pole the coordinates are those of a plane in which the distance from the pole
 * is the one parameter and the angle the other; elsewhere they are (u, v), which go on beyond the
 * ends of closed parameters. */

typedef struct chart {
    const placed *at;
    imp_place place;
    double lo[2], hi[2];
    bool closed[2];
    bool pole[2][2]; /* [k][e]: the end e of parameter k is a pole */
} chart;

/* A point of a patch and the coordinates around it. */
typedef struct spot {
    double p[2]; /* (u, v), within the domain */
    double q[2]; /* the coordinates of this point */
    int polar;   /* the parameter that is a distance from a pole, or -1 */
    int end;     /* the end of it that is the pole */
} spot;

imp_code chart_make(chart *c, const placed *at, imp_place place, imp_error *why);

/* Returns the spot at (u, v). */
spot chart_spot(const chart *c, const double p[2]);

/* (u, v) of coordinates around a spot. Where they are outside of the domain, *p is on its rim. */
void chart_parameters(const chart *c, const spot *s, const double q[2], double p[2]);

/* The range of the coordinate k at a spot, perhaps infinite, and a length that is natural to it. */
void chart_range(const chart *c, const spot *s, int k, double *lo, double *hi);
double chart_width(const chart *c, const spot *s, int k);

/* A point and its derivatives by the two coordinates at a spot. */
typedef struct jet {
    vec x, by[2], second[3]; /* second: by 00, 01, 11 */
} jet;
imp_code chart_jet(const chart *c, const spot *s, jet *j, imp_error *why);

#endif
