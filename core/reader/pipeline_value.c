/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/parameters.h"
#include "core/reader/pipeline_value.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/* Length of the string of JSON that begins at the quote text[0], its closing quote included. */
static size_t string_length(const char *text, size_t length)
{
    size_t i = 1;
    while (i < length && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    return i < length ? i + 1 : length;
}

/* Position of the first comma outside of brackets and strings; `length` if there is none. */
static size_t find_comma(const char *text, size_t length)
{
    size_t depth = 0, i = 0;
    while (i < length) {
        if (text[i] == ',' && depth == 0) break;
        if (strchr("[{(", text[i]) != NULL) ++depth;
        if (strchr("]})", text[i]) != NULL && depth > 0) --depth;
        i += text[i] == '"' ? string_length(text + i, length - i) : 1;
    }
    return i < length ? i : length;
}

/* --- Numbers as people type them -------------------------------------------------------------- */

/* Adds the zeros that JSON wants on both sides of a point, and drops the plus it does not want in
 * front of a number. One character becomes at most three. Answers how many. */
static size_t write_character(const char *text, size_t length, size_t i, char last, char *to)
{
    char c = text[i], next = i + 1 < length ? text[i + 1] : '\0';
    bool begins = last == '\0' || strchr("[,: \t\n\r", last) != NULL;
    if (c == '+' && begins && (is_digit(next) || next == '.')) return 0;
    if (c != '.' || (!is_digit(last) && !is_digit(next))) {
        *to = c;
        return 1;
    }
    size_t n = 0;
    if (!is_digit(last)) to[n++] = '0';
    to[n++] = '.';
    if (!is_digit(next)) to[n++] = '0';
    return n;
}

/* Writes the value as JSON, at most 3 * length bytes; strings stay as they are. */
static size_t write_json(const char *text, size_t length, char *to)
{
    size_t used = 0;
    for (size_t i = 0; i < length;) {
        size_t whole = text[i] == '"' ? string_length(text + i, length - i) : 0;
        if (whole > 0)
            memcpy(to + used, text + i, whole);
        else
            used += write_character(text, length, i, used ? to[used - 1] : '\0', to + used);
        used += whole;
        i += whole ? whole : 1;
    }
    return used;
}

/* Whether something in the text, outside of strings, is to be computed: 2*pi, 1/3, sqrt(2). */
static bool is_expression(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i += text[i] == '"' ? string_length(text + i, length - i) : 1)
        if (text[i] == '*' || text[i] == '/' || text[i] == '^' || text[i] == '(') return true;
    return false;
}

static imp_code parse(const char *text, size_t length, bool list, json_t **json, char *why,
                      size_t why_size)
{
    char *buffer = length <= SIZE_MAX / 4 ? malloc(3 * length + 3) : NULL;
    if (buffer == NULL) return IMP_ERROR_MEMORY;
    size_t used = 0;
    if (list) buffer[used++] = '[';
    used += write_json(text, length, buffer + used);
    if (list) buffer[used++] = ']';
    json_error_t fault;
    errno = 0; /* jansson tells a few failed allocations as errors of syntax */
    *json = json_loadb(buffer, used, PARAMETERS_JSON_FLAGS | JSON_DECODE_ANY, &fault);
    const bool no_memory = errno == ENOMEM || fault.text[0] == '\0';
    free(buffer);
    if (*json != NULL) return IMP_SUCCESS;
    if (no_memory) return IMP_ERROR_MEMORY;
    const int shown = length < 60 ? (int)length : 60;
    if (is_expression(text, length))
        snprintf(
            why, why_size,
            "got %.*s; only numbers are read here, no expressions: 6.283185307179586, not 2*pi",
            shown, text);
    else
        snprintf(why, why_size, "got %.*s, which is not a JSON value: %.90s", shown, text,
                 fault.text);
    return IMP_ERROR_SCENE;
}

/* --- Words ------------------------------------------------------------------------------------ */

/* Begins like a word, perhaps behind a sign, and is none of JSON's. */
static bool is_word(const char *text, size_t length)
{
    size_t sign = text[0] == '-' || text[0] == '+' ? 1 : 0;
    if (length <= sign || !(is_letter(text[sign]) || (text[sign] & 0x80))) return false;
    bool json = (length == 4 && memcmp(text, "true", 4) == 0) ||
                (length == 5 && memcmp(text, "false", 5) == 0) ||
                (length == 4 && memcmp(text, "null", 4) == 0);
    return !json;
}

static imp_code read_word(const char *text, size_t length, json_t **json)
{
    *json = json_stringn(text, length);
    return *json != NULL ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

static imp_code read_string(const char *text, size_t length, json_t **json, char *why,
                            size_t why_size)
{
    bool quoted = length > 0 && text[0] == '"' && string_length(text, length) == length;
    return quoted ? parse(text, length, false, json, why, why_size) : read_word(text, length, json);
}

/* one,"two",three */
static imp_code read_strings(const char *text, size_t length, json_t **json, char *why,
                             size_t why_size)
{
    *json = json_array();
    imp_code code = *json != NULL ? IMP_SUCCESS : IMP_ERROR_MEMORY;
    for (size_t at = 0; at <= length && code == IMP_SUCCESS;) {
        size_t end = at + find_comma(text + at, length - at);
        json_t *element;
        code = read_string(text + at, end - at, &element, why, why_size);
        if (code == IMP_SUCCESS && json_array_append_new(*json, element) != 0)
            code = IMP_ERROR_MEMORY;
        at = end + 1;
    }
    if (code != IMP_SUCCESS) json_decref(*json);
    return code;
}

imp_code pipeline_value_read(const imp_parameter *row, const char *text, size_t length,
                             json_t **json, char *why, size_t why_size)
{
    bool list = find_comma(text, length) < length;
    if (row != NULL && row->kind == IMP_KIND_STRING) {
        if (row->rank == 0) return read_string(text, length, json, why, why_size);
        if (text[0] != '[') return read_strings(text, length, json, why, why_size);
    }
    if (is_word(text, length)) return read_word(text, length, json);
    imp_code code = parse(text, length, list, json, why, why_size);
    return code == IMP_ERROR_SCENE && row == NULL ? read_word(text, length, json) : code;
}
