/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CLEARANCE_H
#define TOOLS_CLI_CLEARANCE_H

#include <impinge/impinge.h>
#include <jansson.h>

/* Minimum distances, for people and for programs: tools/schema/clearance.schema.json. */

typedef struct clearance_table {
    const imp_scene *scene;
    const imp_clearance *answers; /* of one kind: slices, or pairs of bodies; or one */
    size_t count;
} clearance_table;

/* --each: an answer for each pair of bodies that do not ignore each other, by several threads. */
typedef struct clearance_each {
    const imp_scene *scene;
    imp_query *query; /* of the whole scene; is divided */
    double required;
    size_t threads;
} clearance_each;

/* The answers, in the order of the scene and to be freed, and what they cost together. On an error
 * there are none. */
imp_code clearance_each_run(const clearance_each *of, imp_clearance **answers, size_t *count,
                            imp_stats *stats, imp_error *error);

/* "holds", "violated", "undecided"; NULL: nothing was required. */
const char *clearance_verdict_name(imp_requirement verdict);

/* The answer that stands for all: of least lower and of least upper bound, violated where one is
 * violated, with the first violation of all if none before it is possible. count > 0. */
imp_clearance clearance_summary(const clearance_table *table);

/* Whether something other than the answer ended a search. */
bool clearance_is_ended(imp_reason reason);

/* By what is proved: the least lower bound first, then in the order of the scene. */
void clearance_sort(imp_clearance *answers, size_t count);

/* Lines to standard output, verdict first. Bounds are rounded to the side that claims less. Without a
 * requirement, what comes within gamma is said to touch. */
void clearance_print(const imp_scene *scene, const imp_clearance *answer, double gamma);
/* One line a pair of bodies, under a line of heads. count > 0. */
void clearance_print_pairs(const clearance_table *table);

/* CSV: the head, and one line a slice. */
void clearance_print_csv_head(void);
void clearance_print_csv(const imp_clearance *slice);

json_t *clearance_json(const imp_scene *scene, const imp_clearance *answer);
json_t *clearance_slice_json(const imp_clearance *slice);
/* A list, slices or pairs of bodies. */
json_t *clearance_list_json(const clearance_table *table, bool slices);

#endif
