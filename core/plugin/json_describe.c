/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/plugin/json_describe.h"

#include <stdio.h>
#include <string.h>

json_description json_describe(const json_t *json)
{
    json_description words;
    size_t size = sizeof words.at;
    switch (json_typeof(json)) {
    case JSON_OBJECT:
        snprintf(words.at, size, "an object");
        break;
    case JSON_ARRAY:
        snprintf(words.at, size, "an array of %zu", json_array_size(json));
        break;
    case JSON_STRING: {
        const char *s = json_string_value(json);
        snprintf(words.at, size, "\"%.50s%s\"", s, strlen(s) > 50 ? "..." : "");
        break;
    }
    case JSON_INTEGER:
    case JSON_REAL:
        snprintf(words.at, size, "%s", text_of_number(json_number_value(json)).at);
        break;
    default:
        snprintf(words.at, size, "%s",
                 json_is_true(json)    ? "true"
                 : json_is_false(json) ? "false"
                                       : "null");
    }
    return words;
}
