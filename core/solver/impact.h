/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_IMPACT_H
#define CORE_SOLVER_IMPACT_H

#include "core/bounds/separation.h"
#include "core/bounds/trial_rate.h"
#include "core/solver/subdivision.h"
#include "core/solver/upper_time.h"
#include "core/witness/witness.h"

#include <impinge/baseline.h>
#include <impinge/examine.h>

/* The state of a search for the earliest contact
 * ==============================================
 * time_of_impact.h takes its steps, expand_pair.h divides pairs and pair_test.h tests them. */

typedef enum impact_state {
    IMPACT_RUNNING,
    IMPACT_CONTACT,
    IMPACT_CLEAR,
    IMPACT_RESOLUTION, /* a pair is too small to split and neither apart nor touching */
    IMPACT_NO_MEMORY
} impact_state;

/* The first test of a pair and its result. */
typedef struct pair_test {
    pair p;         /* the window that is left, and the axis */
    bool near;      /* whether its nodes may be within gamma_clear */
    bool any_time;  /* for a candidate pair: both exist at one time; else nothing else counts */
    bool done;      /* ahead of its turn */
    uint64_t bytes; /* of nets made for it */
} pair_test;

/* Tests of candidate pairs from `first` on, whose turn has not come. */
typedef struct tests_ahead {
    pair_test *tests;
    uint32_t first, count;
} tests_ahead;

/* Counts of what pays in one candidate pair. */
typedef struct pair_trials {
    trial_rate turning; /* axes that turn, in all tests but the roots' (separation.h) */
    trial_rate sliding; /* distances where an axis parts nodes whose parents slid (distance.h) */
} pair_trials;

typedef struct impact {
    double gamma, gamma_clear;
    time_window window;              /* what is before or after does not count */
    uint32_t baseline;               /* of imp_options; 0: by models */
    candidate_pair *candidate_pairs; /* the caller's */
    size_t candidate_pair_count;     /* 0: their roots are tested at once, each */
    imp_stats *stats;                /* the caller's; bytes: of the trees, without the heap */
    pair_heap heap;
    upper_time upper;           /* with method models */
    imp_explanation *explained; /* counts for each candidate pair; NULL: not asked for */
    bool explains;              /* they are asked for */
    pair_trials *trials;        /* for each candidate pair, from the first step on, or NULL */
    tests_ahead ahead;          /* made by threads that look ahead (pair_test.h) */
    uint64_t serial, refined;   /* of the next pair; of the first after impact_refine */
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
static inline trial_rate *impact_turning(const impact *im, const pair *p)
{
    return im->trials != NULL ? &im->trials[p->candidate_pair].turning : NULL;
}

/* Counts a test, and puts the pair on the heap, which has room, unless its nodes stay apart. */
void impact_push(impact *im, pair_test *t);

/* Keeps the least gap of all witnesses. */
void impact_note_gap(impact *im, const witness *seen);

/* Keeps the witness of the contact that ends the search. */
impact_state impact_contact(impact *im, const witness *seen);

#endif
