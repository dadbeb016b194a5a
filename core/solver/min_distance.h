/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_MIN_DISTANCE_H
#define CORE_SOLVER_MIN_DISTANCE_H

#include "core/solver/subdivision.h"
#include "core/witness/witness.h"

/* The search for the minimum distance over a window of time
 * =========================================================
 * Branch and bound: the pair of least lower bound is divided first, and whatever cannot be nearer
 * than `enough`, a little less than the best witness, is pruned. After every min_distance_advance:
 * (a) no pair of points of the candidates is nearer than min_distance_lower at any time of the
 * window; (b) where upper is finite, the witness's points are no farther apart than that at the
 * time it was found, which lies in the window. */

typedef struct min_distance {
    /* set by the caller; the rest begins as 0, and min_distance_clear frees */
    time_window window;
    double tolerance; /* the search ends when the bracket is as narrow as this part of upper */
    double gamma;     /* or when upper is no more than this; length */
    double required;  /* or, if > 0, not before upper <= required or lower >= relaxed; length */
    double relaxed;   /* a little below what is required */
    double slip; /* what is proved of the candidates holds of the surfaces but for this; length */
    candidate_pair *candidates; /* the caller's */
    imp_stats *stats;           /* the caller's; bytes: of the trees, without the heap */
    /* kept */
    pair *starts; /* candidates not tested yet, farthest first */
    size_t start_count, start_capacity;
    pair_heap heap;
    uint64_t serial;
    double upper;       /* INFINITY: there is no witness yet */
    double stuck;       /* least lower bound of the pairs that precision keeps from being divided */
    witness found;      /* gives upper, */
    double t;           /* at this time, */
    uint32_t candidate; /* of this candidate */
} min_distance;

typedef enum min_distance_state {
    MIN_DISTANCE_RUNNING,
    MIN_DISTANCE_DONE,
    MIN_DISTANCE_RESOLUTION, /* done, but precision ended before the bracket was narrow enough */
    MIN_DISTANCE_NO_MEMORY
} min_distance_state;

/* Takes candidates[first] and `count` in all, as far as their surfaces exist within the window. */
imp_code min_distance_begin(min_distance *m, size_t first, size_t count, imp_error *error);

/* Takes one pair and follows it one step. */
imp_code min_distance_advance(min_distance *m, min_distance_state *state, imp_error *error);

/* Returns the lower bound proved so far for the surfaces; INFINITY if there are no candidates. */
double min_distance_lower(const min_distance *m);

void min_distance_clear(min_distance *m);

#endif
