/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_SHADOW_H
#define TOOLS_VERIFY_SHADOW_H

#include "tools/verify/enclose.h"

/* How far one side reaches along a direction
 * ==========================================
 * Boxes of a surface's pieces, each enclosed and projected on the direction; the box that reaches
 * farthest is divided, until what all of them reach is known well enough. */

/* --- Enclosures ------------------------------------------------------------------------------- */

enum { KEPT = 1024 }; /* a power of 2 */

/* An enclosure that was computed before. */
typedef struct kept {
    const chain *chain; /* NULL: none */
    size_t piece, maps;
    box3 where;
    enclosed result;
    split divide;
    double c[3];
    jet box[3], centre[3]; /* about the point c */
} kept;

/* Returns the enclosure of a box of a piece, computed or found among the last ones. Another call
 * may overwrite it. `memory`: KEPT entries. */
const kept *kept_look(kept *memory, const place *of, const box3 *where);

/* Returns the middle of an interval, within it. */
static inline double middle(double lo, double hi)
{
    const double mid = 0.5 * lo + 0.5 * hi;
    return mid < lo ? lo : mid > hi ? hi : mid;
}

/* --- Shadows ---------------------------------------------------------------------------------- */

typedef struct centre centre; /* round.h */

/* The direction in which a side's reach is measured: n for A, -n for B. A line in time that both
 * sides have in common is subtracted, and cancels. With a centre: away from it if n[0] > 0, else
 * towards it. */
typedef struct aim {
    double n[3], slope, mid;
    const centre *about; /* NULL: an axis */
} aim;

/* n.x - slope (t - mid), or the distance from the centre, over a box of one side. */
typedef struct shadow {
    double lo, hi;          /* bounds */
    double value;           /* at the centre, about */
    double size[VARIABLES]; /* how much it depends on each variable, about */
} shadow;

/* A box of a piece of one side, which may be divided while the other side is not. */
typedef struct area {
    place of;
    box3 where;
    shadow s;
} area;

typedef struct areas {
    area *at;
    size_t count, room;
    unsigned long cast; /* boxes projected so far: what a proof costs, about */
    kept *memory;
} areas; /* freed by free(at) */

/* Adds an area; nothing is added where the surface does not exist. Returns NULL, or why the area
 * has no enclosure. */
const char *areas_add(areas *all, const place *of, const box3 *where, const aim *a);

/* Divides an area along what it depends on most. Sets *divided to false if it cannot be divided. */
const char *areas_divide(areas *all, size_t index, const aim *a, bool *divided);

/* How far a side reaches in its own direction. */
typedef struct reach {
    double bound, value; /* of all boxes, and at their centres, about */
    size_t worst;        /* the area that has the bound */
} reach;

reach areas_reach(const areas *all);

/* Returns why a box of a surface has no enclosure; NULL: it has one. */
const char *shadow_why_unknown(enclosed result);

#endif
