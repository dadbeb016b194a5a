/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_HALVES_H
#define CORE_BOUNDS_NET_HALVES_H

#include "core/bounds/net_hull.h"

/* Halves of nodes that an axis separates from the other node
 * ==========================================================
 * The heights of a half's control points along an axis follow from the node's by de Casteljau,
 * before the half is made. Nothing is found unless both nodes have nets (node_net_made). */

typedef struct net_half {
    int side; /* side of the pair that is halved */
    parameter along;
    int half; /* the half that remains, the other being excluded; -1: both are excluded */
} net_half;

enum { NET_HALVES_MOST = 32 };

/* Heights of one net's control points along an axis, relative to the net's place: at the window's
 * start, at its end, then the weights. When a half is excluded, the other half's replace them. */
typedef struct net_heights {
    const net *net;
    imp_region region; /* what is left of the node's region */
    double x[3 * IMP_QUAD * QUADS_MAX];
    window_ends low; /* least height of the patch; GAP_ROUNDING counts its rounding */
    double most;     /* >= |height|, up to rounding */
    double off;      /* bounds the rounding of halving so far */
} net_heights;

/* The halves that were excluded, and the heights of what is left of both nodes. */
typedef struct net_halves {
    int count;
    net_half found[NET_HALVES_MOST];
    bool has_heights; /* if false, the other fields are not set */
    time_window window;
    double limit;
    window_ends at; /* B's place minus A's, along the axis */
    net_heights of[2];
} net_halves;

/* Finds halves of either node that the axis shows farther from the other node than gamma_clear
 * over the whole window, which lies in both nodes' times. It finds one half, then one of what is
 * left, until neither half of a node is left or no half is excluded. */
void net_halves_find(const node *a, const node *b, vec3 axis, double gamma_clear,
                     const time_window *window, net_halves *halves);

/* Cuts the window for both halves, along u or v, of what is left of one side, into left[k]; near[k]
 * is false if nothing is left for half k. False: no heights are known for this window or these
 * halves, and left and near are not set. */
bool net_halves_cut(const net_halves *halves, int side, parameter j, const time_window *window,
                    time_window left[2], bool near[2]);

#endif
