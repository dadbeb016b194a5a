/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/common/course_internal.h"
#include "plugins/common/csv.h"

#include <stdlib.h>
#include <string.h>

/* Courses from tables: those of parameters, and those of files. */

/* Rows of a time and some values, and the units of each column: in the table, and in the host. */
typedef struct course_table {
    csv_numbers numbers;
    unit from[CSV_COLUMNS_MAX], to[CSV_COLUMNS_MAX];
    int row; /* of the parameter that it came from */
    bool in_file;
} course_table;

/* From the parameters. */
static imp_status course_collect(const course_question *q, csv_numbers *to)
{
    const imp_value *times = &q->v[COURSE_TIMES], *values = &q->v[COURSE_VALUES];
    const size_t width = course_width(q);
    to->rows = times->count;
    if (values->extent[0] != to->rows)
        return imp_reject(q->why, q->first + COURSE_VALUES, -1,
                          "%zu for %zu times; there must be one for each", values->extent[0],
                          to->rows);
    to->number = malloc(to->rows * to->columns * sizeof(double));
    if (to->number == NULL) return IMP_STATUS_INTERNAL;
    for (size_t i = 0; i < to->rows; ++i) {
        to->number[i * to->columns] = times->number[i];
        memcpy(to->number + i * to->columns + 1, values->number + i * width,
               width * sizeof(double));
    }
    return IMP_STATUS_OK;
}

/* The unit of a column that names none. */
static const unit plain_unit = {1, 1, false};

static imp_status refuse_unit(const course_question *q, const course_table *t, size_t k,
                              unit_kind kind)
{
    return imp_reject(q->why, t->row, -1, "column %zu is in '%s'; allowed are %s",
                      t->numbers.place[k] + 1, t->numbers.unit[k], unit_names(kind));
}

/* Finds the unit of column k > 0, whose head says one, or none. */
static imp_status course_find_unit(const course_question *q, course_table *t, size_t k)
{
    const imp_value *u = &q->v[COURSE_UNIT];
    const char *said = t->numbers.unit[k];
    const bool degrees = q->kind == UNIT_ANGLE && u->number[0] != 0;
    if (*said != '\0' && !unit_find(q->kind, said, &t->from[k]))
        return refuse_unit(q, t, k, q->kind);
    if (degrees && *said != '\0' && !t->from[k].is_of_pi)
        return imp_reject(q->why, t->row, -1, "column %zu is in %s, but degrees is true",
                          t->numbers.place[k] + 1, said);
    if (degrees) unit_find(UNIT_ANGLE, "deg", &t->from[k]);
    if (q->kind == UNIT_ANGLE) return IMP_STATUS_OK;
    if (*said != '\0' && !imp_is_given(u))
        return imp_reject(q->why, t->row, -1,
                          "column %zu is in %s, but the scene's unit is not known; give scene_unit",
                          t->numbers.place[k] + 1, said);
    if (imp_is_given(u) && !unit_find(UNIT_LENGTH, u->string[0], &t->to[k]))
        return imp_reject(q->why, q->first + COURSE_UNIT, -1, "found '%.40s'; allowed are %s",
                          u->string[0], unit_names(UNIT_LENGTH));
    if (*said == '\0') t->from[k] = t->to[k];
    return IMP_STATUS_OK;
}

static imp_status course_find_units(const course_question *q, course_table *t)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < CSV_COLUMNS_MAX; ++k) t->from[k] = t->to[k] = plain_unit;
    if (t->numbers.unit[0][0] != '\0' && !unit_find(UNIT_TIME, t->numbers.unit[0], &t->from[0]))
        return refuse_unit(q, t, 0, UNIT_TIME);
    for (size_t k = 1; k < t->numbers.columns && status == IMP_STATUS_OK; ++k)
        status = course_find_unit(q, t, k);
    return status;
}

/* Converts the times, and checks that they increase. */
static imp_status course_take_times(course_table *t, imp_create_error *why)
{
    const csv_numbers *n = &t->numbers;
    if (n->rows < 2)
        return imp_reject(why, t->row, -1, "a table of %zu row%s; it must have two or more",
                          n->rows, n->rows == 1 ? "" : "s");
    for (size_t i = 0; i < n->rows; ++i) {
        double *time = &n->number[i * n->columns];
        *time = unit_convert_near(*time, &t->from[0], &t->to[0]);
        if (i > 0 && !(time[-(ptrdiff_t)n->columns] < *time))
            return imp_reject(why, t->row, t->in_file ? -1 : (int64_t)i,
                              "%.17g after %.17g (row %zu of the table); times must increase",
                              *time, time[-(ptrdiff_t)n->columns], i + 1);
    }
    return IMP_STATUS_OK;
}

static void fill_times(const course_table *t, double *time)
{
    for (size_t i = 0; i < t->numbers.rows; ++i)
        time[i] = t->numbers.number[i * t->numbers.columns];
}

/* Converts rows of one number for each column but the time, `stride` apart. */
static void fill_keys(const course_table *t, const double *number, size_t stride, imp_interval *key)
{
    const size_t width = t->numbers.columns - 1;
    for (size_t i = 0; i < t->numbers.rows; ++i)
        for (size_t k = 0; k < width; ++k)
            key[i * width + k] =
                unit_convert(number[i * stride + k], &t->from[k + 1], &t->to[k + 1]);
}

/* Sets the spline through the values, or through them with the velocities that are given. `key` has
 * room for all three. */
static bool course_set_spline(const course_keys *c, const course_table *t, const course_question *q,
                              imp_interval *key, size_t *piece)
{
    const size_t width = t->numbers.columns - 1, all = t->numbers.rows * width;
    const imp_value *slopes = &q->v[COURSE_VELOCITIES], *bends = &q->v[COURSE_ACCELERATIONS];
    fill_keys(t, t->numbers.number + 1, width + 1, key);
    if (!imp_is_given(slopes)) return spline_set(&c->table, key, piece);
    fill_keys(t, slopes->number, width, key + all);
    if (imp_is_given(bends)) fill_keys(t, bends->number, width, key + 2 * all);
    return spline_set_hermite(&c->table, key, key + all, key + 2 * all, piece);
}

/* Copies the table's numbers, and the velocities and accelerations that were given, to where there
 * is room for them. */
static void keep_given(course_keys *c, const course_table *t, const course_question *q,
                       double *room)
{
    const size_t width = t->numbers.columns - 1;
    const imp_value *further[] = {&q->v[COURSE_VELOCITIES], &q->v[COURSE_ACCELERATIONS]};
    c->given[0] = room;
    for (size_t i = 0; i < t->numbers.rows; ++i, room += width)
        memcpy(room, &t->numbers.number[i * (width + 1) + 1], width * sizeof *room);
    for (int k = 0; k < 2; ++k) {
        if (!imp_is_given(further[k])) continue;
        c->given[k + 1] = room;
        memcpy(room, further[k]->number, further[k]->count * sizeof *room);
        room += further[k]->count;
    }
    for (size_t k = 0; k < width; ++k) {
        c->from[k] = t->from[k + 1];
        c->to[k] = t->to[k + 1];
    }
}

/* The spline of a checked table. */
static imp_status course_set_table(course *c, const course_table *t, const course_question *q,
                                   bool linear)
{
    const size_t width = t->numbers.columns - 1, keys = t->numbers.rows;
    const bool sloped = imp_is_given(&q->v[COURSE_VELOCITIES]);
    const int degree = imp_is_given(&q->v[COURSE_ACCELERATIONS]) ? SPLINE_QUINTIC : SPLINE_CUBIC;
    const size_t bytes = spline_bytes(degree, keys, width, 0);
    imp_interval *key = malloc(3 * keys * width * sizeof *key);
    const size_t given = COURSE_ORDERS * keys * width * sizeof(double);
    course_keys *made = malloc(sizeof *made + bytes + given);
    c->keys = made; /* course_clear frees it */
    if (key == NULL || made == NULL) {
        free(key);
        return IMP_STATUS_INTERNAL;
    }
    *made = (course_keys){.table = spline_place(degree, keys, width, 0, made + 1)};
    made->table.kinked = linear && !sloped;
    fill_times(t, made->table.time);
    keep_given(made, t, q, (double *)(void *)((char *)(made + 1) + bytes));
    size_t piece;
    const bool good = course_set_spline(made, t, q, key, &piece);
    free(key);
    if (!good)
        return imp_reject(
            q->why, t->row, -1,
            "row %zu of the table is too far from the one before for the time between "
            "them: speeds are not finite",
            piece + 2);
    spline_grow(&made->table);
    return IMP_STATUS_OK;
}

imp_status course_read_table(course *c, const course_question *q)
{
    const imp_value *v = q->v;
    const char *way = v[COURSE_INTERPOLATION].string[0];
    const bool linear = strcmp(way, "linear") == 0, in_file = imp_is_given(&v[COURSE_FILE]);
    if (!linear && strcmp(way, "cubic") != 0)
        return imp_reject(q->why, q->first + COURSE_INTERPOLATION, -1,
                          "found \"%.40s\", allowed \"linear\" or \"cubic\"", way);
    course_table t = {.numbers = {.columns = course_width(q) + 1},
                      .row = q->first + (in_file ? COURSE_FILE : COURSE_TIMES),
                      .in_file = in_file};
    imp_status status = in_file
                            ? csv_read(v[COURSE_FILE].string[0], t.row, v[COURSE_COLUMNS].string,
                                       q->first + COURSE_COLUMNS, &t.numbers, q->why)
                            : course_collect(q, &t.numbers);
    if (status == IMP_STATUS_OK) status = course_find_units(q, &t);
    if (status == IMP_STATUS_OK) status = course_take_times(&t, q->why);
    if (status == IMP_STATUS_OK) status = course_set_table(c, &t, q, linear);
    free(t.numbers.number);
    return status;
}
