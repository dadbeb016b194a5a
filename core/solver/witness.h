/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_WITNESS_H
#define CORE_SOLVER_WITNESS_H

#include "core/tree/node.h"

/* A witness: points of two surfaces, evaluated, that are near at a time
 * =====================================================================
 * Found by damped Gauss-Newton steps on the gap. Finding none proves nothing. */

typedef struct witness {
    double u[2], v[2]; /* of surface a and b */
    vec3 point[2];
    double gap;       /* distance of the points as computed; length */
    double gap_upper; /* proved bound of the distance of the exact points */
    bool has_normal;
    vec3 normal; /* unit, a to b */
} witness;

/* Seeks the nearest points of the two surfaces at time t, from the middles of the two nodes; gives
 * up early where the gap stays far above gamma. IMP_ERROR_PLUGIN when an evaluation fails. */
imp_code witness_seek(const tree *const trees[2], const node *const nodes[2], double t,
                      double gamma, witness *found, imp_error *error);

/* Bound of the distance from the point that is evaluated at p = (u, v, t) to the exact one. */
imp_code witness_eval_error(const tree *t, const double p[3], double *eval_error, imp_error *error);

/* The points at the middles themselves, without a search: the paper's termination. */
imp_code witness_at_centres(const tree *const trees[2], const node *const nodes[2], double t,
                            witness *found, imp_error *error);

#endif
