/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_INTERNAL_H
#define CORE_SOLVER_CLEARANCE_INTERNAL_H

#include "core/solver/clearance.h"
#include "core/solver/time_of_impact.h"

/* Declarations that clearance_divide.c, which divides a query into tasks, and clearance.c, which
 * searches them one after the other, share. */

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
    size_t current;         /* index of the current task: number of finished tasks */
    imp_clearance *answers; /* of the finished tasks */
    size_t answer_capacity;
    imp_clearance answer; /* of the current task so far */
    stage stage;
    const candidate_list *whole;
    const candidate_list *list; /* all candidates, or `own`: */
    candidate_list own;    /* the same pairs, with new trees that only recent slices have used */
    uint64_t shared_bytes; /* stats->bytes without the trees of `own`, */
    uint64_t fresh_bytes;  /* and with them, when they were new */
    imp_stats *stats;
    proof_logs *proof; /* NULL: none is kept */
    bool by_violation; /* the search for a violation decided the last task */
    imp_stats before;  /* stats when the current task began; seconds: clock time */
    min_distance distance;
    impact violation;
    size_t tested; /* candidates of the current task that the search for a violation has tested */
    uint64_t turn_from, turn; /* stats->pairs when the turn began; length of a turn in pairs */
    bool takes_turns; /* that search takes long: it alternates with the search for the distance */
    const limit_watch *watch;
    inside_search *insides; /* NULL: solid bodies were not tested yet */
    bool inside_unknown;    /* undecided for some bodies at the current task's start */
    bool known_outside;     /* no body is inside another at the next task's start */
    bool unresolved;        /* double precision ended that search: the distance has to decide */
};

/* Whether one of the current task's bodies, in order, is inside another that is solid when it
 * begins. *found.state is INSIDE_STOPPED where the watch ended the look: begin again. */
imp_code clearance_look_inside(clearance_search *c, const clearance_group *group,
                               inside_answer *found, imp_error *error);

/* Returns the answer of a task that has not begun. */
imp_clearance clearance_blank_answer(const clearance_search *c, size_t index);

#endif
