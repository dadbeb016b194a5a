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

/* *fits: whether the row allows all numbers of the argument. */
static imp_code read_argument(const imp_parameter *row, const imp_argument *a, imp_value *value,
                              bool *fits, imp_error *error)
{
    *fits = has_shape(row, a);
    if (!*fits) return IMP_SUCCESS;
    const size_t count = parameter_numbers_count(a);
    const double *from = a->rank == 0 ? &a->single : a->number;
    for (size_t k = 0; k < count && *fits; ++k) *fits = parameter_is_allowed(row, from[k]);
    if (!*fits) return IMP_SUCCESS;
    double *number = malloc(count * sizeof *number);
    if (number == NULL) return error_set_memory(error);
    memcpy(number, from, count * sizeof *number);
    *value = (imp_value){.number = number, .count = count};
    for (uint32_t k = 0; k < IMP_RANK_MAX; ++k) value->extent[k] = k < a->rank ? a->extent[k] : 1;
    return IMP_SUCCESS;
}

static imp_code read_given(const parameter_table *table, const imp_argument *arguments,
                           size_t count, parameter_values *values, bool *fits, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < count && *fits && code == IMP_SUCCESS; ++k) {
        const char *name = arguments[k].name;
        const ptrdiff_t row = name != NULL ? parameter_table_find(table, name) : -1;
        *fits = row >= 0 && values->value[row].number == NULL;
        if (!*fits) break;
        values->given[row] = true;
        code = read_argument(parameter_table_row(table, (size_t)row), &arguments[k],
                             &values->value[row], fits, error);
    }
    return code;
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

imp_code parameter_numbers_read(const parameter_table *table, const imp_argument *arguments,
                                size_t count, const place *at, parameter_values *values,
                                imp_error *error)
{
    bool fits = arguments != NULL || count == 0;
    *values = (parameter_values){.count = table->count};
    values->value = calloc(table->count + 1, sizeof *values->value + sizeof *values->given);
    if (values->value != NULL) values->given = (bool *)(values->value + table->count + 1);
    imp_code code = values->value != NULL ? IMP_SUCCESS : error_set_memory(error);
    if (code == IMP_SUCCESS) code = read_given(table, arguments, count, values, &fits, error);
    if (code == IMP_SUCCESS && fits) code = read_absent(table, at, values, &fits, error);
    if (code != IMP_SUCCESS || !fits) parameters_clear(values);
    return code;
}
