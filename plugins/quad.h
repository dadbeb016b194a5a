/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_QUAD_H
#define PLUGINS_QUAD_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Four numbers at a time
 * ======================
 * + - * work on all numbers of a quad, [0] to [3] are they. The same rounding as for single
 * numbers, so the same results. One vector register holds a quad where there is AVX2, two on every
 * other 64-bit machine: what is worth it is compiled twice, the second time as QUAD_WIDE, and
 * quad_is_wide() chooses between the two when the program runs. */

#if !defined(__GNUC__)
#error "quad.h needs the vector extension of gcc and clang"
#endif

typedef double quad __attribute__((vector_size(32), may_alias, aligned(8))); /* in any double[] */
typedef int64_t quad_bits __attribute__((vector_size(32)));

enum { QUAD = 4 }; /* numbers in a quad */

#if defined(__x86_64__)
#define QUAD_WIDE __attribute__((target("avx2")))
static inline bool quad_is_wide(void) { return __builtin_cpu_supports("avx2"); }
#else
#define QUAD_WIDE
static inline bool quad_is_wide(void) { return false; }
#endif

/* For functions that are fast when their sizes are constants: they are compiled anew into each
 * caller, their short loops unrolled. */
#define QUAD_INLINE inline __attribute__((always_inline))
#define QUAD_UNROLL _Pragma("GCC unroll 4")

static QUAD_INLINE quad quad_load(const double *x) { return (quad){x[0], x[1], x[2], x[3]}; }

static QUAD_INLINE quad quad_abs(quad x)
{
    return (quad)((quad_bits)x & (quad_bits){INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX});
}

static QUAD_INLINE quad quad_least(quad a, quad b)
{
    quad least;
    for (int k = 0; k < QUAD; ++k) least[k] = a[k] < b[k] ? a[k] : b[k];
    return least;
}

static QUAD_INLINE quad quad_most(quad a, quad b)
{
    quad most;
    for (int k = 0; k < QUAD; ++k) most[k] = a[k] > b[k] ? a[k] : b[k];
    return most;
}

/* out_k = sum_j w_jk in_j, for n + 1 rows of `width` couples; w_jk is w[j * (n+1) + k], and with
 * `triangular` it is 0 for j < k. */
static QUAD_INLINE void quad_rows_of(int n, const double *w, bool triangular, const quad *in,
                                     quad *out, int width)
{
    quad row[32];
    for (int x = 0; x < width; ++x) {
        QUAD_UNROLL
        for (int j = 0; j <= n; ++j) row[j] = in[j * width + x];
        QUAD_UNROLL
        for (int k = 0; k <= n; ++k) {
            const int first = triangular ? k : 0;
            quad sum = w[first * (n + 1) + k] * row[first];
            QUAD_UNROLL
            for (int j = first + 1; j <= n; ++j) sum += w[j * (n + 1) + k] * row[j];
            out[k * width + x] = sum;
        }
    }
}

/* The same, for any n < 32; fast for low ones. */
static QUAD_INLINE void quad_rows(int n, const double *w, bool triangular, const quad *in,
                                  quad *out, int width)
{
    if (n == 1)
        quad_rows_of(1, w, triangular, in, out, width);
    else if (n == 2)
        quad_rows_of(2, w, triangular, in, out, width);
    else if (n == 3)
        quad_rows_of(3, w, triangular, in, out, width);
    else
        quad_rows_of(n, w, triangular, in, out, width);
}

#endif
