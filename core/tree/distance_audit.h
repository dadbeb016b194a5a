/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_DISTANCE_AUDIT_H
#define CORE_TREE_DISTANCE_AUDIT_H

#include "core/tree/node.h"

/* Checks the distances that the type of n's surface claims at points whose distance from the node
 * is known, in a few parts of its region, drawn from *state. IMP_ERROR_PLUGIN: a claim is too
 * large. A surface without distances (surface_has_distance) passes. */
imp_code distance_audit_run(const node *n, uint64_t *state, imp_error *error);

#endif
