/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_POSING_H
#define CORE_TREE_POSING_H

#include <pthread.h>

#include "core/base/arena.h"
#include "core/tree/pose.h"

/* Shapes and spans of a tree
 * ==========================
 * Where all maps of a surface are rigid, a tree of its shapes, halved along u and v, and one of
 * spans of time with their poses stand beside its tree of nodes. A node knows its shape and its
 * span: halving it along u or v halves the shape, along t the span. Both trees are made lazily, as
 * the nodes are: filled outside of the lock, published once. The root has neither; its own are made
 * with its first child, since most surfaces of a large scene are never split. */

typedef struct posing {
    pthread_mutex_t *lock;         /* the tree's: of memory and of publishing */
    const node *root;              /* of the tree */
    _Atomic bool is_idle;          /* nodes of this surface are not posed */
    _Atomic(struct shape *) shape; /* of the root; NULL: not made yet */
    _Atomic(struct span *) span;
    arena memory; /* of shapes and spans */
} posing;

/* Sets shape and span of n, which is half of its parent and has nothing else yet but its place,
 * where the surface moves rigidly and not by itself. Fails as node_child does. */
imp_code posing_begin(posing *g, node *n, tree_growth *growth, imp_error *error);

/* Fills n from its shape and its span. False: n has to be filled from an inclusion. */
bool posing_fill(node *n);

#endif
