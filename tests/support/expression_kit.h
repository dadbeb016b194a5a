/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_EXPRESSION_KIT_H
#define TESTS_SUPPORT_EXPRESSION_KIT_H

#include <string.h>

#include "plugins/expression/expression.h"
#include "tests/support/suite.h"

/* Formulas compiled for tests, with a = 3 and radius = 0.1. */

/* u in [-1, 1], v in [0, 2], t at all times. */
static inline imp_status compile_with(const char *const text[3], size_t count,
                                      const char *const *name, const double *value,
                                      expression_program **program, expression_error *error)
{
    static const char *const variable[] = {"u", "v", "t"};
    imp_model whole[] = {imp_between(-1, 1), imp_between(0, 2), imp_unbounded(4)};
    const expression_scope scope = {variable, whole, 3, name, value, count};
    return expression_compile(&scope, text, program, error);
}

static inline expression_program *compiled_three(const char *x, const char *y, const char *z)
{
    static const char *const name[] = {"a", "radius"};
    static const double value[] = {3, 0.1};
    const char *const text[] = {x, y, z};
    expression_program *program;
    expression_error error;
    imp_status status = compile_with(text, 2, name, value, &program, &error);
    ck_assert_msg(status == IMP_STATUS_OK, "%.200s: %s", x,
                  status == IMP_STATUS_PARAMETER ? error.message : "no memory");
    return program;
}

static inline expression_program *compiled(const char *text)
{
    return compiled_three(text, "0", "0");
}

static inline imp_status value_at(const char *text, double u, double v, double t, double *x,
                                  double *error)
{
    const double p[] = {u, v, t};
    double xs[3], errors[3];
    expression_program *program = compiled(text);
    imp_status status = expression_point(program, p, xs, errors);
    expression_free(program);
    *x = xs[0];
    *error = errors[0];
    return status;
}

static inline size_t length_of(const char *text)
{
    expression_program *program = compiled_three(text, text, text);
    size_t length = expression_length(program);
    expression_free(program);
    return length;
}

/* What is said of a wrong text; "" if it was taken. */
static inline const char *complaint(const char *text)
{
    static expression_error error;
    const char *const texts[] = {"u", text, "v"};
    expression_program *program;
    error = (expression_error){.message = ""};
    imp_status status = compile_with(texts, 0, NULL, NULL, &program, &error);
    if (status == IMP_STATUS_OK) {
        expression_free(program);
        return "";
    }
    ck_assert_int_eq(status, IMP_STATUS_PARAMETER);
    ck_assert_int_eq(error.at, 1);
    return error.message;
}

/* Somewhere inside. */
#define U 0.375
#define V 1.25
#define T -2.5

#endif
