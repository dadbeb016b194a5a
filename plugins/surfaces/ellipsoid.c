/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/common/squares.h"

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { RADII, CENTER };

static const imp_parameter parameters[] = {
    [RADII] =
        IMP_ROW_POSITIVE_VECTOR("radii", "length", "[1,0.75,0.5]", "half axes along x, y and z"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct ellipsoid_instance {
    double radii[3], center[3];
} ellipsoid_instance;

static imp_status ellipsoid_fill(ellipsoid_instance *s, const imp_value *values,
                                 imp_create_error *why)
{
    (void)why;
    imp_copy_vector(s->radii, &values[RADII]);
    imp_copy_vector(s->center, &values[CENTER]);
    return IMP_STATUS_OK;
}
IMP_CREATE_AND_RENEW(ellipsoid, ellipsoid_instance)

static void ellipsoid_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -IMP_HALF_PI_UPPER, IMP_HALF_PI_UPPER);
}

static void ellipsoid_formula(const void *self, imp_model u, imp_model v, imp_model t,
                              imp_model out[3])
{
    const ellipsoid_instance *s = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    out[0] = imp_shift(imp_scale(imp_mul(cos_v, cos_u), s->radii[0]), s->center[0]);
    out[1] = imp_shift(imp_scale(imp_mul(cos_v, sin_u), s->radii[1]), s->center[1]);
    out[2] = imp_shift(imp_scale(sin_v, s->radii[2]), s->center[2]);
}
IMP_SURFACE_FORMULA(ellipsoid_formula)

/* --- By the gradient -------------------------------------------------------------------------- */

/* At least ||q| - 1|, where the range of |q|^2 is known. */
static double off_upper(const imp_model *square)
{
    const double above = imp_sum_up(greatest_root_upper(square) - 1);
    const double below =
        imp_sum_up(1 - imp_larger(imp_round_down(sqrt(imp_larger(square->lo, 0))), 0));
    return imp_larger(above, below);
}

/* A factor that makes |q| - 1 a distance, q = D^-1 x, D = diag(radii), x from the centre. Lemma.
 * |q| - 1 is 0 on the surface, and |grad |q|| = |D^-1 q| / |q|, which is at most 1 / b, b the least
 * radius: the factor may be b. Let d be how far x is from the surface, y the nearest point of it,
 * and a the greatest radius. x / |q| lies on the surface, so that d <= a ||q| - 1|. From x to y, q
 * changes by d / b at most, and D^-1 q by d / b^2. With |q| >= least, |D^-1 q| <= steep and ||q| -
 * 1| <= off for all points, the gradient is at most
 *
 *   S = (steep + a off / b^2) / (least - a off / b)
 *
 * all the way where that is positive, and the factor may be 1 / S. */
static double factor_lower(const ellipsoid_instance *s, const imp_model q[3],
                           const imp_model *square)
{
    const double a = imp_larger(imp_larger(s->radii[0], s->radii[1]), s->radii[2]);
    const double b = imp_smaller(imp_smaller(s->radii[0], s->radii[1]), s->radii[2]);
    const double change = imp_round_up(imp_round_up(a * off_upper(square)) / b);
    const double root = imp_larger(imp_round_down(sqrt(imp_larger(square->lo, 0))), 0);
    const double least = imp_sum_down(root - change);
    imp_model slope[3];
    for (int i = 0; i < 3; ++i) slope[i] = imp_div(q[i], imp_num(s->radii[i]));
    const imp_model slopes = sum_of_squares(slope, 3);
    const double steep = imp_sum_up(greatest_root_upper(&slopes) + imp_round_up(change / b));
    const double found = least > 0 ? imp_round_down(least / steep) : 0;
    return imp_larger(found, b);
}

/* --- By a confocal quadric -------------------------------------------------------------------- */

/* The m for which the bound below is best at x: where its derivative by m, 1 - sum a^2 x^2 / (a^2 -
 * m)^2, is 0. It begins where the normal at x / |q| comes to x, and takes steps of Newton. Any m
 * below all a^2 is right. */
static double choose_m(const ellipsoid_instance *s, const double x[3])
{
    double length = 0, slope = 0, limit = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const double a = s->radii[i], q = x[i] / a;
        length += q * q;
        slope += q * q / (a * a);
        limit = imp_smaller(limit, 0.875 * (a * a));
    }
    double m = imp_smaller((1 - sqrt(length)) * length / slope, limit);
    for (int step = 0; step < 2; ++step) {
        double rise = 1, bend = 0;
        for (int i = 0; i < 3; ++i) {
            const double a = s->radii[i], room = a * a - m, w = a * x[i] / room;
            rise -= w * w;
            bend += 2 * w * w / room;
        }
        m = imp_smaller(m + rise / bend, limit);
    }
    return m;
}

/* What a^2 - m is divided into, rounded so that it is no better a bound: a double w with w^2 (a^2 -
 * m) >= 1 for m > 0, <= 1 for m < 0, if a^2 does not overflow. Roundings of w: square 1 and
 * difference 1, halved by the root, root 1, quotient 1; the difference is at least a^2 / 8, so that
 * what the square's rounding does to it counts 8 times. */
static double weight(double a, double m)
{
    const double w = 1 / sqrt(a * a - m);
    return m > 0 ? w * (1 + 0x1p-49) : w * (1 - 0x1p-49);
}

/* A bound of the distance of points near those that x stands for; false: none is found. Lemma. For
 * y on the surface, sum y^2 / a^2 = 1, and any m < a^2, m not 0, 1 / m = l:
 *
 *   m > 0:  l |x - y|^2 - sum y^2 / a^2 >= -sum x^2 / (a^2 - m),
 *   m < 0: -l |x - y|^2 + sum y^2 / a^2 >=  sum x^2 / (a^2 - m),
 *
 * the least values over all y of space, each a sum of convex parabolas. So |x - y|^2 >= G = m (1 -
 * sum x^2 / (a^2 - m)). Equality holds at x = y (1 - m / a^2), coordinate by coordinate, on the
 * normal at y. With L^2 <= G <= Q^2 and 0 < L, |x - y| >= L + (G - L^2) / (L + Q), the chord of the
 * root, and any smaller factor will do. */
static bool confocal_gap(const ellipsoid_instance *s, const imp_model x[3], imp_model *gap)
{
    const double middle[3] = {x[0].a, x[1].a, x[2].a}, m = choose_m(s, middle);
    imp_model scaled[3];
    const double most_radius = imp_larger(imp_larger(s->radii[0], s->radii[1]), s->radii[2]);
    if (!(most_radius < 0x1p500 && fabs(m) > 0x1p-200 && fabs(m) < 0x1p200)) return false;
    for (int i = 0; i < 3; ++i) scaled[i] = imp_scale(x[i], weight(s->radii[i], m));
    const imp_model one = imp_num(1), left = imp_sub(one, sum_of_squares(scaled, 3));
    const imp_model square = imp_scale(left, m);
    if (!(square.lo > 0)) return false;
    const double least = imp_round_down(sqrt(square.lo)), most = greatest_root_upper(&square);
    if (!(most <= 2 * least)) return false;
    const double factor = imp_larger(inverse_lower(imp_sum_up(most + least)), 0);
    const imp_model beyond = imp_scale(imp_sub(square, imp_sqr(imp_num(least))), factor);
    *gap = imp_add(beyond, imp_num(least));
    if (m > 0) *gap = imp_neg(*gap);
    return true;
}

/* --- Both ------------------------------------------------------------------------------------- */

static imp_model ellipsoid_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    const ellipsoid_instance *s = self;
    const imp_model at[3] = {x, y, z};
    imp_model from[3], q[3], gap;
    (void)t;
    for (int i = 0; i < 3; ++i) from[i] = imp_shift(at[i], -s->center[i]);
    if (confocal_gap(s, from, &gap)) return gap;
    for (int i = 0; i < 3; ++i) q[i] = imp_div(from[i], imp_num(s->radii[i]));
    const imp_model square = sum_of_squares(q, 3);
    return imp_scale(beyond_radius(square, 1), factor_lower(s, q, &square));
}
IMP_DISTANCE_FORMULA(ellipsoid_gap)

/* Names the symmetry of a ball, or of revolution, where radii are equal. */
static imp_status ellipsoid_symmetry(const void *self, imp_symmetry *symmetry)
{
    const ellipsoid_instance *s = self;
    const double *r = s->radii;
    memcpy(symmetry->center, s->center, sizeof s->center);
    symmetry->is_closed = IMP_SYMMETRY_CLOSED;
    symmetry->kind =
        r[0] == r[1] && r[1] == r[2] ? IMP_SYMMETRY_ABOUT_POINT : IMP_SYMMETRY_ABOUT_LINE;
    for (int i = 0; i < 3; ++i)
        if (r[(i + 1) % 3] == r[(i + 2) % 3]) {
            symmetry->axis[i] = 1;
            if (i == 2) symmetry->is_closed |= IMP_SYMMETRY_ORBIT_U;
            return IMP_STATUS_OK;
        }
    return IMP_STATUS_UNBOUNDED;
}

static const imp_surface_type ellipsoid = {
    IMP_SURFACE_FIELDS(ellipsoid, ellipsoid_formula),
    .renew = ellipsoid_renew,
    .distance = ellipsoid_gap_distance,
    .symmetry = ellipsoid_symmetry,
    .summary = "ellipsoid with its axes along x, y and z",
    .equation = "center + (a cos v cos u, b cos v sin u, c sin v), radii = [a,b,c], u in [0,2pi], "
                "v in [-pi/2,pi/2]",
    .source = NULL,
    .formula = "u in [0, 2*pi]; v in [-pi/2, pi/2]; center0 + radii0*cos(v)*cos(u); center1 + "
               "radii1*cos(v)*sin(u); center2 + radii2*sin(v)",
    .example = "ellipsoid radii=1,2,3",
};

PUBLISH_SURFACE(ellipsoid);
