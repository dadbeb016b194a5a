/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_MIN_DISTANCE_H
#define CORE_SOLVER_MIN_DISTANCE_H

#include "core/proof/proof_log.h"
#include "core/solver/subdivision.h"
#include "core/witness/witness.h"

/* The search for the minimum distance over a window of time
 * =========================================================
 * Branch and bound: the pair of least lower bound is split first, and pairs farther apart than
 * `enough`, which is slightly less than the best witness's gap, are pruned. After every
 * min_distance_advance: (a) no pair of points of the candidates is nearer than min_distance_lower
 * at any time of the window; (b) where upper is finite, the witness's points are no farther apart
 * than that at the time it was found, which lies in the window. */

typedef struct min_distance {
    /* set by the caller; the rest begins as 0, and min_distance_clear frees */
    time_window window;
    double tolerance;   /* the search ends when the bracket is as narrow as this part of upper */
    double gamma;       /* or when upper is no more than this; length */
    uint64_t max_pairs; /* of imp_options */
    double required;    /* if > 0, it does not end before upper <= required or lower >= relaxed */
    double relaxed;     /* slightly below `required`; length */
    double slip; /* distances of candidates and of their surfaces differ by at most this; length */
    candidate_pair *candidates; /* the caller's */
    imp_stats *stats;           /* the caller's; bytes: of the trees, without the heap */
    proof_log *proof;           /* the caller's; NULL: none is kept */
    /* set by the search */
    pair *starts; /* candidates not tested yet, farthest first */
    size_t start_count, start_capacity;
    pair_heap heap;
    uint64_t serial;
    double upper;       /* INFINITY: there is no witness yet */
    double stuck;       /* least lower bound of the pairs that double precision cannot split */
    witness found;      /* its gap gives upper, */
    double t;           /* at this time, */
    uint32_t candidate; /* of this candidate */
} min_distance;

typedef enum min_distance_state {
    MIN_DISTANCE_RUNNING,
    MIN_DISTANCE_DONE,
    MIN_DISTANCE_RESOLUTION, /* done, but precision ended before the bracket was narrow enough */
    MIN_DISTANCE_NO_MEMORY
} min_distance_state;

/* Begins with `count` candidates from candidates[first] on, if their surfaces exist in the
 * window. */
imp_code min_distance_begin(min_distance *m, size_t first, size_t count, imp_error *error);

/* Pops one pair and expands it. */
imp_code min_distance_advance(min_distance *m, min_distance_state *state, imp_error *error);

/* Returns the distance above which pairs are pruned; INFINITY while there is no witness. */
double min_distance_enough(const min_distance *m);

/* Returns the lower bound proved so far for the surfaces; INFINITY if there are no candidates. */
double min_distance_lower(const min_distance *m);

void min_distance_clear(min_distance *m);

#endif
