/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/parameter_numbers.h"

#include <stdlib.h>
#include <string.h>

#include "core/plugin/parameters_internal.h"

size_t parameter_numbers_count(const imp_argument *a)
{
    size_t count = 1;
    for (uint32_t k = 0; k < a->rank; ++k) count *= a->extent[k];
    return count;
}

static bool is_number(uint32_t kind) { return kind == IMP_KIND_NUMBER || kind == IMP_KIND_INTEGER; }

/* Whether the argument has the kind and the extents of its row. */
static bool has_shape(const imp_parameter *row, const imp_argument *a)
{
    size_t count = 1;
    if (!is_number(row->kind) || !is_number(a->kind) || a->rank != row->rank) return false;
    for (uint32_t k = 0; k < a->rank; ++k) {
        const bool fits =
            a->extent[k] > 0 && (row->extent[k] == 0 || row->extent[k] == a->extent[k]);
        if (!fits || __builtin_mul_overflow(count, a->extent[k], &count)) return false;
    }
    return count <= SIZE_MAX / sizeof(double) && (a->rank == 0 || a->number != NULL);
}

/* Whether the row allows all of them. Rows of many numbers most often have closed ranges, or none;
 * x - x is 0 for finite x alone. */
static bool are_allowed(const imp_parameter *row, const double *x, size_t count)
{
    const uint32_t open = IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_MAX_OPEN;
    const double min = row->min, max = row->max;
    bool allowed = true;
    if (row->kind == IMP_KIND_NUMBER && (row->flags & open) == 0) {
        for (size_t k = 0; k < count; ++k)
            allowed &= (min <= x[k]) & (x[k] <= max) & (x[k] - x[k] == 0);
        return allowed;
    }
    for (size_t k = 0; k < count && allowed; ++k) allowed = parameter_is_allowed(row, x[k]);
    return allowed;
}

/* False: the row does not allow what the argument has. */
static bool read_argument(const imp_parameter *row, const imp_argument *a, imp_value *value)
{
    if (!has_shape(row, a)) return false;
    const size_t count = parameter_numbers_count(a);
    const double *from = a->rank == 0 ? &a->single : a->number;
    if (!are_allowed(row, from, count)) return false;
    *value = (imp_value){.number = from, .count = count};
    for (uint32_t k = 0; k < IMP_RANK_MAX; ++k) value->extent[k] = k < a->rank ? a->extent[k] : 1;
    return true;
}

/* False: they do not fit. */
static bool read_given(const parameter_table *table, const imp_argument *arguments, size_t count,
                       parameter_values *values)
{
    for (size_t k = 0; k < count; ++k) {
        const char *name = arguments[k].name;
        const ptrdiff_t row = name != NULL ? parameter_table_find(table, name) : -1;
        if (row < 0 || values->given[row]) return false;
        values->given[row] = true;
        if (!read_argument(parameter_table_row(table, (size_t)row), &arguments[k],
                           &values->value[row]))
            return false;
    }
    return true;
}

static imp_code read_absent(const parameter_table *table, const place *at, parameter_values *values,
                            bool *fits, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < table->count && *fits && code == IMP_SUCCESS; ++i) {
        const imp_parameter *row = parameter_table_row(table, i);
        if (values->value[i].number != NULL) continue;
        *fits = (row->flags & (IMP_PARAMETER_OPTIONAL)) != 0 || row->default_value != NULL;
        if (*fits) code = parameters_read_absent(row, at, values, &values->value[i], error);
    }
    return code;
}

/* Numbers of defaults that have room beside the values: more than any of our types has. */
enum { ROOM = 32 };

imp_code parameter_numbers_read(const parameter_table *table, const imp_argument *arguments,
                                size_t count, arena_store *store, const place *at,
                                parameter_values *values, imp_error *error)
{
    bool fits = arguments != NULL || count == 0;
    imp_code code = parameters_begin(values, table->count, ROOM, store, error);
    if (code == IMP_SUCCESS && fits) fits = read_given(table, arguments, count, values);
    values->borrows = true;
    if (code == IMP_SUCCESS && fits) code = read_absent(table, at, values, &fits, error);
    if (code != IMP_SUCCESS || !fits) parameters_clear(values);
    return code;
}
