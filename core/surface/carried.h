/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_CARRIED_H
#define CORE_SURFACE_CARRIED_H

#include "core/surface/surface_internal.h"

/* Centers and axes of symmetries, as maps carry them
 * ==================================================
 * For surface_symmetry.c and surface_orbit.c. */

/* A point, and a bound of its distance from where it would be if all maps so far were exact
 * rotations. */
typedef struct carried {
    imp_model at[3];
    double off;
} carried;

/* Asks the type. IMP_STATUS_UNBOUNDED: it has none. */
imp_status surface_symmetry(const surface *s, imp_symmetry *found);

/* Computes the pose of the surface's map k, and *d >= |R^T R - 1|, which is at most 1/2. */
imp_status carried_pose(const surface *s, size_t k, const imp_region *times, imp_pose *pose,
                        double *d);

/* Moves the point by the map of this pose and d. */
void carried_push(const imp_pose *pose, double d, carried *x);

/* Turns a direction by the map of this pose, whose turn is an exact rotation. */
void carried_turn(const imp_pose *pose, imp_model way[3]);

/* Returns a bound of |w| from above. */
double surface_size_upper(const imp_model w[3]);

#endif
