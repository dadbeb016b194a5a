/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_DISTANCE_AUDIT_H
#define CORE_TREE_DISTANCE_AUDIT_H

#include "core/tree/node.h"

/* Audits of the distances that types claim. core/bounds/claim_audit.h has those of the models that
 * a search has used. */

/* Returns the lower bound of |g| at s that a model of a distance claims, by its polynomial or its
 * range; below 0: no claim. s may be off by two roundings. */
double distance_claim_lower(const imp_model *g, const double s[3]);

/* Checks the distances that the type of n's surface claims at points whose distance from the node
 * is known, in a few parts of its region, drawn from *state. IMP_ERROR_PLUGIN: a claim is too
 * large. A surface without distances (surface_has_distance) passes. */
imp_code distance_audit_run(const node *n, uint64_t *state, imp_error *error);

#endif
