/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_SPLIT_PAIR_H
#define CORE_SOLVER_SPLIT_PAIR_H

#include "core/bounds/net_halves.h"
#include "core/solver/impact.h"
#include "core/solver/subdivision.h"

/* Halves of a pair, for expand_pair.c. */

static inline candidate_pair *impact_candidates(const impact *im, const pair *p)
{
    return &im->candidate_pairs[p->candidate_pair];
}

/* Splits the pair and pushes its halves, of which no more are tested than max_pairs lets. `halves`:
 * the heights of its nodes along its axis; NULL: not known. */
imp_code split_pair(impact *im, const pair *p, cut c, const net_halves *halves, impact_state *state,
                    imp_error *error);

/* Replaces nodes by halves while the pair's axis excludes the other half; only the last gets
 * models. *some false: both halves are excluded. */
imp_code split_leave_out_halves(impact *im, pair *p, net_halves *halves, bool *some,
                                imp_error *error);

#endif
