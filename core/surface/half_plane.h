/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_HALF_PLANE_H
#define CORE_SURFACE_HALF_PLANE_H

#include "core/surface/surface.h"

/* One half plane stands for all
 * =============================
 * Two surfaces that are closed under all rotations about one line, up to a slip, are nearest to
 * each other in every half plane that ends at the line. So one half plane is enough to search: of
 * either surface only those parts matter that meet it. The half plane follows the line. */

/* Holds the half plane's points on a surface, at all times for which it was made: those x with
 * across_lo <= across.x <= across_hi and along_lo <= along.x; and, if height_hi is finite, only
 * those of a stretch along the line, with height_lo <= up.x <= height_hi. */
typedef struct half_plane {
    double across[3], along[3], up[3];     /* of length 1, about */
    double across_lo, across_hi, along_lo; /* length */
    double height_lo, height_hi;           /* length */
} half_plane;

/* The boxes of both surfaces at the times in question. */
typedef struct half_plane_boxes {
    const double *lo[2], *hi[2];
} half_plane_boxes;

/* Whether s may be closed under rotations, before its type is asked. */
bool surface_may_have_half_plane(const surface *s);

/* Computes what holds the half plane on each surface, and *slip: at each time of `times`, two
 * points of the surfaces have companions in the half plane that are at most *slip farther from each
 * other. *slip INFINITY: they have no common line, or nothing is known of it. `asked` becomes the
 * surface to which a status other than OK belongs. */
imp_status surface_half_plane(const surface *const s[2], const half_plane_boxes *boxes,
                              const imp_region *times, half_plane of[2], double *slip, int *asked);

/* half_plane_hold fills across and along for the half plane that ends at a line, such that it holds
 * all points within s of those of it that are within `reach` of the line's center; the stretch is
 * unlimited. False: no half plane is known. For screw_section.c, too. */
struct feature;
bool half_plane_hold(const struct feature *line, double reach, double s, half_plane *h);

#endif
