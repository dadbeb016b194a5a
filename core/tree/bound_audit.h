/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_BOUND_AUDIT_H
#define CORE_TREE_BOUND_AUDIT_H

#include "core/tree/node.h"

/* Claims of plugins, held against their own points
 * ================================================
 * Bounds are claims of the plugin's author. Every point that is evaluated anyway is held against
 * the inclusion of the node it lies in, and against what a posed node's remainder reaches along the
 * body's axes; an audit adds points at every node. What is found is a counterexample: the claim is
 * wrong beyond rounding, at a point that is named. */

/* IMP_ERROR_PLUGIN if the node lies: x = f(p), evaluated without error bounds, is not where the
 * inclusion says, nor does a second look with error bounds explain it. p outside the node's region
 * is no evidence: IMP_SUCCESS. */
imp_code bound_audit_holds_at(const surface *s, const node *n, const double p[3], const double x[3],
                              imp_error *error);

/* Holds the node against a few points of its region, chosen by the region's numbers: corners,
 * edges, inside; and distances from the surface against points beside it (distance_audit.h). */
imp_code bound_audit_run(const surface *s, const node *n, imp_error *error);

#endif
