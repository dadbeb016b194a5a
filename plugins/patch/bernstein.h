/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_BERNSTEIN_H
#define PLUGINS_PATCH_BERNSTEIN_H

/* Polynomials by their control points
 * ===================================
 * The blossom of a polynomial F of degree n is the symmetric function b(w_1 ... w_n), affine in
 * each argument, with b(u ... u) = F(u). Its value is an average of F's control points:
 *
 *   b(w_1 ... w_n) = sum_j weight_j P_j,   sum_j weight_j x^j = prod_k ((1 - w_k) + w_k x)
 *
 * With arguments in [0, 1] the weights are >= 0 and add up to 1. F over [lo, hi] has the
 * control points b(lo x (n - i), hi x i), i = 0 ... n, and lies in their hull.
 *
 * Lemma (weights). Computed weights differ from exact ones by a factor (1 + 2^-53)^(+-3n), at most:
 * one argument costs each weight the rounding of 1 - w, of a product and of a sum, and
 * all terms are >= 0, so nothing cancels. (Underflow apart; users add DBL_MIN to their bounds.)
 *
 * Lemma (averages). A sum of n + 1 products weight_j P_j, added in any order, is off by
 * at most (4n + 1) 2^-53 max|P| (1 + 2^-40): 3n as above, one rounding of the product, at most n of
 * the sums. Averages of averages add up: (4n + 4m + 2) for a patch of degrees n, m. */

/* n over k, exactly as long as n times it is below 2^53. */
static inline double bernstein_choose(int n, int k)
{
    double ways = 1;
    for (int i = 0; i < k; ++i) ways = ways * (n - i) / (i + 1);
    return ways;
}

/* One more argument w: n + 1 weights become n + 2. */
static inline void bernstein_extend(double *weight, int n, double w)
{
    weight[n + 1] = weight[n] * w;
    for (int i = n; i > 0; --i) weight[i] = weight[i] * (1 - w) + weight[i - 1] * w;
    weight[0] *= 1 - w;
}

/* Weights of b(lo x n_lo, hi x n_hi). */
static inline void bernstein_weights(double *weight, int n_lo, double lo, int n_hi, double hi)
{
    weight[0] = 1;
    for (int n = 0; n < n_lo + n_hi; ++n) bernstein_extend(weight, n, n < n_lo ? lo : hi);
}

#endif
