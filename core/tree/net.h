/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NET_H
#define CORE_TREE_NET_H

#include "core/surface/region.h"

#include <stdbool.h>

/* Control nets of nodes
 * =====================
 * What imp_net says of a region, as a node keeps it: the numbers of one coordinate lie side by
 * side, in whole quads of which the last is filled with copies of the last point. A child's net is
 * made from its parent's by de Casteljau where a region is halved exactly; halves in time share
 * one. */

typedef struct net {
    int degree[2];
    int stride; /* points, rounded up to whole quads */
    bool is_moving, is_weighted;
    double time;               /* motion counts from here */
    double place[4], drift[4]; /* added to points, to velocities; x, y, z and a 0, here and below */
    double error[4]; /* >= the surface's distance from the patch over the region; length */
    double most[4];  /* >= |point| + |t - time| |velocity| over the times it was made for; length */
    double numbers[]; /* x, y, z of points; of velocities if moving; weights if weighted */
} net;

/* Room for any net. */
typedef struct net_buffer {
    double memory[sizeof(net) / sizeof(double) + 7 * IMP_NET_POINTS];
} net_buffer;

static inline net *net_in(net_buffer *room) { return (net *)(void *)room->memory; }

size_t net_bytes(const net *n);

/* Whether its hull says more than a bilinear patch, which a quadratic follows as well. */
static inline bool net_is_curved(const net *n)
{
    return n->degree[0] > 1 || n->degree[1] > 1 || n->is_weighted;
}

/* Estimates the surface's largest distance from the patch. */
static inline double net_off(const net *n) { return n->error[0] + n->error[1] + n->error[2]; }

/* Fills n, which has room, from a net over a region that keeps the ABI. False: its numbers are too
 * large or too small to compute with; n is not filled. */
bool net_take(net *n, const imp_net *given, const imp_region *region);

/* Whether the halves of a region along j have nets by halving: j is time, or the cut exactly in the
 * middle. Lemma. lo + hi is s + e exactly (D. Knuth), so with e = 0 and s = 2 c the cut is in the
 * middle. */
static inline bool net_can_halve(const imp_region *region, parameter j)
{
    if (j == PARAMETER_T) return true;
    const double lo = region->lo[j], hi = region->hi[j], s = lo + hi, part = s - lo;
    const double e = (lo - (s - part)) + (hi - part);
    return e == 0 && s == 2 * region->c[j];
}

/* Fills `half`, which has room for as much and may be n, with the net of the lower (0) or upper
 * half along u or v. */
void net_halve(const net *n, parameter j, int side, net *half);

/* Halves other numbers of the net's control points in place: `columns` columns laid out as the
 * net's own, then its weights if it has any. Numbers no larger than `most` are then off by
 * net_halving_upper at most. */
void net_halve_columns(const net *n, parameter j, int side, double *x, int columns);
double net_halving_upper(const net *n, parameter j, double most);

#endif
