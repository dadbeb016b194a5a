/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NODE_MODEL_H
#define CORE_TREE_NODE_MODEL_H

#include "core/tree/node.h"

/* Fills every field of `n` except its region, which is set, and its children from an inclusion's
 * models. Returns NULL, or the promise of imp_model that they break; infinite values break none if
 * `may_be_infinite`. */
const char *node_take_model(node *n, const imp_model model[3], bool may_be_infinite);

/* Adds a ball to a node that was filled with models of a line (node.h). */
void node_add_ball(node *n, double ball);

#endif
