/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_WALK_H
#define PLUGINS_SUBDIVISION_WALK_H

#include "plugins/subdivision/corner.h"
#include "plugins/subdivision/face.h"

/* From level to level toward a face's corner (0,0)
 * ================================================
 * Level k has the control points of what is left of the face there: of a quad the square u, v <=
 * 2^-k, of a triangle all of u <= 2^-k. */

typedef struct walk {
    const control_mesh *mesh;
    corner_points points;
    corner_frame frame, error; /* the limit point, and what it may be off */
    corner_net first, next[2];
    const corner_net *now;
    int level;
} walk;

void walk_begin(const face *q, walk *w);
void walk_again(walk *w);
void walk_step(walk *w);

/* Which parts of what there was before the last step something reaches into, along u (side 0) or v:
 * NEAR the corner, FAR from it. Along the v of a triangle there is one part, NEAR. */
enum { NEAR = 1, FAR = 2 };

int walk_parts(const walk *w, int side, double lo, double hi);

/* The share of a region in such parts. */
imp_region walk_part(const walk *w, const imp_region *region, int u, int v);

/* A part of the face as one of a quarter of the square before the last step, from 0 to 1 there:
 * exact, as 2^level is a power of two and a number from 1 to 2 less 1 is exact. */
double walk_local(const walk *w, double x, int part);

/* What the control points are relative to, and off by. */
void walk_place(const walk *w, rough_points *to);

#endif
