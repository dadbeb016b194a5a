/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_HIERARCHY_INTERNAL_H
#define CORE_TREE_HIERARCHY_INTERNAL_H

#include "core/tree/hierarchy.h"

/* What hierarchy.c, which keeps hierarchies, and hierarchy_build.c, which bounds and halves, share.
 */

struct hierarchy {
    arena_store *store; /* of its memory; NULL: the heap */
    _Atomic(size_t) holders;
    double lo, hi, c, d; /* the times, as in imp_region */
    uint32_t *order;     /* the pieces; those of a cluster are adjacent */
    cluster *clusters; /* count - 1 of them, a parent before its children; the root is the first */
    size_t count;      /* number of pieces */
    size_t used;       /* number of clusters made */
};

/* The place of a piece, used only to choose halves: x, y, z and its number. Pieces of one cluster
 * are adjacent. */
typedef struct spot {
    double at[4];
} spot;
enum { PIECE = 3 };

/* Bounds the pieces of the surface, and makes the clusters. *ended: the watch ended it, and the
 * clusters mean nothing. `pieces` and `spots` have room for one of each piece. */
imp_code hierarchy_fill(hierarchy *h, const surface *s, const limit_watch *watch,
                        cluster_bound *pieces, spot *spots, bool *ended, imp_error *error);

#endif
