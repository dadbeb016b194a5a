/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CLEARANCE_H
#define TOOLS_CLI_CLEARANCE_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "tools/cli/message.h"
#include "tools/cli/survey_parts.h"

/* Minimum distances, for people and for programs: tools/schema/clearance.schema.json. */

/* Advice about two bodies whose search a limit ended. */
typedef struct clearance_advice {
    size_t body[2];
    char *text;
} clearance_advice;

/* Answers of one kind: slices, or pairs of bodies; or one. */
typedef struct clearance_table {
    const imp_scene *scene;
    const clearance_advice *advice; /* about pairs of bodies, in the order of the scene */
    size_t advice_count;
    const survey_parts *survey;   /* about all values of parameters; NULL: there are none */
    const imp_clearance *answers; /* NULL: they are read from */
    const imp_query *query;       /* this, */
    imp_reason ended;             /* reason of unfinished answers; RUNNING: they continue */
    size_t count;
    bool has_rest;      /* then the last answer is */
    imp_clearance rest; /* this, which stands for slices that were not begun */
} clearance_table;

/* Returns answer k, below the count. */
imp_clearance clearance_table_get(const clearance_table *table, size_t k);

/* Returns the advice about the answer's bodies; NULL: there is none. */
const char *clearance_table_advice(const clearance_table *table, const imp_clearance *answer);

/* Adds the counts of one search to those of all; peaks are those of the largest. */
void clearance_add_stats(imp_stats *all, const imp_stats *s);

/* --each: an answer for each pair of bodies that do not ignore each other, by several threads. */
typedef struct clearance_each {
    const imp_scene *scene;
    imp_query *query; /* of the whole scene; is divided */
    double required;
    double within; /* pairs of bodies that never come nearer are counted only; 0: none */
    size_t threads;
    uint64_t max_bytes; /* of the divided query and the answers; 0: no limit */
    double until;       /* seconds of the clock: the limit of time; INFINITY: none */
} clearance_each;

typedef struct clearance_answers {
    imp_clearance *list; /* in any order */
    size_t count;
    clearance_advice *advice; /* in the order of the scene */
    size_t advice_count;
    size_t beyond;       /* pairs of bodies that never come within `within` */
    size_t not_examined; /* pairs of bodies, because of a limit or a signal */
    bool has_rest;       /* list[count] is for pairs that are not listed */
    imp_stats stats;     /* of all together */
} clearance_answers;

/* Measures each pair. The caller frees the answers, after an error, too. */
imp_code clearance_each_run(const clearance_each *of, clearance_answers *found, imp_error *error);
void clearance_answers_free(clearance_answers *found);

/* "holds", "violated", "undecided"; NULL: nothing was required. */
const char *clearance_verdict_name(imp_requirement verdict);

/* Returns the combined answer: the least lower and the least upper bound; violated if one is
 * violated, with the first violation if none before it is possible. Precondition: count > 0. */
imp_clearance clearance_summary(const clearance_table *table);

/* Whether a limit or a signal ended a search. */
bool clearance_is_ended(imp_reason reason);

/* Whether it ended before the answer was known. */
bool clearance_is_undecided(const imp_clearance *answer);

/* The exit status that tells the answer: a requirement that is violated is a contact. */
exit_status clearance_status(const imp_clearance *answer);

/* Orders answers by their lower bound, the least first; equal ones in the order of the scene. */
void clearance_sort(imp_clearance *answers, size_t count);

/* Prints lines to standard output, verdict first. Bounds are rounded to the side that claims less.
 * Without a requirement, bodies that come within gamma are said to touch. */
void clearance_print(const imp_scene *scene, const imp_clearance *answer, double gamma);
/* One line a pair of bodies, under a line of heads. count > 0. */
void clearance_print_pairs(const clearance_table *table);

/* Print the CSV header, and one line for each slice. */
void clearance_print_csv_head(const clearance_table *table);
void clearance_print_csv(const clearance_table *table, size_t k, const imp_clearance *slice);

json_t *clearance_json(const imp_scene *scene, const imp_clearance *answer);
json_t *clearance_slice_json(const clearance_table *table, size_t k, const imp_clearance *slice);
/* Prints the object, and frees it, on one line, with the answers as its last key: "slices", or
 * "pairs" of bodies. Answers are made and printed one by one to save memory. A signal that comes
 * meanwhile ends the list, and what is missing is counted on standard error. */
exit_status clearance_print_json(json_t *object, const clearance_table *table, bool slices,
                                 const char *verb);

#endif
