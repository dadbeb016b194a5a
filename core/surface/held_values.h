/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_HELD_VALUES_H
#define CORE_SURFACE_HELD_VALUES_H

#include "core/surface/surface_shift.h"

/* Surfaces that parameters only turn within themselves
 * ====================================================
 * A spindle that a parameter turns about its axis is the same set of points at all values. So its
 * parameter shifts it by rounding only, however wide a box of values is. */

/* Finds the first maps, up to one that follows a parameter, of which each by itself only turns s
 * within itself at all times and values of the box; none if their slip would exceed `enough`. Under
 * these maps s, at any time and values of the box, is within the slip of s at any others: each
 * point of either has one of the other. The extent is that of the box; its `held` is not read. A
 * status other than OK is a fault of the type or of a map. */
imp_status surface_held_values(const surface *s, const surface_extent *extent, const value_box *box,
                               double enough, held_maps *held);

#endif
