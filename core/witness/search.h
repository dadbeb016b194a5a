/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_SEARCH_H
#define CORE_WITNESS_SEARCH_H

#include "core/tree/node.h"
#include "core/witness/newton.h"

/* A search for the nearest points of two nodes at one time: points and derivatives
 * ================================================================================
 * The unknowns are y = (s_u, s_v) of a and of b, relative to the nodes; D = x_b - x_a. Derivatives
 * come from the nodes' polynomials (from differences, if a node has none), or from models of a
 * small region around the point. Nothing here is a proof. */

typedef struct search {
    const node *const *nodes;
    double t;
    bool is_local;                         /* derivatives come from small regions */
    newton_bounds y;                       /* of y */
    double whole_lo[2][3], whole_hi[2][3]; /* domains of the two surfaces */
} search;

typedef struct search_state {
    double y[NEWTON_UNKNOWNS];
    double p[2][3]; /* parameters (u, v, t) on each surface */
    vec3 x[2];
    vec3 apart; /* D */
    double gap;
} search_state;

/* Computes the parameters p = (u, v, t) that y means on one side, within the surface's domain. */
void search_parameters(const search *g, int side, const double *y, double p[3]);

/* Evaluates the point at p and, unless eval_error is NULL, bounds of its errors. */
imp_code search_point(const surface *s, const double *p, vec3 *x, double eval_error[3],
                      imp_error *error);

/* Sets and returns the error for a point, or its error bounds, that is no number. */
imp_code search_point_check(const surface *s, const double p[3], vec3 x, const double eval_error[3],
                            imp_error *error);

/* Sets and returns the error for a status that a callback returned at p. */
imp_code search_fault(const surface *s, imp_status status, const double p[3], imp_error *error);

/* Computes gradient and Hessian of |D|^2 / 2. */
imp_code search_derive(const search *g, const search_state *s, double gradient[NEWTON_UNKNOWNS],
                       double hessian[NEWTON_UNKNOWNS][NEWTON_UNKNOWNS], imp_error *error);

#endif
