/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_COIL_H
#define PLUGINS_COMMON_COIL_H

#include "plugins/common/near.h"
#include "plugins/common/squares.h"

/* Distances from coils
 * ====================
 * A coil is an endless thread: in cylindrical coordinates (q, theta, z) about its axis it is q =
 * R(phase), phase = around theta - along z + offset, and theta may be any angle of the point, off
 * by whole turns. F = q - R(phase) is 0 on it. At q > 0
 *
 *   |grad F|^2 = 1 + R'(phase)^2 |grad phase|^2,   |grad phase|^2 = along^2 + (around / q)^2.
 *
 * Lemma (way). Let p be a point, y the nearest to it of the coil, d how far apart they are, and m >
 * 0 at most the least radius. Since the point of the coil that lies radially from p is |F(p)| away,
 * d <= |F(p)|. The points between p and y are s from p and d - s from y, s in [0, d], so that their
 * q is at least q_p - s and m - (d - s): at least the mean of both,
 *
 *   q >= (q_p + m - d) / 2,   and   q >= m - d.
 *
 * There the phase is no farther from that of p than d times the greatest |grad phase|. So where S
 * >= |grad F| all the way, |F(p)| = |F(p) - F(y)| <= S d. */

typedef struct coil {
    near_constant around, along, offset; /* rad or any unit of phase; 1/length */
    double root;                         /* at most the least radius, > 0; length */
    double crest;                        /* at least the greatest radius; length */
    double far;                          /* beyond phases of this size nothing is known */
    const void *self;
    imp_model (*radius)(const void *self, imp_model phase);
    double (*slope_upper)(const void *self, imp_interval phase); /* >= |R'| there */
} coil;

static inline double coil_size_upper(near_constant k)
{
    return imp_sum_up(fabs(k.value) + k.error);
}

static inline double coil_hypot_upper(double x, double y)
{
    return imp_round_up(sqrt(imp_sum_up(imp_round_up(x * x) + imp_round_up(y * y))));
}

/* S at most, for ways no longer than `way` from points with these phases, on which q >= least >
 * 0. */
static inline double coil_steepness_upper(const coil *c, imp_interval phase, double way,
                                          double least)
{
    const double around = coil_size_upper(c->around);
    const double twist = coil_hypot_upper(coil_size_upper(c->along), imp_round_up(around / least));
    const double more = imp_round_up(way * twist);
    const imp_interval near = imp_interval_add(phase, imp_interval_make(-more, more));
    if (!(imp_interval_mag(near) <= c->far)) return INFINITY;
    return coil_hypot_upper(1, imp_round_up(c->slope_upper(c->self, near) * twist));
}

/* A factor that makes F a distance. Lemma. Let |F| <= most and q >= nearest for all points p, and h
 * = m / 2. With q >= (nearest + m - most) / 2 all the way the factor may be 1 / S. And where d <=
 * h, q >= h all the way; where d > h, a factor of h / most or less leaves |F| below d. */
static inline double coil_factor_lower(const coil *c, imp_interval phase, double most,
                                       double nearest)
{
    const double half = 0.5 * c->root;
    const double least = 0.5 * imp_sum_down(imp_sum_down(nearest + c->root) - most);
    const double way = imp_smaller(most, half);
    double open = 0, limited = inverse_lower(coil_steepness_upper(c, phase, way, half));
    if (least > 0) open = imp_larger(inverse_lower(coil_steepness_upper(c, phase, most, least)), 0);
    if (most > half) limited = imp_smaller(imp_round_down(half / most), limited);
    return imp_larger(limited, open);
}

/* The angle about the axis, off by whole turns. Lemma. With (c, r) any vector but 0, (x', y') = (x
 * c + y r, y c - x r) has the angle of (x, y) less that of (c, r), and |(c, r)| q as its length. */
static inline imp_model coil_angle(const imp_model m[2], imp_model q)
{
    const double size = imp_larger(fabs(m[0].a), fabs(m[1].a));
    const double c = m[0].a / size, r = m[1].a / size;
    const imp_model ahead = imp_add(imp_scale(m[0], c), imp_scale(m[1], r));
    const imp_model aside = imp_sub(imp_scale(m[1], c), imp_scale(m[0], r));
    if (!(ahead.lo > 0 && q.lo > 0)) return imp_unbounded(7);
    const imp_model length = imp_sqrt(imp_add(imp_sqr(imp_num(c)), imp_sqr(imp_num(r))));
    return imp_add(imp_asin(imp_div(aside, imp_mul(q, length))), imp_atan2(imp_num(r), imp_num(c)));
}

/* What a model claims at least, as a distance. */
static inline double coil_claim_lower(const imp_model *g) { return imp_larger(g->lo, -g->hi); }

/* A distance by the cylinders on which the crests and the roots lie. Lemma. Every y of the coil has
 * root <= q_y <= crest, and no point is nearer to another than their q differ. So where all points
 * have q >= crest, q - crest is a distance, and where all have q <= root, root - q is. */
static inline imp_model coil_beyond(const coil *c, imp_model square)
{
    if (square.lo >= imp_round_up(c->crest * c->crest)) return beyond_radius(square, c->crest);
    if (square.hi <= imp_round_down(c->root * c->root)) return beyond_radius(square, c->root);
    return imp_num(0);
}

/* F as a distance. */
static inline imp_model coil_flank(const coil *c, const imp_model m[2], imp_model q, imp_model z)
{
    const imp_model turn = near_scale(coil_angle(m, q), c->around);
    const imp_model phase = near_shift(imp_sub(turn, near_scale(z, c->along)), c->offset);
    if (!(imp_interval_mag(imp_model_range(&phase)) <= c->far)) return imp_unbounded(7);
    const imp_model f = imp_sub(q, c->radius(c->self, phase));
    const double most = imp_interval_mag(imp_model_range(&f));
    if (!(most < INFINITY)) return imp_unbounded(7);
    return imp_scale(f, coil_factor_lower(c, imp_model_range(&phase), most, q.lo));
}

/* A distance from the coil of a point with these coordinates, z along the axis: the one of both
 * that claims more. */
static inline imp_model coil_gap(const coil *c, imp_model x, imp_model y, imp_model z)
{
    const imp_model m[2] = {x, y}, square = sum_of_squares(m, 2);
    const imp_model beyond = coil_beyond(c, square), flank = coil_flank(c, m, imp_sqrt(square), z);
    return coil_claim_lower(&beyond) > imp_larger(coil_claim_lower(&flank), 0) ? beyond : flank;
}

#endif
