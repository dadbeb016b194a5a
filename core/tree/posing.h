/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_POSING_H
#define CORE_TREE_POSING_H

#include "core/base/arena.h"
#include "core/tree/pose.h"

/* Shapes and spans of a tree
 * ==========================
 * Where all maps of a surface are rigid, its tree of nodes has two more trees: one of shapes,
 * halved along u and v, and one of spans of time with their poses. A node points to its shape and
 * its span: halving it along u or v halves the shape, along t the span. Both trees are made lazily
 * like the nodes: filled outside of the lock, published once. Those of the root are made with its
 * first child, since most surfaces of a large scene are never split. */

typedef struct posing {
    _Atomic bool is_idle;          /* nodes of this surface are not posed */
    _Atomic(struct shape *) shape; /* the root's; NULL: not made yet */
    _Atomic(struct span *) span;
    arena memory; /* of shapes and spans */
} posing;         /* of a tree, whose lock guards memory and publishing */

/* Sets shape and span of n, a half of its parent of which only the place is set, if the surface
 * moves rigidly and not by itself. Errors are those of node_child. */
imp_code posing_begin(tree *t, node *n, tree_growth *growth, imp_error *error);

/* Fills n from its shape and its span. False: it needs an inclusion instead. */
bool posing_fill(node *n);

#endif
