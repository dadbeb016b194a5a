/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_TREE_INTERNAL_H
#define CORE_TREE_TREE_INTERNAL_H

#include <pthread.h>

#include "core/base/arena.h"
#include "core/tree/node.h"
#include "core/tree/posing.h"

/* What the files of a tree share: tree.c, node.c, node_bounds.c, node_net.c. */

struct tree {
    const surface *surface;
    tree_plan plan;
    tree *next;
    _Atomic(node *) root; /* NULL: not made yet */
    bool begins_with_root;
    pthread_mutex_t lock;  /* of changes to the lists of blocks and spare nodes, and of the root */
    arena nodes;           /* beside the root */
    _Atomic(node *) spare; /* reserved, but not published; each one's parent is the next */
    hierarchy *pieces;     /* NULL: it is one surface */
    arena nets;
    posing posing;
    double rest[]; /* the root, if the tree begins with it; else the root's box */
};

/* Which points a node is to bound, and when; which half of which node it is. */
typedef struct node_place {
    bool is_half;        /* its region is that half of the parent's; else the box */
    double lo[3], hi[3]; /* is its region */
    const surface *surface;
    const cluster *many;
    node *parent; /* NULL: it is the root */
    parameter along;
    int side;
} node_place;

/* The whole of one surface, or of a cluster, during these times. */
node_place node_place_of_surface(const surface *s, double t_start, double t_end);
node_place node_place_of_cluster(const cluster *many, double t_start, double t_end);

/* Whether it is a part of its parent's surface, not the whole of one. */
static inline bool node_is_part(const node *n)
{
    return n->parent != NULL && n->parent->surface == n->surface;
}

/* Makes a node there, in memory that may hold anything. */
imp_code node_fill(tree *t, const node_place *place, node *n, tree_growth *growth,
                   imp_error *error);

/* The bounds of a node that has begun: models, a cluster's box, or rates, as the tree's plan asks
 * for. */
imp_code node_bounds_find(const tree *t, node *n, imp_error *error);

/* Names the type, the region and what is wrong. */
imp_code node_fault(const node *n, const char *what, imp_error *error);
imp_code node_status_fault(const node *n, imp_status status, imp_error *error);

/* The net of n, which was not asked for it: published, if n is to keep it, or in the room, or in
 * the tree; NULL: it has none. Its ancestors come first, from the top. Bare ones keep none. */
imp_code node_net_find(tree *t, node *n, bool is_to_keep, net_buffer *room, const net **made,
                       tree_growth *growth, imp_error *error);

/* Fills n, which follows its net, from that. *done: false where it has none, or one that is no
 * bicubic patch. */
imp_code node_fill_from_net(tree *t, node *n, bool *done, tree_growth *growth, imp_error *error);

#endif
