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

/* Returns the parameter, 0 for u or 1 for v, along which s, before its maps, goes around the line:
 * all points of the other parameter are on one circle about it, and all of the circle is there. -1:
 * that is not known. */
int surface_around_line(const surface *s, const imp_symmetry *line);

/* Replaces (u, v) of a point of the surface held, or of its piece s, which is at x at time t under
 * the first `maps` maps, by those of the point of s that it stands for. Returns SURFACE_NOT_CLOSED
 * if that is farther away than the slip and what both evaluations are off. */
imp_status surface_held_place(const surface *s, held_maps held, size_t maps, double t,
                              const double x[3], double *u, double *v);

#endif
