/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_ASIDE_H
#define CORE_SURFACE_ASIDE_H

#include "core/surface/surface.h"

/* Motion that two surfaces share, but not at the end of their maps
 * ================================================================
 * A box that turns and then slides along the axis turns like one that only turns, since turns about
 * a line and shifts along it commute. Such maps may be set aside, and so may maps that cancel each
 * other, or that together do what maps of the other surface do but for rounding. */

/* Maps of either surface that are set aside together: bit k of which[side] for map k. Distances of
 * the two surfaces without them differ from the true ones by at most the slip, at all of the times
 * asked about; length. */
typedef struct shared_aside {
    uint32_t which[2]; /* 0, 0: none are known */
    double slip;
} shared_aside;

/* What a question found of one surface of at most ASIDE_KEPT maps, for its other pairs over the
 * same times: few parts of maps do the same, and most differ in where they move the origin. */
enum { ASIDE_KEPT = 2 };
typedef struct aside_image {
    bool is_asked, is_known;
    double x[3]; /* length */
} aside_image;
typedef struct aside_look {
    double from, to; /* the times; from > to: nothing was found yet */
    bool moves[ASIDE_KEPT];
    double exchange;                    /* how far its two maps, exchanged, move images; length */
    aside_image image[1 << ASIDE_KEPT]; /* of the origin at one moment, under each choice of maps */
} aside_look;                           /* begins as {.from = INFINITY} */

/* Whether there may be such maps with a slip of at most `enough`: false where what is known of
 * either surface, in `looks`, tells that there are none. Neither moves by itself. */
bool surface_may_set_aside(const surface *const s[2], const imp_region *times, double enough,
                           aside_look *const looks[2]);

/* Finds such maps with a slip of at most `enough`. `bare` holds models of each surface before its
 * maps, of which only the ranges are used; neither moves by itself. *spans: how many parts of time
 * may still be looked at, some microseconds each; it falls. `looks` holds what is known of either
 * surface. *asked becomes the side whose callback was called last, for error messages. */
imp_status surface_shared_aside(const surface *const s[2], const imp_model bare[2][3],
                                const imp_region *times, double enough, size_t *spans,
                                aside_look *const looks[2], shared_aside *found, int *asked);

/* Makes the surface of the first `maps` maps of s, but for those that are set aside, at all times
 * of s. The errors of its points have the slip. NULL: no memory. */
surface *surface_new_aside(const surface *s, size_t maps, maps_aside aside);

/* Applies to a point at time t, in place, the maps of s that surface_new_aside leaves out. */
imp_status surface_move_from_aside(const surface *s, size_t maps, maps_aside aside, double t,
                                   double x[3]);

#endif
