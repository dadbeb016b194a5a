/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_POLYNOMIAL_H
#define PLUGINS_COMMON_POLYNOMIAL_H

#include <impinge/formula_text.h>
#include <impinge/model.h>
#include <impinge/plugin.h>

/* Parameters that change as a polynomial in time
 * ==============================================
 * A parameter has two forms of which a caller gives one: a constant rate of change (velocity,
 * rate), or all coefficients, lowest power first (offset, angle). */

/* Checks that exactly one of the two rows is given. */
static inline imp_status check_one_of(const imp_value *values, int rate, int coefficients,
                                      imp_create_error *why, const imp_parameter *rows)
{
    if (imp_is_given(&values[rate]) != imp_is_given(&values[coefficients])) return IMP_STATUS_OK;
    if (imp_is_given(&values[rate]))
        return imp_reject(why, coefficients, -1,
                          "given beside %s, but only one of the two can hold", rows[rate].name);
    return imp_reject(why, -1, -1, "neither %s nor %s is given; give one of them", rows[rate].name,
                      rows[coefficients].name);
}

/* A polynomial of vectors, component by component: coefficient k of component i at
 * [i * count + k]. Memory is the owner's. */
typedef struct polynomial {
    size_t count; /* coefficients of each component */
    double *coefficient;
} polynomial;

/* Returns how many coefficients the given one of the two forms has. */
static inline size_t polynomial_count(const imp_value *rate, const imp_value *coefficients)
{
    return imp_is_given(rate) ? 2 : coefficients->extent[0];
}

/* Fills `out` (width * count numbers) from the form that is given. */
static inline polynomial polynomial_read(const imp_value *rate, const imp_value *coefficients,
                                         size_t width, double *out)
{
    polynomial p = {polynomial_count(rate, coefficients), out};
    for (size_t i = 0; i < width; ++i)
        for (size_t k = 0; k < p.count; ++k)
            out[i * p.count + k] = !imp_is_given(rate) ? coefficients->number[k * width + i]
                                   : k == 1            ? rate->number[i]
                                                       : 0;
    return p;
}

/* Reads a polynomial from a parameter that has only coefficients, as rows of `width` numbers. */
static inline polynomial polynomial_copy(const imp_value *coefficients, size_t width, double *out)
{
    const imp_value rate = {0};
    return polynomial_read(&rate, coefficients, width, out);
}

/* For a parameter given as `count` rows of `given` numbers, 1 or `width`: one stands for all. */
static inline polynomial polynomial_spread(const double *number, size_t count, size_t given,
                                           size_t width, double *out)
{
    for (size_t i = 0; i < width; ++i)
        for (size_t k = 0; k < count; ++k)
            out[i * count + k] = number[k * given + (given == width ? i : 0)];
    return (polynomial){count, out};
}

/* A parameter of one number that has only coefficients: a bare number is a constant. */
#define ROW_IN_TIME(NAME, UNIT, DEFAULT, DOC)                                                      \
    IMP_ROW_NUMBERS(NAME, UNIT, DEFAULT, IMP_PARAMETER_SCALAR_OK,                                  \
                    DOC "; or coefficients of t^0, t^1, t^2 ...")

/* Prints "name = ...; ", component i as a formula in t. */
static inline void polynomial_define(const polynomial *p, size_t i, const char *name,
                                     const imp_text_sink *to)
{
    imp_add_text(to, name);
    for (size_t k = 0; k < p->count; ++k) {
        imp_add_text(to, k == 0 ? " = " : " + ");
        imp_add_number(to, p->coefficient[i * p->count + k]);
        if (k > 0) imp_add_text(to, "*t");
        if (k > 1) imp_add_text(to, "^");
        if (k > 1) imp_add_whole(to, k);
    }
    imp_add_text(to, "; ");
}

/* Computes component i at time t. */
static inline imp_model polynomial_at(const polynomial *p, size_t i, imp_model t)
{
    return imp_poly(p->coefficient + i * p->count, p->count, t);
}

#endif
