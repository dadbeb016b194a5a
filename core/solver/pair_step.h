/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_STEP_H
#define CORE_SOLVER_PAIR_STEP_H

#include "core/bounds/strategy.h"
#include "core/solver/subdivision.h"

/* Steps that the searches for contact and for the distance have in common
 * =======================================================================
 * Both are branch and bound over a heap of pairs: look at the popped pair's one-sided distances,
 * seek a witness, cut a node, test the halves, push what is left. They differ in what a test is and
 * in what orders the heap: a window and its start (expand_pair.h), a lower bound of the distance
 * and its least value (min_distance.h). */

/* What a search tells apart: lengths. */
typedef struct resolution {
    double room;  /* between a distance that is far enough and one that is near enough */
    double scale; /* what is smaller does not matter: what is near enough, or twice the room where
                     that is less */
} resolution;

static inline resolution resolution_of(double near, double far)
{
    const double room = near - far;
    return (resolution){room, 2 * room < near ? 2 * room : near};
}

/* What the distances of the pair's nodes from each other's whole surfaces show, where these are
 * asked for (strategy_takes_distances). `limit`: what is farther apart does not matter; `sliding`
 * as there. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code pair_look(const pair *p, candidate_pair *both, double limit, strategy_goal goal,
                   trial_rate *sliding, distance_outcome *seen, imp_error *error);

/* The cut of the side whose node is worth halving alone, by what pair_look has seen; CUT_NONE:
 * there is no such side, or its remainder is too small to matter. */
cut pair_cut_alone(const pair *p, const distance_outcome *seen, double scale);

/* Puts the pair on the heap, which has room, behind others of the same first key whose centres are
 * nearer at time t; counts it in *serial and `stats`. */
void pair_push(pair_heap *heap, pair *p, double t, uint64_t *serial, imp_stats *stats);

#endif
