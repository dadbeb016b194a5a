/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_NET_JET_H
#define CORE_SOLVER_NET_JET_H

#include "core/solver/net_hull.h"

/* Points of a net's patch, and their derivatives
 * ==============================================
 * By Bernstein polynomials, at s in [-1, 1] or beyond. Rounded like any sum: nothing is proved by them. */

/* The control points of a net at one time, without its place. If weighted they are multiplied with
 * their weights, which are the fourth coordinate. */
typedef struct net_points {
    const net *net;
    imp_quad x[4][QUADS_MAX];
} net_points;

void net_points_take(const net *f, double t, net_points *points);

/* How high each control point lies along an axis. */
void net_heights_along(const net_points *f, vec3 axis, double height[IMP_QUAD * QUADS_MAX]);

/* Value and derivatives along u, v, uu, uv, vv. */
enum { JET_VALUE, JET_U, JET_V, JET_UU, JET_UV, JET_VV, JETS };

typedef struct jet {
    imp_quad by[JETS]; /* x, y, z; the fourth number means nothing */
} jet;

/* The jets of two patches, at s = (y[0], y[1]) and (y[2], y[3]). */
void net_jets_at(const net_points of[2], const double y[4], jet out[2]);

/* How fast the point at s moves. */
vec3 net_velocity_at(const net *f, const double s[2]);

#endif
