/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_ROUND_NET_H
#define PLUGINS_PATCH_ROUND_NET_H

#include "plugins/patch/ring_net.h"

/* NURBS surfaces that are round or flat
 * =====================================
 *
 * CAD systems write a cylinder, a cone, a ball, a torus, or a part of one, as a rational net: rows
 * of control points of arcs about one axis. Such a surface lies on the round one but for rounding,
 * and has its distance and its symmetry. How far it is off is bounded, and subtracted; one that
 * goes around is closed but for IMP_NEARLY_SLACK. */

typedef struct round_net {
    round_profile profile; /* about the axis, beside the center; ROUND_NONE: the net is neither */
    ring_place at;
    uint32_t closed; /* IMP_SYMMETRY_CLOSED, ... */
} round_net;

/* Finds what a surface at rest is. `points`: 3 numbers for each of side[0].count *
 * side[1].count, in that order; weights, positive, may be NULL. Nothing is kept. */
round_net round_net_of(const knots side[2], const double *points, const double *weights);

/* Returns the distance of a point (imp_surface_type.distance); imp_unbounded of ROUND_NONE. */
imp_model round_net_distance(const round_net *r, imp_model x, imp_model y, imp_model z);

/* Implements imp_surface_type.symmetry. */
imp_status round_net_symmetry(const round_net *r, imp_symmetry *symmetry);

#endif
