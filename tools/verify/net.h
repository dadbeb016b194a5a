/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_NET_H
#define TOOLS_VERIFY_NET_H

#include "tools/proof/formula.h"

/* Control points of a surface over a box of u, v and t
 * =====================================================
 * Coordinates as polynomials in Bernstein form, whose values are convex combinations of the control
 * points: a polynomial of u, v and t exactly, all else as the Taylor polynomial of degree 2. The
 * numbers are doubles, rounded to nearest; what they are off by is bounded apart, and grows with
 * each step by a count of roundings. */

enum { NET_POINTS = 96, NET_TIMES = 5 };

typedef struct net {
    int n[3];            /* points along u, v and t */
    double lo[3], hi[3]; /* the box */
    double error[3];     /* of each control point and of all values, by coordinate */
    double size[3];      /* of the control points and of all values, their errors included */
    double share[3][3];  /* of the error, by coordinate and variable that it is due to, about */
    double blur[3];      /* of the error, what clocks other than t have made, about */
    double p[3 * NET_POINTS]; /* by coordinate, then u, then v, then t */
} net;

/* How a clock changes a motion from the middle to an end of its values. */
typedef struct motion_way {
    size_t clock;
    double m[3][4][3]; /* like those of the motion */
} motion_way;

/* x -> M x + d, whose numbers are polynomials of degree 2 in time, in Bernstein form: the sum of
 * those of the motion and, for each way, a factor in [-1, 1] times those of the way. */
typedef struct motion {
    double m[3][4][3];              /* by row and column, d being the last one */
    double error[3][4], size[3][4]; /* with all ways */
    double blur[3][4];              /* of the error, what clocks of ways have made, about */
    motion_way *ways;               /* NULL: none */
    size_t way_count;
} motion;

/* A net, and its motion over the times of the box; NULL: none. */
typedef struct form {
    const net *net;
    const motion *motion;
} form;

/* Returns the control points of a formula that is a polynomial of few terms, over the box, in
 * memory that the caller frees; NULL: it is none. */
net *net_of_formula(const formula *f, const double lo[3], const double hi[3]);

/* Takes over the box from lo to hi of a net that is known over a box around it. False: its points
 * are no numbers. */
bool net_restrict(const net *from, const double lo[3], const double hi[3], net *to);

/* Makes a net of a surface's jets over a box, and at its middle(). False: it has no bounds. */
bool net_of_jets(const jet wide[3], const jet centre[3], const double lo[3], const double hi[3],
                 net *to);

/* Makes one number of a motion, likewise, of jets of time alone. */
bool motion_of_jets(const jet *wide, const jet *centre, double lo, double hi,
                    double coefficients[3], double *error, double *size);

/* Bounds such a number by line[0] + s line[1], s from -1 at lo to 1 at hi, and an error. */
void motion_line_of_jets(const jet *wide, const jet *centre, double lo, double hi, double line[2],
                         double *error);

/* n.x of the control points, moved, and of bounds thereof. */
typedef struct reach {
    int n[3];
    double g[NET_POINTS * NET_TIMES]; /* of each point, but for an error: by u, then v, then t */
    double upper[NET_TIMES]; /* Bernstein coefficients over time of an upper bound, of degree 4 */
    double least;            /* of all points, about */
    double ends[2];          /* of corners at the first and the last time, the greatest, about */
    double error, share[3];  /* of the coefficients; by variable that it is due to, about */
    double blur;             /* of the error, by other clocks, about */
} reach;

/* way[k] becomes how far way k of the motion moves a point along n, at most, about; may be NULL. */
void net_along(const form *x, const double n[3], reach *r, double *way);

/* Takes the corners of the box, which are points of the surface, bits 0, 1 and 2 of their numbers
 * being the ends of u, v and t; and the middle of all control points. Returns how far a corner may
 * be off. */
double net_points(const form *x, double corner[8][3], double centre[3]);

#endif
