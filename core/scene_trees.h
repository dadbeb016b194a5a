/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_TREES_H
#define CORE_SCENE_TREES_H

#include "node.h"
#include "scene.h"

/* The scene's tree of that surface, kind and time interval: made when first asked for, kept as long
 * as the scene, so that all pairs and all later queries share its nodes. `*fresh`: it was made now.
 */
imp_code scene_tree(imp_scene *scene, size_t body, size_t index, tree_kind kind, double t_start,
                    double t_end, node_audit audit, tree **found, bool *fresh, imp_error *error);

#endif
