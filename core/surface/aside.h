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

/* Finds such maps with a slip of at most `enough`. `bare` holds models of each surface before its
 * maps, of which only the ranges are used; neither moves by itself. *spans: how many parts of time
 * may still be looked at, some microseconds each; it falls. *asked becomes the side whose
 * callback was called last, for error messages. */
imp_status surface_shared_aside(const surface *const s[2], const imp_model bare[2][3],
                                const imp_region *times, double enough, size_t *spans,
                                shared_aside *found, int *asked);

/* Makes the surface of the first `maps` maps of s, but for those that are set aside, at all times
 * of s. The errors of its points have the slip. NULL: no memory. */
surface *surface_new_aside(const surface *s, size_t maps, maps_aside aside);

/* Applies to a point at time t, in place, the maps of s that surface_new_aside leaves out. */
imp_status surface_move_from_aside(const surface *s, size_t maps, maps_aside aside, double t,
                                   double x[3]);

#endif
