/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_IMPACT_H
#define CORE_SOLVER_IMPACT_H

#include "core/bounds/separation.h"
#include "core/bounds/trial_rate.h"
#include "core/proof/proof_log.h"
#include "core/solver/pair_spread.h"
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
    pair p;            /* the window that is left, and the axis */
    bool near;         /* whether its nodes may be within gamma_clear */
    bool meets;        /* for a candidate pair: at the window's start, at these parameters */
    double meeting[4]; /* (s_u, s_v) of a and of b, relative to the nodes (pair_meeting.h) */
    bool any_time;  /* for a candidate pair: both exist at some time; if false, the rest is unset */
    bool done;      /* made ahead by another thread */
    uint64_t bytes; /* of nets made for it */
} pair_test;

/* Tests of candidate pairs from `first` on, made ahead by other threads. */
typedef struct tests_ahead {
    pair_test *tests;
    uint32_t first, count;
} tests_ahead;

/* How often expensive bounds paid in one candidate pair. */
typedef struct pair_trials {
    trial_rate turning; /* turning axes, in all tests except the roots' (separation.h) */
    trial_rate sliding; /* distances where axes separate nodes whose parents slid (distance.h) */
    uint32_t popped, next_wide; /* pairs without nets; the count that the next wide search awaits */
    uint32_t tubes;             /* pairs of tubes that were popped (pair_tubes.h) */
    bool are_open;              /* tubes of this candidate pair are opened */
    double start;               /* of the window, about half as many pairs before that count */
} pair_trials;

typedef struct impact {
    double gamma, gamma_clear;
    time_window window;              /* the times that are searched */
    uint32_t baseline;               /* of imp_options; 0: by Taylor models */
    uint64_t max_pairs;              /* of imp_options */
    candidate_pair *candidate_pairs; /* the caller's */
    size_t candidate_pair_count;     /* 0: each pair's roots are tested when added */
    imp_stats *stats; /* the caller's; its bytes are those of the trees, without the heap */
    const query_spread *spread; /* the caller's; NULL: the scene is no middle of a box of values */
    proof_log *proof;           /* the caller's; NULL: none is kept */
    pair_heap heap;             /* its store is that of all this memory */
    upper_time upper;           /* used with Taylor models only */
    imp_explanation *explained; /* counts for each candidate pair; NULL: not asked for */
    bool explains;              /* they are asked for */
    pair_trials *trials;        /* for each candidate pair, from the first step on, or NULL */
    tests_ahead ahead;          /* made by other threads (pair_test.h) */
    uint64_t serial, refined;   /* number of the next pair; of the first after impact_refine */
    double t_lower;
    double apart_until; /* all that is not among the candidate pairs is farther apart than gamma
                           before; INFINITY: at all times */
    time_window *roots; /* windows of candidate pairs; NAN: unknown; NULL: before impact_refine */
    bool *passed;       /* candidate pairs that impact_pass excluded; NULL: none */
    bool any_gap;       /* whether two points were evaluated, */
    double least_gap;   /* and the least distance of two; length */
    witness found;      /* IMPACT_CONTACT: the witness, */
    uint32_t found_candidate; /* of the last expanded pair; of the witness with IMPACT_CONTACT */
} impact; /* the caller sets gamma ... stats, t_lower and apart_until, the rest is 0; impact_clear
             frees */

/* Returns the counts of turning axes of the pair; NULL before the first step: always try. */
static inline trial_rate *impact_turning(const impact *im, const pair *p)
{
    return im->trials != NULL ? &im->trials[p->candidate_pair].turning : NULL;
}

/* Counts a test, and pushes the pair unless its nodes stay apart. Precondition: the heap has
 * capacity. */
void impact_push(impact *im, pair_test *t);

/* Pushes a pair that is not tested, since max_pairs are: it is tested if it is ever popped.
 * Precondition: as for impact_push. */
void impact_push_untested(impact *im, const pair *p);

/* Takes the caller's candidate pairs, to which some were added since. False: no memory; some of
 * the counts are longer, which does no harm. */
bool impact_take_candidates(impact *im, candidate_pair *pairs, size_t count);

/* Keeps the least gap of all witnesses. */
void impact_note_gap(impact *im, const witness *seen);

/* Keeps the witness of the contact that ends the search. */
impact_state impact_contact(impact *im, const witness *seen);

/* Whether gamma_clear is nearly gamma, as for a required distance. */
static inline bool impact_is_narrow(const impact *im) { return im->gamma_clear > 0.5 * im->gamma; }

#endif
