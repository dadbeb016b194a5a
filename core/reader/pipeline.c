/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/plugin/parameters.h"
#include "core/plugin/type_view.h"
#include "core/reader/pipeline.h"
#include "core/reader/pipeline_value.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A piece of the line; nothing is copied until it becomes JSON. */
typedef struct word {
    const char *at;
    size_t length; /* 0: the line has ended */
} word;

typedef struct reader {
    const imp_registry *registry;
    const char *who;
    const char *line, *at; /* at: what is not read yet */
    imp_error *error;
} reader;

__attribute__((format(printf, 3, 4))) static imp_code fail(const reader *r, const char *at,
                                                           const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_set_v(r->error, IMP_ERROR_SCENE, format, arguments);
    va_end(arguments);
    size_t character = text_characters(r->line, (size_t)(at - r->line)) + 1;
    error_prefix(r->error, "%s: at character %zu", r->who, character);
    if (r->error != NULL) text_clean(r->error->text);
    return IMP_ERROR_SCENE;
}

/* --- Words ------------------------------------------------------------------------------------ */

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/* Past the closing quote; NULL if there is none. */
static const char *skip_string(const char *at)
{
    for (++at; *at && *at != '"'; ++at)
        if (*at == '\\' && at[1]) ++at;
    return *at ? at + 1 : NULL;
}

/* Finds the end of the word that begins at r->at: a blank, '!' or the end of the line, outside
 * of quotes and brackets. Which bracket closes which is for the JSON parser to see. */
static imp_code find_end(const reader *r, const char **end)
{
    const char *at = r->at, *opened = NULL;
    size_t depth = 0;
    while (*at && (depth > 0 || (!is_blank(*at) && *at != '!'))) {
        if (*at == '"') {
            const char *after = skip_string(at);
            if (after == NULL) return fail(r, at, "got a quote that is never closed");
            at = after;
            continue;
        }
        if (strchr("[{(", *at) != NULL && depth++ == 0) opened = at;
        if (strchr("]})", *at) != NULL && depth-- == 0)
            return fail(r, at, "got '%c' without its opening bracket", *at);
        ++at;
    }
    if (depth > 0) return fail(r, opened, "got '%c' that is never closed", *opened);
    *end = at;
    return IMP_SUCCESS;
}

/* The next word, a '!' on its own, or the end. */
static imp_code next_word(reader *r, word *w)
{
    while (is_blank(*r->at)) ++r->at;
    const char *end = r->at + (*r->at == '!');
    imp_code code = *r->at == '!' ? IMP_SUCCESS : find_end(r, &end);
    if (code != IMP_SUCCESS) return code;
    *w = (word){r->at, (size_t)(end - r->at)};
    r->at = end;
    return IMP_SUCCESS;
}

static bool is_bar(word w) { return w.length == 1 && *w.at == '!'; }

/* --- Stages ----------------------------------------------------------------------------------- */

/* The row of a parameter, or NULL if type or parameter is unknown. */
static const imp_parameter *find_row(const reader *r, const char *type, bool map, const char *name)
{
    const imp_surface_type *surface = map ? NULL : registry_find_surface(r->registry, type);
    const imp_map_type *mapping = map ? registry_find_map(r->registry, type) : NULL;
    if (surface == NULL && mapping == NULL) return NULL;
    parameter_table table =
        surface != NULL ? type_view_of_surface(surface).table : type_view_of_map(mapping).table;
    ptrdiff_t index = parameter_table_find(&table, name);
    return index < 0 ? NULL : parameter_table_row(&table, (size_t)index);
}

/* A clock is the name of a parameter, or a range: numbers with a comma between. */
static const imp_parameter *clock_row(word value)
{
    static const imp_parameter name = {.name = "clock", .kind = IMP_KIND_STRING};
    static const imp_parameter range = {.name = "clock",
                                        .kind = IMP_KIND_NUMBER,
                                        .rank = 1,
                                        .extent = {2},
                                        .min = -INFINITY,
                                        .max = INFINITY};
    const bool begins = value.length > 0 && strchr("-+.0123456789[", value.at[0]) != NULL;
    return begins && memchr(value.at, ',', value.length) != NULL ? &range : &name;
}

static imp_code put_value(reader *r, json_t *stage, bool map, const char *name, word value)
{
    const char *type = json_string_value(json_object_get(stage, "type"));
    const bool is_clock = strcmp(name, "clock") == 0;
    const imp_parameter *row = is_clock ? clock_row(value) : find_row(r, type, map, name);
    json_t *json;
    char why[200] = "";
    imp_code code = pipeline_value_read(row, value.at, value.length, &json, why, sizeof why);
    if (code == IMP_ERROR_MEMORY) return error_set_memory(r->error);
    if (code != IMP_SUCCESS) return fail(r, value.at, "%s: %s", name, why);
    return json_object_set_new(stage, name, json) == 0 ? IMP_SUCCESS : error_set_memory(r->error);
}

/* One name=value. */
static imp_code read_argument(reader *r, json_t *stage, bool map, word w)
{
    const char *equals = memchr(w.at, '=', w.length);
    if (equals == NULL || equals == w.at)
        return fail(r, w.at, "got '%.*s', expected name=value or '!'",
                    w.length < 60 ? (int)w.length : 60, w.at);
    size_t length = (size_t)(equals - w.at);
    char *name = strndup(w.at, length);
    if (name == NULL) return error_set_memory(r->error);
    word value = {equals + 1, w.length - length - 1};
    imp_code code;
    if (parameters_is_reserved(name) && strcmp(name, "clock") != 0)
        code = fail(r, w.at, "'%s' is not a parameter", name);
    else if (json_object_get(stage, name) != NULL)
        code = fail(r, w.at, "'%.60s' is given twice", name);
    else if (value.length == 0)
        code = fail(r, w.at, "'%.60s' has no value", name);
    else
        code = put_value(r, stage, map, name, value);
    free(name);
    return code;
}

static imp_code read_type(reader *r, json_t *stage, bool map)
{
    word w;
    imp_code code = next_word(r, &w);
    if (code != IMP_SUCCESS) return code;
    const char *expected = map ? "a map's name after '!'" : "a surface type's name";
    if (w.length == 0) return fail(r, w.at, "the line ends, expected %s", expected);
    if (is_bar(w) || memchr(w.at, '=', w.length) != NULL)
        return fail(r, w.at, "got '%.*s', expected %s", w.length < 60 ? (int)w.length : 60, w.at,
                    expected);
    json_t *type = json_stringn(w.at, w.length);
    return json_object_set_new(stage, "type", type) == 0 ? IMP_SUCCESS : error_set_memory(r->error);
}

/* One type or map with its arguments, up to and with the '!' behind it, if any. */
static imp_code read_stage(reader *r, json_t *stage, bool map, bool *more)
{
    *more = false;
    imp_code code = stage != NULL ? read_type(r, stage, map) : error_set_memory(r->error);
    while (code == IMP_SUCCESS) {
        word w;
        code = next_word(r, &w);
        if (code != IMP_SUCCESS || w.length == 0) return code;
        if (is_bar(w)) {
            *more = true;
            return IMP_SUCCESS;
        }
        code = read_argument(r, stage, map, w);
    }
    return code;
}

static imp_code read_maps(reader *r, json_t *maps, bool more)
{
    imp_code code = maps != NULL ? IMP_SUCCESS : error_set_memory(r->error);
    while (code == IMP_SUCCESS && more) {
        json_t *map = json_object();
        code = read_stage(r, map, true, &more);
        if (code != IMP_SUCCESS)
            json_decref(map);
        else if (json_array_append_new(maps, map) != 0)
            code = error_set_memory(r->error);
    }
    return code;
}

/* A reader at the line's beginning; answers false if that is not to be read at all. */
static bool begin(reader *r, const imp_registry *registry, const char *who, const char *line,
                  imp_error *error)
{
    *r = (reader){registry, who, line, line, error};
    if (text_is_utf8(line)) return true;
    error_set(error, IMP_ERROR_SCENE, "%s: is not valid UTF-8", who);
    return false;
}

json_t *pipeline_read(const imp_registry *registry, const char *who, const char *line,
                      imp_error *error)
{
    reader r;
    bool more;
    if (!begin(&r, registry, who, line, error)) return NULL;
    json_t *surface = json_object(), *maps = json_array();
    imp_code code = read_stage(&r, surface, false, &more);
    if (code == IMP_SUCCESS) code = read_maps(&r, maps, more);
    if (code == IMP_SUCCESS && json_object_set(surface, "maps", maps) != 0)
        code = error_set_memory(error);
    json_decref(maps);
    if (code == IMP_SUCCESS) return surface;
    json_decref(surface);
    return NULL;
}

json_t *pipeline_read_stage(const imp_registry *registry, imp_type_kind kind, const char *who,
                            const char *line, imp_error *error)
{
    reader r;
    bool more;
    if (!begin(&r, registry, who, line, error)) return NULL;
    json_t *stage = json_object();
    imp_code code = read_stage(&r, stage, kind == IMP_TYPE_MAP, &more);
    if (code == IMP_SUCCESS && more)
        code = fail(&r, r.at - 1, "got '!', expected the end of the line");
    if (code == IMP_SUCCESS) return stage;
    json_decref(stage);
    return NULL;
}
