/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_QUADRATIC_H
#define CORE_QUADRATIC_H

#include "lanes.h"

/* The least of quadratics over a square
 * =====================================
 * p(s, r) = bs s + br r + qss s^2 + qsr s r + qrr r^2 for s, r in [-1, 1], one p in each lane.
 * In what follows u = 2^-53 and S is the sum of abs of p's coefficients, so abs(p) <= S. */

typedef struct quadratics {
    lanes bs, br, qss, qsr, qrr;
} quadratics;

/* In exact arithmetic the minimum is at least quadratics_lower - QUADRATIC_ROUNDING S - 2^-490,
 * if S < 2^500. */
#define QUADRATIC_ROUNDING 0x1p-47

/* The value at a corner, a low one: neither it nor 0, the value in the middle, can be below the
 * least.
 */
LANES_INLINE lanes quadratics_corner(const quadratics *p)
{
    return p->qss + p->qrr - (lanes_abs(p->bs) + lanes_abs(p->br) - lanes_abs(p->qsr));
}

/* Least of b s + q s^2 over [-1, 1]: at an end, or the vertex -b^2 / 4q where it lies inside;
 * `inverse` is 1 / q. Choosing wrongly at abs(b) = 2 q does no harm: vertex and end then agree to a
 * few u S. A vertex that is left out because q <= 2^-900 lies below the ends by less than q. Else b
 * inverse is below 2 in size. Rounding: b is one sum, then at most four operations on terms below
 * S: under 8 u S, and an underflow. */
LANES_INLINE lanes quadratics_edge_lower(lanes b, lanes q, lanes inverse)
{
    const lanes reach = lanes_abs(b);
    const lanes_mask inside = (reach < q + q) & (q > lanes_all(0x1p-900));
    return lanes_pick(inside, (b * inverse) * (b * lanes_all(-0.25)), q - reach);
}

LANES_INLINE lanes quadratics_into_square(lanes s)
{
    return lanes_max(lanes_min(s, lanes_all(1)), lanes_all(-1));
}

/* Lemma (interior minimum). Let D = 4 qss qrr - qsr^2. If D <= 0 or qss + qrr <= 0 the minimum
 * over the square is on its edge. Else p is convex with one stationary point z, and the
 * minimum is on the edge too unless z lies in the square. If it does, both hold:
 *
 *   (A) min p >= p(y) + g(y).(z - y) >= p(y) - 2 (|g_s| + |g_r|) for any y of the square, g = grad
 *       p;
 *   (B) min p >= edge minimum - 4 D / (qss + qrr): from z walk along the eigenvector of the least
 *       eigenvalue l of the form to the edge, at most sqrt(8) away: p grows by at most 8 l, and
 *       l = (D / 4) / (largest) <= (D / 4) / ((qss + qrr) / 2).
 *
 * The better of the two is taken, y being z as computed. Numerators and D carry errors below
 * 4 u times the terms they sum; "outside" is only believed beyond that, and so is D <= 0. Rounding
 * in p(y) and g(y): each is at most seven operations on terms below 2 S: together under 60 u S. */
LANES_INLINE lanes quadratics_inner_lower(const quadratics *p, lanes edge)
{
    const lanes slack = lanes_all(0x1p-50), two = lanes_all(2), four = lanes_all(4);
    const lanes product = four * p->qss * p->qrr, square = p->qsr * p->qsr;
    const lanes doubt = slack * (lanes_abs(product) + square), trace = p->qss + p->qrr;
    const lanes d = product - square, d_upper = d + doubt;
    const lanes s1 = p->qsr * p->br, s2 = two * p->qrr * p->bs;
    const lanes r1 = p->qsr * p->bs, r2 = two * p->qss * p->br;
    const lanes outside_s = lanes_abs(s1 - s2) - slack * (lanes_abs(s1) + lanes_abs(s2));
    const lanes outside_r = lanes_abs(r1 - r2) - slack * (lanes_abs(r1) + lanes_abs(r2));
    const lanes_mask on_edge = (d_upper <= lanes_all(0)) | (trace <= lanes_all(0)) |
                               (outside_s > d_upper) | (outside_r > d_upper);
    const lanes by_walk = edge - four * d_upper / trace;
    const lanes s = quadratics_into_square((s1 - s2) / d);
    const lanes r = quadratics_into_square((r1 - r2) / d);
    const lanes gs = p->bs + two * p->qss * s + p->qsr * r;
    const lanes gr = p->br + two * p->qrr * r + p->qsr * s;
    const lanes value = (p->bs + p->qss * s + p->qsr * r) * s + (p->br + p->qrr * r) * r;
    const lanes by_tangent = value - two * (lanes_abs(gs) + lanes_abs(gr));
    const lanes inner = lanes_pick(d > doubt, lanes_max(by_tangent, by_walk), by_walk);
    return lanes_pick(on_edge, edge, lanes_min(inner, edge));
}

/* A lower bound over the square, exact but for rounding. Lemma (when the edge is enough). Where 4
 * qss qrr is below qsr^2 by a part in 2^28, the form is indefinite beyond rounding. Where abs(bs)
 * reaches 2 qss + abs(qsr), the slope along s keeps its sign over the square, up to 3 u of it, and
 * so the edge holds the minimum up to 12 u S; r alike. Where qss or qrr is not above 0, one of
 * the two holds or there is no minimum inside. */
LANES_INLINE lanes quadratics_lower(const quadratics *p)
{
    const lanes is = lanes_all(1) / p->qss, ir = lanes_all(1) / p->qrr;
    const lanes ends =
        lanes_min(p->qrr + p->br + quadratics_edge_lower(p->bs + p->qsr, p->qss, is),
                  p->qrr - p->br + quadratics_edge_lower(p->bs - p->qsr, p->qss, is));
    const lanes sides =
        lanes_min(p->qss + p->bs + quadratics_edge_lower(p->br + p->qsr, p->qrr, ir),
                  p->qss - p->bs + quadratics_edge_lower(p->br - p->qsr, p->qrr, ir));
    const lanes edge = lanes_min(ends, sides), twist = lanes_abs(p->qsr);
    const lanes_mask inner = (p->qss * p->qrr > twist * twist * lanes_all(0.25 - 0x1p-30)) &
                             (lanes_abs(p->bs) < p->qss + p->qss + twist) &
                             (lanes_abs(p->br) < p->qrr + p->qrr + twist);
    return lanes_any(inner) ? quadratics_inner_lower(p, edge) : edge;
}

#endif
