/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_WITNESS_H
#define CORE_WITNESS_WITNESS_H

#include "core/tree/node.h"

/* A witness: points of two surfaces, evaluated, that are near at a time
 * =====================================================================
 * Damped Newton steps on the gap seek it. Finding none proves nothing. */

typedef struct witness {
    size_t piece[2];   /* of surface a and b; 0 if it has one piece */
    double u[2], v[2]; /* parameters on the piece */
    vec3 point[2];
    double gap;       /* distance of the points as computed; length */
    double gap_upper; /* proved bound of the distance of the exact points */
    bool has_normal;
    vec3 normal; /* unit, a to b */
} witness;

/* Seeks the nearest points of the two surfaces at time t, starting at the middles of the two nodes,
 * neither of which is a cluster; stops early if the gap stays far above gamma. IMP_ERROR_PLUGIN: an
 * evaluation failed. */
imp_code witness_seek(const node *const nodes[2], double t, double gamma, witness *found,
                      imp_error *error);

/* Seeks points nearer to each other than those of *found, a witness at time t of the two nodes,
 * with the derivatives of models around the points, which are exact but for rounding; at a pole,
 * where only v leads away, from the opposite u, too. */
imp_code witness_polish(const node *const nodes[2], double t, witness *found, imp_error *error);

/* Evaluates points at n parameters (u, v, t), n <= WITNESS_POINTS, and bounds their distances from
 * the exact points. */
enum { WITNESS_POINTS = 3 };
imp_code witness_eval_errors(const surface *s, size_t n, const double (*p)[3], double *eval_error,
                             vec3 *x, imp_error *error);

/* Makes a witness of the points at parameters (s_u, s_v) of a and of b, relative to the nodes. They
 * may lie outside the nodes, but not outside the surfaces' domains. */
imp_code witness_at(const node *const nodes[2], double t, const double y[4], witness *found,
                    imp_error *error);

/* Makes a witness of the points at the nodes' middles, without a search: the paper's
 * termination. */
imp_code witness_at_centres(const node *const nodes[2], double t, witness *found, imp_error *error);

#endif
