/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "quadratic.h"

#include <math.h>

/* In what follows u = 2^-53 and S is the sum of abs of p's coefficients, so abs(p) <= S. */

/* Least of b s + q s^2 over [-1, 1]: at an end, or the vertex -b^2 / 4q where it lies inside.
 * Choosing wrongly at abs(b) = 2 q does no harm: vertex and end then agree to a few u S. Rounding:
 * b is one sum, then at most four operations on terms below S: under 8 u S. */
static double edge_lower(double b, double q)
{
    const double reach = fabs(b);
    return reach < 2 * q ? -(b * b / (4 * q)) : q - reach;
}

static double smaller(double x, double y) { return x < y ? x : y; }

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
double quadratic_inner_lower(const quadratic *p, double edge)
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

double quadratic_lower(const quadratic *p)
{
    const double below = p->qrr - p->br + edge_lower(p->bs - p->qsr, p->qss);
    const double above = p->qrr + p->br + edge_lower(p->bs + p->qsr, p->qss);
    const double left = p->qss - p->bs + edge_lower(p->br - p->qsr, p->qrr);
    const double right = p->qss + p->bs + edge_lower(p->br + p->qsr, p->qrr);
    const double edge = smaller(smaller(below, above), smaller(left, right));
    return p->qss > 0 && p->qrr > 0 ? quadratic_inner_lower(p, edge) : edge;
}
