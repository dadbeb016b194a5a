/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch_series.h"

#include <string.h>

#include <impinge/interval.h>

/* Lemma (noise). In units of ROUNDING, as functions on the region, the computed
 * sum_kl C_kl T_k T_l and F differ by at most
 *   units most                             the net (2 for patch_set_net)
 *   (n + m + 4) beta_u beta_v most         R: two sums of n + 1 and m + 1 products with beta (1 + 1
 *                                          for beta itself); beta_u, beta_v: sums of all |beta|
 *   sum_ij |R_ij| (error_i + error_j)      w as a function (chebyshev_shift_error)
 *   sum_ij |R_ij| (n + m + 2) reach_i reach_j   the two sums that make C
 * because |T_k| <= 1 and sum_k |w_ik| <= reach_i. The derivative with respect to s of a polynomial
 * of degree n is at most n^2 times its bound (Markov), so noise costs a rate n^2 noise. */

/* --- Once: the series ------------------------------------------------------------------------- */

void patch_multiply(int size, const double *matrix, const double *in, double *out, int width)
{
    for (int k = 0; k < size; ++k) {
        double *row = out + k * width;
        for (int x = 0; x < width; ++x) row[x] = 0;
        for (int j = 0; j < size; ++j) {
            const double entry = matrix[k * size + j];
            for (int x = 0; x < width; ++x) row[x] += entry * in[j * width + x];
        }
    }
}

static double patch_sum_abs(const double *x, int count)
{
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += fabs(x[i]);
    return sum;
}

void patch_set_series(patch *f, double *work)
{
    const int n = f->degree[0], m = f->degree[1], lanes = f->lanes, row = (m + 1) * lanes;
    double beta_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], beta_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    double shift[PATCH_SIDE_MAX], reach[PATCH_SIDE_MAX];
    memset(beta_u, 0, (size_t)((n + 1) * (n + 1)) * sizeof *beta_u);
    memset(beta_v, 0, (size_t)((m + 1) * (m + 1)) * sizeof *beta_v);
    for (int k = 0; k <= n || k <= m; ++k) {
        shift[k] = chebyshev_shift_error(k);
        reach[k] = chebyshev_reach(k);
    }
    chebyshev_of_bernstein(n, beta_u);
    chebyshev_of_bernstein(m, beta_v);
    patch_multiply(n + 1, beta_u, f->net, work, row);
    for (int i = 0; i <= n; ++i)
        patch_multiply(m + 1, beta_v, work + i * row, f->series + i * row, lanes);
    double beta =
        patch_sum_abs(beta_u, (n + 1) * (n + 1)) * patch_sum_abs(beta_v, (m + 1) * (m + 1));
    for (int lane = 0; lane < lanes; ++lane) {
        double units = (f->units + (n + m + 4) * beta) * f->most[lane];
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= m; ++j)
                units += fabs(f->series[i * row + j * lanes + lane]) *
                         (shift[i] + shift[j] + (n + m + 2) * reach[i] * reach[j]);
        f->noise[lane] = units * ROUNDING * SLACK + IMP_TINY;
    }
}

/* --- Per region: C ---------------------------------------------------------------------------- */
