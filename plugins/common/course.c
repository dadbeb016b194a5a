/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/course.h"

#include "plugins/common/csv.h"

#include <stdlib.h>
#include <string.h>

void course_clear(course *c) { free(c->memory); }

/* --- Making one ------------------------------------------------------------------------------ */

/* Exactly one of rate, coefficients, times with values, and file. */
static imp_status course_check(const imp_value *values, int first, imp_create_error *why,
                               const imp_parameter *rows)
{
    const imp_value *v = values + first;
    static const int forms[] = {COURSE_RATE, COURSE_COEFFICIENTS, COURSE_TIMES, COURSE_FILE};
    int given = -1;
    for (int k = 0; k < 4; ++k) {
        if (!imp_is_given(&v[forms[k]])) continue;
        if (given >= 0)
            return imp_reject(why, first + forms[k], -1,
                              "given beside %s, but only one of the two can hold",
                              rows[first + given].name);
        given = forms[k];
    }
    if (given < 0)
        return imp_reject(why, -1, -1, "neither %s nor %s nor times nor file is given; give one",
                          rows[first + COURSE_RATE].name, rows[first + COURSE_COEFFICIENTS].name);
    if (imp_is_given(&v[COURSE_VALUES]) != (given == COURSE_TIMES))
        return imp_reject(why, first + COURSE_VALUES, -1,
                          "times and %s belong together: give both or neither",
                          rows[first + COURSE_VALUES].name);
    if (imp_is_given(&v[COURSE_COLUMNS]) && given != COURSE_FILE)
        return imp_reject(why, first + COURSE_COLUMNS, -1, "belongs to a file, which is missing");
    return IMP_OK;
}

static imp_status course_read_polynomial(course *c, const imp_value *v, size_t width)
{
    c->memory =
        malloc(width * polynomial_count(&v[COURSE_RATE], &v[COURSE_COEFFICIENTS]) * sizeof(double));
    if (c->memory == NULL) return IMP_INTERNAL;
    c->polynomial =
        polynomial_read(&v[COURSE_RATE], &v[COURSE_COEFFICIENTS], width, (double *)c->memory);
    return IMP_OK;
}

/* Rows of a time and `width` values, from the parameters. */
static imp_status course_collect(const imp_value *v, int first, size_t width, csv_numbers *to,
                                 imp_create_error *why)
{
    to->rows = v[COURSE_TIMES].count;
    if (v[COURSE_VALUES].extent[0] != to->rows)
        return imp_reject(why, first + COURSE_VALUES, -1,
                          "%zu for %zu times; there must be one for each",
                          v[COURSE_VALUES].extent[0], to->rows);
    to->number = malloc(to->rows * to->columns * sizeof(double));
    if (to->number == NULL) return IMP_INTERNAL;
    for (size_t i = 0; i < to->rows; ++i) {
        to->number[i * to->columns] = v[COURSE_TIMES].number[i];
        memcpy(to->number + i * to->columns + 1, v[COURSE_VALUES].number + i * width,
               width * sizeof(double));
    }
    return IMP_OK;
}

static imp_status course_check_times(const csv_numbers *table, int row, bool in_file,
                                     imp_create_error *why)
{
    if (table->rows < 2)
        return imp_reject(why, row, -1, "%zu rows of a table; allowed are two or more",
                          table->rows);
    for (size_t i = 1; i < table->rows; ++i) {
        const double before = table->number[(i - 1) * table->columns];
        const double now = table->number[i * table->columns];
        if (!(before < now))
            return imp_reject(why, row, in_file ? -1 : (int64_t)i,
                              "%.17g after %.17g (row %zu of the table); times must increase", now,
                              before, i + 1);
    }
    return IMP_OK;
}

/* The spline of a checked table. */
static imp_status course_set_table(course *c, const csv_numbers *table, bool linear, int row,
                                   imp_create_error *why)
{
    const size_t width = table->columns - 1, keys = table->rows;
    imp_interval *key = malloc(keys * width * sizeof *key);
    c->memory = malloc(spline_bytes(keys, width, 0));
    if (key == NULL || c->memory == NULL) {
        free(key);
        return IMP_INTERNAL;
    }
    c->table = spline_place(keys, width, 0, c->memory);
    c->table.kinked = linear;
    for (size_t i = 0; i < keys; ++i) {
        c->table.time[i] = table->number[i * table->columns];
        for (size_t j = 0; j < width; ++j) {
            const double x = table->number[i * table->columns + 1 + j];
            key[i * width + j] = imp_interval_make(x, x);
        }
    }
    size_t piece;
    const bool good = spline_set(&c->table, key, &piece);
    free(key);
    if (!good)
        return imp_reject(
            why, row, -1,
            "row %zu of the table is too far from the one before for the time between "
            "them: speeds are not finite",
            piece + 2);
    spline_grow(&c->table);
    return IMP_OK;
}

static imp_status course_read_table(course *c, const imp_value *values, int first, size_t width,
                                    imp_create_error *why)
{
    const imp_value *v = values + first;
    const char *way = v[COURSE_INTERPOLATION].string[0];
    const bool linear = strcmp(way, "linear") == 0, in_file = imp_is_given(&v[COURSE_FILE]);
    if (!linear && strcmp(way, "cubic") != 0)
        return imp_reject(why, first + COURSE_INTERPOLATION, -1,
                          "found \"%.40s\", allowed \"linear\" or \"cubic\"", way);
    csv_numbers table = {.columns = width + 1};
    const int row = first + (in_file ? COURSE_FILE : COURSE_TIMES);
    imp_status status = in_file ? csv_read(v[COURSE_FILE].string[0], row, v[COURSE_COLUMNS].string,
                                           first + COURSE_COLUMNS, &table, why)
                                : course_collect(v, first, width, &table, why);
    if (status == IMP_OK) status = course_check_times(&table, row, in_file, why);
    if (status == IMP_OK) status = course_set_table(c, &table, linear, row, why);
    free(table.number);
    return status;
}

/* On failure there is nothing to clear. */
imp_status course_read(course *c, const imp_value *values, int first, size_t width,
                       imp_create_error *why, const imp_parameter *rows)
{
    const imp_value *v = values + first;
    *c = (course){.hold = v[COURSE_HOLD].number[0] != 0};
    imp_status status = course_check(values, first, why, rows);
    if (status != IMP_OK) return status;
    const bool is_table = imp_is_given(&v[COURSE_TIMES]) || imp_is_given(&v[COURSE_FILE]);
    status = is_table ? course_read_table(c, values, first, width, why)
                      : course_read_polynomial(c, v, width);
    if (status != IMP_OK) course_clear(c);
    return status;
}

/* --- Asking --------------------------------------------------------------------------------- */

void course_span(const course *c, double *lo, double *hi)
{
    const bool is_table = c->polynomial.count == 0;
    *lo = is_table ? c->table.time[0] : -INFINITY;
    *hi = is_table ? c->table.time[c->table.pieces] : INFINITY;
}

void course_times(const course *c, double *lo, double *hi)
{
    course_span(c, lo, hi);
    if (c->hold) *lo = -INFINITY, *hi = INFINITY;
}

bool course_is_defined(const course *c, double from, double to)
{
    double lo, hi;
    course_times(c, &lo, &hi);
    return from >= lo && to <= hi;
}

void course_at(const course *c, size_t width, imp_model t, imp_model *out)
{
    imp_interval node[SPLINE_WIDTH_MAX];
    if (c->polynomial.count == 0)
        spline_models(&c->table, c->hold ? spline_hold(&c->table, t) : t, out, node);
    else
        for (size_t i = 0; i < width; ++i) out[i] = polynomial_at(&c->polynomial, i, t);
}
