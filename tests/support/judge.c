/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/judge.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

__attribute__((format(printf, 2, 3))) static bool refute(fault *why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why->text, sizeof why->text, format, arguments);
    va_end(arguments);
    return false;
}

bool judge_point(const double x[3], const double error[3], const number exact[3], fault *why)
{
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(x[i]) || !(error[i] >= 0 && error[i] < INFINITY))
            return refute(why, "coordinate %d is %g +- %g", i, x[i], error[i]);
        number off = num_abs(num_sub(num(x[i]), exact[i]));
        if (num_is_less(num(error[i]), off))
            return refute(why, "coordinate %d is %a, exact %a, off by %g, error said to be %g", i,
                          x[i], num_near(exact[i]), num_near(off), error[i]);
    }
    return true;
}

static bool judge_form(const imp_model *g, int i, fault *why)
{
    double sum = g->a;
    for (int j = 0; j < 3; ++j) sum += g->b[j];
    for (int k = 0; k < 6; ++k) sum += g->q[k];
    if (!isfinite(sum)) return refute(why, "coordinate %d: infinite or NaN coefficients", i);
    if (!(g->e >= 0)) return refute(why, "coordinate %d: e = %g", i, g->e);
    if (!(g->lo <= g->hi)) return refute(why, "coordinate %d: [%g, %g]", i, g->lo, g->hi);
    for (int j = 0; j < 3; ++j)
        if (!(g->rate[j] >= 0)) return refute(why, "coordinate %d: rate %g", i, g->rate[j]);
    for (int j = 0; j < 3; ++j)
        if (!(g->depends >> j & 1) && (g->b[j] != 0 || g->rate[j] != 0))
            return refute(why, "coordinate %d depends on parameter %d and says no", i, j);
    return true;
}

static number quadratic(const imp_model *g, const number s[3])
{
    number x = num(g->a);
    for (int j = 0; j < 3; ++j) x = num_add(x, num_mul(num(g->b[j]), s[j]));
    for (int j = 0, k = 0; j < 3; ++j)
        for (int l = j; l < 3; ++l, ++k) x = num_add(x, num_mul(num(g->q[k]), num_mul(s[j], s[l])));
    return x;
}

static bool judge_model(const imp_model *g, int i, const number s[3], number exact, fault *why)
{
    if (!judge_form(g, i, why)) return false;
    number off = num_abs(num_sub(quadratic(g, s), exact));
    if (g->e < INFINITY && num_is_less(num(g->e), off))
        return refute(why, "coordinate %d is %g off the quadratic, e = %g", i, num_near(off), g->e);
    if ((g->lo > -INFINITY && num_is_less(exact, num(g->lo))) ||
        (g->hi < INFINITY && num_is_less(num(g->hi), exact)))
        return refute(why, "coordinate %d is %a, out of [%a, %a]", i, num_near(exact), g->lo,
                      g->hi);
    return true;
}

bool judge_models(const imp_model model[3], const number s[3], const number exact[3], fault *why)
{
    for (int i = 0; i < 3; ++i)
        if (!judge_model(&model[i], i, s, exact[i], why)) return false;
    return true;
}

bool judge_rates(int n, const double *rate, const double *p, const double *q, number at_p,
                 number at_q, fault *why)
{
    number way = num_abs(num_sub(at_p, at_q)), bound = num(0);
    for (int j = 0; j < n; ++j) {
        if (!(rate[j] >= 0)) return refute(why, "rate %d is %g", j, rate[j]);
        if (p[j] == q[j]) continue;
        if (!(rate[j] < INFINITY)) return true;
        number step = num_abs(num_sub(num(p[j]), num(q[j])));
        bound = num_add(bound, num_mul(num(rate[j]), step));
    }
    if (num_is_less(bound, way))
        return refute(why, "changes by %g where rates allow %g", num_near(way), num_near(bound));
    return true;
}
