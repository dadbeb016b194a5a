/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_AXIS_H
#define CORE_BOUNDS_NET_AXIS_H

#include "core/bounds/difference.h"

/* Separating axes of two control nets
 * ===================================
 * Each node lies within its net's error of the convex hull of its control points, which move
 * linearly in time. An axis separates two nodes where the least n.(y - x) over pairs of control
 * points exceeds the errors and |n| gamma_clear; net_axis.c proves this over a window
 * (core/PROOF.md, Lemma 14). Precondition of both functions: both nodes have nets
 * (node_net_made). */

/* Turns `axis`, which may be any direction but 0, to one that shows most of the widest gap of the
 * hulls at time t: GJK on their Minkowski difference. False: the hulls intersect at t; `axis` is
 * unchanged. */
bool net_axis_seek(const node *a, const node *b, double t, vec3 *axis);

/* Cuts the window, which lies in both nodes' times, to the part in which the axis does not prove
 * the nodes farther apart than gamma_clear. False: none is left. */
bool net_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear, time_window *window);

#endif
