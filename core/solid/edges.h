/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_EDGES_H
#define CORE_SOLID_EDGES_H

#include <stdint.h>

#include "core/base/union_find.h"
#include "core/solid/patches.h"

/* The edges of the patches of a body, and which of them run along each other
 * ========================================================================
 * Each patch has four edges, one for each side of its domain, traversed counter-clockwise in the
 * plane of u and v: v lowest, u highest, v highest, u lowest. Edges are compared by their points,
 * never by names or numbers: two edges are one seam if they run through the same points, in the
 * same or in the opposite direction. Points within `slack` of each other are the same. */

typedef struct edges {
    const patches *patches;
    vec3 *at;     /* steps + 1 points of each edge, in its direction */
    size_t count; /* 4 for each patch: number 4 p + k is side k of patch p */
    int steps;    /* even */
    double slack; /* > 0, length */
    bool bounded; /* all points are finite */
} edges;

/* Evaluates all edges; free them in any case. */
imp_code edges_read(edges *e, const patches *p, double slack, imp_error *error);
void edges_free(edges *e);

/* Returns the most memory that edges_read and edges_match take. */
size_t edges_bytes(size_t count);

static inline const vec3 *edge_points(const edges *e, size_t i)
{
    return e->at + i * (size_t)(e->steps + 1);
}

/* Returns whether the edge is a single point, as at the pole of a sphere. */
bool edge_is_point(const edges *e, size_t i);

/* Compares the points of two edges. 1: the two run through the same points in the same direction;
 * -1: in opposite ones; 0: neither. A point has no direction. */
int edge_compare(const edges *e, size_t i, size_t j);

/* Finds out whether point k of edge i lies on edge j. 1: it does, and the two run in the same
 * direction there; -1: in opposite directions; 0: it does not, or, between the ends of edge i, the
 * two lead in other directions. Evaluates the patch. */
int edge_passes(const edges *e, size_t i, int k, size_t j);

/* Sets partner[i], for each edge i that is no point, to the one other edge along the same seam.
 * SEAM_NONE: there is none. SEAM_EVEN, SEAM_ODD: there are several, and the seam has an even or an
 * odd number of edges, i counted; where it is odd, the patches cannot bound a volume, unless some
 * are copies of others (shared.h). Joins the sets of all patches along one seam, unless `sets` is
 * NULL. False: no memory. */
#define SEAM_NONE SIZE_MAX
#define SEAM_EVEN (SIZE_MAX - 1)
#define SEAM_ODD (SIZE_MAX - 2)
bool edges_match(const edges *e, size_t *partner, union_find *sets);

/* Sets *cancel to whether, at each seam of several edges, the edges of each shell run in opposite
 * directions in pairs, where patches of sign -1 run the other way round. False: no memory. */
bool edges_cancel(const edges *e, const size_t *partner, const imp_facing *facing, bool *cancel);

#endif
