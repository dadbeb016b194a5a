/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include <impinge/decimal.h>

#include "core/plugin/parameters_internal.h"

/* Plain defaults, read without an object of JSON: an instance that is made anew for each step of a
 * simulation reads those of all parameters that are not given. */

static const char *skip_blanks(const char *at) { return at + strspn(at, " \t\r\n"); }

/* Reads one number that the row allows. NULL: there is none. */
static const char *read_one(const imp_parameter *row, const char *at, double *x)
{
    imp_decimal d = {.fits = false};
    at = skip_blanks(at);
    const char *const end = imp_decimal_scan(at, at + strlen(at), &d);
    if (end == NULL || !imp_decimal_value(&d, x) || !parameter_is_allowed(row, *x)) return NULL;
    return skip_blanks(end);
}

/* Reads [1, 2], at most `most` numbers. NULL: the text is something else. */
static const char *read_row(const imp_parameter *row, const char *at, size_t most, double *x,
                            size_t *count)
{
    *count = 0;
    do {
        if (*count == most || *at != (*count == 0 ? '[' : ',')) return NULL;
        at = read_one(row, at + 1, &x[(*count)++]);
        if (at == NULL) return NULL;
    } while (*at != ']');
    return skip_blanks(at + 1);
}

/* Reads [[1, 2], [3, 4]], rows of one length. */
static const char *read_rows(const imp_parameter *row, const char *at, size_t most, double *x,
                             size_t extent[2])
{
    size_t rows = 0;
    do {
        size_t length;
        if (*at != (rows == 0 ? '[' : ',')) return NULL;
        at = skip_blanks(at + 1);
        at = read_row(row, at, most, x, &length);
        if (at == NULL || (rows > 0 && length != extent[1])) return NULL;
        extent[0] = ++rows, extent[1] = length;
        x += length, most -= length;
    } while (*at != ']');
    return skip_blanks(at + 1);
}

/* Reads a number, a row or rows, as many numbers as the row allows. NULL: the text is something
 * else. */
static const char *read_array(const imp_parameter *row, const char *at, size_t most, double *x,
                              size_t extent[2])
{
    extent[0] = extent[1] = 1;
    at = skip_blanks(at);
    if (row->rank == 2) return read_rows(row, at, most, x, extent);
    const bool is_scalar = *at != '[' && (row->flags & IMP_PARAMETER_SCALAR_OK) != 0;
    return row->rank == 0 || is_scalar ? read_one(row, at, x)
                                       : read_row(row, at, most, x, &extent[0]);
}

static void take(imp_value *value, size_t rows, size_t columns)
{
    value->count = rows * columns;
    value->extent[0] = rows;
    value->extent[1] = columns;
    for (uint32_t k = 2; k < IMP_RANK_MAX; ++k) value->extent[k] = 1;
}

static double *take_room(parameter_values *values, size_t count)
{
    if (count > values->room_left) return malloc(count * sizeof(double));
    values->room_left -= count;
    values->room += count;
    return values->room - count;
}

/* Without memory the value stays without numbers, and has a count. */
static bool take_numbers(parameter_values *values, imp_value *value, const double *x, size_t rows,
                         size_t columns)
{
    double *number = take_room(values, rows * columns);
    if (number != NULL) memcpy(number, x, rows * columns * sizeof *number);
    value->number = number;
    take(value, rows, columns);
    return true;
}

static bool read_numbers(const imp_parameter *row, parameter_values *values, imp_value *value)
{
    enum { COUNT_MAX = 16 };
    double x[COUNT_MAX];
    size_t extent[2];
    const char *const rest = read_array(row, row->default_value, COUNT_MAX, x, extent);
    bool fits = rest != NULL && *rest == '\0';
    for (uint32_t k = 0; k < row->rank && fits; ++k)
        fits = row->extent[k] == 0 || row->extent[k] == extent[k];
    return fits && take_numbers(values, value, x, extent[0], extent[1]);
}

static bool read_boolean(const imp_parameter *row, parameter_values *values, imp_value *value)
{
    const bool is_true = strcmp(row->default_value, "true") == 0;
    const double x = is_true;
    if (!is_true && strcmp(row->default_value, "false") != 0) return false;
    return take_numbers(values, value, &x, 1, 1);
}

/* Reads a string of ASCII without escapes. Its address and the string are one block. */
static bool read_string(const imp_parameter *row, parameter_values *values, imp_value *value)
{
    const char *const text = row->default_value;
    const size_t size = strlen(text);
    if (size < 2 || text[0] != '"' || text[size - 1] != '"') return false;
    for (size_t k = 1; k + 1 < size; ++k)
        if (text[k] < ' ' || text[k] == '"' || text[k] == '\\' || text[k] > '~') return false;
    take(value, 1, 1);
    const size_t bytes = sizeof(char *) + size - 1, unit = sizeof(double);
    const char **string = (const char **)(void *)take_room(values, (bytes + unit - 1) / unit);
    value->string = string;
    if (string == NULL) return true;
    char *copy = (char *)(string + 1);
    memcpy(copy, text + 1, size - 2);
    copy[size - 2] = '\0';
    string[0] = copy;
    return true;
}

static bool read_plain(const imp_parameter *row, parameter_values *values, imp_value *value)
{
    switch (row->kind) {
    case IMP_KIND_NUMBER:
    case IMP_KIND_INTEGER:
        return row->rank <= 2 && read_numbers(row, values, value);
    case IMP_KIND_BOOLEAN:
        return row->rank == 0 && read_boolean(row, values, value);
    case IMP_KIND_STRING:
        return row->rank == 0 && read_string(row, values, value);
    default:
        return false;
    }
}

imp_code parameter_default_plain(const imp_parameter *row, parameter_values *values,
                                 imp_value *value, bool *is_plain, imp_error *error)
{
    *is_plain = read_plain(row, values, value);
    if (!*is_plain || value->number != NULL || value->string != NULL) return IMP_SUCCESS;
    *value = (imp_value){.count = 0};
    return error_set_memory(error);
}
