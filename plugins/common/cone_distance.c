/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/cone_distance.h"

#include "plugins/common/squares.h"

#include <stdbool.h>

/* Lemma. Let points of space have cylindrical coordinates (q, phi, z), q >= 0, z from the base, and
 * let y = (h - z) sign h. Those of the cone lie on the line |h| q = r y, y >= 0, from which (q, y)
 * is
 *
 *   ||h| q - r y| / L >= ||h| q - r |y|| / L,   L = (h^2 + r^2)^(1/2),
 *
 * away, since q >= 0; points of space are no nearer. And
 *
 *   (h q)^2 - (r y)^2 = (|h| q - r |y|) (|h| q + r |y|),
 *
 * whose last factor is at most |h| Q + r Y where q <= Q, |y| <= Y: a bound without roots. */
static imp_model cone_beyond(double r, double h, const imp_model m[3])
{
    const double slant = greatest_root_upper(
        &(imp_model){.hi = imp_round_up(imp_round_up(h * h) + imp_round_up(r * r))});
    const imp_model across = sum_of_squares(m, 2), y = imp_shift(imp_neg(m[2]), h);
    const imp_model sum = imp_sub(imp_mul(across, imp_sqr(imp_num(h))), imp_sqr(imp_scale(y, r)));
    const double along = imp_round_up(r * imp_interval_mag(imp_model_range(&y)));
    const double most = imp_sum_up(imp_round_up(fabs(h) * greatest_root_upper(&across)) + along);
    return imp_scale(sum, imp_larger(inverse_lower(imp_round_up(most * slant)), 0));
}

/* Lemma. Let e be a vector across the axis, |e| = 1 up to 4 u, f the same turned by a quarter, and
 * p = e.(x, y), s = f.(x, y). Then |e| q = (p^2 + s^2)^(1/2), which is from p to |p| + |s|, at most
 * 2 max(-p, 0) + |s| above p; and where p > 0
 *
 *   p + s^2 / (2 p) - s^4 / (8 p^3) <= |e| q <= p + s^2 / (2 p).
 *
 * On a line through the axis s is 0, and q exact up to the line's end at the axis. `beyond` is the
 * second bound of |e| q - p. */
static imp_model across_near(imp_model p, imp_model s, double beyond)
{
    const double most = imp_interval_mag(imp_model_range(&s)), least = p.lo;
    imp_model q = imp_add(p, imp_between(0, beyond));
    if (least > 0 && most <= least) {
        const double ratio = most / least, slack = 0.125 * ratio * ratio * ratio * most;
        const imp_model half = imp_scale(imp_div(imp_sqr(s), p), 0.5);
        q = imp_add(imp_add(p, half), imp_between(-imp_round_up(2 * slack), 0));
    }
    return imp_mul(q, imp_between(1 - 0x1p-50, 1 + 0x1p-50));
}

/* Like cone_beyond, by ||h| q - r y| / L itself, for points that stay on one side of the axis or
 * come to it on a line, up to rounding. False: they do not. */
static bool cone_near(double r, double h, const imp_model m[3], imp_model *gap)
{
    const double size = sqrt(m[0].a * m[0].a + m[1].a * m[1].a),
                 e[2] = {m[0].a / size, m[1].a / size};
    if (!(size > 0x1p-300)) return false;
    const imp_model p = imp_add(imp_scale(m[0], e[0]), imp_scale(m[1], e[1]));
    const imp_model t = imp_sub(imp_scale(m[1], e[0]), imp_scale(m[0], e[1]));
    const imp_model y = h > 0 ? imp_shift(imp_neg(m[2]), h) : imp_shift(m[2], -h);
    const double most = imp_interval_mag(imp_model_range(&t));
    const double beyond = imp_sum_up(2 * imp_larger(-p.lo, 0) + most);
    if (!((p.lo > 0 && most <= p.lo) || beyond <= 0x1p-40 * size)) return false;
    const double slant = greatest_root_upper(
        &(imp_model){.hi = imp_round_up(imp_round_up(h * h) + imp_round_up(r * r))});
    const imp_model apart = imp_sub(imp_scale(across_near(p, t, beyond), fabs(h)), imp_scale(y, r));
    *gap = imp_scale(apart, imp_larger(inverse_lower(slant), 0));
    return true;
}

/* Beyond the apex. Lemma. Where r q <= |h| (-y), (q, y) is in the polar cone of the half line of
 * the section, whose direction is (r, |h|): its nearest point is the apex. A bound of q^2 + (z -
 * h)^2's root is one of the distance. False: the points are not all there. */
static bool cone_above(double r, double h, const imp_model m[3], imp_model *gap)
{
    const imp_model up = imp_shift(m[2], -h), from[3] = {m[0], m[1], up};
    const double beyond = h > 0 ? up.lo : -up.hi;
    if (!(beyond > 0)) return false;
    const imp_model across = sum_of_squares(m, 2);
    const double least = imp_round_down(fabs(h) * beyond);
    if (!(imp_round_up(r * greatest_root_upper(&across)) <= least)) return false;
    *gap = beyond_radius(sum_of_squares(from, 3), 0);
    return true;
}

imp_model cone_distance(double radius, double height, const imp_model m[3])
{
    imp_model gap;
    if (cone_above(radius, height, m, &gap)) return gap;
    return cone_near(radius, height, m, &gap) ? gap : cone_beyond(radius, height, m);
}
