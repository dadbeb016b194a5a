/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_BOX_PATCH_H
#define PLUGINS_PATCH_BOX_PATCH_H

#include "plugins/patch/rough_points.h"

/* A quartic box spline over one triangle, as a patch
 * ==================================================
 * On a grid of triangles, where each point (x, y) has the neighbours (x+1, y), (x, y+1), (x-1,
 * y+1), (x-1, y), (x, y-1) and (x+1, y-1), the limit of Loop's subdivision is a quartic box spline:
 * over the triangle of (0,0), (1,0), (0,1) a quartic polynomial of the twelve control points around
 * it (C. Loop, Smooth subdivision surfaces based on triangles, 1987). Polynomials of neighbours
 * have two derivatives in common.
 * It is evaluated over one of three areas, each of which is a square in s and w. A quartic
 * polynomial of what is bilinear in s and w is a patch of degrees 4 and 4:
 *
 *   BOX_WHOLE  the triangle, from its corner (0,0), with barycentric coordinates 1 - s, s (1 - w),
 *              s w as in triangle.h
 *   BOX_OUTER  the triangle P_0 P_1 P_2 as it lies in half a trapezoid: P_0 P_1 is its side w = 0
 *              and P_2 is at (1,1). At (0,1) is P_0 + (P_2 - P_1) / 2, beyond the triangle.
 *   BOX_INNER  the other triangle of the same half: P_0 at (0,0), P_1 at (1,1), and (0,1) is in the
 *              middle of P_0 P_2. At (1,0) is P_0 + P_1 - P_2, beyond the triangle.
 *
 * A triangle A B C halved has children at B and at C and one between; with the corner (u, v) = (0,
 * 0) at A, s = 2u - 1 and w = 2v, these two cover u >= 1/2, v <= 1/2, and meet in the curve (1 + s)
 * w = 2 s. Beyond it, polynomials go on, but are not the surface. */

enum {
    BOX_POINTS = 12,
    BOX_DEGREE = 4,
    BOX_SIDE = BOX_DEGREE + 1,
    BOX_NUMBERS = BOX_SIDE * BOX_SIDE
};

typedef enum box_area { BOX_WHOLE, BOX_OUTER, BOX_INNER, BOX_AREAS } box_area;

/* Where the control points lie, P_0 P_1 P_2 first. */
extern const int box_place[BOX_POINTS][2];

/* The patches of the twelve points, row by row: of their control points and of their Chebyshev
 * series. */
typedef struct box_tables {
    double net[BOX_AREAS][BOX_NUMBERS * BOX_POINTS], series[BOX_AREAS][BOX_NUMBERS * BOX_POINTS];
    double net_size[BOX_AREAS];      /* at least the sum of |entries| of any row */
    double series_size[BOX_AREAS];   /* of all rows together */
    double shift_error[BOX_NUMBERS]; /* of each number of a series, see patch_set_series */
} box_tables;

void box_make_tables(box_tables *to);

/* Twelve points and the area. `is_mirrored`: 1 - w replaces w. */
typedef struct box_data {
    const box_tables *tables;
    box_area area;
    bool is_mirrored;
    rough_points points;
} box_data;

/* Evaluates one point p = (s, w, t) in the triangle with the contract of imp_surface_type.eval;
 * error may not be NULL. */
void box_point(const box_data *data, const double p[3], double x[3], double error[3]);

/* Implement imp_surface_type.include and .net. Bounds over a region that reaches beyond the
 * triangle hold for the part that does not; a net's region must not reach beyond it. */
imp_status box_include(const box_data *data, const imp_region *region, imp_model model[3]);
imp_status box_net(const box_data *data, const imp_region *region, imp_net *net);

#endif
