/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_UPPER_TIME_H
#define CORE_SOLVER_UPPER_TIME_H

#include "core/solver/pair_heap.h"
#include "core/witness/witness.h"

/* A contact that is found before it is proved to be the first
 * =========================================================
 * The nearest points of a pair's surfaces, followed in time, soon touch: then the first contact is
 * no later. Such a time, of which the search learns early, ends the windows of the pairs that are
 * followed, a little behind it; what is left of these windows waits on the heap. Where the search
 * comes to it, it is the answer. */

typedef struct upper_time {
    bool is_known; /* `seen` touches at t; if false, only the counters are valid */
    double t;
    witness seen;
    uint32_t candidate_pair; /* whose witness */
    bool has_horizon;
    double horizon; /* any time, t or a little later: where windows end while they are followed */
    uint64_t followed, next; /* pairs followed; how many it takes until the next search */
} upper_time;

/* Counts a pair that is followed, and, when it is time, seeks a contact earlier than t from there;
 * *sought tells whether it did. IMP_ERROR_PLUGIN when an evaluation fails. */
imp_code upper_time_follow(upper_time *up, const pair *p, double gamma, bool *sought,
                           imp_error *error);

/* Adapts to a smaller gamma: a contact that still touches stays known; otherwise one is sought at
 * once. */
void upper_time_refine(upper_time *up, double gamma);

/* Ends the window at the horizon. True: there is a part behind it, which becomes *later. */
bool upper_time_divide(const upper_time *up, time_window *window, time_window *later);

#endif
