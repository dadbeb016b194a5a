/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_AT_VALUES_H
#define TOOLS_VIEW_AT_VALUES_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "tools/cli/arguments.h"

/* Scenes with parameters are drawn at values of them: those of --at NAME=VALUE,..., else those that
 * a result names, else the middle of their ranges. With --sweep NAME that parameter is in the place
 * of time, and what follows time stands at --at time=T, or where the scene begins. */

/* Copies the part of --at that is a time or a word, which is empty if there is none. False: there
 * are two, or it is too long. */
bool at_values_time(const char *text, char *part, size_t size);

/* "b = 1.2, c = 0"; empty: there are no parameters, or none but the one that is swept. */
typedef struct values_text {
    char text[512];
} values_text;

/* Replaces the scene by that at the values, if it has parameters, and names them. `known` is the
 * object "parameters" of a result, or NULL. Complains. */
exit_status at_values_pose(imp_scene **scene, const json_t *known, const arguments *args,
                           values_text *names);

#endif
