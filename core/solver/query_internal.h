/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_QUERY_INTERNAL_H
#define CORE_SOLVER_QUERY_INTERNAL_H

#include <stdatomic.h>

#include "core/broad_phase/examined_times.h"
#include "core/solid/inside.h"
#include "core/solver/clearance.h"
#include "core/solver/explanation.h"
#include "core/solver/time_of_impact.h"
#include "core/solver/world.h"

/* Declarations that the files of the query share: query.c makes and runs it, query_limits.c ends it
 * early, query_collect.c is its broad phase, query_contact.c its search for a contact,
 * query_refine.c continues it, query_divide.c divides it, query_answer.c and query_clearance.c
 * return its results. */

/* The parts of a divided query. */
typedef struct query_parts {
    size_t count;
    atomic_uint_least64_t nodes, bytes; /* that they have added to the scene's trees */
    size_t
        first[]; /* where the candidates of each begin and, at [count], where the last ones end */
} query_parts;

struct imp_query {
    imp_scene *scene;
    imp_options options;
    examined_times examined;
    imp_stats stats;      /* bytes: of the trees, without the heap */
    double gamma_clear;   /* as requested; searches use it plus slips; length */
    uint64_t scene_bytes; /* 0 in a part of a divided query: the whole query counts them */
    uint64_t peak_bytes;
    double next_report; /* seconds spent when options.progress is called next */
    bool failed;
    imp_verdict verdict;
    proof_logs *proof;     /* NULL: none is kept */
    bool at_rest;          /* CONTACT of two surfaces that do not move, */
    world_witness contact; /* found here */
    imp_reason reason;
    atomic_bool cancelled;
    candidate_list candidates;
    clearance_search *clearance; /* NULL: the earliest contact is sought, as follows */
    impact impact;
    size_t candidates_tested; /* how many candidate pairs have been tested */
    limit_watch watch;        /* ends what is asked about solid bodies when a limit comes */
    double step_from[2];      /* seconds spent before this step; of the clock when it began */
    bool watch_ended;         /* a limit came */
    inside_search *insides;   /* NULL: not begun */
    double seam;              /* most width of a seam of a solid; INFINITY: gamma says it */
    size_t insides_next;      /* of the candidate pairs, which bodies are asked about next */
    bool inside_unknown;      /* of two bodies it cannot be told, */
    size_t unknown_candidate; /* which are this pair's */
    imp_contact_kind kind;    /* CONTACT; INSIDE: */
    inside_answer inside;
    query_parts *parts; /* NULL: not divided */
    double divided;     /* seconds of the clock when it was */
};

/* What is added to gamma_clear where a proof is kept, so that the verifier, whose bounds differ,
 * has room; length. */
double query_proof_room(const imp_query *query);

void query_forget_proof(imp_query *query);

/* Ends the query, or the step, with this verdict. */
void query_finish(imp_query *query, imp_verdict verdict, imp_reason reason);

/* Asks about the next two bodies of the candidates one of which is solid, whether one is inside the
 * other at the query's start, which is contact. */
imp_code query_look_inside(imp_query *query, imp_error *error);

/* Whether there is any such pair left to ask about. */
bool query_may_be_inside(const imp_query *query);

/* Makes the query's watch. */
void query_begin_watch(imp_query *query);

/* Lets all pairs be asked again who is inside whom. */
void query_forget_insides(imp_query *query);

/* Returns the reason that a clear query answers. */
imp_reason query_reason_of_clear(const imp_query *query);

/* Counts the memory of this moment, of which `of_candidates` bytes are the broad phase's. */
void query_note_bytes(imp_query *query, uint64_t of_candidates);

/* Reads the clock, and reports progress if that is due; the program may cancel then.
 * `seconds_before` were spent before this step, which began at `start` of the clock. */
void query_read_clock(imp_query *query, double seconds_before, double start);

/* Holds callbacks of this thread to the time that max_seconds leaves at `start`; returns what
 * active_callback_limit restores. */
double query_limit_callbacks(const imp_query *query, double start);

/* Returns the limit that is reached, or IMP_REASON_NONE. A cancellation ends one step: it is
 * cleared here, the only place that acts on it, so that none is lost. */
imp_reason query_exhausted_limit(imp_query *query, double seconds);

/* Returns the gamma_clear of the search: the requested one, plus the slip of pairs that are
 * searched at one moment, and room for a verifier. */
double query_searched_gamma_clear(const imp_query *query, double gamma_clear);

/* Does one unit of work of the search for the earliest contact: tests the roots of the next
 * candidate pair or, after all of them, expands a pair of the heap. */
imp_code query_search_contact(imp_query *query, imp_error *error);

/* Fills the list of candidates, unless a limit comes first, which ends the query. `start` is when
 * the step began. */
imp_code query_collect(imp_query *query, double start, imp_error *error);

/* Lets the search have the candidates that were added. IMP_ERROR_MEMORY: it has those before, and
 * this is to be called again. */
imp_code query_take_candidates(imp_query *query, imp_error *error);

/* Adds pairs that come near only later to the candidates, unless a limit comes first, which ends
 * the query. */
imp_code query_collect_more(imp_query *query, imp_error *error);

/* Fills the list of candidates of a part, in the frames in which they are searched. Limits that
 * come first are left to the next step. `whole` is only read, but for the counts of its parts. */
imp_code query_collect_part(imp_query *part, const imp_query *whole, size_t index,
                            imp_error *error);

#endif
