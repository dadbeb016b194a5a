/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/base/unconst.h"
#include "core/plugin/parameters_internal.h"

#include <assert.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool parameters_is_reserved(const char *name)
{
    return strcmp(name, "type") == 0 || strcmp(name, "maps") == 0 || strcmp(name, "clock") == 0;
}

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

imp_code parameters_keep(parameter_values *values, json_t *json, imp_error *error)
{
    if (values->made == NULL) values->made = json_array();
    return json_array_append_new(values->made, json) == 0 ? IMP_SUCCESS : error_set_memory(error);
}

imp_code parameters_read_absent(const imp_parameter *row, const place *at, parameter_values *values,
                                imp_value *value, imp_error *error)
{
    for (uint32_t k = row->rank; k < IMP_RANK_MAX; ++k) value->extent[k] = 1;
    if (row->flags & IMP_PARAMETER_OPTIONAL) return IMP_SUCCESS;
    if (row->default_value == NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "'%s' is missing; it must be %s", row->name,
                           parameter_shape_words(row, 0).at);
    bool is_plain;
    const imp_code code = parameter_default_plain(row, values, value, &is_plain, error);
    if (code != IMP_SUCCESS || is_plain) return code;
    place member = place_key(at, row->name);
    json_t *json;
    /* The registry has seen this default parse: what fails now is memory, whatever jansson says. */
    if (parameters_read_default(row, &member, &json, NULL) != IMP_SUCCESS)
        return error_set_memory(error);
    if (parameters_keep(values, json, NULL) != IMP_SUCCESS) return error_set_memory(error);
    return parameters_read_value(row, json, &member, value, error);
}

/* Puts the folder in front of a relative name of a file. NULL: no memory. */
static json_t *name_in_folder(const char *folder, const char *name)
{
    if (folder == NULL || name[0] == '/' || name[0] == '\0') return json_string_nocheck(name);
    char *path = malloc(strlen(folder) + strlen(name) + 1);
    if (path == NULL) return NULL;
    strcat(strcpy(path, folder), name);
    json_t *whole = json_string_nocheck(path); /* folders need not be UTF-8 */
    free(path);
    return whole;
}

/* A relative name of a file, made whole; anything else as it is. */
static imp_code whole_name(const imp_parameter *row, const char *folder, parameter_values *values,
                           const json_t **json, imp_error *error)
{
    const char *name = json_string_value(*json);
    if ((row->flags & IMP_PARAMETER_FILE) == 0 || folder == NULL || name == NULL)
        return IMP_SUCCESS;
    json_t *whole = name_in_folder(folder, name);
    if (parameters_keep(values, whole, NULL) != IMP_SUCCESS) return error_set_memory(error);
    *json = whole;
    return IMP_SUCCESS;
}

/* Reads the value of a row from the array file that the object names. */
static imp_code read_array_file(const imp_parameter *row, const json_t *json, const char *folder,
                                const array_file_limit *limit, const place *at,
                                parameter_values *values, imp_value *value, imp_error *error)
{
    uint64_t bytes = 0;
    array_name name;
    const imp_code named = array_file_name(json, at, &name, error);
    if (named != IMP_SUCCESS) return named;
    json_t *path = name_in_folder(folder, name.file);
    if (path == NULL || parameters_keep(values, path, NULL) != IMP_SUCCESS ||
        !named_files_add(&values->files, json_string_value(path), folder))
        return error_set_memory(error);
    array_file_limit rest;
    if (limit != NULL) rest = *limit, rest.held += values->file_bytes, limit = &rest;
    const imp_code code =
        array_file_read(row, json_string_value(path), name.array, limit, at, value, &bytes, error);
    values->file_bytes += bytes;
    return code;
}

static imp_code read_all(const parameter_table *table, const json_t *object, const char *folder,
                         const array_file_limit *limit, const place *at, parameter_values *values,
                         imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < table->count && code == IMP_SUCCESS; ++i) {
        const imp_parameter *row = parameter_table_row(table, i);
        const json_t *json = json_object_get(object, row->name);
        values->given[i] = json != NULL;
        place member = place_key(at, row->name);
        code = whole_name(row, folder, values, &json, error);
        if (code != IMP_SUCCESS) return code;
        if (json != NULL && array_file_is_asked(row, json))
            code = read_array_file(row, json, folder, limit, &member, values, &values->value[i],
                                   error);
        else
            code = json != NULL
                       ? parameters_read_value(row, json, &member, &values->value[i], error)
                       : parameters_read_absent(row, at, values, &values->value[i], error);
    }
    return code;
}

imp_code parameters_read(const parameter_table *table, const char *type, const json_t *object,
                         const char *folder, const array_file_limit *limit, const place *at,
                         parameter_values *values, imp_error *error)
{
    assert(json_is_object(object));
    imp_code code = refuse_unknown(table, type, object, at, error);
    if (code != IMP_SUCCESS) return code;
    code = parameters_begin(values, table->count, 0, NULL, error);
    if (code == IMP_SUCCESS) code = read_all(table, object, folder, limit, at, values, error);
    if (code != IMP_SUCCESS) parameters_clear(values);
    return code;
}

imp_code parameters_begin(parameter_values *values, size_t count, size_t room, arena_store *store,
                          imp_error *error)
{
    const size_t of_values = (count + 1) * sizeof *values->value, of_room = room * sizeof(double);
    *values = (parameter_values){.count = count, .room_left = room, .store = store};
    values->value = arena_store_room(store, of_values + of_room + (count + 1) * sizeof(bool));
    if (values->value == NULL) return error_set_memory(error);
    values->room = (double *)(void *)(values->value + count + 1);
    values->given = (bool *)(values->room + room);
    memset(values->value, 0, of_values);
    memset(values->given, 0, (count + 1) * sizeof(bool));
    return IMP_SUCCESS;
}

static bool has_in_room(const parameter_values *values, const void *numbers)
{
    const double *at = numbers;
    return at >= (const double *)(const void *)(values->value + values->count + 1) &&
           at < values->room;
}

void parameters_clear(parameter_values *values)
{
    for (size_t i = 0; values->value != NULL && i < values->count; ++i) {
        imp_value *value = &values->value[i];
        if ((values->borrows && values->given[i]) || has_in_room(values, value->number))
            value->number = NULL;
        if (has_in_room(values, value->string)) value->string = NULL;
        parameters_clear_value(value);
    }
    arena_store_free_room(values->store, values->value);
    json_decref(values->made);
    named_files_clear(&values->files);
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
