/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_PARTS_H
#define CORE_SOLVER_CLEARANCE_PARTS_H

#include "core/solver/clearance.h"

/* What the files of the clearance share: clearance_parts.c divides what is asked into parts, clearance.c
 * searches them one after the other. */

/* A pair of bodies, or all, during a slice of time. */
typedef struct part {
    imp_clearance answer;
    size_t first, count; /* its candidates in the list */
    bool done;
} part;

typedef enum stage { STAGE_NEXT, STAGE_DISTANCE, STAGE_VIOLATION } stage;

struct clearance_search {
    const imp_scene *scene;
    bool any_pair;
    imp_options options;
    imp_clearance_options asked;
    part *parts;
    size_t count, current;
    stage stage;
    const candidate_list *list;
    imp_stats *stats;
    imp_stats before; /* when the current part began; seconds: of the clock */
    min_distance distance;
    impact violation;
    size_t tested; /* of the current part's candidates, while the violation is searched for */
    uint64_t turn_from, turn; /* of stats->pairs: when its turn began, and how many a turn has */
    bool takes_turns; /* that search took long: it and the search for the distance go on in turn */
    bool unresolved;  /* double precision ended that search: the distance is to decide */
};

#endif
