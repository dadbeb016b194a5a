/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/sinc.h"

/* At least the errors of f below, 16 units of 2^-53, and of its derivatives, 2^8 units. */
#define SINC_ERROR 0x1p-49
#define SINC_SLOPE_ERROR 0x1p-45

/* f and three derivatives, |x| >= 1; c: x f and its derivatives.
 *
 * Rounding, in units of 2^-53: sin and cos are within 8 (4 ulp, of numbers up to 1), f has two
 * roundings more, of a difference of at most 2 and of a quotient of at most 1; and every step adds
 * to k times the error of the one before the roundings of a product, a difference and a quotient: f
 * 8 + 3, f' 8 + 11 + 3, f'' 8 + 44 + 5, f''' 8 + 171 + 5. */
static void sinc_far(double x, const double c[4], double f[4])
{
    f[0] = c[0] / x;
    for (int k = 1; k < 4; ++k) f[k] = (c[k] - k * f[k - 1]) / x;
}

/* f and three derivatives for |x| <= 1, from f = sum_n c_n x^n, |c_n| = 1 / (n+1)!, of alternating
 * signs: sinc has the even n, cosc the odd ones.
 *
 * What follows n = 19 is below 2 / 21!, and at most 21^3 times that in the derivatives, below
 * 2^-50. Rounding: Horner's rule has the sum from n on, at most 2 / (n+1)!, and rounds twice and
 * the coefficient before: in units of 2^-53, less than 5 (1 + 1/2 + 1/6 + ...), 9 in all. In the
 * derivatives a step adds to at most 1 what is at most 1 and rounds five times: below 2^8. */
static void sinc_near(double x, int odd, double f[4])
{
    static const double size[20] = {1.,
                                    1. / 2,
                                    1. / 6,
                                    1. / 24,
                                    1. / 120,
                                    1. / 720,
                                    1. / 5040,
                                    1. / 40320,
                                    1. / 362880,
                                    1. / 3628800,
                                    1. / 39916800,
                                    1. / 479001600,
                                    1. / 6227020800,
                                    1. / 87178291200,
                                    1. / 1307674368000,
                                    1. / 20922789888000,
                                    1. / 355687428096000,
                                    1. / 6402373705728000,
                                    1. / 121645100408832000,
                                    1. / 2432902008176640000};
    f[0] = f[1] = f[2] = f[3] = 0;
    for (int n = 19; n >= 0; --n) {
        const double c = n % 2 != odd ? 0 : n / 2 % 2 ? -size[n] : size[n];
        f[0] = f[0] * x + c;
        if (n >= 1) f[1] = f[1] * x + c * n;
        if (n >= 2) f[2] = f[2] * x + c * (n * (n - 1));
        if (n >= 3) f[3] = f[3] * x + c * (n * (n - 1) * (n - 2));
    }
}

/* The model of f, from f and its derivatives at s->m. |f'| is at most 1/2, and 1/3 is the most it
 * changes per unit of x. */
static imp_model sinc_compose(imp_model x, imp_series s, const double f[4], double least)
{
    const double r = s.r;
    s.c[0] = f[0], s.c[1] = f[1], s.c[2] = f[2] / 2, s.c[3] = f[3] / 6;
    s.e =
        (r * r * r * r / 120 + SINC_ERROR + SINC_SLOPE_ERROR * (r + r * r + r * r * r)) * IMP_SLACK;
    const double slope = imp_smaller((fabs(f[1]) + r / 3 + SINC_SLOPE_ERROR) * IMP_SLACK, 0.5);
    return imp_compose(&x, &s, imp_interval_make(least, 1), slope);
}

imp_model sinc_of(imp_model x)
{
    const double least = -0.2173; /* -0.217233... at about 4.49 */
    double f[4];
    const imp_series s = imp_series_around(imp_model_range(&x));
    const double sine = sin(s.m), cosine = cos(s.m);
    if (fabs(s.m) >= 1)
        sinc_far(s.m, (const double[4]){sine, cosine, -sine, -cosine}, f);
    else
        sinc_near(s.m, 0, f);
    return sinc_compose(x, s, f, least);
}

imp_model sinc_cosc(imp_model x)
{
    const double least = -0.7247; /* odd, and 0.724611... at about 2.33 */
    double f[4];
    const imp_series s = imp_series_around(imp_model_range(&x));
    const double sine = sin(s.m), cosine = cos(s.m);
    if (fabs(s.m) >= 1)
        sinc_far(s.m, (const double[4]){1 - cosine, sine, cosine, -sine}, f);
    else
        sinc_near(s.m, 1, f);
    return sinc_compose(x, s, f, least);
}
