/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TIME_OF_IMPACT_H
#define CORE_TIME_OF_IMPACT_H

#include <stdatomic.h>

#include "pair_heap.h"
#include "witness.h"

/* The search for the earliest contact: pop, witness, prune, split, push
 * =====================================================================
 * After every impact_advance: (a) no pair of points of the couples is nearer than `clearance` at
 * any time before t_lower; (b) with IMPACT_CONTACT the witness's gap_upper is at most gamma at
 * t_lower; (c) with IMPACT_CLEAR there are no such points at all. (a) holds for every answer. */

/* Two surfaces of different bodies whose boxes come near each other. */
typedef struct couple {
    tree *trees[2];
    size_t body[2], surface[2];
    double inexact; /* how inexact evaluation is, about; set by impact_add_couple; length */
} couple;

typedef enum impact_state {
    IMPACT_RUNNING,
    IMPACT_CONTACT,
    IMPACT_CLEAR,
    IMPACT_RESOLUTION, /* a pair is too small to split and neither apart nor touching */
    IMPACT_NO_MEMORY
} impact_state;

typedef struct impact {
    double gamma, clearance;
    imp_method method;
    imp_bounds bounds;
    couple *couples; /* the caller's */
    pair_heap heap;
    uint64_t serial;
    double t_lower;
    witness found;         /* IMPACT_CONTACT: the witness, */
    uint32_t found_couple; /* and whose */
    imp_stats stats;       /* bytes: of the trees, without the heap */
} impact; /* the caller sets gamma ... couples and t_lower, the rest is 0; impact_clear frees */

/* Tests the roots of couple `index` and keeps the pair if they may be near. */
imp_code impact_add_couple(impact *im, uint32_t index, impact_state *state, imp_error *error);

/* Takes one pair from the heap and follows it one step. On IMP_ERROR_PLUGIN the search is over and
 * its results so far still stand. */
imp_code impact_advance(impact *im, impact_state *state, imp_error *error);

void impact_clear(impact *im);

#endif
