/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_DISTANCE_AUDIT_H
#define CORE_TREE_DISTANCE_AUDIT_H

#include "core/tree/node.h"

/* IMP_ERROR_PLUGIN if the type of n's surface claims too large a distance of points that are as far
 * off the node as they are made to be, in a few parts of its region, drawn from *state. Nothing is
 * known of a surface without distances (surface_has_distance): IMP_SUCCESS. */
imp_code distance_audit_run(const node *n, uint64_t *state, imp_error *error);

#endif
