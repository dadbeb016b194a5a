/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_TEST_H
#define CORE_SOLVER_PAIR_TEST_H

#include "core/solver/impact.h"

/* Whether a pair's nodes may be within gamma_clear
 * ==================================================
 * The first test of a pair may leave too much of its window. It is completed when the pair is
 * popped, since a third of the pairs pushed never is. Pairs of roots are tested first of all,
 * perhaps ahead of their turn by several threads: such a test depends only on its two nodes. */

/* Completes the test of a pair that had its first test, or whose nodes had; p->window becomes what
 * is left. */
bool pair_test_fully(const impact *im, pair *p);

/* Makes the nodes' nets where they are of use; their memory is added to *bytes. */
imp_code pair_test_ask_for_nets(const impact *im, const pair *p, uint64_t *bytes, imp_error *error);

/* The first test of t->p; the rest of *t is its result. Makes the nodes' nets. `turning` is as for
 * separation_window. */
imp_code pair_test_first(const impact *im, pair_test *t, trial_rate *turning, imp_error *error);

/* The first test of the roots of candidate pair `index`: that made ahead, or one made now. */
imp_code pair_test_candidate(impact *im, uint32_t index, pair_test *t, imp_error *error);

/* Has candidate pairs from `first` on, of `count` in all, tested by the threads of the program,
 * unless that was done. */
void pair_test_look_ahead(impact *im, uint32_t first, size_t count, const imp_options *options);

#endif
