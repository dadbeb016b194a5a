/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/unconst.h"
#include "core/common/array.h"
#include "core/plugin/json_describe.h"
#include "core/plugin/parameters_internal.h"

/* The value of one parameter, from JSON. */

#define INTEGER_MAX 9007199254740992.0 /* 2^53: below it every whole number is a double */

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

static bool is_whole_enough(const imp_parameter *row, double x)
{
    return row->kind != IMP_KIND_INTEGER || (fabs(x) <= INTEGER_MAX && floor(x) == x);
}

bool parameter_is_allowed(const imp_parameter *row, double x)
{
    return is_whole_enough(row, x) && is_in_range(row, x);
}

static imp_code read_number(reader *r, const json_t *json, const char *name, const place *at)
{
    const imp_parameter *row = r->row;
    if (!json_is_number(json) && row->kind == IMP_KIND_TABLE)
        return place_error(at, r->error, IMP_ERROR_SCENE, "got %s, must be a number",
                           json_describe(json).at);
    if (!json_is_number(json)) return refuse(r, json, row->rank, at);
    double x = json_number_value(json);
    if (!is_whole_enough(row, x)) return refuse(r, json, row->rank, at);
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

/* Reads the numbers that the array begins with and the row allows; *read is how many. */
static imp_code read_numbers(reader *r, const json_t *array, size_t *read)
{
    const imp_parameter *row = r->row;
    const size_t count = json_array_size(array);
    *read = 0;
    if (row->kind != IMP_KIND_NUMBER && row->kind != IMP_KIND_INTEGER) return IMP_SUCCESS;
    for (; *read < count; ++*read) {
        const json_t *json = json_array_get(array, *read);
        if (!json_is_number(json)) break;
        const double x = json_number_value(json);
        if (!parameter_is_allowed(row, x)) break;
        if (!reserve_number(r)) return error_set_memory(r->error);
        r->number[r->value->count++] = x;
    }
    return IMP_SUCCESS;
}

static imp_code read_level(reader *r, const json_t *json, uint32_t depth, const place *at)
{
    assert(depth <= r->row->rank && r->row->rank <= IMP_RANK_MAX);
    if (depth == r->row->rank) return read_leaf(r, json, at);
    if (!json_is_array(json)) return refuse(r, json, depth, at);
    imp_code code = check_extent(r, json_array_size(json), depth, at);
    size_t i = 0;
    if (code == IMP_SUCCESS && depth + 1 == r->row->rank) code = read_numbers(r, json, &i);
    for (; i < json_array_size(json) && code == IMP_SUCCESS; ++i) {
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
