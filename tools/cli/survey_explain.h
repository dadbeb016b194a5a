/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SURVEY_EXPLAIN_H
#define TOOLS_CLI_SURVEY_EXPLAIN_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "tools/cli/explain.h"

/* --explain of a scene with parameters: which bodies the boxes of values went to, and which
 * parameters they were halved along. */

/* Whether the table is asked for, by --explain; whether advice is, about an answer that is
 * undecided. */
typedef struct survey_explaining {
    bool table, advice;
    explain_goal goal;
} survey_explaining;

/* Prints the table, then the advice. False: no memory. */
bool survey_explain_print(const imp_scene *scene, const imp_survey *survey, survey_explaining what);

/* Adds "survey", the table, and "advice". False: no memory. */
bool survey_explain_set_json(json_t *object, const imp_scene *scene, const imp_survey *survey,
                             survey_explaining what);

#endif
