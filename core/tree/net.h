/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NET_H
#define CORE_TREE_NET_H

#include "core/surface/region.h"

#include <stdbool.h>

/* Control nets of nodes
 * =====================
 * A node's copy of the imp_net of its region: the numbers of one coordinate are contiguous, in
 * whole quads, the last of which is filled with copies of the last point. A child's net is made
 * from its parent's by de Casteljau where a region is halved exactly; halves in time share the
 * parent's. */

typedef struct net {
    int degree[2];
    int stride; /* points, rounded up to whole quads */
    bool is_moving, is_weighted;
    double time; /* points are those of this time */
    double place[4],
        drift[4];    /* offset of all points, of all velocities; x, y, z and a 0, here and below */
    double error[4]; /* >= the surface's distance from the patch over the region; length */
    double most[4];  /* >= |point| + |t - time| |velocity| over the times it was made for; length */
    double numbers[]; /* x, y, z of points; of velocities if moving; weights if weighted */
} net;

/* Memory for any net. */
typedef struct net_buffer {
    double memory[sizeof(net) / sizeof(double) + 7 * IMP_NET_POINTS];
} net_buffer;

static inline net *net_in(net_buffer *buffer) { return (net *)(void *)buffer->memory; }

size_t net_bytes(const net *n);

/* Whether it is more than bilinear: a quadratic represents a bilinear patch exactly. */
static inline bool net_is_curved(const net *n)
{
    return n->degree[0] > 1 || n->degree[1] > 1 || n->is_weighted;
}

/* Bounds the surface's largest distance from the patch, up to 2 roundings. */
static inline double net_off(const net *n) { return n->error[0] + n->error[1] + n->error[2]; }

/* Fills n, which has memory for it, from a net over a region that keeps the ABI. False: its numbers
 * are too large or too small to compute with; n is not filled. */
bool net_take(net *n, const imp_net *given, const imp_region *region);

/* Whether nets of the halves of a region along j follow from its net: j is time, or the cut is
 * exactly in the middle. Lemma. lo + hi is s + e exactly (D. Knuth), so with e = 0 and s = 2 c the
 * cut is in the middle. */
static inline bool net_can_halve(const imp_region *region, parameter j)
{
    if (j == PARAMETER_T) return true;
    const double lo = region->lo[j], hi = region->hi[j], s = lo + hi, part = s - lo;
    const double e = (lo - (s - part)) + (hi - part);
    return e == 0 && s == 2 * region->c[j];
}

/* Fills `half`, which has as much memory as n and may be n, with the net of the lower (0) or upper
 * half along u or v. */
void net_halve(const net *n, parameter j, int side, net *half);

/* Halves `columns` columns of numbers, one number per control point, in place: laid out as the
 * net's own, followed by its weights if it has any. Numbers no larger than `most` are then off by
 * at most net_halving_upper. */
void net_halve_columns(const net *n, parameter j, int side, double *x, int columns);
double net_halving_upper(const net *n, parameter j, double most);

#endif
