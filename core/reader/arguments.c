/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/arguments.h"

#include <math.h>
#include <string.h>

#include "core/base/text.h"
#include "core/plugin/parameters.h"

/* One element of an argument, or its only one: NULL if there is no memory, or if it is a number
 * that is not finite or a text that is not UTF-8, which *bad then says. */
static json_t *leaf(const imp_argument *a, size_t k, bool *bad)
{
    if (a->kind == IMP_KIND_STRING) {
        const char *text = a->rank == 0 ? a->text : a->string[k];
        *bad = text == NULL || !text_is_utf8(text);
        return *bad ? NULL : json_string(text);
    }
    const double x = a->rank == 0 ? a->single : a->number[k];
    *bad = !isfinite(x);
    if (*bad) return NULL;
    return a->kind == IMP_KIND_BOOLEAN ? json_boolean(x != 0) : json_real(x);
}

typedef struct walk {
    const imp_argument *argument;
    size_t next; /* element, row-major */
    const place *at;
    imp_error *error;
} walk;

static imp_code refuse_leaf(const walk *w)
{
    const imp_argument *a = w->argument;
    if (a->kind == IMP_KIND_STRING)
        return place_error(w->at, w->error, IMP_ERROR_SCENE,
                           "element %zu is NULL or not UTF-8, must be strings of UTF-8", w->next);
    return place_error(w->at, w->error, IMP_ERROR_SCENE, "got %g at element %zu, must be finite",
                       a->rank == 0 ? a->single : a->number[w->next], w->next);
}

static imp_code level(walk *w, uint32_t depth, json_t **made)
{
    bool bad = false;
    if (depth == w->argument->rank) {
        *made = leaf(w->argument, w->next, &bad);
        if (bad) return refuse_leaf(w);
        w->next += 1;
        return *made != NULL ? IMP_SUCCESS : error_set_memory(w->error);
    }
    *made = json_array();
    imp_code code = *made != NULL ? IMP_SUCCESS : error_set_memory(w->error);
    for (size_t k = 0; k < w->argument->extent[depth] && code == IMP_SUCCESS; ++k) {
        json_t *element = NULL;
        code = level(w, depth + 1, &element);
        if (code == IMP_SUCCESS && json_array_append_new(*made, element) != 0)
            code = error_set_memory(w->error);
    }
    if (code == IMP_SUCCESS) return code;
    json_decref(*made);
    *made = NULL;
    return code;
}

/* Names to numbers. */
static imp_code table(const imp_argument *a, const place *at, json_t **made, imp_error *error)
{
    *made = json_object();
    if (*made == NULL) return error_set_memory(error);
    for (size_t k = 0; k < a->extent[0]; ++k) {
        const char *name = a->string[k];
        imp_code code = IMP_SUCCESS;
        if (name == NULL || !text_is_utf8(name) || !isfinite(a->number[k]))
            code = place_error(at, error, IMP_ERROR_SCENE,
                               "element %zu has no name of UTF-8 or no finite number", k);
        else if (json_object_set_new(*made, name, json_real(a->number[k])) != 0)
            code = error_set_memory(error);
        if (code == IMP_SUCCESS) continue;
        json_decref(*made);
        *made = NULL;
        return code;
    }
    return IMP_SUCCESS;
}

static imp_code check(const imp_argument *a, const place *at, imp_error *error)
{
    size_t elements = 1;
    if (a->kind < IMP_KIND_NUMBER || a->kind > IMP_KIND_TABLE || a->rank > IMP_RANK_MAX)
        return place_error(at, error, IMP_ERROR_USAGE, "kind %u of rank %u does not exist",
                           (unsigned)a->kind, (unsigned)a->rank);
    const bool is_table = a->kind == IMP_KIND_TABLE;
    for (uint32_t k = 0; k < a->rank; ++k)
        if (__builtin_mul_overflow(elements, a->extent[k], &elements) || a->extent[k] == 0)
            return place_error(at, error, IMP_ERROR_SCENE,
                               "extent %u is %zu, must be from 1 to what memory holds", (unsigned)k,
                               a->extent[k]);
    const bool numbers = a->kind != IMP_KIND_STRING && (a->rank > 0 || is_table);
    const bool strings = (a->kind == IMP_KIND_STRING && a->rank > 0) || is_table;
    if ((numbers && a->number == NULL) || (strings && a->string == NULL))
        return place_error(at, error, IMP_ERROR_USAGE, "the array is NULL");
    return IMP_SUCCESS;
}

static imp_code add(json_t *object, const imp_argument *a, const place *up, imp_error *error)
{
    if (a->name == NULL || !text_is_utf8(a->name))
        return place_error(up, error, IMP_ERROR_USAGE, "an argument has no name of UTF-8");
    const place at = place_key(up, a->name);
    const bool is_clock = strcmp(a->name, "clock") == 0;
    if ((parameters_is_reserved(a->name) && !is_clock) || json_object_get(object, a->name) != NULL)
        return place_error(&at, error, IMP_ERROR_SCENE, "is given twice, or is not a parameter");
    json_t *value = NULL;
    imp_code code = check(a, &at, error);
    walk w = {.argument = a, .at = &at, .error = error};
    if (code == IMP_SUCCESS)
        code = a->kind == IMP_KIND_TABLE ? table(a, &at, &value, error) : level(&w, 0, &value);
    if (code == IMP_SUCCESS && json_object_set_new(object, a->name, value) != 0)
        code = error_set_memory(error);
    return code;
}

imp_code arguments_to_json(const char *type, const imp_argument *arguments, size_t count,
                           const place *at, json_t **object, imp_error *error)
{
    if (type == NULL || !text_is_utf8(type) || (arguments == NULL && count > 0))
        return place_error(at, error, IMP_ERROR_USAGE,
                           "the type's name is NULL or not UTF-8, or the arguments are NULL");
    *object = json_object();
    imp_code code = json_object_set_new(*object, "type", json_string(type)) == 0
                        ? IMP_SUCCESS
                        : error_set_memory(error);
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k)
        code = add(*object, &arguments[k], at, error);
    if (code != IMP_SUCCESS) json_decref(*object);
    return code;
}
