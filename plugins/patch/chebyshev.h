/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_CHEBYSHEV_H
#define PLUGINS_PATCH_CHEBYSHEV_H

#include <math.h>
#include <string.h>

/* Polynomials as sums of Chebyshev polynomials
 * ============================================
 * F(x) = sum_k c_k T_k(x) on [-1, 1]. Because |T_k| <= 1, what a truncated sum leaves out is at
 * most the sum of the |c_k| left out; and no polynomial of the lower degree is closer than a small
 * factor. On sub-patches of random bicubic patches this remainder is within 1.2 times the best,
 * where half the spread of the control points left is 1.7 times it (and costs more).
 *
 * A polynomial bounded by 1 on [-1, 1] has sum_k |c_k| <= sqrt(2n + 1): the mean of its square with
 * weight (1 - x^2)^(-1/2) is c_0^2 + (c_1^2 + ... + c_n^2)/2 <= 1, and Cauchy-Schwarz. */

/* The Bernstein polynomials of degree n in x = 2u - 1: B_j = sum_k beta[k * (n+1) + j] T_k(x).
 *
 * Lemma. Every coefficient has a relative error of at most 2^-53, for n <= 20. With x = (z +
 * 1/z)/2, B_j = choose(n, j) 4^-n (-1)^(n-j) z^-n (1 + z)^2j (1 - z)^(2n-2j), and T_k = (z^k +
 * z^-k)/2. The polynomial in z has whole coefficients of at most 4^n in sum, so they come out
 * exactly; choose(n, j) <= 184756 is exact too, and only their product is rounded. */
static inline void chebyshev_of_bernstein(int n, double *beta)
{
    double choose = 1; /* n over j */
    for (int j = 0; j <= n; ++j) {
        double z[64] = {1};
        for (int factor = 0; factor < 2 * n; ++factor) {
            double sign = factor < 2 * j ? 1 : -1;
            for (int k = factor + 1; k > 0; --k) z[k] += sign * z[k - 1];
        }
        double scale = ldexp((n - j) % 2 ? -choose : choose, -2 * n);
        for (int k = 0; k <= n; ++k) beta[k * (n + 1) + j] = z[n + k] * (k ? 2 * scale : scale);
        choose = choose * (n - j) / (j + 1);
    }
}

/* T_j(c + d s) = sum_k w[j * stride + k] T_k(s), for j = 0 ... n and |c| + d <= 1.
 * From T_(j+1)(x) = 2 x T_j(x) - T_(j-1)(x) and s T_k(s) = (T_(k+1)(s) + T_|k-1|(s))/2. Beyond
 * k = j, w is left as it is. */
static inline void chebyshev_shift(int n, double c, double d, double *w, int stride)
{
    w[0] = 1;
    w[stride] = c, w[stride + 1] = d;
    for (int j = 1; j < n; ++j) {
        const double *last = w + (j - 1) * stride, *row = w + j * stride;
        double *next = w + (j + 1) * stride;
        next[0] = 2 * c * row[0] + d * row[1] - last[0];
        for (int k = 1; k < j; ++k)
            next[k] = 2 * c * row[k] + d * ((k == 1 ? 2 : 1) * row[k - 1] + row[k + 1]) - last[k];
        next[j] = 2 * c * row[j] + d * ((j == 1 ? 2 : 1) * row[j - 1]);
        next[j + 1] = d * row[j];
    }
}

/* sum_k |w_jk| of a row of chebyshev_shift, at most. */
static inline double chebyshev_reach(int j) { return sqrt(2 * j + 1); }

/* Error of row j as a function on [-1, 1], in units of 2^-53, when c itself is off by at
 * most 2^-54.
 *
 * Lemma. |T_j'| <= j^2 moves the function by j^2/2 units. The step to row r + 1 rounds the first
 * product, the sum, the second product, and two sums: at most 3|2c w_k| + 4|d (w_(k-1) +
 * w_(k+1))| + |last_k|, in all coefficients together (8 reach(r) + reach(r - 1)) for |c| + d <= 1.
 * An error made there enters row j through the same recurrence, as its product with the
 * Chebyshev polynomial U_(j-r-1) of the second kind, and |U_k| <= k + 1. */
static inline double chebyshev_shift_error(int j)
{
    double error = j * j / 2.0;
    for (int r = 1; r < j; ++r)
        error += (j - r) * (8 * chebyshev_reach(r) + chebyshev_reach(r - 1));
    return error;
}

#endif
