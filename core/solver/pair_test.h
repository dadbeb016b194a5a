/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_TEST_H
#define CORE_SOLVER_PAIR_TEST_H

#include "core/solver/impact.h"

/* Whether a pair's nodes may be within gamma_clear
 * ================================================
 * The first test of a pair is cheap and may leave too much of its window. It is completed when the
 * pair is popped, since a third of the pairs pushed is never popped. Pairs of roots are tested at
 * the beginning, possibly ahead of their turn by several threads: such a test depends only on its
 * two nodes. */

/* Completes the test of a pair after its first test; p->window becomes the window that is left.
 * False: none is left. */
bool pair_test_fully(const impact *im, pair *p);

/* Makes the nodes' nets if strategy_wants_nets; their memory is added to *bytes. */
imp_code pair_test_ask_for_nets(const impact *im, const pair *p, uint64_t *bytes, imp_error *error);

/* Makes the nets of those sides. */
imp_code pair_test_make_nets(const impact *im, const pair *p, const bool sides[2], uint64_t *bytes,
                             imp_error *error);

/* Makes the first test of t->p, and the nodes' nets; the other fields of *t are its result.
 * `turning` is as for separation_window. */
imp_code pair_test_first(const impact *im, pair_test *t, trial_rate *turning, imp_error *error);

/* Returns in *t the first test of the roots of candidate pair `index`, made ahead or now. */
imp_code pair_test_candidate(impact *im, uint32_t index, pair_test *t, imp_error *error);

/* Lets the program's threads test the roots of candidate pairs from `first` on, of `count` in all,
 * unless that was done. */
void pair_test_look_ahead(impact *im, uint32_t first, size_t count, const imp_options *options);

#endif
