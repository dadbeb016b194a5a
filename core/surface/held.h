/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_HELD_H
#define CORE_SURFACE_HELD_H

#include "core/surface/surface.h"

/* Surfaces that turn within themselves, held still
 * ================================================
 * The first maps of a roller, a wheel or a can only turn it within itself; what is left of its
 * motion is often a shift. Held at one moment, these maps leave the same set of points at each
 * time, but for a slip. Which parameters a point of it has differs, which matters only where points
 * are reported. */

/* Finds the first maps that, together, only turn s within itself, the last of which depends on
 * time; none if their slip would exceed `enough`. Then P(t) s and P(t0) s, P being these maps and
 * t0 surface_held_moment, are within the slip of each other, point by point, at all of the region's
 * times. `bare` holds models of s before its maps, of which only the ranges are used. */
imp_status surface_held_maps(const surface *s, const imp_model bare[3], const imp_region *times,
                             double enough, held_maps *held);

/* The moment at which maps of s are held, the same for all questions. */
double surface_held_moment(const surface *s);

/* Makes the surface of the first `maps` maps of s, some of which are held at the moment, at all
 * times of s. The errors of its points have the slip. NULL: no memory. */
surface *surface_new_held(const surface *s, size_t maps, held_maps held);

/* Replaces (u, v) by those of the point of s, or of its piece, that is at x at time t under the
 * first `maps` maps, and known to have the same v, or u, as one of the surface held. Returns
 * SURFACE_BAD_SYMMETRY if there is none. */
imp_status surface_held_place(const surface *s, size_t maps, double t, const double x[3], double *u,
                              double *v);

#endif
