/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_PARABOLOID_H
#define CORE_BOUNDS_NET_PARABOLOID_H

#include "core/bounds/time_window.h"

/* A separating paraboloid of two control nets
 * ===========================================
 * Where two surfaces touch, a separating plane, or a paraboloid that bends there more than one
 * surface and less than the other, often separates large nodes around the contact up to that time.
 * A separating axis loses what both surfaces bend, and Taylor models lose their remainders. The
 * height of each net above the paraboloid is a polynomial of u and v, whose least value is found by
 * halving its Bernstein coefficients: one node at a time, not pairs of nodes. */

/* The paraboloid, elliptic or hyperbolic, of all x with
 *
 *   normal.X = (bend[0] (across[0].X)^2 + bend[1] (across[1].X)^2) / 2,
 *
 * X = x - at - (t - time) velocity: it moves with the contact. Any numbers are sound; useful are
 * three unit vectors that are perpendicular to each other. Both bends 0: a plane. */
typedef struct net_paraboloid {
    vec3 normal, across[2]; /* `normal` points from A to B */
    double bend[2];         /* curvature along `across`; 1/length */
    vec3 at, velocity;      /* world space; length, length/time */
    double time;
} net_paraboloid;

/* Whether both nodes are proved to be farther apart than gamma_clear during all of the window,
 * A on one side of the paraboloid and B on the other. Only nets that were made (node_net_made)
 * serve, of at most third order and without weights. Precondition: their numbers are finite, as
 * net_take demands; those of the paraboloid, of gamma_clear and of the window may be any, also NaN.
 */
bool net_paraboloid_parts(const node *a, const node *b, const net_paraboloid *d, double gamma_clear,
                          const time_window *window);

#endif
