/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_FEATURE_H
#define CORE_SURFACE_FEATURE_H

#include "core/surface/carried.h"

/* Lines and centers of symmetries, in space
 * =========================================
 * For surface_orbit.c and half_plane.c. All maps here are exact rotations and shifts. */

/* A symmetry's center and axis as the surface's maps carry them. */
typedef struct feature {
    imp_symmetry of; /* before the maps */
    imp_model center[3], axis[3];
} feature;

/* What a unit axis with a length within 8 u of 1 is off by, of two of them, at most. */
#define AXES_OFF 0x1p-48

/* Computes the feature at these times. IMP_STATUS_UNBOUNDED: a map has no pose then. */
imp_status feature_carry(const surface *s, const imp_symmetry *of, const imp_region *times,
                         feature *f);

/* 1 / |axis|, off by less than 8 u of it: squares, sums, halved by the root, root, quotient. */
double feature_inverse_length(const imp_symmetry *of);

/* y - x, coordinate by coordinate. */
void feature_difference(const imp_model y[3], const imp_model x[3], imp_model way[3]);

/* >= the distance of the points of a box from one with these models. */
double feature_reach_upper(const double lo[3], const double hi[3], const imp_model from[3]);

/* Bounds *off = |(c_a - c_b) x n_a| and *angle = |n_a - n_b|, c being the centers and n the unit
 * axes, of b's two directions the nearer one. */
void feature_compare_lines(const feature *a, const feature *b, double *off, double *angle);

#endif
