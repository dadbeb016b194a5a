/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_EXPAND_PAIR_H
#define CORE_SOLVER_EXPAND_PAIR_H

#include "core/solver/pair_test.h"

/* One step with the pair whose window starts first: a search for a witness at that start, else its
 * halves are tested and pushed. */
imp_code expand_pair(impact *im, pair *p, impact_state *state, imp_error *error);

#endif
