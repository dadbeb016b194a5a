/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/course_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void course_clear(course *c)
{
    free(c->polynomial.coefficient);
    free(c->keys);
}

/* --- Making one ------------------------------------------------------------------------------- */

/* A unit belongs to a table of angles, or to a file of lengths. */
static imp_status course_check_unit(const course_question *q, int given)
{
    const imp_value *u = &q->v[COURSE_UNIT];
    const bool angle = q->kind == UNIT_ANGLE, asked = angle ? u->number[0] != 0 : imp_is_given(u);
    if (!asked || given == COURSE_FILE || (angle && given == COURSE_TIMES)) return IMP_STATUS_OK;
    return imp_reject(q->why, q->first + COURSE_UNIT, -1, "belongs to a %s, which is missing",
                      angle ? "table" : "file");
}

/* Velocities belong to times, and accelerations to velocities; there is one for each time. */
static imp_status course_check_slopes(const course_question *q, int given)
{
    static const int further[] = {COURSE_VELOCITIES, COURSE_ACCELERATIONS};
    for (int k = 0; k < 2; ++k) {
        const imp_value *v = &q->v[further[k]];
        const int owner = k == 0 ? COURSE_TIMES : COURSE_VELOCITIES;
        if (!imp_is_given(v)) continue;
        if (given != COURSE_TIMES || !imp_is_given(&q->v[owner]))
            return imp_reject(q->why, q->first + further[k], -1, "belongs to %s, which is missing",
                              q->rows[q->first + owner].name);
        if (v->extent[0] != q->v[COURSE_TIMES].count)
            return imp_reject(q->why, q->first + further[k], -1,
                              "%zu for %zu times; there must be one for each", v->extent[0],
                              q->v[COURSE_TIMES].count);
        if (strcmp(q->v[COURSE_INTERPOLATION].string[0], "linear") != 0)
            return imp_reject(q->why, q->first + further[k], -1,
                              "given beside interpolation, which takes slopes from the values");
    }
    return IMP_STATUS_OK;
}

/* Exactly one of rate, coefficients, times with values, and file. */
static imp_status course_check(const course_question *q)
{
    const imp_value *v = q->v;
    const imp_parameter *rows = q->rows + q->first;
    static const int forms[] = {COURSE_RATE, COURSE_COEFFICIENTS, COURSE_TIMES, COURSE_FILE};
    int given = -1;
    for (int k = 0; k < 4; ++k) {
        if (!imp_is_given(&v[forms[k]])) continue;
        if (given >= 0)
            return imp_reject(q->why, q->first + forms[k], -1,
                              "given beside %s, but only one of the two can hold",
                              rows[given].name);
        given = forms[k];
    }
    if (given < 0)
        return imp_reject(q->why, -1, -1, "neither %s nor %s nor times nor file is given; give one",
                          rows[COURSE_RATE].name, rows[COURSE_COEFFICIENTS].name);
    if (imp_is_given(&v[COURSE_VALUES]) != (given == COURSE_TIMES))
        return imp_reject(q->why, q->first + COURSE_VALUES, -1,
                          "times and %s belong together: give both or neither",
                          rows[COURSE_VALUES].name);
    if (imp_is_given(&v[COURSE_COLUMNS]) && given != COURSE_FILE)
        return imp_reject(q->why, q->first + COURSE_COLUMNS, -1,
                          "belongs to a file, which is missing");
    const imp_status status = course_check_unit(q, given);
    return status == IMP_STATUS_OK ? course_check_slopes(q, given) : status;
}

static imp_status course_read_polynomial(course *c, const course_question *q)
{
    const imp_value *rate = &q->v[COURSE_RATE], *coefficients = &q->v[COURSE_COEFFICIENTS];
    c->numbers = course_width(q) * polynomial_count(rate, coefficients);
    double *room = malloc(c->numbers * sizeof *room);
    if (room == NULL) return IMP_STATUS_INTERNAL;
    c->polynomial = polynomial_read(rate, coefficients, course_width(q), room);
    return IMP_STATUS_OK;
}

/* On failure there is nothing to clear. */
imp_status course_read(course *c, const imp_value *values, int first, unit_kind kind,
                       imp_create_error *why, const imp_parameter *rows)
{
    const course_question q = {values + first, first, kind, why, rows};
    *c = (course){.hold = q.v[COURSE_HOLD].number[0] != 0};
    imp_status status = course_check(&q);
    if (status != IMP_STATUS_OK) return status;
    const bool is_table = imp_is_given(&q.v[COURSE_TIMES]) || imp_is_given(&q.v[COURSE_FILE]);
    status = is_table ? course_read_table(c, &q) : course_read_polynomial(c, &q);
    if (status != IMP_STATUS_OK) course_clear(c);
    return status;
}

imp_status course_renew(course *c, const imp_value *values, int first, unit_kind kind,
                        imp_create_error *why, const imp_parameter *rows)
{
    const course_question q = {values + first, first, kind, why, rows};
    const imp_value *rate = &q.v[COURSE_RATE], *coefficients = &q.v[COURSE_COEFFICIENTS];
    const imp_status status = course_check(&q);
    if (status != IMP_STATUS_OK) return status;
    if (imp_is_given(&q.v[COURSE_TIMES]) || imp_is_given(&q.v[COURSE_FILE]) ||
        c->polynomial.count != polynomial_count(rate, coefficients))
        return IMP_STATUS_UNBOUNDED;
    c->hold = q.v[COURSE_HOLD].number[0] != 0;
    c->polynomial =
        polynomial_read(rate, coefficients, course_width(&q), c->polynomial.coefficient);
    return IMP_STATUS_OK;
}

/* --- Asking ----------------------------------------------------------------------------------- */

void course_span(const course *c, double *lo, double *hi)
{
    const bool is_table = c->polynomial.count == 0;
    *lo = is_table ? c->keys->table.time[0] : -INFINITY;
    *hi = is_table ? c->keys->table.time[c->keys->table.pieces] : INFINITY;
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
        spline_models(&c->keys->table, c->hold ? spline_hold(&c->keys->table, t) : t, out, node);
    else
        for (size_t i = 0; i < width; ++i) out[i] = polynomial_at(&c->polynomial, i, t);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* What spline_write_part asks for: a number of the table in units of the host. */
static void write_key(const void *of, int order, size_t key, size_t lane, const imp_text_sink *to)
{
    const course_keys *c = of;
    const unit *from = &c->from[lane], *into = &c->to[lane];
    imp_add_number(to, c->given[order][key * c->table.lanes + lane]);
    if (from->top * into->bottom == into->top * from->bottom && from->is_of_pi == into->is_of_pi)
        return;
    imp_add_text(to, "*");
    imp_add_number(to, from->top);
    imp_add_text(to, "*");
    imp_add_number(to, into->bottom);
    imp_add_text(to, "/(");
    imp_add_number(to, from->bottom);
    imp_add_text(to, "*");
    imp_add_number(to, into->top);
    imp_add_text(to, from->is_of_pi ? ")*pi" : ")");
}

/* Prints a table, a part for each of its pieces. */
static void write_table(const course *c, const char *name, const char *before, const char *after,
                        const imp_text_sink *to)
{
    const course_keys *keys = c->keys;
    const int orders = keys->given[1] == NULL ? 0 : keys->given[2] == NULL ? 1 : 2;
    const spline_text text = {&keys->table, c->hold, orders, name, write_key, keys};
    for (size_t k = 0; k < keys->table.pieces; ++k) {
        imp_add_text(to, k > 0 ? "| " : "");
        imp_add_text(to, before);
        spline_write_part(&text, k, to);
        imp_add_text(to, after);
    }
}

void course_write(const course *c, const char *name, const char *before, const char *after,
                  const imp_text_sink *to)
{
    const char digits[COURSE_WIDTH_MAX] = {'0', '1', '2'};
    if (c->polynomial.count == 0) {
        write_table(c, name, before, after, to);
        return;
    }
    imp_add_text(to, before);
    for (size_t i = 0; i < COURSE_WIDTH_MAX && i * c->polynomial.count < c->numbers; ++i) {
        char numbered[32];
        snprintf(numbered, sizeof numbered, "%s%c", name, digits[i]);
        polynomial_define(&c->polynomial, i, numbered, to);
    }
    imp_add_text(to, after);
}
