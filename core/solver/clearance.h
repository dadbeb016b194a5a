/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_H
#define CORE_SOLVER_CLEARANCE_H

#include "core/broad_phase/candidates.h"
#include "core/solid/inside.h"
#include "core/solver/min_distance.h"

/* Queries of the minimum distance (imp_clearance_new)
 * ===================================================
 * A query is a list of tasks, one for each pair of bodies and slice of time. The minimum distance
 * of each task is searched by itself; the trees are shared. If a required distance is violated, or
 * only a verdict is wanted, a search for the earliest violation follows. */

typedef struct clearance_search clearance_search;

/* Checks the options. The watch ends long tests of solid bodies, and must outlive the search.
 * any_pair: there is a pair of surfaces to be tested. */
imp_code clearance_new(imp_scene *scene, bool any_pair, const imp_options *options,
                       const imp_clearance_options *asked, const limit_watch *watch,
                       clearance_search **made, imp_error *error);
/* Makes the same search as `whole` for two bodies alone. `whole` is only read. */
imp_code clearance_part(const clearance_search *whole, const size_t body[2],
                        const limit_watch *watch, clearance_search **made, imp_error *error);
bool clearance_is_each(const clearance_search *c);
double clearance_near(const clearance_search *c);      /* farther pairs are left out; length */
double clearance_slip_most(const clearance_search *c); /* that the answer has room for; length */
bool clearance_is_of_all_times(const clearance_search *c); /* false: slices */
void clearance_free(clearance_search *c);

/* Divides the candidates into tasks. `list` and `stats` must outlive the search. */
imp_code clearance_begin(clearance_search *c, const candidate_list *list, imp_stats *stats,
                         imp_error *error);

/* Does one unit of work. *reason: RUNNING, NONE when all tasks are done, or why the search cannot
 * continue. */
imp_code clearance_work(clearance_search *c, imp_reason *reason, imp_error *error);

/* The state of the current task, for progress and budgets. */
typedef struct clearance_state {
    double lower, upper; /* length */
    double t_lower;      /* no violation before; NAN while none is searched for */
    size_t heap, bytes;  /* pairs on the heap; memory without the trees */
} clearance_state;
clearance_state clearance_look(const clearance_search *c);

/* Returns the pairs of nodes that the current task still has to search, and the distance that would
 * part them; NULL: no task has begun, or the last has ended. */
const pair_heap *clearance_waiting(const clearance_search *c, double *apart);

/* Returns the number of tasks; with `each` and `within` it is 0 before clearance_begin. */
size_t clearance_count(const clearance_search *c);

/* Fills the answer of task `index`; an unfinished task gets `reason`. */
imp_code clearance_answer(const clearance_search *c, size_t index, imp_reason reason,
                          imp_clearance *answer, imp_error *error);

/* Keeps what a certificate needs in `logs`, from the first step on. IMP_ERROR_USAGE: there is more
 * than one answer. */
imp_code clearance_keep_proof(clearance_search *c, proof_logs *logs, imp_error *error);

/* Returns whether the search for a violation proved the answer, else that for the minimum distance
 * did. */
bool clearance_is_by_violation(const clearance_search *c);

/* Returns what the answer of task 0 proves, also where a limit ended it. */
typedef struct clearance_proved {
    double apart, from, to; /* nothing is nearer than `apart` then */
} clearance_proved;
clearance_proved clearance_what_is_proved(const clearance_search *c, const imp_clearance *answer);

#endif
