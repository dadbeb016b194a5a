/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TYPE_H
#define PLUGINS_EXPRESSION_TYPE_H

#include "plugins/expression/expression.h"

#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* What types given by formulas share
 * ==================================
 * The first parameters of the surface and of the map of points are the same: three texts,
 * constants, and the times at which they are defined. The motion has the last two of these. */

enum { TEXT_X, TEXT_Y, TEXT_Z, CONSTANTS, TIME, TEXT_ROWS };

#define ROW_TEXT(NAME, DEFAULT, DOC)                                                               \
    {                                                                                              \
        .name = NAME, .unit = "length", .default_value = DEFAULT, .doc = DOC,                      \
        .kind = IMP_KIND_STRING                                                                    \
    }
#define ROW_CONSTANTS(TEXTS)                                                                       \
    {                                                                                              \
        .name = "constants", .unit = "1",                                                          \
        .doc = "at most 4096 names with numbers, for use in " TEXTS, .kind = IMP_KIND_TABLE,       \
        .flags = IMP_PARAMETER_OPTIONAL, .min = -INFINITY, .max = INFINITY                         \
    }
#define ROW_TIME(DOC)                                                                              \
    IMP_ROW("time", "time", NULL, IMP_PARAMETER_OPTIONAL, 1, 2, 0, -INFINITY, INFINITY, DOC)

/* The times of a map. */
#define ROW_MAP_TIME                                                                               \
    ROW_TIME("[t0,t1]: times at which it is defined; other times cannot be queried; default: all " \
             "times")

/* t0 <= t1 of that row, or all times. */
static inline imp_status read_time(const imp_value *values, int row, double *lo, double *hi,
                                   imp_create_error *why)
{
    const double *given = values[row].number;
    *lo = -INFINITY, *hi = INFINITY;
    if (!imp_is_given(&values[row])) return IMP_STATUS_OK;
    *lo = given[0], *hi = given[1];
    if (*lo <= *hi) return IMP_STATUS_OK;
    return imp_reject(why, row, -1, "[%g,%g] ends before it begins", *lo, *hi);
}

static inline void use_constants(const imp_value *constants, expression_scope *scope)
{
    scope->constant = constants->string;
    scope->constant_value = constants->number;
    scope->constant_count = constants->count;
}

/* What a variable from lo to hi may be; j is its place among (u, v, t). */
static inline imp_model whole_range(double lo, double hi, int j)
{
    imp_model range = imp_unbounded(1u << j);
    range.lo = lo, range.hi = hi;
    return imp_model_collapse(range);
}

/* `form` and `section` as in expression_compile_form, or both NULL. */
static inline imp_status compile_texts(const imp_value *values, expression_scope *scope,
                                       expression_program **program, struct text_form *form,
                                       expression_program **section, imp_create_error *why)
{
    const char *const text[3] = {values[TEXT_X].string[0], values[TEXT_Y].string[0],
                                 values[TEXT_Z].string[0]};
    use_constants(&values[CONSTANTS], scope);
    expression_error error;
    imp_status status = expression_compile_form(scope, text, program, form, section, &error);
    if (status != IMP_STATUS_PARAMETER) return status;
    int row = error.at < 3                          ? TEXT_X + error.at
              : error.at == EXPRESSION_AT_CONSTANTS ? CONSTANTS
                                                    : -1;
    return imp_reject(why, row, -1, "%s", error.message);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* What is printed of an instance: `lo` and `hi` hold u, v and t of a surface, of a map t alone. */
typedef struct printed_values {
    const imp_value *values;
    const double *lo, *hi;
} printed_values;

static inline void write_constants(const imp_value *constants, const imp_text_sink *to)
{
    for (size_t k = 0; k < constants->count; ++k)
        imp_define(to, constants->string[k], constants->number[k]);
}

static inline void write_range(const char *variable, double lo, double hi, const imp_text_sink *to)
{
    if (lo > -INFINITY || hi < INFINITY) imp_add_range(to, variable, lo, hi);
}

static inline void write_coordinates(const imp_value *values, const imp_text_sink *to)
{
    for (int i = TEXT_X; i <= TEXT_Z; ++i) {
        imp_add_text(to, values[i].string[0]);
        if (i < TEXT_Z) imp_add_text(to, "; ");
    }
}

/* Print a surface and a map of points (imp_surface_type.formula): constants, domain and the three
 * texts. */
static inline void write_surface_texts(const printed_values *p, const imp_text_sink *to)
{
    static const char *const variable[] = {"u", "v", "t"};
    write_constants(&p->values[CONSTANTS], to);
    for (int j = 0; j < 3; ++j) write_range(variable[j], p->lo[j], p->hi[j], to);
    write_coordinates(p->values, to);
}

static inline void write_map_texts(const printed_values *p, const imp_text_sink *to)
{
    write_constants(&p->values[CONSTANTS], to);
    write_range("t", *p->lo, *p->hi, to);
    write_coordinates(p->values, to);
}

/* A text, and how much of it there is; `at` NULL: it is only measured. */
typedef struct kept_text {
    char *at;
    size_t length;
} kept_text;

static inline void add_to_kept(const imp_text_sink *sink, const char *text, size_t size)
{
    kept_text *kept = (kept_text *)sink->host;
    if (kept->at != NULL) memcpy(kept->at + kept->length, text, size);
    kept->length += size;
}

/* Keeps what `print` prints, for free(). NULL: no memory. */
static inline char *keep_texts(void (*print)(const printed_values *p, const imp_text_sink *to),
                               const imp_value *values, const double *lo, const double *hi)
{
    const printed_values of = {values, lo, hi};
    kept_text kept = {NULL, 0};
    const imp_text_sink to = {
        .struct_size = (uint32_t)sizeof to, .host = &kept, .add = add_to_kept};
    print(&of, &to);
    kept = (kept_text){(char *)malloc(kept.length + 1), 0};
    if (kept.at == NULL) return NULL;
    print(&of, &to);
    kept.at[kept.length] = '\0';
    return kept.at;
}

#endif
