/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_QUADRATIC_H
#define CORE_BOUNDS_QUADRATIC_H

#include "core/base/rounding.h"

#include <impinge/quad.h>

/* The minimum of a quadratic over a square
 * ========================================
 * p(s, r) = bs s + br r + qss s^2 + qsr s r + qrr r^2 for s, r in [-1, 1], one p in each lane.
 * In what follows u is UNIT_ROUNDOFF and S the sum of |coefficients| of p, so |p| <= S. */

typedef struct quadratics {
    imp_quad bs, br, qss, qsr, qrr;
} quadratics;

/* In exact arithmetic the minimum is at least quadratics_lower - QUADRATIC_ROUNDING u S -
 * QUADRATIC_UNDERFLOW if S < 2^500. The parts of the budget, in units of u S, are derived in the
 * lemmas below. */
#define QUADRATIC_UNDERFLOW 0x1p-490

enum {
    QUADRATIC_ROUNDING = 64,
    QUADRATIC_EDGE = 6,      /* the minimum over the edge */
    QUADRATIC_NO_INNER = 12, /* the interior minimum left out */
    QUADRATIC_TANGENT = 26,  /* the bound (A) of an interior minimum */
    QUADRATIC_WALK = 14      /* the bound (B), less that of the edge */
};
_Static_assert(QUADRATIC_EDGE + QUADRATIC_NO_INNER <= QUADRATIC_ROUNDING, "edge only");
_Static_assert(QUADRATIC_TANGENT <= QUADRATIC_ROUNDING, "interior, bound (A)");
_Static_assert(QUADRATIC_EDGE + QUADRATIC_WALK <= QUADRATIC_ROUNDING, "interior, bound (B)");

/* The value at a low corner: an upper bound of the minimum, as is 0, the value in the middle. */
IMP_QUAD_INLINE imp_quad quadratics_corner(const quadratics *p)
{
    return p->qss + p->qrr - (imp_quad_abs(p->bs) + imp_quad_abs(p->br) - imp_quad_abs(p->qsr));
}

/* Least of b s + q s^2 over [-1, 1]: at an end, or the vertex -b^2 / 4q where it lies inside;
 * `inverse` is 1 / q. A vertex that is left out because q <= 2^-900 lies below the ends by less
 * than q. Else b inverse is below 2 in size, and the vertex at most |b| / 2 <= S / 2. Rounding of
 * the minimum over the edge, which adds two terms to this, in units of u S; an underflow besides:
 *
 *   b = bs -+ qsr     1, and moves the least by as much; the choice is exact for b as computed
 *   vertex            inverse 1, two products 2, of S / 2 at most: < 2
 *   end q - |b|       1, instead of the vertex
 *   qrr + br          1
 *   the last sum      1 */
_Static_assert(1 + 2 + 1 + 1 <= QUADRATIC_EDGE, "rounding of the edge");

IMP_QUAD_INLINE imp_quad quadratics_edge_lower(imp_quad b, imp_quad q, imp_quad inverse)
{
    const imp_quad reach = imp_quad_abs(b);
    const imp_quad_mask inside = (reach < q + q) & (q > imp_quad_all(0x1p-900));
    return imp_quad_pick(inside, (b * inverse) * (b * imp_quad_all(-0.25)), q - reach);
}

IMP_QUAD_INLINE imp_quad quadratics_into_square(imp_quad s)
{
    return imp_quad_max(imp_quad_min(s, imp_quad_all(1)), imp_quad_all(-1));
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
 * 4 u times the terms they sum; "outside" is only accepted beyond twice that, and so is D <= 0.
 * Rounding, in units of u S:
 *
 *   (A) p(y)              5: the term qss s^2 goes through 2 products and 3 sums, others fewer
 *       g_s, g_r          3 of |bs| + 2 |qss| + |qsr| each, together 3 * 2, and twice that: 12
 *       |g_s| + |g_r|     1 of 2 S, and twice that: 4
 *       the difference    1 of 5 S: 5
 *   (B) 4 D / trace       trace 1, quotient 1, of 4 S at most: 8; D is padded already
 *       the difference    1 of 5 S: 5 */
_Static_assert(5 + 12 + 4 + 5 <= QUADRATIC_TANGENT, "rounding of the bound (A)");
_Static_assert(8 + 5 <= QUADRATIC_WALK, "rounding of the bound (B)");
PAD_COVERS(8, 4); /* of numerators and of D */

IMP_QUAD_INLINE imp_quad quadratics_inner_lower(const quadratics *p, imp_quad edge)
{
    const imp_quad slack = imp_quad_all(8 * UNIT_ROUNDOFF), two = imp_quad_all(2),
                   four = imp_quad_all(4);
    const imp_quad product = four * p->qss * p->qrr, square = p->qsr * p->qsr;
    const imp_quad doubt = slack * (imp_quad_abs(product) + square), trace = p->qss + p->qrr;
    const imp_quad d = product - square, d_upper = d + doubt;
    const imp_quad s1 = p->qsr * p->br, s2 = two * p->qrr * p->bs;
    const imp_quad r1 = p->qsr * p->bs, r2 = two * p->qss * p->br;
    const imp_quad outside_s =
        imp_quad_abs(s1 - s2) - slack * (imp_quad_abs(s1) + imp_quad_abs(s2));
    const imp_quad outside_r =
        imp_quad_abs(r1 - r2) - slack * (imp_quad_abs(r1) + imp_quad_abs(r2));
    const imp_quad_mask on_edge = (d_upper <= imp_quad_all(0)) | (trace <= imp_quad_all(0)) |
                                  (outside_s > d_upper) | (outside_r > d_upper);
    const imp_quad by_walk = edge - four * d_upper / trace;
    const imp_quad s = quadratics_into_square((s1 - s2) / d);
    const imp_quad r = quadratics_into_square((r1 - r2) / d);
    const imp_quad gs = p->bs + two * p->qss * s + p->qsr * r;
    const imp_quad gr = p->br + two * p->qrr * r + p->qsr * s;
    const imp_quad value = (p->bs + p->qss * s + p->qsr * r) * s + (p->br + p->qrr * r) * r;
    const imp_quad by_tangent = value - two * (imp_quad_abs(gs) + imp_quad_abs(gr));
    const imp_quad inner = imp_quad_pick(d > doubt, imp_quad_max(by_tangent, by_walk), by_walk);
    return imp_quad_pick(on_edge, edge, imp_quad_min(inner, edge));
}

/* Returns what quadratics_lower returns, with fewer instructions, where qss and qrr are 0: p is
 * linear in s and in r, and least at a corner. */
IMP_QUAD_INLINE imp_quad quadratics_bilinear_lower(const quadratics *p)
{
    const imp_quad ends =
        imp_quad_min(p->br - imp_quad_abs(p->bs + p->qsr), -p->br - imp_quad_abs(p->bs - p->qsr));
    const imp_quad sides =
        imp_quad_min(p->bs - imp_quad_abs(p->br + p->qsr), -p->bs - imp_quad_abs(p->br - p->qsr));
    return imp_quad_min(ends, sides);
}

/* A lower bound over the square, exact but for rounding. Lemma (when the edge is enough). Where 4
 * qss qrr is below qsr^2 by a part in 2^28, the form is indefinite beyond rounding. Where |bs|
 * reaches 2 qss + |qsr|, which is two roundings, the slope along s keeps its sign over the square,
 * but for 3 u of its terms, |bs| + 2 |qss| + |qsr| <= 2 S; so over a way of at most 2 the value
 * falls by at most 2 * 3 * 2 u S below the edge's; r alike. Where qss or qrr is not above 0, one of
 * the two holds or there is no minimum inside. */
_Static_assert(2 * 3 * 2 <= QUADRATIC_NO_INNER, "no interior minimum");

IMP_QUAD_INLINE imp_quad quadratics_lower(const quadratics *p)
{
    const imp_quad is = imp_quad_all(1) / p->qss, ir = imp_quad_all(1) / p->qrr;
    const imp_quad ends =
        imp_quad_min(p->qrr + p->br + quadratics_edge_lower(p->bs + p->qsr, p->qss, is),
                     p->qrr - p->br + quadratics_edge_lower(p->bs - p->qsr, p->qss, is));
    const imp_quad sides =
        imp_quad_min(p->qss + p->bs + quadratics_edge_lower(p->br + p->qsr, p->qrr, ir),
                     p->qss - p->bs + quadratics_edge_lower(p->br - p->qsr, p->qrr, ir));
    const imp_quad edge = imp_quad_min(ends, sides), twist = imp_quad_abs(p->qsr);
    const imp_quad_mask inner = (p->qss * p->qrr > twist * twist * imp_quad_all(0.25 - 0x1p-30)) &
                                (imp_quad_abs(p->bs) < p->qss + p->qss + twist) &
                                (imp_quad_abs(p->br) < p->qrr + p->qrr + twist);
    return imp_quad_any(inner) ? quadratics_inner_lower(p, edge) : edge;
}

#endif
