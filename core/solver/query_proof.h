/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_QUERY_PROOF_H
#define CORE_SOLVER_QUERY_PROOF_H

#include "core/proof/proof_file.h"
#include <impinge/impinge.h>

/* What a certificate takes from a query that keeps a proof (imp_query_keep_proof) */

/* Returns the steps of the search that proved the answer. */
proof_search query_proof_search(const imp_query *query);

/* Claims that two points are at most `within` apart at time t. */
void proof_claim_points(proof_claim *claim, const imp_side *a, const imp_side *b, double t,
                        double within);

/* Returns the answer's upper end, with room for how the verifier rounds the points. */
double proof_within_upper(const imp_clearance *answer);

/* Returns the distance to claim: the answer's lower end, less some room for how the verifier
 * encloses surfaces. */
double proof_apart_lower(const imp_clearance *answer, const imp_clearance_options *asked);

#endif
