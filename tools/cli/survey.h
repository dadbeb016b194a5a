/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SURVEY_H
#define TOOLS_CLI_SURVEY_H

#include <jansson.h>

#include "tools/cli/arguments.h"

/* Scenes with parameters: questions about all their values (imp_survey). */

extern const option options_parameters[]; /* parameter: every verb that reads one scene */
extern const option options_survey[];     /* boxes, resume, max-boxes: solve, pair, clearance */

/* Whether the scene has parameters, which may be NULL. Warns of those that nobody follows. */
bool survey_is_needed(const imp_scene *scene, const arguments *args);

/* Complains of options that do not go with parameters. */
exit_status survey_check(const arguments *args);

/* Answer `solve` and `clearance` for all values: print the answer as text or JSON, and return the
 * exit status. */
exit_status survey_contact(imp_scene *scene, const arguments *args);
exit_status survey_clearance(imp_scene *scene, const imp_clearance_options *asked,
                             const arguments *args);

/* Solves a scene with parameters for all their values, as a line of `batch`. *answer: the result as
 * JSON with the values and boxes, without the scene's name, which the caller frees; NULL: no
 * memory. After an error only *error is set. [any thread] */
imp_code survey_solve(imp_scene *scene, const arguments *args, imp_result *result, json_t **answer,
                      imp_error *error);

/* Returns the text of a scene, with the parameters of the command line put into it: `text` itself
 * is freed. Texts that are no JSON object stay as they are, so that the reader complains.
 * *declared: how many parameters the text has of its own, which come first. NULL: it complained. */
char *survey_add_parameters(char *text, size_t *length, size_t *declared, const arguments *args);

/* Refuses names of the command line that the scene, made of that text, neither declares nor
 * follows. */
imp_code survey_check_parameters(const imp_scene *scene, size_t declared, const arguments *args,
                                 imp_error *error);

#endif
