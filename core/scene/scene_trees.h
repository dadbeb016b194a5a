/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_TREES_H
#define CORE_SCENE_SCENE_TREES_H

#include "core/scene/scene.h"
#include "core/tree/node.h"

typedef struct lent_tree {
    tree *tree; /* the scene's */
    bool fresh; /* it was made now */
} lent_tree;

/* The scene's tree of that surface and plan: made when first asked for, kept as long as the scene,
 * so that all pairs and all later queries share its nodes. */
imp_code scene_tree(imp_scene *scene, size_t body, size_t index, const tree_plan *plan,
                    lent_tree *lent, imp_error *error);

#endif
