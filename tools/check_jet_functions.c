/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_jet.h"

/* Functions of one number, each with its first two derivatives: pure calculus. Where a derivative
 * is infinite or there is a kink, spans say so by themselves. */

static span one_less(span x) { return span_sub(span_of(1), x); } /* 1 - x */

void jet_sqr_(span x, span g[3]) { g[0] = span_sqr(x), g[1] = span_scale(x, 2), g[2] = span_of(2); }

void jet_abs_(span x, span g[3])
{
    const bool kink = x.lo < 0 && x.hi > 0;
    g[0] = span_abs(x);
    g[1] = kink ? span_make(-1, 1) : span_of(x.hi > 0 ? 1 : -1);
    g[2] = kink || span_is(x, 0) ? span_whole() : span_of(0);
    if (span_is(x, 0)) g[1] = span_make(-1, 1);
}

/* 1 / (2 r), -1 / (4 r^3) for the root r. */
void jet_sqrt_(span x, span g[3])
{
    g[0] = span_sqrt(x);
    g[1] = span_inverse(span_scale(g[0], 2));
    g[2] = span_neg(span_inverse(span_scale(span_whole_power(g[0], 3), 4)));
}

/* 1 / (3 r^2), -2 / (9 r^5) for the root r. */
void jet_cbrt_(span x, span g[3])
{
    g[0] = span_cbrt(x);
    g[1] = span_inverse(span_scale(span_sqr(g[0]), 3));
    g[2] = span_scale(span_inverse(span_scale(span_whole_power(g[0], 5), 9)), -2);
}

void jet_exp_(span x, span g[3]) { g[0] = g[1] = g[2] = span_exp(x); }

void jet_log_(span x, span g[3])
{
    g[0] = span_log(x);
    g[1] = x.hi > 0 ? span_inverse(span_make(x.lo > 0 ? x.lo : 0, x.hi)) : span_whole();
    g[2] = span_neg(span_sqr(g[1]));
}

void jet_sin_(span x, span g[3]) { g[0] = span_sin(x), g[1] = span_cos(x), g[2] = span_neg(g[0]); }

void jet_cos_(span x, span g[3])
{
    g[0] = span_cos(x), g[1] = span_neg(span_sin(x)), g[2] = span_neg(g[0]);
}

/* 1 + y^2, 2 y (1 + y^2) */
void jet_tan_(span x, span g[3])
{
    g[0] = span_tan(x);
    g[1] = span_add(span_of(1), span_sqr(g[0]));
    g[2] = span_scale(span_mul(g[0], g[1]), 2);
}

/* 1 / sqrt(1 - x^2), x / sqrt(1 - x^2)^3 */
void jet_asin_(span x, span g[3])
{
    const span steep = span_inverse(span_sqrt(one_less(span_sqr(x))));
    g[0] = span_asin(x), g[1] = steep, g[2] = span_mul(x, span_whole_power(steep, 3));
}

void jet_acos_(span x, span g[3])
{
    jet_asin_(x, g);
    g[0] = span_acos(x), g[1] = span_neg(g[1]), g[2] = span_neg(g[2]);
}

/* 1 / (1 + x^2), -2 x / (1 + x^2)^2 */
void jet_atan_(span x, span g[3])
{
    g[0] = span_atan(x);
    g[1] = span_inverse(span_add(span_of(1), span_sqr(x)));
    g[2] = span_scale(span_mul(x, span_sqr(g[1])), -2);
}

void jet_sinh_(span x, span g[3]) { g[0] = g[2] = span_sinh(x), g[1] = span_cosh(x); }

void jet_cosh_(span x, span g[3]) { g[0] = g[2] = span_cosh(x), g[1] = span_sinh(x); }

/* 1 - y^2, -2 y (1 - y^2) */
void jet_tanh_(span x, span g[3])
{
    g[0] = span_tanh(x);
    g[1] = one_less(span_sqr(g[0]));
    g[2] = span_scale(span_mul(g[0], g[1]), -2);
}
