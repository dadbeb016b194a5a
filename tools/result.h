/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_RESULT_H
#define TOOLS_RESULT_H

#include <impinge/impinge.h>
#include <jansson.h>

/* A result, for people and for programs. */

/* Some lines to standard output, verdict first. Whatever bound they state is rounded to the side
 * that claims less. */
void result_print(const imp_scene *scene, const imp_result *result);

/* One object, as tools/schema/result.schema.json says. NULL: no memory. */
json_t *result_json(const imp_scene *scene, const imp_result *result);

/* "clear", "contact", "undecided". */
const char *result_verdict_name(imp_verdict verdict);

#endif
