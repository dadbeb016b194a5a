/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/batch_scene.h"

#include <stdio.h>
#include <string.h>

#include "tools/cli/verbs.h"

exit_status batch_shard_read(const arguments *args, batch_shard *shard)
{
    const option_value *value = arguments_option(args, "shard");
    *shard = (batch_shard){0, 1};
    if (value == NULL) return EXIT_ANSWERED;
    char rest;
    unsigned index, count;
    if (strspn(value->text, "0123456789/") == strlen(value->text) &&
        sscanf(value->text, "%9u/%9u%c", &index, &count, &rest) == 2 && index >= 1 &&
        index <= count) {
        *shard = (batch_shard){index - 1, count};
        return EXIT_ANSWERED;
    }
    return complain(EXIT_USAGE, args->verb->name,
                    "--shard: got '%s', must be I/N with 1 <= I <= N, for example 1/4",
                    value->text);
}

/* --- Ids -------------------------------------------------------------------------------------- */

/* Returns the place after the JSON string that begins at `at`; NULL: it does not end. *plain: it
 * has no escapes. */
static const char *behind_string(const char *at, const char *end, bool *plain)
{
    *plain = true;
    for (++at; at < end && *at != '"'; ++at)
        if (*at == '\\') {
            *plain = false;
            ++at;
        }
    return at < end ? at + 1 : NULL;
}

/* An iterator over the keys and values of the outermost object. */
typedef struct member_walk {
    const char *at, *end;
} member_walk;

static void skip_blanks(member_walk *w)
{
    while (w->at < w->end && strchr(" \t\r\n", *w->at) != NULL) ++w->at;
}

/* Moves to the ',' or '}' after a value. False: there is none. */
static bool skip_value(member_walk *w)
{
    size_t depth = 0;
    bool plain;
    while (w->at != NULL && w->at < w->end) {
        if (*w->at == '"') {
            w->at = behind_string(w->at, w->end, &plain);
            continue;
        }
        if (depth == 0 && (*w->at == ',' || *w->at == '}')) return true;
        depth += *w->at == '{' || *w->at == '[';
        depth -= depth > 0 && (*w->at == '}' || *w->at == ']');
        ++w->at;
    }
    return false;
}

/* Finds the value of the last "id", or of the first if the keys are known to differ, without
 * parsing the other values. False: the text is no object, or has keys with escapes. */
static bool find_id(const input_text *line, bool keys_differ, const char **id, size_t *length)
{
    member_walk w = {line->text, line->text + line->length};
    *id = NULL;
    *length = 0;
    skip_blanks(&w);
    if (w.at == w.end || *w.at != '{') return false;
    do {
        ++w.at; /* the '{' or ',' */
        skip_blanks(&w);
        const char *key = w.at;
        bool plain;
        if (w.at == w.end || *w.at != '"') return false;
        w.at = behind_string(w.at, w.end, &plain);
        if (w.at == NULL || !plain) return false;
        const bool is_id = w.at - key == 4 && memcmp(key, "\"id\"", 4) == 0;
        skip_blanks(&w);
        if (w.at == w.end || *w.at++ != ':') return false;
        const char *value = w.at;
        if (!skip_value(&w)) return false;
        if (is_id) *id = value, *length = (size_t)(w.at - value);
    } while (*w.at == ',' && !(keys_differ && *id != NULL));
    return true;
}

json_t *batch_scene_id(const input_text *line, bool was_read)
{
    const char *text;
    size_t length;
    if (!find_id(line, was_read, &text, &length)) return batch_line_id(line);
    json_t *id = text != NULL ? json_loadb(text, length, JSON_DECODE_ANY, NULL) : NULL;
    return id != NULL ? id : json_null();
}

json_t *batch_line_id(const input_text *line)
{
    json_t *object = json_loadb(line->text, line->length, 0, NULL);
    json_t *id = json_object_get(object, "id");
    id = id != NULL ? json_incref(id) : json_null();
    json_decref(object);
    return id;
}
