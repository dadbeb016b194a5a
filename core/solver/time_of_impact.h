/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_TIME_OF_IMPACT_H
#define CORE_SOLVER_TIME_OF_IMPACT_H

#include <stdatomic.h>

#include "core/solver/subdivision.h"
#include "core/solver/upper_time.h"
#include "core/solver/witness.h"

/* The search for the earliest contact: pop, witness, prune, split, push
 * =====================================================================
 * After every impact_advance: (a) no pair of points of the candidates is nearer than `clearance` at
 * any time before t_lower; (b) with IMPACT_CONTACT the witness's gap_upper is at most gamma at
 * t_lower; (c) with IMPACT_CLEAR there are no such points at all. (a) holds for every answer. */

typedef enum impact_state {
    IMPACT_RUNNING,
    IMPACT_CONTACT,
    IMPACT_CLEAR,
    IMPACT_RESOLUTION, /* a pair is too small to split and neither apart nor touching */
    IMPACT_NO_MEMORY
} impact_state;

/* The first test of a pair. */
typedef struct pair_test {
    pair p;         /* the window that is left, and the axis */
    bool near;      /* whether its nodes may be within the clearance */
    bool any_time;  /* for a candidate pair: both exist at one time; else nothing else counts */
    bool done;      /* ahead of its turn */
    uint64_t bytes; /* of nets made for it */
} pair_test;

/* Tests of candidate pairs from `first` on, whose turn has not come. */
typedef struct tests_ahead {
    pair_test *tests;
    uint32_t first, count;
} tests_ahead;

/* What pays in one candidate pair. */
typedef struct pair_chances {
    chances turning; /* axes that turn, in all tests but the roots' (separation.h) */
    chances sliding; /* distances where an axis parts nodes whose parents slid (sight.h) */
} pair_chances;

typedef struct impact {
    double gamma, clearance;
    time_window window; /* what is before or after does not count */
    imp_method method;
    imp_bounds bounds;
    candidate_pair *candidate_pairs; /* the caller's */
    size_t candidate_pair_count;     /* 0: their roots are tested at once, each */
    imp_stats *stats;                /* the caller's; bytes: of the trees, without the heap */
    pair_heap heap;
    upper_time upper;         /* with method models */
    pair_chances *chances;    /* for each candidate pair, from the first step on, or NULL */
    tests_ahead ahead;        /* made by threads that look ahead (pair_test.h) */
    uint64_t serial, refined; /* of the next pair; of the first after impact_refine */
    double t_lower;
    time_window
        *roots;       /* of candidate pairs, for impact_refine; NAN: unknown; NULL: never refined */
    bool *passed;     /* candidate pairs that impact_pass leaves out; NULL: none */
    bool any_gap;     /* whether any two points were evaluated, */
    double least_gap; /* and the least distance of two; length */
    witness found;    /* IMPACT_CONTACT: the witness, */
    uint32_t found_candidate; /* whose pair was followed last: with IMPACT_CONTACT, the witness's */
} impact; /* the caller sets gamma ... stats and t_lower, the rest is 0; impact_clear frees */

/* NULL before the first step: each chance is taken. */
static inline chances *impact_turning(const impact *im, const pair *p)
{
    return im->chances != NULL ? &im->chances[p->candidate_pair].turning : NULL;
}

/* Tests the roots of candidate pair `index` and keeps the pair if they may be near. */
imp_code impact_add_candidate(impact *im, uint32_t index, impact_state *state, imp_error *error);

/* Takes one pair from the heap and follows it one step. On IMP_ERROR_PLUGIN the search is over and
 * its results so far still stand. */
imp_code impact_advance(impact *im, impact_state *state, imp_error *error);

/* Goes on with a smaller gamma and clearance; `count` candidate pairs, or 0 while these are not
 * known. False: no memory, nothing has changed. */
bool impact_refine(impact *im, double gamma, double clearance, size_t count);

/* After IMPACT_CONTACT or IMPACT_RESOLUTION: goes on without the two bodies of that pair. False: no
 * memory, nothing has changed. */
bool impact_pass(impact *im, size_t count);

void impact_clear(impact *im);

#endif
