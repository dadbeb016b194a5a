/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_JSON_QUICK_H
#define CORE_READER_JSON_QUICK_H

#include <jansson.h>

#include "core/reader/reading_budget.h"

/* JSON read quickly
 * =================
 * Makes of a text what jansson makes of it with PARAMETERS_JSON_FLAGS, in a third of the time: most
 * of a scene is numbers, and these are rounded without strtod. What is rare or wrong is left to
 * jansson, which then reads all of the text again and words the complaint. */

typedef enum json_quick_end {
    JSON_QUICK_DONE,
    JSON_QUICK_LEFT,      /* to jansson: an escape, a long key, deep nesting, any error */
    JSON_QUICK_NO_MEMORY, /* an allocation failed */
    JSON_QUICK_LIMIT      /* the budget is over */
} json_quick_end;

/* Parses the text, which is an object or an array. What jansson takes for the values is taken from
 * the budget before they are made. *end is JSON_QUICK_DONE exactly if the result is not NULL; with
 * JSON_QUICK_LEFT the budget is as it was. */
json_t *json_quick_parse(const char *text, size_t length, reading_budget *budget,
                         json_quick_end *end);

#endif
