/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_SHADOW_H
#define TOOLS_VERIFY_SHADOW_H

#include "tools/verify/look.h"

/* How far one side reaches along a direction
 * ==========================================
 * Boxes of a surface's pieces, each projected on the direction; the box that reaches farthest is
 * divided, until what all of them reach is known well enough. */

typedef struct centre centre; /* round.h */

/* Each side's own direction of an axis: n of A, -n of B. Or away from a centre, n[0] = 1, or
 * towards it, n[0] = -1; where that is a line, n[0] and n[1] are any weights of the distance from
 * it and of the height along it (meridian.h), the signs of B's being opposite. */
typedef struct aim {
    double n[3];
    const centre *about; /* NULL: an axis */
    bool is_round;   /* of an axis: all angles count, of the map that turns most (orbit.h); and */
    bool circles;    /* of shapes whose points are circles */
    double at;       /* of a centre: the time at which distances are bounded; NAN: at all times */
    double times[2]; /* for which that one stands */
    double slip;     /* how much their squares change from that time, at most; */
    double lift;     /* and heights; where n[1] is 0, 0 */
    double radius;   /* of the middle, about */
} aim;

/* Whether an aim is bounded by jets, over boxes that are divided along t, too; else by control
 * points. */
static inline bool aim_is_of_jets(const aim *a) { return a->about != NULL || a->is_round; }

/* A box of a piece of one side, which may be divided while the other side is not; along u and v
 * alone where control points bound it. */
typedef struct area {
    place of;
    box3 where;
    double upper[NET_TIMES]; /* of n.x or the distance: Bernstein coefficients over time */
    double ends[2], least;   /* of points at the first and the last time, and of all, about */
} area;

typedef struct areas {
    area *at;
    size_t count, room;
    unsigned long cast; /* boxes projected so far: what a proof costs, about */
    memory *memory;
    split cut; /* where a formula begins or ends, by T or a clock; along < 0: nowhere */
} areas;       /* freed by free(at) */

void areas_begin(areas *all, memory *known);

/* NULL, or why not. Nothing is added where the surface does not exist, or where the cell has to be
 * divided in time. */
const char *areas_add(areas *all, const place *of, const box3 *where, const aim *a);

/* Divides an area along what it depends on most. Sets *divided to false if it cannot be divided,
 * or if time or another clock is to be divided. */
const char *areas_divide(areas *all, size_t index, const aim *a, bool *divided);

/* Computes how much an area depends on each variable, about; on t, where it is not linear in it.
 * clocks[k] becomes how much it depends on the values of each clock. */
void areas_sizes(const areas *all, size_t index, const aim *a, double size[VARIABLES],
                 double clocks[CLOCKS_MAX]);

/* How far a side reaches in its own direction. */
typedef struct limits {
    double upper[NET_TIMES], ends[2], least; /* of all areas */
    size_t worst[NET_TIMES];                 /* the area that has the bound */
} limits;

limits areas_limits(const areas *all);

/* Why a box of a surface is not known; NULL: it is. */
const char *shadow_why_unknown(enclosed result);

#endif
