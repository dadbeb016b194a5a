/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SURVEY_PARTS_H
#define TOOLS_CLI_SURVEY_PARTS_H

#include "tools/cli/arguments.h"
#include "tools/cli/survey_answer.h"

/* Several questions about all values of a scene's parameters
 * ==========================================================
 * One for each pair of bodies (--each), or for each slice of time or of a parameter (--profile).
 * Each is a survey of its own: its answer does not depend on the others, nor on the number of
 * threads. */

typedef struct survey_parts {
    imp_scene *scene;
    const arguments *args;
    imp_options options;
    const imp_clearance_options *asked; /* NULL: the earliest contact */
    size_t threads;
    double until; /* seconds of the clock: the limit of time; INFINITY: none */
    size_t count;
    size_t (*bodies)[2]; /* of each question, in the order of the scene; NULL: slices */
    size_t over;         /* parameter that is sliced; SIZE_MAX: time */
    size_t rest;         /* slice that stands for all from it on; SIZE_MAX: none */
    imp_result *results; /* one of both; all bytes 0: not there yet */
    imp_clearance *nearest;
    survey_answer *answers;
    double *numbers; /* of all answers */
} survey_parts;

/* Prepare the questions; survey_parts_end in any case. `asked` must outlive them. They complain. */
exit_status survey_parts_each(survey_parts *p, imp_scene *scene, const imp_clearance_options *asked,
                              const arguments *args, size_t threads);
exit_status survey_parts_slices(survey_parts *p, imp_scene *scene,
                                const imp_clearance_options *asked, const arguments *args);
void survey_parts_end(survey_parts *p);

/* Whether the time is over, or a signal came. */
bool survey_parts_are_over(const survey_parts *p);

/* Answers question k. [any thread] */
imp_code survey_parts_ask(survey_parts *p, size_t k, imp_error *error);

/* Answers all until time is over, by several threads. The error is that of the first that fails. */
imp_code survey_parts_run(survey_parts *p, imp_error *error);

/* Finds the question about two bodies, of which the first has the smaller index. */
size_t survey_parts_find(const survey_parts *p, const size_t body[2]);

/* Adds to an object what answer k says of values. 0: done. */
int survey_parts_set_json(json_t *object, const survey_parts *p, size_t k);

/* Prints ", at a = 1, b = 2" where answer k has a witness. */
void survey_parts_print_values(const survey_parts *p, size_t k);

/* Returns slice k, of time or of the parameter that is sliced. */
typedef struct value_range {
    double lo, hi;
} value_range;
value_range survey_parts_slice(const survey_parts *p, size_t k);

#endif
