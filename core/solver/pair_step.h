/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_STEP_H
#define CORE_SOLVER_PAIR_STEP_H

#include "core/bounds/strategy.h"
#include "core/solver/subdivision.h"

/* Steps that the searches for contact and for the distance have in common
 * =======================================================================
 * Both are branch and bound over a heap of pairs: compute the popped pair's one-sided distances,
 * seek a witness, split a node, test the halves, push those that are left. They differ in the test
 * and in the order of the heap: a window and its start (expand_pair.h), a lower bound of the
 * distance and its value (min_distance.h). */

/* The lengths that a search has to resolve. */
typedef struct resolution {
    double room;  /* greatest distance that is reported less least that is pruned */
    double scale; /* smaller lengths do not matter: `near`, or twice `room` if that is less */
} resolution;

static inline resolution resolution_of(double near, double far)
{
    const double room = near - far;
    return (resolution){room, 2 * room < near ? 2 * room : near};
}

/* Measures both candidates (candidate_pair_measure) before the pair is looked at. A cluster is cut
 * whatever the errors of its points are, so for it nothing is evaluated yet. */
imp_code pair_measure(const pair *p, const candidate_pair *both, imp_error *error);

/* How a search looks at a pair. */
typedef struct pair_question {
    double limit; /* nodes farther apart do not matter; length */
    strategy_goal goal;
    /* A certificate is written, whose verifier does not believe a type's claims of symmetry: no
     * point stands for others, and no screw motion is taken for rest. */
    bool keeps_proof;
    const time_window *within; /* of the search; NULL: all times of the two surfaces */
    trial_rate *sliding;       /* the candidate pair's count of trials, or NULL */
} pair_question;

/* Computes the distances of the pair's nodes from each other's whole surfaces, if
 * strategy_takes_distances; of two roots with many pieces, once for each goal, those of the pieces;
 * and, once, whether spines part both surfaces (spine.h). IMP_ERROR_PLUGIN: a callback breaks the
 * ABI. */
imp_code pair_look(const pair *p, candidate_pair *both, const pair_question *q,
                   distance_outcome *seen, imp_error *error);

/* Forgets what has been tried of a pair of surfaces, and what was found of some times alone, slips
 * of trees of one moment among it: for a search of another slice of time. */
void pair_look_anew(candidate_pair *both);

/* Returns the cut of the node that pair_look chose to be split alone; CUT_NONE: it chose none, or
 * the node's remainder is too small to matter. */
cut pair_cut_alone(const pair *p, const distance_outcome *seen, double scale);

/* Whether the pair lies where others stand for it (half_plane.h). */
static inline bool pair_is_left_out(const pair *p, const candidate_pair *both)
{
    return candidate_pair_leaves_out(both, p->a, p->b);
}

/* Whether no more pairs may be tested. `most`: max_pairs of imp_options. */
static inline bool pairs_are_spent(const imp_stats *stats, uint64_t most)
{
    return most > 0 && stats->pairs >= most;
}

/* Pushes the pair; among pairs of the same first key, nearer centres at time t come first. Counts
 * it in *serial and `stats`. Precondition: the heap has capacity. */
void pair_push(pair_heap *heap, pair *p, double t, uint64_t *serial, imp_stats *stats);

#endif
