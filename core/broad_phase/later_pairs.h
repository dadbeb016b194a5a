/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_LATER_PAIRS_H
#define CORE_BROAD_PHASE_LATER_PAIRS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/base/arena_store.h"
#include "core/broad_phase/candidate.h"

/* Pairs of candidates that are left for later
 * ===========================================
 * In a crowd each surface sweeps, in all of the query's times, through the boxes of many others,
 * but few come near each other before the first contact. A pair that waits takes 8 bytes, no tree
 * and no test. */

/* Candidates of pairs that were made ready together. */
typedef struct ready_candidates {
    struct ready_candidates *next;
    candidate *at;
    size_t count;
} ready_candidates;

typedef struct later_pairs {
    arena_store *store;
    uint32_t (*pair)[2]; /* numbers of two candidates; once sorted: by body of the first, body of
                            the second, first, second */
    size_t count, capacity;
    double until;            /* these pairs are apart before */
    size_t spans;            /* as of a collection: what is left for all pairs of the query */
    ready_candidates *ready; /* of pairs that do not wait any more */
    size_t ready_count;      /* candidates in all of these */
} later_pairs;

/* NULL: no memory. */
later_pairs *later_pairs_new(arena_store *store, double until);
void later_pairs_free(later_pairs *later);
uint64_t later_pairs_bytes(const later_pairs *later); /* of NULL, too */

/* False: no memory. */
bool later_pairs_add(later_pairs *later, size_t first, size_t second);

/* Sorts them. False: no memory. */
bool later_pairs_sort(later_pairs *later, const candidate *candidates, size_t count);

/* Returns the number of the first pair after pair k that is not of the same two bodies. */
size_t later_pairs_next(const later_pairs *later, const candidate *candidates, size_t k);

#endif
