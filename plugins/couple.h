/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COUPLE_H
#define PLUGINS_COUPLE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Two numbers at a time
 * =====================
 * A couple is what one vector register holds on every 64-bit machine. + - * work on both of its
 * numbers, [0] and [1] are they. The same rounding as for single numbers, so the same results. */

#if !defined(__GNUC__)
#error "couple.h needs the vector extension of gcc and clang"
#endif

typedef double couple __attribute__((vector_size(16), may_alias));
typedef int64_t couple_bits __attribute__((vector_size(16)));

enum { COUPLE = 2 }; /* numbers in a couple */

/* For functions that are fast when their sizes are constants: they are compiled anew into each
 * caller, their short loops unrolled. */
#define COUPLE_INLINE inline __attribute__((always_inline))
#define COUPLE_UNROLL _Pragma("GCC unroll 4")

static inline couple couple_load(const double *x) { return (couple){x[0], x[1]}; }

static inline couple couple_abs(couple x)
{
    return (couple)((couple_bits)x & (couple_bits){INT64_MAX, INT64_MAX});
}

static inline couple couple_least(couple a, couple b)
{
    return (couple){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}

/* out_k = sum_j w_jk in_j, for n + 1 rows of `width` couples; w_jk is w[j * (n+1) + k], and with
 * `triangular` it is 0 for j < k. */
static COUPLE_INLINE void couple_rows_of(int n, const double *w, bool triangular, const couple *in,
                                         couple *out, int width)
{
    couple row[32];
    for (int x = 0; x < width; ++x) {
        COUPLE_UNROLL
        for (int j = 0; j <= n; ++j) row[j] = in[j * width + x];
        COUPLE_UNROLL
        for (int k = 0; k <= n; ++k) {
            const int first = triangular ? k : 0;
            couple sum = w[first * (n + 1) + k] * row[first];
            COUPLE_UNROLL
            for (int j = first + 1; j <= n; ++j) sum += w[j * (n + 1) + k] * row[j];
            out[k * width + x] = sum;
        }
    }
}

/* The same, for any n < 32; fast for low ones. */
static COUPLE_INLINE void couple_rows(int n, const double *w, bool triangular, const couple *in,
                                      couple *out, int width)
{
    if (n == 1)
        couple_rows_of(1, w, triangular, in, out, width);
    else if (n == 2)
        couple_rows_of(2, w, triangular, in, out, width);
    else if (n == 3)
        couple_rows_of(3, w, triangular, in, out, width);
    else
        couple_rows_of(n, w, triangular, in, out, width);
}

#endif
