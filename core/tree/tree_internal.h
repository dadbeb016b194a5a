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
    pthread_mutex_t lock;  /* guards the arenas, the list of spare nodes, and the root */
    arena nodes;           /* all but the root */
    _Atomic(node *) spare; /* reserved, but not published; linked by `parent` */
    hierarchy *pieces;     /* NULL: it is one surface */
    arena nets;
    posing posing;
    double rest[]; /* the root, or the root's box if it has none yet */
};

/* The points and times that a node is to bound, and which half of which node it is. */
typedef struct node_place {
    bool is_half;        /* its region is that half of the parent's; else it is the box */
    double lo[3], hi[3]; /* [lo, hi] */
    const surface *surface;
    const cluster *many;
    node *parent;    /* NULL: it is the root */
    parameter along; /* or NODE_AS_TUBE */
    int side;
} node_place;

/* Return the place of the whole of one surface, or of a cluster of its pieces, during these
 * times. */
node_place node_place_of_surface(const surface *s, double t_start, double t_end);
node_place node_place_of_cluster(const surface *s, const cluster *many, double t_start,
                                 double t_end);

/* Whether the node bounds a part of its parent's surface, not the whole of another piece. */
static inline bool node_is_part(const node *n)
{
    return n->parent != NULL && n->parent->surface == n->surface;
}

/* Whether the node is to be bounded as a tube: halves along v are not. */
static inline bool node_is_to_be_tube(const node *n)
{
    double lo[3], hi[3];
    if (n->follows != FOLLOWS_LINE) return false;
    surface_domain(n->surface, lo, hi);
    return n->region.lo[PARAMETER_V] == lo[PARAMETER_V] &&
           n->region.hi[PARAMETER_V] == hi[PARAMETER_V];
}

/* Makes a node at this place, in uninitialised memory. */
imp_code node_fill(tree *t, const node_place *place, node *n, tree_growth *growth,
                   imp_error *error);

/* Computes the bounds of a node whose place is set: from models, a cluster's box, or rates, as the
 * tree's plan says. */
imp_code node_bounds_find(const tree *t, node *n, imp_error *error);

/* Set an error that names the type, the region and what is wrong. */
imp_code node_fault(const node *n, const char *what, imp_error *error);
imp_code node_status_fault(const node *n, imp_status status, imp_error *error);

/* Makes the net of n, for which node_net was not called: published if is_to_keep, else in `buffer`
 * or in the tree; NULL: it has none. The nets of its ancestors are made first, from the root on;
 * bare nodes keep none. */
imp_code node_net_find(tree *t, node *n, bool is_to_keep, net_buffer *buffer, const net **made,
                       tree_growth *growth, imp_error *error);

/* Fills n, which follows its net, from that net. *done false: it has none, or one that is no
 * bicubic patch. */
imp_code node_fill_from_net(tree *t, node *n, bool *done, tree_growth *growth, imp_error *error);

#endif
