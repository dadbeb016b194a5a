/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "quadratic.h"

#include <math.h>

/* In what follows u = 2^-53 and S is the sum of abs of p's coefficients, so abs(p) <= S. */

static void span_hull(span *range, double x)
{
    if (x < range->lo) range->lo = x;
    if (x > range->hi) range->hi = x;
}

/* Range of c + b s + q s^2 over [-1, 1]: ends, and the vertex -b^2 / 4q where it lies inside.
 * Choosing wrongly at abs(b) = 2 abs(q) does no harm: vertex and end then agree to a few u S.
 * Rounding: c and b are one sum each, then at most four operations on terms below S: under 8 u S.
 */
static void edge_hull(span *range, double c, double b, double q)
{
    const double reach = fabs(b);
    span_hull(range, c + (q + reach));
    span_hull(range, c + (q - reach));
    if (reach < 2 * fabs(q)) span_hull(range, c - b * b / (4 * q));
}

/* Lemma (interior extremum). Let D = 4 qss qrr - qsr^2 and, say, qss > 0. If D <= 0 the minimum
 * over the square is on its edge. If D > 0, p is convex with one stationary point z, and the
 * minimum is on the edge too unless z lies in the square. If it does, both hold:
 *
 *   (A) min p >= p(y) + g(y).(z - y) >= p(y) - 2 (|g_s| + |g_r|) for any y of the square, g = grad
 * p; (B) min p >= edge minimum - 4 D / (qss + qrr): from z walk along the eigenvector of the least
 *       eigenvalue l of the form to the edge, at most sqrt(8) away: p grows by at most 8 l, and
 *       l = (D / 4) / (largest) <= (D / 4) / ((qss + qrr) / 2).
 *
 * The better of the two is taken, y being z as computed. Numerators and D carry errors below
 * 4 u times the terms they sum; "outside" is only believed beyond that, and so is D <= 0. Rounding
 * in p(y) and g(y): each is at most seven operations on terms below 2 S: together under 60 u S. */
static double interior_lower(const quadratic *p, double edge)
{
    const double slack = 0x1p-50;
    const double product = 4 * p->qss * p->qrr, square = p->qsr * p->qsr;
    const double d = product - square;
    const double d_upper = d + slack * (fabs(product) + square);
    if (d_upper <= 0 || p->qss + p->qrr <= 0) return edge;
    const double s1 = p->qsr * p->br, s2 = 2 * p->qrr * p->bs;
    const double r1 = p->qsr * p->bs, r2 = 2 * p->qss * p->br;
    if (fabs(s1 - s2) - slack * (fabs(s1) + fabs(s2)) > d_upper) return edge;
    if (fabs(r1 - r2) - slack * (fabs(r1) + fabs(r2)) > d_upper) return edge;
    const double by_walk = edge - 4 * d_upper / (p->qss + p->qrr);
    if (!(d > slack * (fabs(product) + square))) return by_walk;
    const double s = fmax(-1, fmin(1, (s1 - s2) / d)), r = fmax(-1, fmin(1, (r1 - r2) / d));
    const double gs = p->bs + 2 * p->qss * s + p->qsr * r;
    const double gr = p->br + 2 * p->qrr * r + p->qsr * s;
    const double value = (p->bs + p->qss * s + p->qsr * r) * s + (p->br + p->qrr * r) * r;
    const double by_tangent = value - 2 * (fabs(gs) + fabs(gr));
    const double best = by_tangent > by_walk ? by_tangent : by_walk;
    return best < edge ? best : edge;
}

span quadratic_span(const quadratic *p)
{
    span range = {INFINITY, -INFINITY};
    edge_hull(&range, p->qrr + p->br, p->bs + p->qsr, p->qss);
    edge_hull(&range, p->qrr - p->br, p->bs - p->qsr, p->qss);
    edge_hull(&range, p->qss + p->bs, p->br + p->qsr, p->qrr);
    edge_hull(&range, p->qss - p->bs, p->br - p->qsr, p->qrr);
    if (p->qss > 0 && p->qrr > 0) {
        range.lo = interior_lower(p, range.lo);
    } else if (p->qss < 0 && p->qrr < 0) {
        const quadratic minus = {-p->bs, -p->br, -p->qss, -p->qsr, -p->qrr};
        range.hi = -interior_lower(&minus, -range.hi);
    }
    return range;
}
