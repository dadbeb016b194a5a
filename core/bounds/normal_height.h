/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NORMAL_HEIGHT_H
#define CORE_BOUNDS_NORMAL_HEIGHT_H

#include "core/bounds/normal_turn.h"
#include "core/bounds/quadratic.h"

/* How high one surface lies above the other over a window
 * =======================================================
 * What normal_field.c and dividing_surface.c share: a height that is the sum of a part of A, a part
 * of B and a path, and the size of vectors along an axis. */

/* offset + drift w + bend w^2, and the parts of A and B at the start of the window and at its
 * end. */
typedef struct height {
    double offset, drift, bend;
    quadratics parts;
} height;

/* Returns the height, or its negative if B lies on that side at the focus. */
static inline height height_towards(const height *h, double focus)
{
    const quadratics *p = &h->parts;
    if (!(h->offset + (h->drift + h->bend * focus) * focus < 0)) return *h;
    return (height){-h->offset, -h->drift, -h->bend, {-p->bs, -p->br, -p->qss, -p->qsr, -p->qrr}};
}

/* The line middle + drift w, below a height of which each part is linear in w. */
typedef struct height_line {
    double middle, drift;
} height_line;

/* Computes the line, without rounding. False: it is nowhere above 0, or, unless `is_whole`, not
 * worth a slack. */
bool height_least(const height *h, bool is_whole, height_line *line);

/* Bounds |n|.x, x >= 0. */
static inline double weighted(vec3 n, const double *x)
{
    return fabs(n.x[0]) * x[0] + fabs(n.x[1]) * x[1] + fabs(n.x[2]) * x[2];
}

/* Bounds, along n, the edges of both remainders. */
double edges_upper(const difference *r, vec3 n);

/* Bounds, along n, how far the terms of second order of both slices change within the window. */
double bending_upper(const difference *r, vec3 n);

#endif
