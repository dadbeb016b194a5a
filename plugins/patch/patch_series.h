/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_SERIES_H
#define PLUGINS_PATCH_PATCH_SERIES_H

#include "plugins/patch/chebyshev.h"
#include "plugins/patch/patch.h"
#include "plugins/patch/rows.h"

/* A patch as a Chebyshev series
 * =============================
 * With x = 2u - 1 and y = 2v - 1, a polynomial is F = sum_ij R_ij T_i(x) T_j(y); R is `series`,
 * made once. A region has x = c + d s, and T_i(c + d s) = sum_k w_ik T_k(s) (chebyshev.h), so over
 * it
 *
 *   F = sum_kl C_kl T_k(s_u) T_l(s_v),   C_kl = sum_ij w_ik w_jl R_ij. */

/* out = matrix . in, for size rows of width numbers, a multiple of IMP_QUAD. */
void patch_multiply(int size, const double *matrix, const double *in, double *out, int width);

/* Fills series and noise. `work` has the size of the net. */
void patch_set_series(patch *f, double *work);

/* The series of all lanes over a region. Fits in (n+1)(m+1) lanes numbers; `work` likewise. */
IMP_QUAD_INLINE void patch_localize(const patch *f, int n, int m, int lanes,
                                    const imp_region *region, imp_quad *c, imp_quad *work)
{
    double along_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    const int group = lanes / IMP_QUAD, row = (m + 1) * group;
    chebyshev_shift(n, 2 * region->c[0] - 1, 2 * region->d[0], along_u, n + 1);
    chebyshev_shift(m, 2 * region->c[1] - 1, 2 * region->d[1], along_v, m + 1);
    patch_rows(n, along_u, true, (const imp_quad *)f->series, work, row);
    for (int k = 0; k <= n; ++k) patch_rows(m, along_v, true, work + k * row, c + k * row, group);
}

#endif
