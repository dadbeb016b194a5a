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

IMP_QUAD_INLINE void multiply(int size, const double *matrix, const double *in, double *out,
                              int width)
{
    const int groups = width / IMP_QUAD;
    const imp_quad *from = (const imp_quad *)in;
    imp_quad *row = (imp_quad *)out;
    for (int k = 0; k < size; ++k, row += groups)
        for (int x = 0; x < groups; ++x) {
            imp_quad sum = {0};
            for (int j = 0; j < size; ++j) sum += matrix[k * size + j] * from[j * groups + x];
            row[x] = sum;
        }
}

IMP_QUAD_NARROW static void multiply_narrow(int size, const double *matrix, const double *in,
                                            double *out, int width)
{
    multiply(size, matrix, in, out, width);
}
IMP_QUAD_WIDE static void multiply_wide(int size, const double *matrix, const double *in,
                                        double *out, int width)
{
    multiply(size, matrix, in, out, width);
}

void patch_multiply(int size, const double *matrix, const double *in, double *out, int width)
{
    if (imp_quad_is_wide())
        multiply_wide(size, matrix, in, out, width);
    else
        multiply_narrow(size, matrix, in, out, width);
}

static double patch_sum_abs(const double *x, int count)
{
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += fabs(x[i]);
    return sum;
}

/* The terms of the noise that depend on the degrees alone, for each number of the series. */
static void patch_set_noise(patch *f, double beta)
{
    const int n = f->degree[0], m = f->degree[1], lanes = f->lanes;
    double shift[PATCH_SIDE_MAX], reach[PATCH_SIDE_MAX], units[PATCH_LANES_MAX];
    for (int k = 0; k <= n || k <= m; ++k) {
        shift[k] = chebyshev_shift_error(k);
        reach[k] = chebyshev_reach(k);
    }
    for (int lane = 0; lane < lanes; ++lane)
        units[lane] = (f->units + (n + m + 4) * beta) * f->most[lane];
    const double *series = f->series;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j, series += lanes) {
            const double each = shift[i] + shift[j] + (n + m + 2) * reach[i] * reach[j];
            for (int lane = 0; lane < lanes; ++lane) units[lane] += fabs(series[lane]) * each;
        }
    for (int lane = 0; lane < lanes; ++lane)
        f->noise[lane] = units[lane] * ROUNDING * SLACK + IMP_TINY;
}

void patch_set_series(patch *f, double *work)
{
    const int n = f->degree[0], m = f->degree[1], lanes = f->lanes, row = (m + 1) * lanes;
    patch_multiply(n + 1, f->beta[0], f->net, work, row);
    for (int i = 0; i <= n; ++i)
        patch_multiply(m + 1, f->beta[1], work + i * row, f->series + i * row, lanes);
    patch_set_noise(f, patch_sum_abs(f->beta[0], (n + 1) * (n + 1)) *
                           patch_sum_abs(f->beta[1], (m + 1) * (m + 1)));
}

/* --- Per region: C ---------------------------------------------------------------------------- */
