/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ROUNDING_H
#define CORE_BASE_ROUNDING_H

#include <impinge/quad.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* Outward rounding
 * ================
 * Everything is rounded to nearest and padded outward where it becomes a bound. Functions that pad
 * end in _upper or _lower. A pad is a whole number of units u = UNIT_ROUNDOFF; PAD_COVERS beside it
 * counts the roundings that it has to outweigh, one term for each step of the lemma.
 *
 * Lemma (pads). Rounding to nearest gives fl(y) with y / (1 + u) <= fl(y) <= y (1 + u) for y >= 0,
 * but for underflow. Let x >= 0 come from the exact X by at most n roundings, each of which changes
 * a non-negative whole by that factor at most: X <= x (1 + u)^n and x <= X (1 + u)^n. x * (p u) is
 * exact if p is a power of two, so padding rounds once more.
 *
 *   upper: fl(x + p u x) >= x (1 + p u) / (1 + u) >= X (1 + p u) / (1 + u)^(n+1) >= X
 *          if p >= n + 2, since (1 + u)^(n+1) <= 1 + (n + 2) u for n < 2^26;
 *   lower: fl(x - p u x) <= x (1 - p u) (1 + u) <= X (1 - p u) (1 + u)^(n+1) <= X
 *          if p >= n + 1, since (1 + u)^m <= 1 / (1 - m u);
 *   p = 2 moves x to the next double at least, which outweighs one rounding.
 *
 * A NaN stays NaN. */

#define UNIT_ROUNDOFF 0x1p-53 /* u: half of the distance from 1 to the next double */

/* A static assertion that a pad of `pad` units outweighs `roundings` roundings. */
#define PAD_COVERS(pad, roundings)                                                                 \
    _Static_assert(((pad) & ((pad)-1)) == 0 &&                                                     \
                       ((roundings) + 2 <= (pad) || ((roundings) == 1 && (pad) == 2)),             \
                   "a pad outweighs its roundings")

/* Bounds of what underflow can take away. A product loses 2^-1075 at most: fewer than 32 of them
 * lose less than PRODUCTS_UNDERFLOW. A square lost is below 2^-1074 and so its root below 2^-537:
 * the root of a sum of nine, times a factor below 2^100, loses less than ROOT_UNDERFLOW. */
#define PRODUCTS_UNDERFLOW 0x1p-1070
#define ROOT_UNDERFLOW 0x1p-400

/* An upper and a lower bound of what x >= 0 is in exact arithmetic; `pad` by PAD_COVERS. */
static inline double padded_upper(double x, int pad) { return x + x * (pad * UNIT_ROUNDOFF); }

/* padded_upper in each lane. */
IMP_QUAD_INLINE imp_quad quad_padded_upper(imp_quad x, int pad)
{
    return x + x * imp_quad_all(pad * UNIT_ROUNDOFF);
}
static inline double padded_lower(double x, int pad) { return x - x * (pad * UNIT_ROUNDOFF); }

/* The next double above x, as nextafter gives it, but inline. Doubles of one sign are in the order
 * of their bits. */
static inline double double_above(double x)
{
    int64_t bits;
    if (!(x < INFINITY)) return x;
    if (x == 0) return 0x1p-1074;
    memcpy(&bits, &x, sizeof bits);
    bits += x > 0 ? 1 : -1;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* double_above in each lane, of positive numbers and NaN. */
IMP_QUAD_INLINE imp_quad quad_above(imp_quad x)
{
    return (imp_quad)((imp_quad_mask)x - (x < imp_quad_all(INFINITY)));
}

/* Return x + y rounded up and x - y rounded down: never on the wrong side of the exact value,
 * whatever underflows. */
static inline double sum_upper(double x, double y) { return double_above(x + y); }
static inline double difference_lower(double x, double y) { return -double_above(-(x - y)); }

/* Returns a float above x. */
static inline float float_upper(double x) { return nextafterf((float)x, INFINITY); }

#endif
