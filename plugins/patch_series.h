/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_SERIES_H
#define PLUGINS_PATCH_SERIES_H

#include "patch.h"

/* A patch as a Chebyshev series
 * =============================
 * With x = 2u - 1 and y = 2v - 1, a polynomial is F = sum_ij R_ij T_i(x) T_j(y); R is `series`,
 * made once. A region has x = c + d s, and T_i(c + d s) = sum_k w_ik T_k(s) (chebyshev.h), so over
 * it
 *
 *   F = sum_kl C_kl T_k(s_u) T_l(s_v),   C_kl = sum_ij w_ik w_jl R_ij.
 *
 * Lemma (noise). In units of ROUNDING, as functions on the region, the computed
 * sum_kl C_kl T_k T_l and F differ by at most
 *   units most                             the net (2 for patch_set_net)
 *   (n + m + 4) beta_u beta_v most         R: two sums of n + 1 and m + 1 products with beta (1 + 1
 *                                          for beta itself); beta_u, beta_v: sums of all |beta|
 *   sum_ij |R_ij| (error_i + error_j)      w as a function (chebyshev_shift_error)
 *   sum_ij |R_ij| (n + m + 2) reach_i reach_j   the two sums that make C
 * because |T_k| <= 1 and sum_k |w_ik| <= reach_i. The derivative with respect to s of a polynomial
 * of degree n is at most n^2 times its bound (Markov), so noise costs a rate n^2 noise. */

/* --- Once: the series --- */

/* out = matrix . in, for size rows of width numbers. */
static inline void patch_multiply(int size, const double *matrix, const double *in, double *out,
                                  int width)
{
    for (int k = 0; k < size; ++k)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int j = 0; j < size; ++j) sum += matrix[k * size + j] * in[j * width + x];
            out[k * width + x] = sum;
        }
}

static inline double patch_sum_abs(const double *x, int count)
{
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += fabs(x[i]);
    return sum;
}

/* Fills series and noise. `work` has room for as many numbers as the net. */
static inline void patch_set_series(patch *f, double *work)
{
    const int n = f->degree[0], m = f->degree[1], lanes = f->lanes, row = (m + 1) * lanes;
    double beta_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], beta_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
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
                         (chebyshev_shift_error(i) + chebyshev_shift_error(j) +
                          (n + m + 2) * chebyshev_reach(i) * chebyshev_reach(j));
        f->noise[lane] = units * ROUNDING * SLACK + IMP_TINY;
    }
}

/* --- Per region: C --- */

/* The series of all lanes over a region. Fits in (n+1)(m+1) lanes numbers; `work` likewise. */
static QUAD_INLINE void patch_localize(const patch *f, int n, int m, int lanes,
                                       const imp_region *region, quad *c, quad *work)
{
    double along_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    const int group = lanes / QUAD, row = (m + 1) * group;
    chebyshev_shift(n, 2 * region->c[0] - 1, 2 * region->d[0], along_u, n + 1);
    chebyshev_shift(m, 2 * region->c[1] - 1, 2 * region->d[1], along_v, m + 1);
    quad_rows(n, along_u, true, (const quad *)f->series, work, row);
    for (int k = 0; k <= n; ++k) quad_rows(m, along_v, true, work + k * row, c + k * row, group);
}

#endif
