/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/base/unconst.h"
#include "core/common/array.h"
#include "core/plugin/json_describe.h"
#include "core/plugin/parameters.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define INTEGER_MAX 9007199254740992.0 /* 2^53: below it every whole number is a double */

bool parameters_is_reserved(const char *name)
{
    return strcmp(name, "type") == 0 || strcmp(name, "maps") == 0 || strcmp(name, "clock") == 0;
}

/* --- One value -------------------------------------------------------------------------------- */

/* A value while it is read: arrays that grow as leaves arrive, so that no shape claimed by
 * the text is believed before its elements have been seen. */
typedef struct reader {
    const imp_parameter *row;
    imp_value *value;
    double *number;
    const char **string;
    size_t number_capacity, string_capacity;
    imp_error *error;
} reader;

static bool reserve_number(reader *r)
{
    double *grown =
        array_reserve(r->number, r->value->count, &r->number_capacity, sizeof *r->number);
    if (grown != NULL) r->number = grown;
    return grown != NULL;
}

static bool reserve_string(reader *r)
{
    const char **grown =
        array_reserve(r->string, r->value->count, &r->string_capacity, sizeof *r->string);
    if (grown != NULL) r->string = grown;
    return grown != NULL;
}

static imp_code add(reader *r, double number, const char *string)
{
    bool numbers = r->row->kind != IMP_KIND_STRING;
    bool strings = r->row->kind == IMP_KIND_STRING || r->row->kind == IMP_KIND_TABLE;
    if ((numbers && !reserve_number(r)) || (strings && !reserve_string(r)))
        return error_set_memory(r->error);
    if (numbers) r->number[r->value->count] = number;
    if (strings) r->string[r->value->count] = string;
    ++r->value->count;
    return IMP_SUCCESS;
}

static imp_code refuse(reader *r, const json_t *json, uint32_t depth, const place *at)
{
    return place_error(at, r->error, IMP_ERROR_SCENE, "got %s, must be %s", json_describe(json).at,
                       parameter_shape_words(r->row, depth).at);
}

static bool is_in_range(const imp_parameter *row, double x)
{
    bool above = row->flags & IMP_PARAMETER_MIN_OPEN ? x > row->min : x >= row->min;
    bool below = row->flags & IMP_PARAMETER_MAX_OPEN ? x < row->max : x <= row->max;
    return isfinite(x) && above && below;
}

static imp_code read_number(reader *r, const json_t *json, const char *name, const place *at)
{
    const imp_parameter *row = r->row;
    if (!json_is_number(json) && row->kind == IMP_KIND_TABLE)
        return place_error(at, r->error, IMP_ERROR_SCENE, "got %s, must be a number",
                           json_describe(json).at);
    if (!json_is_number(json)) return refuse(r, json, row->rank, at);
    double x = json_number_value(json);
    if (row->kind == IMP_KIND_INTEGER && !(fabs(x) <= INTEGER_MAX && floor(x) == x))
        return refuse(r, json, row->rank, at);
    if (!is_in_range(row, x))
        return place_error(at, r->error, IMP_ERROR_SCENE, "got %s, must be %s",
                           json_describe(json).at, parameter_range_words(row).at);
    return add(r, x, name);
}

static imp_code read_string(reader *r, const json_t *json, const place *at)
{
    if (!json_is_string(json)) return refuse(r, json, r->row->rank, at);
    const char *s = json_string_value(json);
    if (strlen(s) != json_string_length(json))
        return place_error(at, r->error, IMP_ERROR_SCENE, "got a NUL character in a string");
    return add(r, 0, s);
}

static imp_code read_table(reader *r, const json_t *json, const place *at)
{
    if (!json_is_object(json)) return refuse(r, json, r->row->rank, at);
    json_t *object = unconst(json);
    imp_code code = IMP_SUCCESS;
    const char *name;
    json_t *number;
    json_object_foreach(object, name, number)
    {
        place member = place_key(at, name);
        if (code == IMP_SUCCESS) code = read_number(r, number, name, &member);
    }
    return code;
}

static imp_code read_leaf(reader *r, const json_t *json, const place *at)
{
    switch (r->row->kind) {
    case IMP_KIND_BOOLEAN:
        if (!json_is_boolean(json)) return refuse(r, json, r->row->rank, at);
        return add(r, json_is_true(json) ? 1 : 0, NULL);
    case IMP_KIND_STRING:
        return read_string(r, json, at);
    case IMP_KIND_TABLE:
        return read_table(r, json, at);
    default:
        return read_number(r, json, NULL, at);
    }
}

/* The first array at each depth settles a free extent; all others must agree with it. */
static imp_code check_extent(reader *r, size_t found, uint32_t depth, const place *at)
{
    size_t allowed = r->row->extent[depth], *settled = &r->value->extent[depth];
    if (found == 0 || (allowed != 0 && found != allowed))
        return place_error(at, r->error, IMP_ERROR_SCENE, "got an array of %zu, must be %s", found,
                           allowed ? parameter_shape_words(r->row, depth).at : "1 element or more");
    if (*settled != 0 && *settled != found)
        return place_error(at, r->error, IMP_ERROR_SCENE,
                           "got an array of %zu, must be %zu as in the first one", found, *settled);
    *settled = found;
    return IMP_SUCCESS;
}

static imp_code read_level(reader *r, const json_t *json, uint32_t depth, const place *at)
{
    assert(depth <= r->row->rank && r->row->rank <= IMP_RANK_MAX);
    if (depth == r->row->rank) return read_leaf(r, json, at);
    if (!json_is_array(json)) return refuse(r, json, depth, at);
    imp_code code = check_extent(r, json_array_size(json), depth, at);
    for (size_t i = 0; i < json_array_size(json) && code == IMP_SUCCESS; ++i) {
        place element = place_index(at, i);
        code = read_level(r, json_array_get(json, i), depth + 1, &element);
    }
    return code;
}

static bool is_bare_scalar(const imp_parameter *row, const json_t *json)
{
    return row->rank == 1 && (row->flags & IMP_PARAMETER_SCALAR_OK) && !json_is_array(json);
}

imp_code parameters_read_value(const imp_parameter *row, const json_t *json, const place *at,
                               imp_value *value, imp_error *error)
{
    *value = (imp_value){.count = 0};
    for (uint32_t k = row->rank; k < IMP_RANK_MAX; ++k) value->extent[k] = 1;
    reader r = {.row = row, .value = value, .error = error};
    if (is_bare_scalar(row, json)) value->extent[0] = 1;
    imp_code code =
        is_bare_scalar(row, json) ? read_leaf(&r, json, at) : read_level(&r, json, 0, at);
    value->number = r.number;
    value->string = r.string;
    if (code != IMP_SUCCESS) parameters_clear_value(value);
    return code;
}

void parameters_clear_value(imp_value *value)
{
    free(unconst(value->number));
    free(unconst(value->string));
    *value = (imp_value){.count = 0};
}

/* --- All values ------------------------------------------------------------------------------- */

imp_code parameters_read_default(const imp_parameter *row, const place *at, json_t **json,
                                 imp_error *error)
{
    json_error_t fault;
    errno = 0;
    *json = json_loads(row->default_value, PARAMETERS_JSON_FLAGS | JSON_DECODE_ANY, &fault);
    if (*json != NULL) return IMP_SUCCESS;
    if (fault.text[0] == '\0' || errno == ENOMEM) return error_set_memory(error);
    return place_error(at, error, IMP_ERROR_PLUGIN, "got %.60s, which is not JSON: %s",
                       row->default_value, fault.text);
}

/* "center, radius": as many names as fit. */
static parameter_words names_of(const parameter_table *table)
{
    parameter_words words = {""};
    for (size_t i = 0; i < table->count; ++i)
        text_append(words.at, sizeof words.at, "%s%s", i ? ", " : "",
                    parameter_table_row(table, i)->name);
    if (table->count == 0) text_append(words.at, sizeof words.at, "no parameters");
    if (strlen(words.at) + 1 == sizeof words.at) strcpy(words.at + sizeof words.at - 4, "...");
    return words;
}

static imp_code refuse_unknown(const parameter_table *table, const char *type, const json_t *object,
                               const place *at, imp_error *error)
{
    const char *name;
    json_t *unused;
    json_object_foreach((json_t *)unconst(object), name, unused)
    {
        if (parameters_is_reserved(name) || parameter_table_find(table, name) >= 0) continue;
        const char *near = parameter_table_nearest(table, name);
        place member = place_key(at, name);
        if (near != NULL)
            return place_error(&member, error, IMP_ERROR_SCENE,
                               "unknown parameter, did you mean '%s'? %s takes %s", near, type,
                               names_of(table).at);
        return place_error(&member, error, IMP_ERROR_SCENE, "unknown parameter; %s takes %s", type,
                           names_of(table).at);
    }
    return IMP_SUCCESS;
}

static imp_code read_absent(const imp_parameter *row, const place *at, parameter_values *values,
                            imp_value *value, imp_error *error)
{
    for (uint32_t k = row->rank; k < IMP_RANK_MAX; ++k) value->extent[k] = 1;
    if (row->flags & IMP_PARAMETER_OPTIONAL) return IMP_SUCCESS;
    if (row->default_value == NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "'%s' is missing; it must be %s", row->name,
                           parameter_shape_words(row, 0).at);
    place member = place_key(at, row->name);
    json_t *json;
    /* The registry has seen this default parse: what fails now is memory, whatever jansson says. */
    if (parameters_read_default(row, &member, &json, NULL) != IMP_SUCCESS)
        return error_set_memory(error);
    if (json_array_append_new(values->made, json) != 0) return error_set_memory(error);
    return parameters_read_value(row, json, &member, value, error);
}

/* A relative name of a file, made whole; anything else as it is. */
static imp_code whole_name(const imp_parameter *row, const char *folder, parameter_values *values,
                           const json_t **json, imp_error *error)
{
    const char *name = json_string_value(*json);
    if ((row->flags & IMP_PARAMETER_FILE) == 0 || folder == NULL || name == NULL)
        return IMP_SUCCESS;
    if (name[0] == '/' || name[0] == '\0') return IMP_SUCCESS;
    char *path = malloc(strlen(folder) + strlen(name) + 1);
    if (path == NULL) return error_set_memory(error);
    strcat(strcpy(path, folder), name);
    json_t *whole = json_string_nocheck(path); /* folders need not be UTF-8 */
    free(path);
    if (json_array_append_new(values->made, whole) != 0) return error_set_memory(error);
    *json = whole;
    return IMP_SUCCESS;
}

static imp_code read_all(const parameter_table *table, const json_t *object, const char *folder,
                         const place *at, parameter_values *values, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < table->count && code == IMP_SUCCESS; ++i) {
        const imp_parameter *row = parameter_table_row(table, i);
        const json_t *json = json_object_get(object, row->name);
        place member = place_key(at, row->name);
        code = whole_name(row, folder, values, &json, error);
        if (code != IMP_SUCCESS) return code;
        code = json != NULL ? parameters_read_value(row, json, &member, &values->value[i], error)
                            : read_absent(row, at, values, &values->value[i], error);
    }
    return code;
}

imp_code parameters_read(const parameter_table *table, const char *type, const json_t *object,
                         const char *folder, const place *at, parameter_values *values,
                         imp_error *error)
{
    assert(json_is_object(object));
    imp_code code = refuse_unknown(table, type, object, at, error);
    if (code != IMP_SUCCESS) return code;
    *values = (parameter_values){.count = table->count};
    values->value = calloc(table->count + 1, sizeof *values->value);
    values->made = json_array();
    code = values->value != NULL && values->made != NULL
               ? read_all(table, object, folder, at, values, error)
               : error_set_memory(error);
    if (code != IMP_SUCCESS) parameters_clear(values);
    return code;
}

void parameters_clear(parameter_values *values)
{
    for (size_t i = 0; values->value != NULL && i < values->count; ++i)
        parameters_clear_value(&values->value[i]);
    free(values->value);
    json_decref(values->made);
    *values = (parameter_values){.count = 0};
}

imp_code parameters_create_error(const parameter_table *table, const parameter_values *values,
                                 const imp_create_error *why, const place *at, imp_error *error)
{
    char text[sizeof why->text];
    memcpy(text, why->text, sizeof text);
    text[sizeof text - 1] = '\0';
    if (text[0] == '\0') snprintf(text, sizeof text, "refused, and the plugin does not say why");
    if (why->parameter < 0 || (size_t)why->parameter >= table->count)
        return place_error(at, error, IMP_ERROR_SCENE, "%s", text);
    const imp_parameter *row = parameter_table_row(table, (size_t)why->parameter);
    const imp_value *value = &values->value[why->parameter];
    place member = place_key(at, row->name);
    place element = place_index(&member, (size_t)why->element);
    bool has_element =
        why->element >= 0 && row->rank > 0 && (uint64_t)why->element < value->extent[0];
    return place_error(has_element ? &element : &member, error, IMP_ERROR_SCENE, "%s", text);
}
