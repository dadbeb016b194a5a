/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/argument_list.h"

#include <stdlib.h>
#include <string.h>

#include "tools/check/values.h"
#include "tools/cli/catalogue.h"

static size_t leaves_of(const json_t *json)
{
    size_t count = 0;
    if (json_is_object(json)) return json_object_size(json);
    if (!json_is_array(json)) return 1;
    for (size_t k = 0; k < json_array_size(json); ++k) count += leaves_of(json_array_get(json, k));
    return count;
}

static bool gather(argument *a, const char *name, const json_t *leaf)
{
    const size_t k = a->value.count;
    if (json_is_number(leaf))
        a->number[k] = json_number_value(leaf);
    else if (json_is_boolean(leaf))
        a->number[k] = json_is_true(leaf);
    else if (json_is_string(leaf))
        name = json_string_value(leaf);
    else
        return false;
    a->string[k] = name;
    ++a->value.count;
    return true;
}

static bool gather_all(argument *a, json_t *json)
{
    const char *name;
    json_t *entry;
    json_object_foreach(json, name, entry) if (!gather(a, name, entry)) return false;
    if (json_is_object(json)) return true;
    if (!json_is_array(json)) return gather(a, NULL, json);
    for (size_t k = 0; k < json_array_size(json); ++k)
        if (!gather_all(a, json_array_get(json, k))) return false;
    return true;
}

/* Extents up to the rank in the table; a bare value may stand for an array of one. */
static void measure(const imp_parameter *row, const json_t *json, size_t extent[IMP_RANK_MAX])
{
    for (uint32_t k = 0; k < IMP_RANK_MAX; ++k) {
        const bool within = k < row->rank && json_is_array(json);
        extent[k] = within ? json_array_size(json) : 1;
        json = within ? json_array_get(json, 0) : NULL;
    }
}

static bool place_numbers(argument *a)
{
    const size_t size = a->value.count * sizeof *a->number;
    if (!guard_make(&a->numbers, size)) return false;
    a->value.number = guard_place(&a->numbers, a->number, size);
    return true;
}

static bool place_strings(argument *a)
{
    const size_t count = a->value.count, size = count * sizeof *a->string;
    a->texts = calloc(count, sizeof *a->texts);
    if (a->texts == NULL || !guard_make(&a->strings, size)) return false;
    for (size_t k = 0; k < count; ++k) {
        const size_t length = strlen(a->string[k]) + 1;
        if (!guard_make(&a->texts[k], length)) return false;
        a->string[k] = guard_place(&a->texts[k], a->string[k], length);
    }
    a->value.string = guard_place(&a->strings, a->string, size);
    return true;
}

/* False: the stage cannot be read, or no memory. */
static bool argument_make(argument *a, const imp_parameter *row, const json_t *values)
{
    json_t *json = stage_value(values, row);
    for (uint32_t k = row->rank; k < IMP_RANK_MAX; ++k) a->value.extent[k] = 1;
    if (json == NULL) return (row->flags & IMP_PARAMETER_OPTIONAL) != 0;
    const size_t room = leaves_of(json) + 1;
    a->number = calloc(room, sizeof *a->number);
    a->string = calloc(room, sizeof *a->string);
    bool made = a->number != NULL && a->string != NULL && gather_all(a, json);
    measure(row, json, a->value.extent);
    if (row->kind != IMP_KIND_STRING) made = made && place_numbers(a);
    if (row->kind == IMP_KIND_STRING || row->kind == IMP_KIND_TABLE)
        made = made && place_strings(a);
    json_decref(json);
    return made;
}

bool arguments_list_make(arguments_list *list, const imp_type_info *type, const json_t *given)
{
    *list = (arguments_list){.count = type->parameter_count};
    list->each = calloc(list->count + 1, sizeof *list->each);
    if (list->each == NULL || !guard_make(&list->values, list->count * sizeof(imp_value) + 1))
        return false;
    imp_value *values = guard_place(&list->values, NULL, list->count * sizeof *values);
    for (size_t k = 0; k < list->count; ++k) {
        if (!argument_make(&list->each[k], catalogue_parameter(type, k), given)) return false;
        values[k] = list->each[k].value;
    }
    return true;
}

const imp_value *arguments_list_values(const arguments_list *list)
{
    return (const imp_value *)(const void *)(list->values.end - list->count * sizeof(imp_value));
}

void arguments_list_hide(arguments_list *list)
{
    guard_hide(&list->values);
    for (size_t k = 0; k < list->count; ++k) {
        argument *a = &list->each[k];
        guard_hide(&a->numbers);
        guard_hide(&a->strings);
        for (size_t s = 0; a->texts != NULL && s < a->value.count; ++s) guard_hide(&a->texts[s]);
    }
}

void arguments_list_free(arguments_list *list)
{
    for (size_t k = 0; list->each != NULL && k < list->count; ++k) {
        argument *a = &list->each[k];
        for (size_t s = 0; a->texts != NULL && s < a->value.count; ++s) guard_free(&a->texts[s]);
        guard_free(&a->numbers);
        guard_free(&a->strings);
        free(a->texts);
        free(a->number);
        free((void *)a->string);
    }
    guard_free(&list->values);
    free(list->each);
}
