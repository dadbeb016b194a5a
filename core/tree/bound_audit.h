/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_BOUND_AUDIT_H
#define CORE_TREE_BOUND_AUDIT_H

#include "core/tree/node.h"

/* Checks a plugin's bounds at its own points
 * ==========================================
 * Bounds are claims of the plugin's author. Every point that is evaluated anyway is compared with
 * the inclusion of its node, and with the extent of a posed node's remainder along the body's axes;
 * an audit adds points at every node. An error is a counterexample: the claim is wrong beyond
 * rounding at the point named. */

/* Returns IMP_ERROR_PLUGIN if x = f(p), evaluated without error bounds, is outside the node's
 * inclusion, and a second evaluation with error bounds does not explain it. IMP_SUCCESS if p is
 * outside the node's region. */
imp_code bound_audit_holds_at(const surface *s, const node *n, const double p[3], const double x[3],
                              imp_error *error);

/* Compares the node's bounds with a few points of its region (corners, edges, inside), drawn with a
 * seed made of the region's numbers, and checks distances from the surface (distance_audit.h). */
imp_code bound_audit_run(const surface *s, const node *n, imp_error *error);

#endif
