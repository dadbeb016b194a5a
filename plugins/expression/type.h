/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TYPE_H
#define PLUGINS_EXPRESSION_TYPE_H

#include "plugins/expression/expression.h"

#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* What the surface and the map given by formulas share
 * ====================================================
 * Their first parameters are the same: three texts, constants, and the times at which they are
 * defined. */

enum { TEXT_X, TEXT_Y, TEXT_Z, CONSTANTS, TIME, TEXT_ROWS };

#define ROW_TEXT(NAME, DEFAULT, DOC)                                                               \
    {                                                                                              \
        .name = NAME, .unit = "length", .default_value = DEFAULT, .doc = DOC,                      \
        .kind = IMP_KIND_STRING                                                                    \
    }
#define ROW_CONSTANTS                                                                              \
    {                                                                                              \
        .name = "constants", .unit = "1",                                                          \
        .doc = "at most 4096 names with numbers, for use in x, y and z", .kind = IMP_KIND_TABLE,   \
        .flags = IMP_PARAMETER_OPTIONAL, .min = -INFINITY, .max = INFINITY                         \
    }
#define ROW_TIME(DOC)                                                                              \
    IMP_ROW("time", "time", NULL, IMP_PARAMETER_OPTIONAL, 1, 2, 0, -INFINITY, INFINITY, DOC)

/* t0 <= t1, or all times. */
static inline imp_status read_time(const imp_value *values, double *lo, double *hi,
                                   imp_create_error *why)
{
    const double *given = values[TIME].number;
    *lo = -INFINITY, *hi = INFINITY;
    if (!imp_is_given(&values[TIME])) return IMP_STATUS_OK;
    *lo = given[0], *hi = given[1];
    if (*lo <= *hi) return IMP_STATUS_OK;
    return imp_reject(why, TIME, -1, "[%g,%g] ends before it begins", *lo, *hi);
}

/* What a variable from lo to hi may be; j is its place among (u, v, t). */
static inline imp_model whole_range(double lo, double hi, int j)
{
    imp_model range = imp_unbounded(1u << j);
    range.lo = lo, range.hi = hi;
    return imp_model_collapse(range);
}

/* `form` and `radius` as in expression_compile_coil, or both NULL. */
static inline imp_status compile_texts(const imp_value *values, expression_scope *scope,
                                       expression_program **program, struct coil_form *form,
                                       expression_program **radius, imp_create_error *why)
{
    const char *const text[3] = {values[TEXT_X].string[0], values[TEXT_Y].string[0],
                                 values[TEXT_Z].string[0]};
    scope->constant = values[CONSTANTS].string;
    scope->constant_value = values[CONSTANTS].number;
    scope->constant_count = values[CONSTANTS].count;
    expression_error error;
    imp_status status = expression_compile_coil(scope, text, program, form, radius, &error);
    if (status != IMP_STATUS_PARAMETER) return status;
    int row = error.at < 3                          ? TEXT_X + error.at
              : error.at == EXPRESSION_AT_CONSTANTS ? CONSTANTS
                                                    : -1;
    return imp_reject(why, row, -1, "%s", error.message);
}

/* --- As text ---------------------------------------------------------------------------------- */

/* Prints the instance (imp_surface_type.formula): constants, domain and the three texts. lo and hi
 * hold u, v and t of a surface, and of a map t alone. */
static inline void write_texts(const imp_value *values, const double *lo, const double *hi,
                               bool is_surface, const imp_text_sink *to)
{
    static const char *const variable[] = {"u", "v", "t"};
    const imp_value *constants = &values[CONSTANTS];
    for (size_t k = 0; k < constants->count; ++k)
        imp_define(to, constants->string[k], constants->number[k]);
    for (int j = is_surface ? 0 : 2; j < 3; ++j, ++lo, ++hi)
        if (*lo > -INFINITY || *hi < INFINITY) imp_add_range(to, variable[j], *lo, *hi);
    for (int i = TEXT_X; i <= TEXT_Z; ++i) {
        imp_add_text(to, values[i].string[0]);
        if (i < TEXT_Z) imp_add_text(to, "; ");
    }
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

/* Keeps what write_texts prints, for free(). NULL: no memory. */
static inline char *keep_texts(const imp_value *values, const double *lo, const double *hi,
                               bool is_surface)
{
    kept_text kept = {NULL, 0};
    const imp_text_sink to = {
        .struct_size = (uint32_t)sizeof to, .host = &kept, .add = add_to_kept};
    write_texts(values, lo, hi, is_surface, &to);
    kept = (kept_text){(char *)malloc(kept.length + 1), 0};
    if (kept.at == NULL) return NULL;
    write_texts(values, lo, hi, is_surface, &to);
    kept.at[kept.length] = '\0';
    return kept.at;
}

#endif
