/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/jet.h"

/* Functions of one number, each with its first two derivatives: pure calculus. An infinite
 * derivative or a kink gives an unbounded interval. */

static ld_interval one_less(ld_interval x)
{
    return ld_interval_sub(ld_interval_of(1), x);
} /* 1 - x */

bool jet_sqr_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_sqr(x), g[1] = ld_interval_scale(x, 2), g[2] = ld_interval_of(2);
    return true;
}

bool jet_abs_(ld_interval x, ld_interval g[3])
{
    const bool kink = x.lo < 0 && x.hi > 0;
    g[0] = ld_interval_abs(x);
    g[1] = kink ? ld_interval_make(-1, 1) : ld_interval_of(x.hi > 0 ? 1 : -1);
    g[2] = kink || ld_interval_is(x, 0) ? ld_interval_entire() : ld_interval_of(0);
    if (ld_interval_is(x, 0)) g[1] = ld_interval_make(-1, 1);
    return true;
}

/* 1 / (2 r), -1 / (4 r^3) for the root r. */
bool jet_sqrt_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_sqrt(x);
    g[1] = ld_interval_inverse(ld_interval_scale(g[0], 2));
    g[2] = ld_interval_neg(
        ld_interval_inverse(ld_interval_scale(ld_interval_integer_power(g[0], 3), 4)));
    return jet_is_from(x, 0);
}

/* 1 / (3 r^2), -2 / (9 r^5) for the root r. */
bool jet_cbrt_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_cbrt(x);
    g[1] = ld_interval_inverse(ld_interval_scale(ld_interval_sqr(g[0]), 3));
    g[2] = ld_interval_scale(
        ld_interval_inverse(ld_interval_scale(ld_interval_integer_power(g[0], 5), 9)), -2);
    return true;
}

bool jet_exp_(ld_interval x, ld_interval g[3])
{
    g[0] = g[1] = g[2] = ld_interval_exp(x);
    return true;
}

bool jet_log_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_log(x);
    g[1] = x.hi > 0 ? ld_interval_inverse(ld_interval_make(x.lo > 0 ? x.lo : 0, x.hi))
                    : ld_interval_entire();
    g[2] = ld_interval_neg(ld_interval_sqr(g[1]));
    return x.lo > 0;
}

bool jet_sin_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_sin(x), g[1] = ld_interval_cos(x), g[2] = ld_interval_neg(g[0]);
    return true;
}

bool jet_cos_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_cos(x), g[1] = ld_interval_neg(ld_interval_sin(x)),
    g[2] = ld_interval_neg(g[0]);
    return true;
}

/* 1 + y^2, 2 y (1 + y^2) */
bool jet_tan_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_tan(x);
    g[1] = ld_interval_add(ld_interval_of(1), ld_interval_sqr(g[0]));
    g[2] = ld_interval_scale(ld_interval_mul(g[0], g[1]), 2);
    return ld_interval_excludes_0(ld_interval_cos(x));
}

/* 1 / sqrt(1 - x^2), x / sqrt(1 - x^2)^3 */
bool jet_asin_(ld_interval x, ld_interval g[3])
{
    const ld_interval steep = ld_interval_inverse(ld_interval_sqrt(one_less(ld_interval_sqr(x))));
    g[0] = ld_interval_asin(x), g[1] = steep,
    g[2] = ld_interval_mul(x, ld_interval_integer_power(steep, 3));
    return jet_is_from(x, -1) && jet_is_from(ld_interval_neg(x), -1);
}

bool jet_acos_(ld_interval x, ld_interval g[3])
{
    const bool has_value = jet_asin_(x, g);
    g[0] = ld_interval_acos(x), g[1] = ld_interval_neg(g[1]), g[2] = ld_interval_neg(g[2]);
    return has_value;
}

/* 1 / (1 + x^2), -2 x / (1 + x^2)^2 */
bool jet_atan_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_atan(x);
    g[1] = ld_interval_inverse(ld_interval_add(ld_interval_of(1), ld_interval_sqr(x)));
    g[2] = ld_interval_scale(ld_interval_mul(x, ld_interval_sqr(g[1])), -2);
    return true;
}

bool jet_sinh_(ld_interval x, ld_interval g[3])
{
    g[0] = g[2] = ld_interval_sinh(x), g[1] = ld_interval_cosh(x);
    return true;
}

bool jet_cosh_(ld_interval x, ld_interval g[3])
{
    g[0] = g[2] = ld_interval_cosh(x), g[1] = ld_interval_sinh(x);
    return true;
}

/* 1 - y^2, -2 y (1 - y^2) */
bool jet_tanh_(ld_interval x, ld_interval g[3])
{
    g[0] = ld_interval_tanh(x);
    g[1] = one_less(ld_interval_sqr(g[0]));
    g[2] = ld_interval_scale(ld_interval_mul(g[0], g[1]), -2);
    return true;
}
