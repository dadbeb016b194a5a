/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/solid_angle.h"

#include "core/base/rounding.h"

/* Lemma (plane triangle). Van Oosterom and Strackee: with a, b, c from x and their lengths A, B, C,
 * the solid angle is 2 atan2(N, D), N = a.(b x c), D = ABC + (a.b) C + (b.c) A + (c.a) B.
 *
 * Rounding, in units u A B C. Differences of exact points are off by 1 in each coordinate, which
 * changes a product of three by 3. N is a sum of six products |a_i b_j c_k|, together at most
 * 6 ABC, each of which goes through 2 products and 3 sums:        6 (3 + 5)              = 48
 * A length: squares of coordinates off by 1, two sums, a root: (2 + 1 + 2) / 2 + 1 < 4. A dot
 * product, at most AB in sum of magnitudes: 2 + 1 + 2 = 5, times a length 4 and a product 1: three
 * of them (5 + 4 + 1) 3 = 30; ABC: 3 * 4 + 2 = 14; three sums of at most 4 ABC: 12; together 56
 * Both are below 64, and ROUNDING = 128 outweighs the rounding of ABC itself.
 *
 * If (D, N) is off by at most e = ROUNDING u ABC in each coordinate, and its length r is at least 4
 * e, its direction turns by at most asin(sqrt 2 e / r) <= 1.5 e / r, and the solid angle changes by
 * at most 3 e / r; 4 e / r covers the rounding of r. The direction does not pass the negative axis,
 * where atan2 jumps, unless D < 0 and |N| <= e: then, and for a small r, the error is that of a
 * whole turn. atan2 is within 4 ulp of at most pi: 4 * 2^-51; twice that, and the sum's own
 * rounding, are below LIBM. */
enum { ROUNDING = 128 };
#define LIBM 0x1p-46

void solid_angle_add_error(enclosed_angle *sum, double error)
{
    sum->error = sum_upper(sum->error, error);
}

void solid_angle_add_triangle(enclosed_angle *sum, vec3 x, vec3 a, vec3 b, vec3 c)
{
    a = vec3_sub(a, x), b = vec3_sub(b, x), c = vec3_sub(c, x);
    const double la = vec3_norm(a), lb = vec3_norm(b), lc = vec3_norm(c), whole = la * lb * lc;
    const double n = vec3_dot(a, vec3_cross(b, c));
    const double d = whole + vec3_dot(a, b) * lc + vec3_dot(b, c) * la + vec3_dot(c, a) * lb;
    const double e = ROUNDING * UNIT_ROUNDOFF * whole, r = hypot(n, d);
    const bool known = r >= 4 * e && !(d <= e && fabs(n) <= e) && whole > 0x1p-900;
    sum->angle += 2 * atan2(n, d);
    solid_angle_add_error(sum, known ? 4 * e / r + LIBM : FULL_ANGLE);
    solid_angle_add_error(sum, 2 * UNIT_ROUNDOFF * fabs(sum->angle));
}
