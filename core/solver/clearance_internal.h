/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_INTERNAL_H
#define CORE_SOLVER_CLEARANCE_INTERNAL_H

#include "core/solver/clearance.h"
#include "core/solver/time_of_impact.h"

/* What the files of the clearance share: clearance_divide.c divides what is asked into tasks,
 * clearance.c searches them one after the other. */

/* A pair of bodies, or all: each of its slices of time is a task. */
typedef struct clearance_group {
    size_t body[2];      /* SIZE_MAX: all bodies */
    size_t first, count; /* its candidates in the list */
} clearance_group;

typedef enum stage { STAGE_NEXT, STAGE_DISTANCE, STAGE_VIOLATION } stage;

struct clearance_search {
    imp_scene *scene;
    bool any_pair;
    imp_options options;
    imp_clearance_options asked;
    clearance_group *groups;
    size_t group_count;
    size_t current;         /* index of the task that is searched: as many are done */
    imp_clearance *answers; /* of the tasks that are done */
    size_t answer_capacity;
    imp_clearance answer; /* of the current task, from its beginning on */
    stage stage;
    const candidate_list *whole;
    const candidate_list *list; /* the whole one, or */
    candidate_list own;         /* its pairs with trees that only slices since then have used */
    uint64_t shared_bytes;      /* stats->bytes without the own trees, */
    uint64_t fresh_bytes;       /* and with them when they were new */
    imp_stats *stats;
    imp_stats before; /* when the current task began; seconds: of the clock */
    min_distance distance;
    impact violation;
    size_t tested; /* of the current task's candidates, while the violation is searched for */
    uint64_t turn_from, turn; /* of stats->pairs: when its turn began, and how many a turn has */
    bool takes_turns; /* that search took long: it and the search for the distance go on in turn */
    const patch_watch *watch;
    inside_search *insides; /* NULL: nothing was asked about solid bodies yet */
    bool inside_unknown;    /* at the current task's start, of some bodies */
    bool known_outside;     /* nobody is inside at the next task's start */
    bool unresolved;        /* double precision ended that search: the distance is to decide */
};

/* Whether one of the current task's bodies, in order, is inside another that is solid when it
 * begins. *found.state is INSIDE_STOPPED where the watch ended the look: begin again. */
imp_code clearance_look_inside(clearance_search *c, const clearance_group *group,
                               inside_answer *found, imp_error *error);

/* What is known of a task before it begins. */
imp_clearance clearance_blank_answer(const clearance_search *c, size_t index);

#endif
