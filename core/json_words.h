/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_JSON_WORDS_H
#define CORE_JSON_WORDS_H

#include <jansson.h>

/* A JSON value in a few words, after "found": -1, "abc", an array of 3, an object. */
typedef struct json_words {
    char at[80];
} json_words;
json_words json_in_words(const json_t *json);

#endif
