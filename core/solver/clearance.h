/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_H
#define CORE_SOLVER_CLEARANCE_H

#include "core/broad_phase/candidates.h"
#include "core/solid/inside.h"
#include "core/solver/min_distance.h"

/* The questions of imp_clearance_new
 * ==================================
 * A clearance is a list of tasks, pairs of bodies by slices of time, each with a minimum distance
 * that is searched for by itself; the trees are shared. Where something is required and violated,
 * or only the verdict is asked for, a search for the earliest violation follows. */

typedef struct clearance_search clearance_search;

/* Checks what is asked. The watch ends long looks at solid bodies, and must outlive it. any_pair:
 * two surfaces of the scene are to be tested with each other. */
imp_code clearance_new(imp_scene *scene, bool any_pair, const imp_options *options,
                       const imp_clearance_options *asked, const patch_watch *watch,
                       clearance_search **made, imp_error *error);
/* Asks the question of `whole` about two bodies alone. `whole` is only read. */
imp_code clearance_part(const clearance_search *whole, const size_t body[2],
                        const patch_watch *watch, clearance_search **made, imp_error *error);
bool clearance_is_each(const clearance_search *c);
double clearance_near(const clearance_search *c); /* surfaces farther apart do not count; length */
bool clearance_is_of_all_times(const clearance_search *c); /* not of slices */
void clearance_free(clearance_search *c);

/* Divides the candidates, which must outlive it like `stats`, into tasks. */
imp_code clearance_begin(clearance_search *c, const candidate_list *list, imp_stats *stats,
                         imp_error *error);

/* Does one unit of work. *reason: RUNNING, NONE when all tasks are done, or why it cannot go on. */
imp_code clearance_work(clearance_search *c, imp_reason *reason, imp_error *error);

/* State of the task that is searched now, for progress and budgets. */
typedef struct clearance_state {
    double lower, upper; /* length */
    double t_lower;      /* no violation before; NAN while it is not searched for */
    size_t heap, bytes;  /* pairs that wait; memory beside the trees */
} clearance_state;
clearance_state clearance_look(const clearance_search *c);

/* With `each` and `within`: 0 before clearance_begin. */
size_t clearance_count(const clearance_search *c);

/* `reason` is given to tasks that are not done. */
imp_code clearance_answer(const clearance_search *c, size_t index, imp_reason reason,
                          imp_clearance *answer, imp_error *error);

#endif
