/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_FORMULA_SURFACE_H
#define TESTS_SUPPORT_FORMULA_SURFACE_H

#include <math.h>
#include <string.h>

#include "plugins/expression/text_form.h"
#include "tests/support/suite.h"

/* Surfaces of three texts in u, v and t, the form that is read from these, and their points. */

typedef struct formula_text {
    char text[3][256];
    double lo[2], hi[2];
} formula_text;

typedef struct formula_surface {
    expression_program *program, *section; /* section: NULL if the form is TEXT_PLAIN */
    text_form form;
    double lo[2], hi[2];
} formula_surface;

static inline formula_surface formula_surface_of(const formula_text *of)
{
    static const char *const names[] = {"u", "v", "t"};
    const char *const text[3] = {of->text[0], of->text[1], of->text[2]};
    imp_model whole[3];
    for (int j = 0; j < 3; ++j) {
        whole[j] = imp_unbounded(1u << j);
        if (j < 2) whole[j].lo = of->lo[j], whole[j].hi = of->hi[j];
    }
    const expression_scope scope = {.variable = names, .whole = whole, .variable_count = 3};
    formula_surface k;
    expression_error error;
    const imp_status status =
        expression_compile_form(&scope, text, &k.program, &k.form, &k.section, &error);
    ck_assert_msg(status == IMP_STATUS_OK, "%s | %s | %s: %s", text[0], text[1], text[2],
                  error.message);
    memcpy(k.lo, of->lo, sizeof k.lo);
    memcpy(k.hi, of->hi, sizeof k.hi);
    return k;
}

static inline void formula_surface_free(formula_surface *k)
{
    expression_free(k->program);
    expression_free(k->section);
}

/* The distance of x from the point at p. */
static inline double formula_apart(const formula_surface *k, const double p[3], const double x[3])
{
    double y[3], sum = 0;
    ck_assert_int_eq(expression_point(k->program, p, y, NULL), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) sum += (x[i] - y[i]) * (x[i] - y[i]);
    return sqrt(sum);
}

enum { FORMULA_GRID = 32 };

/* The least distance found of x from the surface: by a grid, then by steps along u and v, halved
 * where none comes nearer, down to the finest, as a part of the domain. */
static inline double formula_nearest(const formula_surface *k, const double x[3], double finest)
{
    double best[3] = {0, 0, 0}, least = INFINITY;
    for (int i = 0; i <= FORMULA_GRID; ++i)
        for (int j = 0; j <= FORMULA_GRID; ++j) {
            const double p[3] = {k->lo[0] + (k->hi[0] - k->lo[0]) * i / FORMULA_GRID,
                                 k->lo[1] + (k->hi[1] - k->lo[1]) * j / FORMULA_GRID, 0};
            const double now = formula_apart(k, p, x);
            if (now < least) least = now, memcpy(best, p, sizeof best);
        }
    for (double step = 1.0 / FORMULA_GRID; step > finest;) {
        const double before = least;
        for (int way = 0; way < 4; ++way) {
            double p[3] = {best[0], best[1], 0};
            const int j = way / 2;
            p[j] += (way % 2 ? -step : step) * (k->hi[j] - k->lo[j]);
            p[j] = p[j] < k->lo[j] ? k->lo[j] : p[j] > k->hi[j] ? k->hi[j] : p[j];
            const double now = formula_apart(k, p, x);
            if (now < least) least = now, memcpy(best, p, sizeof best);
        }
        if (!(least < before)) step *= 0.5;
    }
    return least;
}

#endif
