/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_EXPRESSION_H
#define PLUGINS_EXPRESSION_EXPRESSION_H

#include <impinge/model.h>

#include <stdbool.h>

/* Formulas as text
 * ================
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } power
 *   power    = operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * So -2^2 is -4, 2^3^2 is 2^9, 2^-1 is 1/2. Numbers are 1, .5, 5., 1e-3, and stand for the nearest
 * double, as in scene files. Names are the variables, named constants, pi and e; the functions are
 * listed in expression_names.c. Discontinuous functions (floor, sign, mod, <, ...) are rejected.
 *
 * Three texts, for x, y and z, are compiled into one list of operations (expression_operation.h),
 * in which common subexpressions are computed once. The list is run on models, which gives rates
 * and inclusions, or on points, which gives values and errors. Running allocates nothing, and any
 * number of threads may run one program at once. */

/* Limits. A text beyond them is rejected with the place of the error. The number of operations
 * includes those on constants, which are computed at compile time. A run keeps all values that are
 * still needed on the stack, EXPRESSION_SLOTS_MAX models at most: 68 kB. */
#define EXPRESSION_OPERATIONS_MAX 16384
#define EXPRESSION_SLOTS_MAX 512
/* Names are compared one by one: 2^12 constants in 2^14 operations are 2^26 comparisons. */
#define EXPRESSION_CONSTANTS_MAX 4096
#define EXPRESSION_DEPTH_MAX 200 /* nesting of parentheses, functions and exponents */
#define EXPRESSION_VARIABLES_MAX 4

/* The meaning of names that are not built in. */
typedef struct expression_scope {
    const char *const *variable;
    const imp_model *whole; /* what each variable may be */
    size_t variable_count;  /* at least 1 */
    const char *const *constant;
    const double *constant_value;
    size_t constant_count;
} expression_scope;

/* What is wrong, and where: in text 0, 1 or 2, at the line and column (from 1, in characters) that
 * the message begins with; in a constant's name; or in all three texts together. */
enum { EXPRESSION_AT_CONSTANTS = 3, EXPRESSION_AT_ALL = 4 };
typedef struct expression_error {
    int at;
    char message[240];
} expression_error;

typedef struct expression_program expression_program;

/* IMP_STATUS_OK, and then *program is the caller's to free; IMP_STATUS_PARAMETER, and then *error
 * is set; or IMP_STATUS_INTERNAL: no memory. On failure *program is NULL or as it was. */
imp_status expression_compile(const expression_scope *scope, const char *const text[3],
                              expression_program **program, expression_error *error);
void expression_free(expression_program *program);

/* Like expression_compile. *form becomes what the texts are besides (text_form.h), and *section a
 * program for the caller to free: of R, three times, if they are a coil, of R, Z and phi, if they
 * are a surface of revolution, else NULL. */
struct text_form;
imp_status expression_compile_form(const expression_scope *scope, const char *const text[3],
                                   expression_program **program, struct text_form *form,
                                   expression_program **section, expression_error *error);

/* Operations that a run computes. */
size_t expression_length(const expression_program *program);

/* x, y, z over a region, from one model per variable. Undefined in all of it: unbounded. */
void expression_models(const expression_program *program, const imp_model *variables,
                       imp_model out[3]);

/* x, y, z and their absolute errors at one point. IMP_STATUS_DOMAIN where they are undefined, or
 * infinite. error may be NULL. */
imp_status expression_point(const expression_program *program, const double *variables, double x[3],
                            double *error);

/* Evaluates n points, each of as many variables as the program has, up to the first that fails.
 * `error` may be NULL. */
imp_status expression_points(const expression_program *program, size_t n, const double *variables,
                             double *x, double *error);

#endif
