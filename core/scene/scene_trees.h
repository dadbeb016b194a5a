/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_TREES_H
#define CORE_SCENE_SCENE_TREES_H

#include "core/scene/scene.h"
#include "core/tree/node.h"

/* The scene's tree of that surface and plan: made when first asked for, by whichever thread, and
 * kept as long as the scene, so that all pairs and all queries share its nodes. If it is made now,
 * that is added to *growth, and it has a root as asked; one that is there may have none, or one. */
imp_code scene_tree(imp_scene *scene, size_t body, size_t index, const tree_plan *plan,
                    bool with_root, tree **found, tree_growth *growth, imp_error *error);

#endif
