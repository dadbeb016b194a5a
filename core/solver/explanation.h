/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_EXPLANATION_H
#define CORE_SOLVER_EXPLANATION_H

#include <impinge/examine.h>

#include "core/solver/impact.h"

/* Why pairs had to be divided
 * ===========================
 * A pair that no bound parts is tested again with less to hold it together: without one node's
 * remainder, then without both. What helps is the obstacle. This costs up to four more tests of a
 * pair, is done only where an explanation is asked for, and changes nothing of the search. */

/* Returns what kept this pair of nodes from being parted. `both`: its surfaces. */
imp_obstacle explanation_of(const pair *p, const candidate_pair *both, double gamma_clear);

/* Returns explanation_of if im->explained is not NULL; else IMP_OBSTACLE_SIZE, without a test. */
imp_obstacle explanation_if_asked(const impact *im, const pair *p);

/* Counts a divided pair, or one that ended the search, where im->explained is not NULL. */
void explanation_count(impact *im, const pair *p, imp_obstacle obstacle);

/* Fills in what does not depend on counts: the surfaces, and what their types leave out. */
void explanation_describe(const candidate_pair *both, imp_explanation *row);

#endif
