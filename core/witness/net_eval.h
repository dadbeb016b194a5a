/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_NET_EVAL_H
#define CORE_WITNESS_NET_EVAL_H

#include "core/bounds/net_hull.h"

/* Points of a net's patch, and their derivatives
 * ==============================================
 * Both are computed by Bernstein polynomials, at s in [-1, 1] or beyond. Rounding is not bounded:
 * nothing here is a proof. */

/* The control points of a net at one time, relative to its place. If weighted, they are multiplied
 * by their weights, which are the fourth coordinate. */
typedef struct net_points {
    const net *net;
    imp_quad x[4][QUADS_MAX];
} net_points;

void net_points_take(const net *f, double t, net_points *points);

/* Computes the height of each control point along an axis. */
void net_heights_along(const net_points *f, vec3 axis, double height[IMP_QUAD * QUADS_MAX]);

/* Value and derivatives along u, v, uu, uv, vv. */
enum { NET_VALUE, NET_U, NET_V, NET_UU, NET_UV, NET_VV, NET_DERIVATIVES };

typedef struct net_derivatives {
    imp_quad by[NET_DERIVATIVES]; /* x, y, z; the fourth number is undefined */
} net_derivatives;

/* Computes value and derivatives of two patches, at s = (y[0], y[1]) and (y[2], y[3]). */
void net_eval_at(const net_points of[2], const double y[4], net_derivatives out[2]);

/* Returns the velocity of the point at s. */
vec3 net_velocity_at(const net *f, const double s[2]);

#endif
