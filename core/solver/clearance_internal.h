/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_INTERNAL_H
#define CORE_SOLVER_CLEARANCE_INTERNAL_H

#include "core/solver/clearance.h"
#include "core/solver/time_of_impact.h"

/* What the files of the clearance share: clearance_divide.c divides what is asked into tasks,
 * clearance.c searches them one after the other. */

/* A pair of bodies, or all, during a slice of time. */
typedef struct clearance_task {
    imp_clearance answer;
    size_t first, count; /* its candidates in the list */
    bool done;
} clearance_task;

typedef enum stage { STAGE_NEXT, STAGE_DISTANCE, STAGE_VIOLATION } stage;

struct clearance_search {
    const imp_scene *scene;
    bool any_pair;
    imp_options options;
    imp_clearance_options asked;
    clearance_task *tasks;
    size_t count, current;
    stage stage;
    const candidate_list *list;
    imp_stats *stats;
    imp_stats before; /* when the current task began; seconds: of the clock */
    min_distance distance;
    impact violation;
    size_t tested; /* of the current task's candidates, while the violation is searched for */
    uint64_t turn_from, turn; /* of stats->pairs: when its turn began, and how many a turn has */
    bool takes_turns; /* that search took long: it and the search for the distance go on in turn */
    bool unresolved;  /* double precision ended that search: the distance is to decide */
};

#endif
