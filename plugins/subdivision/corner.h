/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_CORNER_H
#define PLUGINS_SUBDIVISION_CORNER_H

#include "plugins/subdivision/control_mesh.h"

#include <impinge/quad.h>

/* The control points that a face depends on
 * =========================================
 * Around a quad whose corners are at (0,0), (1,0), (1,1), (0,1) of a grid lie its neighbours, at -1
 * to 2. Where all corners are regular (four faces; two at the border; one at a corner of it) these
 * 4 by 4 points are those of a bicubic B-spline. Beyond a border there are none: a row p_-1 = 2 p_0
 * - p_1 there gives the border's rules, exactly: (p_-1 + 6 p_0 + p_1) / 8 = p_0.
 *
 * The corner at (0,0) may be extraordinary. Then the point at (-1,-1) means nothing, and the fan of
 * faces around the corner counts instead: its edges and diagonals. One step of subdivision leaves
 * such a neighbourhood of half the size, whose corner is the same; the other three quarters of the
 * quad are regular then (J. Stam, Exact evaluation of Catmull-Clark subdivision surfaces at
 * arbitrary parameter values, SIGGRAPH 1998).
 *
 * The corners of a triangle of Loop's are at (0,0), (1,0), (0,1) of a grid of triangles
 * (box_patch.h), and its neighbours at -1 to 2 with -1 <= x + y <= 2. Where all corners are regular
 * (six faces; three at the border; one at a corner of it) these 12 points are those of a quartic
 * box spline. Beyond a border edge p q of a face p q r lies p + q - r: that gives the border's
 * rules, exactly. All else is likewise, but a fan has no diagonals; three quarters of the triangle
 * are regular after a step. */

enum { CORNER_SIDE = 4, CORNER_FINE = 5 };

/* Numbers of points. */
typedef struct corner_points {
    bool is_loop;
    uint32_t grid[CORNER_SIDE]
                 [CORNER_SIDE]; /* at (x, y): [x + 1][y + 1]; CONTROL_NONE: not there */
    bool is_border[4];          /* the sides of the face, from (0,0) counterclockwise */
    unsigned missing
        [3];      /* of a triangle's corners, if regular: bit k: the neighbour in direction k, from
                            (1,0) counterclockwise, is beyond a border */
    bool has_fan; /* the rest; false: the corner is regular */
    int faces, edges, at; /* edges: faces, at a border one more; `at`: our face */
    uint32_t edge[CONTROL_VALENCE_MAX + 1], diagonal[CONTROL_VALENCE_MAX];
} corner_points;

/* The face of half-edge h, which begins at the corner (0,0); other corners are regular. */
void corner_find(const control_mesh *m, uint32_t h, corner_points *to);

/* Faces at a point as a surface that is smooth there has them. */
static inline bool corner_is_regular(const control_mesh *m, const control_point *p)
{
    if (m->loop != NULL) return p->is_border ? p->faces == 1 || p->faces == 3 : p->faces == 6;
    return p->is_border ? p->faces <= 2 : p->faces == 4;
}

/* The points themselves, at t = 0, and their velocities: `groups` quads each. */
enum { CORNER_GROUPS = 2, CORNER_LANES = CORNER_GROUPS * IMP_QUAD };

typedef struct corner_net {
    bool is_loop;
    int groups, faces, edges, at; /* faces is 0 where the corner is regular */
    bool is_border[4];            /* as in corner_points */
    unsigned missing[3];
    imp_quad grid[CORNER_FINE][CORNER_FINE]
                 [CORNER_GROUPS]; /* 4 by 4 at first, 5 by 5 after a step */
    imp_quad centre[CORNER_GROUPS];
    imp_quad edge[CONTROL_VALENCE_MAX + 1][CORNER_GROUPS];
    imp_quad diagonal[CONTROL_VALENCE_MAX][CORNER_GROUPS]; /* of quads */
    double most[CORNER_LANES];                             /* greatest |number| */
    double slip[CORNER_LANES]; /* at least |point - exact|, but for rows beyond a border */
} corner_net;

/* What the points and the velocities are relative to. */
typedef struct corner_frame {
    double place[3], drift[3];
} corner_frame;

/* Where an extraordinary corner lies on the surface, and its velocity, with their errors. */
void corner_limit(const corner_points *of, const control_mesh *m, corner_frame *limit,
                  corner_frame *error);

/* The points, relative to the frame. */
void corner_take(const corner_points *of, const control_mesh *m, const corner_frame *frame,
                 corner_net *to);

/* One step. */
void corner_step(const corner_net *from, corner_net *to);

/* What may be between a row beyond a border and twice the row at it less the next, in units of
 * 2^-53 `most`: one rounding, of three times `most` at its greatest, and where two rows meet of
 * nine times it. For triangles, p + q - r is rounded when it is twice and when it is three times
 * `most` at the greatest; at a corner of the border with one face, one of the three may be such a
 * point itself: 5, and 4 + 3. */
#define CORNER_REFLECTION (16 * 0x1p-53)

#endif
