/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CLEARANCE_INTERNAL_H
#define CORE_SOLVER_CLEARANCE_INTERNAL_H

#include "core/broad_phase/candidates_rest.h"
#include "core/solver/clearance.h"
#include "core/solver/time_of_impact.h"

/* Declarations that the files of a clearance query share: clearance_divide.c divides it into tasks,
 * clearance.c runs these one after the other. A task is a search for the minimum distance
 * (clearance_distance.c) and, where a distance is required, one for the earliest violation
 * (clearance_violation.c). */

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
    candidate_moments moments; /* of the list, for the current task */
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

/* Returns the bodies of the current task. */
const clearance_group *clearance_group_of(const clearance_search *c);

/* Returns how much distances of the current task's pairs may slip. */
double clearance_slip(const clearance_search *c);

/* Keeps the current task's answer and frees its searches. NONE as a reason becomes DECIDED where
 * the query's limits ended the search before its tolerance. */
void clearance_finish_task(clearance_search *c, imp_reason reason);

/* Whether only a verdict is wanted. */
bool clearance_decides(const clearance_search *c);

/* Whether the bodies are proved to be farther apart than asked.within. */
bool clearance_is_beyond(const clearance_search *c);

/* Return lengths, where a distance is required. Relaxed: between this and the required distance,
 * either verdict is right. Kept: at this the verdict is that it holds; where a proof is kept, half
 * way to the required distance, so that the verifier, whose bounds differ, has room. Searched: what
 * the searches have to prove, which is the one kept, plus the slip of pairs that are searched at
 * one moment. */
double clearance_relaxed(const clearance_search *c);
double clearance_kept(const clearance_search *c);
double clearance_searched(const clearance_search *c);

/* Whether a turn of one search ends. Where the search for contact takes long, a narrow bracket may
 * be known earlier. So both searches alternate, each turn twice as long: the verdict takes at most
 * about four times the work of the faster one. */
bool clearance_turn_ends(clearance_search *c);

/* Begin the search for the minimum distance, and for a violation, of the current task. */
imp_code clearance_begin_distance(clearance_search *c, const clearance_group *group,
                                  imp_error *error);
void clearance_begin_violation(clearance_search *c);

/* Do one unit of work of the task's search; it may finish the task, or hand over to the other
 * search. *reason changes where the query cannot continue. */
imp_code clearance_search_distance(clearance_search *c, imp_reason *reason, imp_error *error);
imp_code clearance_search_violation(clearance_search *c, imp_reason *reason, imp_error *error);

/* Copies what the search for the minimum distance has found so far into the answer. */
imp_code clearance_take_bracket(const clearance_search *c, imp_clearance *answer, imp_error *error);

/* Copies the witness of candidate pair k at time t, whose gap becomes `upper`, into the answer. */
imp_code clearance_take_witness(const clearance_search *c, uint32_t k, const witness *w, double t,
                                imp_clearance *answer, imp_error *error);

/* IMP_ERROR_PLUGIN: the answer's witness contradicts the bound `lower`, which holds before time
 * t. */
imp_code clearance_check_witness(const clearance_search *c, const imp_clearance *answer,
                                 double lower, double t, imp_error *error);

#endif
