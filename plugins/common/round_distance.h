/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_ROUND_DISTANCE_H
#define PLUGINS_COMMON_ROUND_DISTANCE_H

#include <impinge/model.h>
#include <impinge/surface.h>

/* Surfaces of revolution whose profiles are straight lines or arcs of circles
 * ===========================================================================
 * Such a surface lies on a cylinder, a plane, a cone, a ball or a torus, whose distance function is
 * that of the surface, too. Nothing has to be exact: how far the profile is at most from the line
 * or the circle is bounded, and subtracted. */

/* A profile farther than this part of its size from its line or circle has no distance; one within
 * ROUND_OFF_LEAST of it has no better one. */
#define ROUND_OFF_MOST 0x1p-10
#define ROUND_OFF_LEAST 0x1p-40

typedef enum round_kind {
    ROUND_NONE, /* neither a line nor an arc, or farther from it than ROUND_OFF_MOST permits */
    ROUND_CYLINDER,
    ROUND_PLANE,
    ROUND_CONE,
    ROUND_CIRCLE /* a torus; a ball if its center is on the axis */
} round_kind;

typedef struct round_profile {
    round_kind kind;
    double radius; /* of the cylinder; of the cone at z = height; of the circle; length */
    double ring;   /* how far the circle's center is from the axis, perhaps negative; length */
    double height; /* z of the plane, of the circle's center, of the cone's circle; length */
    double apex;   /* of the cone above its circle, along z; length */
    double off;    /* >= how far the profile is from the line or circle; length */
} round_profile;

/* Returns the distance of points m (imp_surface_type.distance), beside the point r = z = 0;
 * imp_unbounded of ROUND_NONE. */
imp_model round_profile_distance(const round_profile *p, const imp_model m[3]);

/* Fills kind and axis of a closed symmetry whose orbits are those of u. */
void round_profile_symmetry(const round_profile *p, imp_symmetry *symmetry);

#endif
