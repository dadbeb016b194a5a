/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ARGUMENT_LIST_H
#define TOOLS_CHECK_ARGUMENT_LIST_H

#include <jansson.h>

#include "tools/check/guard.h"
#include "tools/check/subject.h"

/* What create and renew are given, with every array in pages of its own, behind which nothing can
 * be read: reading past an argument, or later from one that is gone, ends the process. */

/* One parameter's value: its arrays, each in pages of their own. */
typedef struct argument {
    imp_value value;
    double *number; /* gathered, then placed */
    const char **string;
    guard numbers, strings, *texts;
} argument;

typedef struct arguments_list {
    argument *each;
    size_t count;
    guard values; /* what create is given */
} arguments_list;

/* Makes those of a stage's values (values.h). False: it cannot be read, or no memory; then, too,
 * the list has to be freed. */
bool arguments_list_make(arguments_list *list, const imp_type_info *type, const json_t *given);
const imp_value *arguments_list_values(const arguments_list *list);

/* Takes all of it out of reach. */
void arguments_list_hide(arguments_list *list);
void arguments_list_free(arguments_list *list);

#endif
