/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_NET_HALVES_H
#define CORE_SOLVER_NET_HALVES_H

#include "core/solver/relative.h"

/* Halves of nodes that an axis excludes
 * =====================================
 * The heights of a half's control points along an axis are known before the half is made: de
 * Casteljau on the heights of the node's. Nothing is found unless both nodes have a net that was
 * asked for (node_net). */

typedef struct net_half {
    int side; /* of the pair: whose half */
    parameter along;
    int half; /* the half that is left, the other is excluded; -1: both are */
} net_half;

enum { NET_HALVES_MOST = 32 };

/* Finds halves of either node that the axis shows farther from the other node than the clearance
 * over the whole window, which lies in both nodes' times. It finds one half, then one of what is
 * left, until neither half of a node is left or no half is excluded. Returns how many were
 * found. */
int net_halves_find(const node *a, const node *b, vec3 axis, double clearance,
                    const time_window *window, net_half found[NET_HALVES_MOST]);

#endif
