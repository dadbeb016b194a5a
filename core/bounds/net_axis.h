/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_AXIS_H
#define CORE_BOUNDS_NET_AXIS_H

#include "core/bounds/difference.h"

/* Separating axes of two control nets
 * ===================================
 * Each node lies within its net's error (net.h) of the convex hull of its control points, which
 * move linearly in time. An axis n separates two nodes where the least n.(y - x), over control
 * points x of A and y of B, exceeds the errors along n plus |n| gamma_clear. net_axis.c proves this
 * over a window (core/PROOF.md, Lemma 14); net_hull.h counts its rounding. net_axis_seek decides
 * only how much is proved, never whether it is true. Precondition of both functions: both nodes
 * have nets (node_net_made). */

/* Turns `axis`, which may be any direction but 0, to one that shows most of the widest gap of the
 * hulls at time t: GJK on their Minkowski difference. False: the hulls intersect at t; `axis` is
 * unchanged. */
bool net_axis_seek(const node *a, const node *b, double t, vec3 *axis);

/* Cuts the window, which lies in both nodes' times, to the part in which the axis does not prove
 * the nodes farther apart than gamma_clear. False: none is left. */
bool net_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear, time_window *window);

#endif
