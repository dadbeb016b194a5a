/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/json_line.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/json_memory.h"
#include "tools/cli/shortest.h"

typedef struct line_text {
    char *text; /* NULL: no memory, and nothing more is written */
    size_t length, size;
} line_text;

static void put(line_text *line, const char *text, size_t length)
{
    if (line->text != NULL && length > line->size - line->length) {
        const size_t larger = 2 * (line->size + length);
        char *moved = realloc(line->text, larger);
        if (moved == NULL) free(line->text);
        line->text = moved;
        line->size = larger;
    }
    if (line->text == NULL) return;
    memcpy(line->text + line->length, text, length);
    line->length += length;
}

static void put_words(line_text *line, const char *words) { put(line, words, strlen(words)); }

/* Whether the string needs no escapes and is ASCII. */
static bool is_plain(const char *text, size_t length)
{
    for (size_t k = 0; k < length; ++k)
        if (text[k] < ' ' || text[k] > '~' || text[k] == '"' || text[k] == '\\') return false;
    return true;
}

static void put_string(line_text *line, const char *text, size_t length)
{
    if (is_plain(text, length)) {
        put(line, "\"", 1);
        put(line, text, length);
        put(line, "\"", 1);
        return;
    }
    json_t *value = json_stringn(text, length);
    char *escaped = json_memory_text(value, JSON_ENCODE_ANY);
    json_decref(value);
    if (escaped != NULL) {
        put_words(line, escaped);
    } else {
        free(line->text);
        line->text = NULL;
    }
    free(escaped);
}

static void put_number(line_text *line, const json_t *value)
{
    char text[SHORTEST_SIZE];
    const size_t length = json_is_real(value)
                              ? shortest_write(json_real_value(value), text)
                              : (size_t)snprintf(text, sizeof text, "%" JSON_INTEGER_FORMAT,
                                                 json_integer_value(value));
    put(line, text, length);
}

static void put_value(line_text *line, json_t *value);

static void put_object(line_text *line, json_t *object)
{
    const char *before = "{";
    for (void *at = json_object_iter(object); at != NULL; at = json_object_iter_next(object, at)) {
        const char *key = json_object_iter_key(at);
        put_words(line, before);
        put_string(line, key, strlen(key));
        put(line, ":", 1);
        put_value(line, json_object_iter_value(at));
        before = ",";
    }
    put_words(line, *before == '{' ? "{}" : "}");
}

static void put_array(line_text *line, json_t *array)
{
    put(line, "[", 1);
    for (size_t k = 0; k < json_array_size(array); ++k) {
        if (k > 0) put(line, ",", 1);
        put_value(line, json_array_get(array, k));
    }
    put(line, "]", 1);
}

static void put_value(line_text *line, json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        put_object(line, value);
        break;
    case JSON_ARRAY:
        put_array(line, value);
        break;
    case JSON_STRING:
        put_string(line, json_string_value(value), json_string_length(value));
        break;
    case JSON_INTEGER:
    case JSON_REAL:
        put_number(line, value);
        break;
    case JSON_TRUE:
        put_words(line, "true");
        break;
    case JSON_FALSE:
        put_words(line, "false");
        break;
    case JSON_NULL:
        put_words(line, "null");
        break;
    }
}

char *json_line_text(json_t *value)
{
    enum { USUAL = 1024 };
    if (value == NULL || json_memory_failed()) return NULL; /* damaged values are not read */
    line_text line = {.text = malloc(USUAL), .size = USUAL};
    put_value(&line, value);
    put(&line, "", 1);
    if (!json_memory_failed()) return line.text;
    free(line.text);
    return NULL;
}
