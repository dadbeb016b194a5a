/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_RANDOM_H
#define CORE_COMMON_RANDOM_H

#include <math.h>
#include <stdint.h>

/* Pseudorandom numbers: splitmix64 (G. Steele, D. Lea, C. Flood, 2014). The state is one number,
 * the seed; the sequence is the same on every machine. */

static inline uint64_t random_bits(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Draws a number in [0, 1), a multiple of 2^-53. */
static inline double random_fraction(uint64_t *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

static inline double random_between(uint64_t *state, double lo, double hi)
{
    return lo + (hi - lo) * random_fraction(state);
}

/* Draws 2^k, k uniform in [lo, hi]. */
static inline double random_power(uint64_t *state, double lo, double hi)
{
    return exp2(random_between(state, lo, hi));
}

#endif
