/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/values.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

exit_status value_refuse(value_place at, const char *format, ...)
{
    char text[600], where[64] = "";
    va_list more;
    va_start(more, format);
    vsnprintf(text, sizeof text, format, more);
    va_end(more);
    if (at.body != SIZE_MAX) snprintf(where, sizeof where, "/bodies/%zu", at.body);
    return complain(EXIT_DATA, "simulate", "%.300s: %s%s%s: %s", at.file, where,
                    at.key[0] != '\0' ? "/" : "", at.key, text);
}

/* The start of a value's JSON text, for messages. */
typedef struct value_text {
    char at[80];
} value_text;

static value_text text_of(const json_t *value)
{
    value_text t = {"nothing"};
    char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(15));
    if (text != NULL) snprintf(t.at, sizeof t.at, "%.70s", text);
    free(text);
    return t;
}

static bool read_numbers(const json_t *value, size_t count, double *to)
{
    if (!json_is_array(value) || json_array_size(value) != count) return false;
    for (size_t i = 0; i < count; ++i) {
        const json_t *one = json_array_get(value, i);
        if (!json_is_number(one)) return false;
        to[i] = json_number_value(one);
    }
    return true;
}

/* Returns whether no number is beyond VALUE_MAX. */
static bool are_moderate(const double *x, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (!(fabs(x[i]) <= VALUE_MAX)) return false;
    return true;
}

exit_status value_vector(value_place at, const json_t *object, vec *to)
{
    const json_t *value = json_object_get(object, at.key);
    if (value == NULL) return EXIT_ANSWERED;
    if (!read_numbers(value, 3, to->x))
        return value_refuse(at, "got %s, must be three numbers, [x,y,z]", text_of(value).at);
    if (are_moderate(to->x, 3)) return EXIT_ANSWERED;
    return value_refuse(at, "got %s, must be numbers from %g to %g", text_of(value).at, -VALUE_MAX,
                        VALUE_MAX);
}

exit_status value_number(value_place at, const json_t *object, double lo, double hi, double *to)
{
    const json_t *value = json_object_get(object, at.key);
    if (value == NULL) return EXIT_ANSWERED;
    const double number = json_number_value(value);
    if (json_is_number(value) && number >= lo && number <= hi) {
        *to = number;
        return EXIT_ANSWERED;
    }
    return value_refuse(at, "got %s, must be a number from %g to %g", text_of(value).at, lo, hi);
}

exit_status value_positive(value_place at, const json_t *object, double *to)
{
    const json_t *value = json_object_get(object, at.key);
    if (value == NULL || !json_is_number(value) || json_number_value(value) > 0)
        return value_number(at, object, 1 / VALUE_MAX, VALUE_MAX, to);
    return value_refuse(at, "got %s, must be a number greater than 0", text_of(value).at);
}

/* Returns whether all leading minors are positive by more than rounding. */
static bool is_definite(const mat3 *a)
{
    const double size = mat3_greatest(a), slack = 1e-12;
    const mat3 zero = mat3_diagonal(0), b = mat3_add(&zero, 1 / size, a);
    const double minor = b.m[0][0] * b.m[1][1] - b.m[0][1] * b.m[1][0];
    return b.m[0][0] > slack && minor > slack * slack && mat3_determinant(&b) > slack * slack;
}

static exit_status check_inertia(value_place at, const json_t *value, mat3 *to)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < i; ++j) {
            const double size = fabs(to->m[i][i]) + fabs(to->m[j][j]);
            if (!(fabs(to->m[i][j] - to->m[j][i]) <= 1e-12 * size))
                return value_refuse(at,
                                    "got %g in row %d, column %d, and %g in row %d, column %d; "
                                    "must be symmetric",
                                    to->m[i][j], i, j, to->m[j][i], j, i);
            to->m[j][i] = to->m[i][j];
        }
    const double size = mat3_greatest(to);
    if (!(size >= 1 / VALUE_MAX && size <= VALUE_MAX))
        return value_refuse(at, "got %s, must have its greatest number from %g to %g",
                            text_of(value).at, 1 / VALUE_MAX, VALUE_MAX);
    if (is_definite(to)) return EXIT_ANSWERED;
    return value_refuse(at, "got %s, must be positive definite", text_of(value).at);
}

exit_status value_inertia(value_place at, const json_t *object, mat3 *to)
{
    const json_t *value = json_object_get(object, at.key);
    if (value == NULL) return EXIT_ANSWERED;
    bool good = json_is_array(value) && json_array_size(value) == 3;
    for (size_t i = 0; good && i < 3; ++i)
        good = read_numbers(json_array_get(value, i), 3, to->m[i]);
    if (good) return check_inertia(at, value, to);
    return value_refuse(at, "got %s, must be three rows of three numbers", text_of(value).at);
}
