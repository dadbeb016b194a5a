/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_ROWS_H
#define PLUGINS_PATCH_ROWS_H

#include <impinge/quad.h>
#include <stdbool.h>

/* Rows of control points times a small matrix: what a patch does most. */

#define PATCH_UNROLL _Pragma("GCC unroll 4")

/* out_k = sum_j w_jk in_j, for n + 1 rows of `width` quads; w_jk is w[j * (n+1) + k], and with
 * `triangular` it is 0 for j < k. */
IMP_QUAD_INLINE void patch_rows_of(int n, const double *w, bool triangular, const imp_quad *in,
                                   imp_quad *out, int width)
{
    imp_quad row[32];
    for (int x = 0; x < width; ++x) {
        PATCH_UNROLL
        for (int j = 0; j <= n; ++j) row[j] = in[j * width + x];
        PATCH_UNROLL
        for (int k = 0; k <= n; ++k) {
            const int first = triangular ? k : 0;
            imp_quad sum = w[first * (n + 1) + k] * row[first];
            PATCH_UNROLL
            for (int j = first + 1; j <= n; ++j) sum += w[j * (n + 1) + k] * row[j];
            out[k * width + x] = sum;
        }
    }
}

/* Combines rows for any n < 32; fast for low ones. */
IMP_QUAD_INLINE void patch_rows(int n, const double *w, bool triangular, const imp_quad *in,
                                imp_quad *out, int width)
{
    if (n == 1)
        patch_rows_of(1, w, triangular, in, out, width);
    else if (n == 2)
        patch_rows_of(2, w, triangular, in, out, width);
    else if (n == 3)
        patch_rows_of(3, w, triangular, in, out, width);
    else
        patch_rows_of(n, w, triangular, in, out, width);
}

#endif
