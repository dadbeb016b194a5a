/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_UPPER_TIME_H
#define CORE_SOLVER_UPPER_TIME_H

#include "core/bounds/net_paraboloid.h"
#include "core/solver/pair_heap.h"
#include "core/witness/witness.h"

/* A contact that is found before it is proved to be the first
 * ===========================================================
 * The nearest points of a pair's surfaces, followed in time, may touch: the first contact is no
 * later than that. Such an upper time ends the windows of the pairs that are expanded, a little
 * after it; the later parts of these windows stay on the heap. When the search reaches the upper
 * time, it is the answer. */

typedef struct upper_time {
    bool is_known; /* `seen` is a contact at t; if false, only the counters are valid */
    double t;
    witness seen;
    uint32_t candidate_pair;   /* of the witness */
    bool has_horizon;          /* the contact was found by following nets; then only: */
    double horizon;            /* t or a little later: windows of expanded pairs end there */
    net_paraboloid paraboloid; /* between the surfaces at the contact */
    uint32_t count;            /* of such contacts so far, each earlier than the one before */
    bool has_nets;             /* the last expanded pair has nets, by which it may be followed */
    uint64_t followed, next;   /* pairs expanded; the count at which the next search is made */
} upper_time;

/* Counts an expanded pair and, at intervals, seeks a contact earlier than t starting from it;
 * *sought: whether it did. IMP_ERROR_PLUGIN: an evaluation failed. */
imp_code upper_time_follow(upper_time *up, const pair *p, double gamma, bool *sought,
                           imp_error *error);

/* Seeks a contact at the start of what is left of the pair's window; *met: there is one, and it is
 * kept. Precondition: no contact is known up to then. */
imp_code upper_time_try(upper_time *up, const pair *p, double start, double gamma, bool *met,
                        imp_error *error);

/* Keeps a witness of the pair at time t if its gap is within gamma: a contact earlier than the
 * known one. */
void upper_time_note(upper_time *up, const pair *p, double t, double gamma, const witness *seen);

/* Adapts to a smaller gamma: a contact whose gap is still small enough stays known; otherwise the
 * next pair is used to seek one. */
void upper_time_refine(upper_time *up, double gamma);

/* Whether the horizon is inside the window. */
static inline bool upper_time_divides(const upper_time *up, const time_window *window)
{
    return up->has_horizon && window->lo < up->horizon && up->horizon < window->hi;
}

#endif
