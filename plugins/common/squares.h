/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SQUARES_H
#define PLUGINS_COMMON_SQUARES_H

#include <impinge/formula.h>

/* Distances by their squares
 * ==========================
 * How far a point is from a round surface needs the root of a sum of squares. It is left out: the
 * difference of two squares, times a number, is as sharp a bound near the surface, smooth
 * everywhere, and terms of third order cancel in its sum. */

/* x[0]^2 + ... + x[n-1]^2, n <= 3. */
static inline imp_model sum_of_squares(const imp_model *x, int n)
{
    imp_model all[3] = {imp_num(0), imp_num(0), imp_num(0)};
    imp_interval range = imp_interval_make(0, 0);
    for (int i = 0; i < n; ++i) {
        all[i] = x[i];
        range = imp_interval_add(range, imp_interval_sqr(imp_model_range(&x[i])));
    }
    return imp_model_within(imp_dot3(all, all), range);
}

/* An upper bound of the root of a model that is never negative. */
static inline double greatest_root_upper(const imp_model *square)
{
    return imp_round_up(sqrt(imp_larger(square->hi, 0)));
}

/* An upper bound of 1 / x for x > 0. */
static inline double inverse_lower(double x) { return imp_round_down(1 / x); }

/* From q^2, q >= 0, a g with |g| <= |q - r| and the sign of q - r; r > 0. Lemma. The root is
 * concave. With L <= q <= Q and L >= r it is above its chord,
 *
 *   q - r >= (L - r) + (q^2 - L^2) / (L + Q) >= 0,
 *
 * where any smaller factor than 1 / (L + Q) will do; with Q <= r below its tangent,
 *
 *   r - q >= (r - Q) + (Q^2 - q^2) / (2 Q) >= 0.
 *
 * where any smaller factor than 1 / (2 Q) will do, too. Else q^2 - r^2 = (q - r) (q + r), and 0 <
 * q + r <= Q + r. A factor that underflows, is 1 / infinity, or is infinite, since Q is 0, is taken
 * as 0. */
static inline imp_model beyond_radius(imp_model square, double r)
{
    const double most = greatest_root_upper(&square);
    const double least = imp_larger(imp_round_down(sqrt(imp_larger(square.lo, 0))), 0);
    const double from = least >= r ? least : most <= r ? most : r;
    const double factor = inverse_lower(imp_sum_up(most <= r ? 2 * from : most + from));
    const imp_model beyond = imp_scale(imp_sub(square, imp_sqr(imp_num(from))),
                                       factor > 0 && factor < INFINITY ? factor : 0);
    return from == r ? beyond : imp_add(beyond, imp_sub(imp_num(from), imp_num(r)));
}

#endif
