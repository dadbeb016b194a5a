/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_EXPAND_PAIR_H
#define CORE_SOLVER_EXPAND_PAIR_H

#include "core/solver/pair_test.h"

/* Takes one step with the pair whose window starts first: seeks a witness at that start; if there
 * is none, splits the pair, tests its halves and pushes them. */
imp_code expand_pair(impact *im, pair *p, impact_state *state, imp_error *error);

#endif
