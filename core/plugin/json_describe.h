/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_JSON_DESCRIBE_H
#define CORE_PLUGIN_JSON_DESCRIBE_H

#include <jansson.h>

/* A JSON value in a few words, after "got": -1, "abc", an array of 3, an object. */
typedef struct json_description {
    char at[80];
} json_description;
json_description json_describe(const json_t *json);

#endif
