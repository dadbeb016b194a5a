/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_DIVIDER_H
#define CORE_BOUNDS_NET_DIVIDER_H

#include "core/bounds/time_window.h"

/* A surface of second order between two control nets
 * ==================================================
 * Where two surfaces touch, a plane between them, or a surface that bends there more than the one
 * and less than the other, often parts large nodes around the contact up to that time: much larger
 * ones than an axis parts, which loses what both bend, or than one that Taylor models prove, which
 * lose their remainders. In the divider's coordinates each net is a polynomial of u and v whose
 * least value is found by halving its Bernstein coefficients, one node at a time instead of pairs
 * of nodes. */

/* The surface normal.X = (bend[0] (across[0].X)^2 + bend[1] (across[1].X)^2) / 2 with
 * X = x - at - (t - time) velocity: it moves with the contact. Any numbers are sound; useful are
 * three unit vectors that are perpendicular to each other. */
typedef struct net_divider {
    vec3 normal, across[2]; /* `normal` points from A to B */
    double bend[2];         /* curvature along `across`; 1/length */
    vec3 at, velocity;      /* world space; length, length/time */
    double time;
} net_divider;

/* Whether both nodes are proved to be farther apart than gamma_clear during all of the window,
 * A on one side of the divider and B on the other. Only nets that were made (node_net_made) serve,
 * of at most third order and without weights. Precondition: their numbers are finite, as net_take
 * demands; those of the divider, of gamma_clear and of the window may be any, also NaN. */
bool net_divider_parts(const node *a, const node *b, const net_divider *d, double gamma_clear,
                       const time_window *window);

#endif
