/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_CLAIM_AUDIT_H
#define CORE_BOUNDS_CLAIM_AUDIT_H

#include "core/bounds/distance.h"

/* Checks one-sided distances at points
 * ====================================
 * Where a distance has separated two nodes, or cut their window, an audit evaluates points of the
 * node and seeks points of the other surface that are near them at the same time. One pair of
 * points that is nearer than the claim refutes it: the distance, or the symmetry by which it was
 * extended to all times, is wrong. */

/* Tests that |g| is at most the distance of points of q->a from the surface of q->b over the region
 * of q->a, which is no cluster, and at all times if distance_slides(q). `when` lies in the times of
 * both nodes. IMP_ERROR_PLUGIN: a counterexample was found. */
imp_code claim_audit_run(const distance_question *q, const imp_model *g, const time_window *when,
                         imp_error *error);

#endif
