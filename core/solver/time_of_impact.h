/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_TIME_OF_IMPACT_H
#define CORE_SOLVER_TIME_OF_IMPACT_H

#include "core/solver/impact.h"

/* The search for the earliest contact: pop, test, witness, cut, push
 * ==================================================================
 * impact_advance pops a pair and completes its test; expand_pair.h seeks a witness, divides the
 * pair, and tests and pushes its halves.
 *
 * After every impact_advance: (a) no pair of points of the candidates is nearer than `gamma_clear`
 * at any time before t_lower; (b) with IMPACT_CONTACT the witness's gap_upper is at most gamma at
 * t_lower; (c) with IMPACT_CLEAR there are no such points at all. (a) holds for every answer. */

/* Tests the roots of candidate pair `index` and pushes the pair if they may be near. */
imp_code impact_add_candidate(impact *im, uint32_t index, impact_state *state, imp_error *error);

/* Whether nothing is left to do before the time up to which pairs that are no candidates yet are
 * apart. */
bool impact_lacks_candidates(const impact *im);

/* Pops one pair and expands it. On IMP_ERROR_PLUGIN the search is over; its results so far remain
 * valid. */
imp_code impact_advance(impact *im, impact_state *state, imp_error *error);

/* Continues with a smaller gamma and gamma_clear, for `count` candidate pairs, or 0 while these are
 * not known. False: no memory; nothing has changed. */
bool impact_refine(impact *im, double gamma, double gamma_clear, size_t count);

/* After IMPACT_CONTACT or IMPACT_RESOLUTION: continues without the two bodies of that pair. False:
 * no memory; nothing has changed. */
bool impact_pass(impact *im);

void impact_clear(impact *im);

#endif
