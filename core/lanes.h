/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_LANES_H
#define CORE_LANES_H

#include <stdbool.h>
#include <string.h>

/* Four numbers at a time
 * ======================
 * Vectors of four doubles: four directions, or x, y, z and one unused. A function that works on
 * them is LANES_INLINE and is called from two copies of its entry, one of them LANES_WIDE, between
 * which lanes_are_wide() chooses when the program runs. Operations and their order are the same in
 * both, so the answers are too. */

enum { LANES = 4 };

typedef double lanes __attribute__((vector_size(8 * LANES)));
typedef long long lanes_mask __attribute__((vector_size(8 * LANES))); /* each lane 0 or -1 */

#define LANES_INLINE static inline __attribute__((always_inline))

#if defined(__x86_64__)
#define LANES_WIDE __attribute__((target("avx2")))
static inline bool lanes_are_wide(void) { return __builtin_cpu_supports("avx2"); }
#else
#define LANES_WIDE
static inline bool lanes_are_wide(void) { return false; }
#endif

LANES_INLINE lanes lanes_all(double x) { return (lanes){x, x, x, x}; }

LANES_INLINE lanes lanes_load(const double x[LANES])
{
    lanes y;
    memcpy(&y, x, sizeof y);
    return y;
}

LANES_INLINE void lanes_store(double x[LANES], lanes y) { memcpy(x, &y, sizeof y); }

LANES_INLINE lanes lanes_pick(lanes_mask m, lanes yes, lanes no)
{
    return (lanes)((m & (lanes_mask)yes) | (~m & (lanes_mask)no));
}

LANES_INLINE lanes lanes_abs(lanes x)
{
    const long long most = 0x7fffffffffffffff;
    return (lanes)((lanes_mask)x & (lanes_mask){most, most, most, most});
}

/* The greater; y where either is NaN. */
LANES_INLINE lanes lanes_max(lanes x, lanes y)
{
    lanes z;
    for (int k = 0; k < LANES; ++k) z[k] = x[k] > y[k] ? x[k] : y[k];
    return z;
}

/* The lesser; y where either is NaN. */
LANES_INLINE lanes lanes_min(lanes x, lanes y)
{
    lanes z;
    for (int k = 0; k < LANES; ++k) z[k] = x[k] < y[k] ? x[k] : y[k];
    return z;
}

LANES_INLINE bool lanes_any(lanes_mask m) { return (m[0] | m[1] | m[2] | m[3]) != 0; }

#endif
