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

/* --- Nets ------------------------------------------------------------------------------------- */

/* Bernstein polynomials of degree n at s, k = 0 ... n. */
static void bernstein(uint32_t n, number s, number b[IMP_NET_POINTS])
{
    const number rest = num_sub(num(1), s);
    b[0] = num(1);
    for (uint32_t k = 1; k <= n; ++k) {
        b[k] = num_mul(b[k - 1], s);
        for (uint32_t i = k - 1; i > 0; --i)
            b[i] = num_add(num_mul(b[i - 1], s), num_mul(b[i], rest));
        b[0] = num_mul(b[0], rest);
    }
}

void net_value(const imp_net *net, const imp_region *region, const double p[3], number x[3])
{
    const uint32_t m = net->degree[1], count = (net->degree[0] + 1) * (m + 1);
    const number tau = num_sub(num(p[2]), num(region->c[2]));
    number b[2][IMP_NET_POINTS], share[IMP_NET_POINTS], all = num(0);
    for (int j = 0; j < 2; ++j) {
        const number lo = num(region->lo[j]), side = num_sub(num(region->hi[j]), lo);
        const bool some = region->hi[j] > region->lo[j];
        bernstein(net->degree[j], some ? num_div(num_sub(num(p[j]), lo), side) : num(0), b[j]);
    }
    for (uint32_t k = 0; k < count; ++k) {
        share[k] = num_mul(b[0][k / (m + 1)], b[1][k % (m + 1)]);
        if (net->is_weighted) share[k] = num_mul(share[k], num(net->weight[k]));
        all = num_add(all, share[k]);
    }
    for (int i = 0; i < 3; ++i) {
        number sum = num(0);
        for (uint32_t k = 0; k < count; ++k) {
            number at = num(net->point[i][k]);
            if (net->is_moving) at = num_add(at, num_mul(tau, num(net->velocity[i][k])));
            sum = num_add(sum, num_mul(share[k], at));
        }
        const number base = num_add(num(net->place[i]), num_mul(tau, num(net->drift[i])));
        x[i] = num_add(base, num_div(sum, all));
    }
}

bool judge_net(const imp_net *net, const imp_region *region, const double p[3],
               const number exact[3], fault *why)
{
    number x[3];
    net_value(net, region, p, x);
    for (int i = 0; i < 3; ++i)
        if (num_is_less(num(net->error[i]), num_abs(num_sub(x[i], exact[i]))))
            return refute(why, "coordinate %d is %a, off the net's patch at %a by more than %a", i,
                          num_near(exact[i]), num_near(x[i]), net->error[i]);
    return true;
}
