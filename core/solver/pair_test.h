/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_TEST_H
#define CORE_SOLVER_PAIR_TEST_H

#include "core/solver/time_of_impact.h"

/* Whether a pair's nodes may be within the clearance
 * ==================================================
 * The first test of a pair may leave more of its window than there is; it is completed when the pair is
 * popped, as a third of what is pushed never is. Pairs of roots are tested first of all, perhaps ahead of
 * their turn by several threads: such a test depends on nothing but its two nodes. */

/* Completely; p->window becomes what is left. Of a pair that had its first test, or whose nodes had. */
bool pair_test_fully(const impact *im, pair *p);

/* Makes the nets of the nodes that may have one, if they are of use; what that takes is added to *bytes. */
imp_code pair_test_ask_for_nets(const impact *im, const pair *p, uint64_t *bytes, imp_error *error);

/* The first test of t->p, to the rest of *t. Makes the nodes' nets. `turning` as for separation_by_models. */
imp_code pair_test_first(const impact *im, pair_test *t, chances *turning, imp_error *error);

/* The first test of the roots of candidate pair `index`: that made ahead, or one made now. */
imp_code pair_test_candidate(impact *im, uint32_t index, pair_test *t, imp_error *error);

/* Has candidate pairs from `first` on, of `count` in all, tested by the threads of the program, unless
 * that was done. */
void pair_test_look_ahead(impact *im, uint32_t first, size_t count, const imp_options *options);

#endif
