/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SURVEY_ANSWER_H
#define TOOLS_CLI_SURVEY_ANSWER_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "tools/cli/explain.h"

/* What a survey answers beside a result or a clearance: values of parameters, and how far it came.
 * For people and for programs. */

typedef struct survey_answer {
    imp_survey_state state; /* all bytes 0: not there yet */
    bool has_values;
    double *numbers; /* of each parameter: the value, lo and hi of the worst box left */
} survey_answer;

/* Numbers that an answer has room for; at least 1. */
size_t survey_answer_room(const imp_scene *scene);

void survey_answer_read(const imp_scene *scene, const imp_survey *survey, survey_answer *answer);

/* Whether the values are those of the result or clearance, not only of something that is known, and
 * what it asks for. */
typedef struct survey_told {
    bool known, undecided;
    explain_goal goal;
} survey_told;
survey_told survey_told_of_contact(const imp_result *result);
survey_told survey_told_of_clearance(const imp_clearance *clearance);

/* {name: value}; NULL: no memory. */
json_t *survey_values_json(const imp_scene *scene, const double *values);

/* Adds the keys that stand beside an answer. 0: done. */
int survey_answer_set_json(json_t *object, const imp_scene *scene, const survey_answer *answer,
                           survey_told told);

/* Prints "a = 1, b = 2", without a line's end. */
void survey_answer_print_values(const imp_scene *scene, const double *values);

/* Prints lines that follow those of an answer. */
void survey_answer_print(const imp_scene *scene, const survey_answer *answer, survey_told told);

#endif
