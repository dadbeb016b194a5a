/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_POLYGON_H
#define TOOLS_SIMULATE_POLYGON_H

#include <stdbool.h>
#include <stddef.h>

/* Convex polygons in a plane, counter-clockwise. One or two corners are a point and a segment. */

typedef struct point2 {
    double x[2];
} point2;

enum { POLYGON_MAX = 48 };

typedef struct polygon {
    size_t count; /* 0: nothing */
    point2 at[POLYGON_MAX];
} polygon;

/* Returns the convex hull of n points, which it sorts; of a hull with more corners than there is
 * room for, the largest part. */
polygon polygon_hull(point2 *points, size_t n);

/* Returns the sum of a polygon and a square of half the width `by` about the origin. */
polygon polygon_grow(const polygon *p, double by);

/* Returns what two polygons with an area have in common. */
polygon polygon_intersect(const polygon *a, const polygon *b);

/* Removes corners that are no farther than that from another corner, or from the segment between
 * their neighbours. */
void polygon_simplify(polygon *p, double distance);

/* Removes corners until there are at most `most`: always that which takes the least area away. */
void polygon_reduce(polygon *p, size_t most);

#endif
