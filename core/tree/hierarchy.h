/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_HIERARCHY_H
#define CORE_TREE_HIERARCHY_H

#include "core/base/limit_watch.h"
#include "core/surface/surface.h"

/* A bounding volume hierarchy over the pieces of one surface
 * ==========================================================
 * A cluster is a set of pieces and a box around them that moves linearly, before any map: for every
 * point x of a piece and every time t of the hierarchy, with s = (t - c) / d in [-1, 1],
 *
 *   | x_i - (a_i + b_i s) | <= e_i
 *
 * Clusters are halved at the median of the longest axis, down to single pieces. A hierarchy is
 * immutable once built. It depends on the instance and the times alone: all surfaces of an instance
 * share it, in all scenes, and the instance keeps the last few on its shelf. */

typedef struct cluster_bound {
    double a[3], b[3], e[3]; /* length; e is infinite if there are no bounds */
    double rate[3];          /* length / time: >= |df/dt| of each piece */
} cluster_bound;

typedef struct hierarchy hierarchy;

typedef struct cluster {
    const hierarchy *of;
    cluster_bound bound;
    const struct cluster *child[2]; /* NULL: that half is one piece, */
    uint32_t piece[2];              /* with this index */
} cluster;

/* Finds or makes the hierarchy over the times t_start..t_end, finite and within the domain, and
 * holds it for the caller. Its memory is of the store, which must outlive the instance; NULL: of
 * the heap. Precondition: `s` has two pieces or more. Errors are those of node_child; *found is
 * NULL where `watch` ended it. Any thread. */
imp_code hierarchy_of(const surface *s, double t_start, double t_end, const limit_watch *watch,
                      arena_store *store, hierarchy **found, imp_error *error);
/* Holds it once more. h may be NULL in both. */
hierarchy *hierarchy_hold(hierarchy *h);
void hierarchy_release(hierarchy *h);

const cluster *hierarchy_root(const hierarchy *h);

/* Returns the numbers of the pieces in an order in which those of each cluster stand together: of n
 * of them the first n / 2 are those of the first half. */
const uint32_t *hierarchy_order(const hierarchy *h);
size_t hierarchy_bytes(const hierarchy *h);

/* Returns the k-th of n pieces that are spread over the whole hierarchy, by index. */
size_t hierarchy_sample(const hierarchy *h, size_t k, size_t n);

/* Makes models of a cluster, before any map, over a region whose times are part of the hierarchy's.
 * The region's u stands for the points of the cluster. */
void cluster_models(const cluster *c, const imp_region *region, imp_model model[3]);

#endif
