/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_SIGHT_H
#define CORE_SOLVER_SIGHT_H

#include "core/solver/distance.h"
#include "core/solver/subdivision.h"

/* What one node's distance from the other's surface shows of a pair
 * =================================================================
 * Asked of each of the two nodes while the answer is not known. */

typedef struct sight {
    time_window
        left; /* of the pair's window: outside, its nodes are farther apart than the clearance */
    bool is_apart;  /* all the time */
    double lower;   /* no nearer over the pair's window, if nearer than the clearance; length */
    int side;       /* whose node alone is worth halving; -1: neither */
    double bend[3]; /* how far u, v and t bend its points beside the other surface, about; length */
} sight;

/* Nothing is known yet. */
sight sight_none(const pair *p);

/* Adds to *seen what both nodes show, both bounded. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code sight_take(const pair *p, candidate_pair *both, double clearance, sight *seen,
                    imp_error *error);

#endif
