/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_QUAD_H
#define IMPINGE_QUAD_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if !defined(__GNUC__)
#error "<impinge/quad.h> needs the vector extension of gcc and clang."
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Four doubles at a time
 * ======================
 *
 * + - * / and comparisons work on all four numbers of an imp_quad; x[0] to x[3] are the numbers.
 * Each is rounded as a single double is, so the results are the same. A quad may be stored in any
 * double[].
 *
 * One vector register holds a quad with AVX2; other 64-bit machines need two. Code that gains from
 * AVX2 is compiled twice:
 *
 *   IMP_QUAD_INLINE double sum_up(const double *x) { ... }
 *   IMP_QUAD_NARROW static double sum_narrow(const double *x) { return sum_up(x); }
 *   IMP_QUAD_WIDE static double sum_wide(const double *x) { return sum_up(x); }
 *   ...
 *   imp_quad_is_wide() ? sum_wide(x) : sum_narrow(x)
 *
 * Operations and their order are the same in both, so the results are the same too. */

/* Quads are passed to and returned from inlined functions only, so the calling convention does not
 * matter. gcc warns about it in functions that are not inlined: -Wno-psabi turns this off. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

enum { IMP_QUAD = 4 }; /* numbers in a quad */

typedef double imp_quad __attribute__((vector_size(32), may_alias, aligned(8)));
typedef int64_t imp_quad_mask __attribute__((vector_size(32))); /* each 0 or -1 */

/* Compiled anew into each caller, for its instruction set and for sizes that are constant there. */
#define IMP_QUAD_INLINE static inline __attribute__((always_inline))

/* Not inlined: its callers would save registers for it even where they call the wide one. */
#define IMP_QUAD_NARROW __attribute__((noinline))

#if defined(__x86_64__)
#define IMP_QUAD_WIDE __attribute__((target("avx2")))
static inline bool imp_quad_is_wide(void) { return __builtin_cpu_supports("avx2") != 0; }
#else
#define IMP_QUAD_WIDE
static inline bool imp_quad_is_wide(void) { return false; }
#endif

IMP_QUAD_INLINE imp_quad imp_quad_of(double a, double b, double c, double d)
{
    imp_quad x = {a, b, c, d};
    return x;
}

IMP_QUAD_INLINE imp_quad imp_quad_all(double x) { return imp_quad_of(x, x, x, x); }

/* Through the type's own pointer: gcc 12 with -march=x86-64-v3 copies memcpy's 32 bytes by halves
 * through the stack, where the load of the whole waits for both stores. */
IMP_QUAD_INLINE imp_quad imp_quad_load(const double x[4]) { return *(const imp_quad *)x; }

IMP_QUAD_INLINE void imp_quad_store(double x[4], imp_quad y) { *(imp_quad *)x = y; }

/* `yes` where m is -1, `no` where it is 0. */
IMP_QUAD_INLINE imp_quad imp_quad_pick(imp_quad_mask m, imp_quad yes, imp_quad no)
{
    return (imp_quad)((m & (imp_quad_mask)yes) | (~m & (imp_quad_mask)no));
}

IMP_QUAD_INLINE imp_quad imp_quad_abs(imp_quad x)
{
    const imp_quad_mask all_but_sign = {INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX};
    return (imp_quad)((imp_quad_mask)x & all_but_sign);
}

/* The greater; y where either is NaN. */
IMP_QUAD_INLINE imp_quad imp_quad_max(imp_quad x, imp_quad y)
{
    imp_quad z;
    for (int k = 0; k < IMP_QUAD; ++k) z[k] = x[k] > y[k] ? x[k] : y[k];
    return z;
}

/* The lesser; y where either is NaN. */
IMP_QUAD_INLINE imp_quad imp_quad_min(imp_quad x, imp_quad y)
{
    imp_quad z;
    for (int k = 0; k < IMP_QUAD; ++k) z[k] = x[k] < y[k] ? x[k] : y[k];
    return z;
}

/* By halves, which takes fewer instructions than lane by lane. */
IMP_QUAD_INLINE bool imp_quad_any(imp_quad_mask m)
{
    typedef int64_t pair __attribute__((vector_size(16)));
    pair half[2];
    memcpy(half, &m, sizeof half);
    half[0] |= half[1];
    return (half[0][0] | half[0][1]) != 0;
}

/* A shuffle of two quads: lanes 0 to 3 are those of x, 4 to 7 those of y. With the builtin, gcc
 * transposes four rows in 8 instructions; with an initialiser of single lanes it takes 20. */
#if defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define IMP_QUAD_SHUFFLE(x, y, i, j, k, l) __builtin_shufflevector(x, y, i, j, k, l)
#endif
#endif
#if !defined(IMP_QUAD_SHUFFLE)
#define IMP_QUAD_LANE(x, y, i) ((i) < IMP_QUAD ? (x)[(i) % IMP_QUAD] : (y)[(i) % IMP_QUAD])
#define IMP_QUAD_SHUFFLE(x, y, i, j, k, l)                                                         \
    imp_quad_of(IMP_QUAD_LANE(x, y, i), IMP_QUAD_LANE(x, y, j), IMP_QUAD_LANE(x, y, k),            \
                IMP_QUAD_LANE(x, y, l))
#endif

/* Four rows become the columns. */
IMP_QUAD_INLINE void imp_quad_transpose(imp_quad row[4])
{
    const imp_quad a = row[0], b = row[1], c = row[2], d = row[3];
    const imp_quad even[2] = {IMP_QUAD_SHUFFLE(a, b, 0, 4, 2, 6),
                              IMP_QUAD_SHUFFLE(c, d, 0, 4, 2, 6)};
    const imp_quad odd[2] = {IMP_QUAD_SHUFFLE(a, b, 1, 5, 3, 7),
                             IMP_QUAD_SHUFFLE(c, d, 1, 5, 3, 7)};
    row[0] = IMP_QUAD_SHUFFLE(even[0], even[1], 0, 1, 4, 5);
    row[1] = IMP_QUAD_SHUFFLE(odd[0], odd[1], 0, 1, 4, 5);
    row[2] = IMP_QUAD_SHUFFLE(even[0], even[1], 2, 3, 6, 7);
    row[3] = IMP_QUAD_SHUFFLE(odd[0], odd[1], 2, 3, 6, 7);
}

/* The cross product of two vectors of three; then 0 where both have 0. */
IMP_QUAD_INLINE imp_quad imp_quad_cross(imp_quad a, imp_quad b)
{
    return IMP_QUAD_SHUFFLE(a, a, 1, 2, 0, 3) * IMP_QUAD_SHUFFLE(b, b, 2, 0, 1, 3) -
           IMP_QUAD_SHUFFLE(a, a, 2, 0, 1, 3) * IMP_QUAD_SHUFFLE(b, b, 1, 2, 0, 3);
}

#pragma GCC diagnostic pop

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_QUAD_H */
