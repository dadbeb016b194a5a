/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_FOLLOW_H
#define CORE_SOLVER_FOLLOW_H

#include "core/solver/pair_test.h"
#include "core/solver/time_of_impact.h"

/* One step with the pair whose window starts first: a search for a witness at that start, else its halves are
 * tested and pushed. */
imp_code follow_pair(impact *im, pair *p, impact_state *state, imp_error *error);

/* Counts a test, and puts the pair on the heap, which has room, unless its nodes stay apart. */
void follow_push(impact *im, pair_test *t);

/* Keeps the least gap of all witnesses. */
void follow_note_gap(impact *im, const witness *seen);

/* Keeps the witness of the contact that ends the search. */
impact_state follow_contact(impact *im, const witness *seen);

#endif
