/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/json_text.h"

#include <stdlib.h>

/* json_dumps of jansson 2.14 leaves out a key whose text it cannot allocate, and reports success.
 * json_dumpb allocates no text: it is called once for the length and once for the text. */
char *json_text_of(const json_t *value, imp_error *error)
{
    const size_t length = json_dumpb(value, NULL, 0, JSON_COMPACT);
    char *text = length > 0 ? malloc(length + 1) : NULL;
    if (text == NULL || json_dumpb(value, text, length, JSON_COMPACT) != length) {
        free(text);
        error_set_memory(error);
        return NULL;
    }
    text[length] = '\0';
    return text;
}
