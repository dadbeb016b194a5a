/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_CARRIED_H
#define CORE_SURFACE_CARRIED_H

#include "core/surface/surface_internal.h"

/* Centers and axes of symmetries, as maps carry them
 * ==================================================
 * For surface_symmetry.c, surface_orbit.c and the files of slips. */

/* Lengths of an axis between these have squares that neither underflow nor overflow. */
#define AXIS_LEAST 0x1p-340
#define AXIS_MOST 0x1p340

/* A point, and a bound of its distance from where it would be if all maps so far were exact
 * rotations. */
typedef struct carried {
    imp_model at[3];
    double off;
} carried;

/* The plane of all x with normal.x = height, `off` being that of the height. The normal is a
 * direction of any length. It follows maps as no point of the plane does: where rotations keep the
 * normal and shifts go across it, its models have no remainders, whatever the normal. */
typedef struct carried_plane {
    carried normal;
    imp_model height;
    double off;
} carried_plane;

/* Asks the type. IMP_STATUS_UNBOUNDED: it has none. */
imp_status surface_symmetry(const surface *s, imp_symmetry *found);

/* Whether numbers and flags of a symmetry are what a type may answer. */
bool symmetry_is_sane(const imp_symmetry *found);

/* Whether its motions are screws, so that no rotation or translation alone is one of them. */
static inline bool symmetry_is_screw(const imp_symmetry *found)
{
    return found->kind == IMP_SYMMETRY_SCREW_RIGHT || found->kind == IMP_SYMMETRY_SCREW_LEFT;
}

/* Whether rotations about a line, or all about its center, map the surface onto itself. */
static inline bool symmetry_is_round(const imp_symmetry *found)
{
    const uint32_t closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ZONE;
    return (found->is_closed & closed) != 0 && !symmetry_is_screw(found);
}

/* Returns the rotations that keep the whole surface; of several pieces, if of_pieces, those that
 * keep each of them. IMP_STATUS_UNBOUNDED: none are known. */
imp_status surface_closed_symmetry(const surface *s, bool of_pieces, imp_symmetry *found);

/* Returns >= how far a rotation of that closed symmetry takes a point of the surface off the
 * surface, which is in this box at one time: 0, unless it is closed but for rounding. */
double symmetry_slack_upper(const imp_symmetry *found, const double lo[3], const double hi[3]);

/* Whether all maps are rigid in exact arithmetic: rotations and shifts. */
bool carried_exactly(const surface *s);

/* Computes the pose of the surface's map k, and *d >= |R^T R - 1|, which is at most 1/2. */
imp_status carried_pose(const surface *s, size_t k, const imp_region *times, imp_pose *pose,
                        double *d);

/* Moves the point by the map of this pose and d. */
void carried_push(const imp_pose *pose, double d, carried *x);

/* Moves the point back by R^T, the map's transposed turn. */
void carried_pull(const imp_pose *pose, double d, carried *x);

/* Moves the point back by R^-1 instead, and takes its error into the coordinates. */
void carried_pull_truly(const imp_pose *pose, double d, carried *x);

/* Moves a point by all maps of the surface, and turns `count` directions, which are followed
 * exactly where the maps' turns are exact rotations. IMP_STATUS_UNBOUNDED: a map has no pose. */
imp_status carried_through(const surface *s, const imp_region *times, carried *x, size_t count,
                           imp_model way[][3]);

/* Like carried_through, by the maps after the first `maps`. */
imp_status carried_after(const surface *s, size_t maps, const imp_region *times, carried *x,
                         size_t count, imp_model way[][3]);

/* Moves the plane by the map of this pose and d, or back by its transposed turn. */
void carried_push_plane(const imp_pose *pose, double d, carried_plane *x);
void carried_pull_plane(const imp_pose *pose, double d, carried_plane *x);

/* Returns a bound of |w| from above. */
double surface_size_upper(const imp_model w[3]);

#endif
