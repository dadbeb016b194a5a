/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/round_profile.h"

#include "plugins/patch/bernstein.h"

#include <impinge/interval.h>
#include <stdbool.h>

enum { POINTS_MAX = 21 };

/* Control points (q, z), q = r, or q = -r where no r is positive. */
typedef struct outline_points {
    int degree;
    double q[POINTS_MAX], z[POINTS_MAX], weight[POINTS_MAX];
    double size;    /* the largest extent; length */
    bool is_beside; /* all q >= 0: the curve, in the hull of these points, is the section itself */
} outline_points;

static outline_points points_of(const double *points, const double *weights, size_t count)
{
    outline_points c = {.degree = (int)count - 1};
    double most = 0, least = 0, low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < count; ++k) {
        most = imp_larger(points[2 * k], most);
        least = imp_smaller(points[2 * k], least);
        low = imp_smaller(points[2 * k + 1], low);
        high = imp_larger(points[2 * k + 1], high);
    }
    c.is_beside = least >= 0 || most <= 0;
    c.size = imp_larger(imp_larger(most, -least), high - low);
    for (size_t k = 0; k < count; ++k) {
        c.q[k] = most <= 0 ? -points[2 * k] : points[2 * k];
        c.z[k] = points[2 * k + 1];
        c.weight[k] = weights != NULL ? weights[k] : 1;
    }
    return c;
}

/* x - y, of two doubles. */
static imp_interval difference(double x, double y)
{
    return imp_interval_sub(imp_interval_make(x, x), imp_interval_make(y, y));
}

static imp_interval number(double x) { return imp_interval_make(x, x); }

/* --- Lines ------------------------------------------------------------------------------------ */

/* How far the control point (q, z) is from the half line |h| q = r y, y >= 0 of a cone, with the y
 * of cone_distance, at most: for y >= 0 it is | |h| q - r y| / |h| from the half line's point as
 * high, and that by r from its point as far from the axis; else it is some way from the apex. */
static double cone_off(const round_profile *line, double q, double z)
{
    const imp_interval h = number(line->apex), r = number(line->radius);
    const imp_interval below = imp_interval_sub(h, difference(z, line->height));
    const imp_interval y = line->apex > 0 ? below : imp_interval_neg(below);
    const imp_interval apart =
        imp_interval_sub(imp_interval_mul(imp_interval_abs(h), number(q)), imp_interval_mul(r, y));
    const imp_interval wide = number(imp_larger(fabs(line->apex), line->radius));
    const imp_interval to_apex = imp_interval_add(imp_interval_abs(number(q)), imp_interval_abs(y));
    return imp_interval_mag(y.lo >= 0 ? imp_interval_div(apart, wide) : to_apex);
}

/* How far the control point (q, z) is from the line, at most. */
static double line_off(const round_profile *line, double q, double z)
{
    if (line->kind == ROUND_CYLINDER) return imp_interval_mag(difference(q, line->radius));
    if (line->kind == ROUND_PLANE) return imp_interval_mag(difference(z, line->height));
    return cone_off(line, q, z);
}

/* Lemma. The weights are positive, so that the curve is in the convex hull of its control points.
 * The distance from a line or a half line is a convex function: on the curve it is no greater than
 * its greatest at these. */
static double lines_off(const outline_points *c, const round_profile *line)
{
    double most = 0;
    for (int k = 0; k <= c->degree; ++k) {
        const double off = line_off(line, c->q[k], c->z[k]);
        if (!(off <= most)) most = off;
    }
    return most;
}

/* The line through both ends, of any of the kinds. */
static round_profile line_of(const outline_points *c, round_kind kind)
{
    const int n = c->degree, base = c->q[0] >= c->q[n] ? 0 : n;
    const double rise = c->z[n] - c->z[0], widening = c->q[n] - c->q[0];
    round_profile line = {.kind = kind, .radius = c->q[base], .height = c->z[base]};
    if (kind == ROUND_CONE) line.apex = -line.radius * (rise / widening);
    line.off = lines_off(c, &line);
    const bool sane = kind == ROUND_PLANE || (c->is_beside && line.radius > 0);
    if (!sane || (kind == ROUND_CONE && !(fabs(line.apex) > 0))) line.off = INFINITY;
    return line;
}

/* --- Circles ---------------------------------------------------------------------------------- */

/* The point of the curve at s, by de Casteljau's scheme; not rounded outward. */
static void curve_point(const outline_points *c, double s, double at[2])
{
    double x[POINTS_MAX], y[POINTS_MAX], w[POINTS_MAX];
    for (int k = 0; k <= c->degree; ++k) {
        w[k] = c->weight[k];
        x[k] = w[k] * c->q[k];
        y[k] = w[k] * c->z[k];
    }
    for (int n = c->degree; n > 0; --n)
        for (int k = 0; k < n; ++k) {
            x[k] += s * (x[k + 1] - x[k]);
            y[k] += s * (y[k + 1] - y[k]);
            w[k] += s * (w[k + 1] - w[k]);
        }
    at[0] = x[0] / w[0];
    at[1] = y[0] / w[0];
}

/* Lemma. Let the curve be p = c + X / W, X = sum B_i w_i (P_i - c), W = sum B_i w_i. Products of
 * Bernstein polynomials are multiples of those of twice the degree: |X|^2 - R^2 W^2 and W^2 have
 * coefficients g_k / C(2n, k), h_k / C(2n, k), of which
 *
 *   g_k = sum_(i + j = k) C(n, i) C(n, j) w_i w_j ((P_i - c).(P_j - c) - R^2),
 *
 * and h_k > 0 is that sum without its last factor. So ||p - c|^2 - R^2| is at most the greatest
 * |g_k| / h_k, and ||p - c| - R| is that divided by |p - c| + R >= R, at most. */
static double circle_off(const outline_points *c, const round_profile *circle)
{
    const imp_interval square = imp_interval_sqr(number(circle->radius));
    double most = 0;
    for (int k = 0; k <= 2 * c->degree; ++k) {
        imp_interval g = number(0), h = number(0);
        for (int i = k > c->degree ? k - c->degree : 0; i <= k && i <= c->degree; ++i) {
            const int j = k - i;
            const imp_interval across = imp_interval_mul(difference(c->q[i], circle->ring),
                                                         difference(c->q[j], circle->ring));
            const imp_interval along = imp_interval_mul(difference(c->z[i], circle->height),
                                                        difference(c->z[j], circle->height));
            const imp_interval share =
                imp_interval_scale(imp_interval_mul(number(c->weight[i]), number(c->weight[j])),
                                   bernstein_choose(c->degree, i) * bernstein_choose(c->degree, j));
            const imp_interval beyond = imp_interval_sub(imp_interval_add(across, along), square);
            g = imp_interval_add(g, imp_interval_mul(share, beyond));
            h = imp_interval_add(h, share);
        }
        const double off = imp_interval_mag(imp_interval_div(g, h));
        if (!(off <= most)) most = off;
    }
    return imp_round_up(most / circle->radius);
}

/* The circle through three points of the curve. */
static round_profile circle_through(const outline_points *c, const double at[3])
{
    double p[3][2];
    for (int k = 0; k < 3; ++k) curve_point(c, at[k], p[k]);
    const double x = p[1][0] - p[0][0], y = p[1][1] - p[0][1], v = p[2][0] - p[0][0],
                 w = p[2][1] - p[0][1], twice = 2 * (x * w - y * v);
    const double first = x * x + y * y, second = v * v + w * w;
    const double across = (w * first - y * second) / twice,
                 along = (x * second - v * first) / twice;
    round_profile circle = {.kind = ROUND_CIRCLE, .ring = p[0][0] + across};
    circle.height = p[0][1] + along;
    circle.radius = sqrt(across * across + along * along);
    if (fabs(circle.ring) <= ROUND_OFF_LEAST * circle.radius) circle.ring = 0;
    const bool sane = circle.radius > 0 && (c->is_beside || circle.ring == 0);
    circle.off = sane ? circle_off(c, &circle) : INFINITY;
    return circle;
}

/* --- The profile ------------------------------------------------------------------------------ */

round_profile round_profile_of(const double *points, const double *weights, size_t count)
{
    static const double open[3] = {0, 0.5, 1}, closed[3] = {0, 1. / 3, 2. / 3};
    const outline_points c = points_of(points, weights, count);
    const round_profile tried[] = {line_of(&c, ROUND_CYLINDER), line_of(&c, ROUND_PLANE),
                                   line_of(&c, ROUND_CONE), circle_through(&c, open),
                                   circle_through(&c, closed)};
    round_profile best = {.kind = ROUND_NONE, .off = INFINITY};
    for (size_t k = 0; k < sizeof tried / sizeof *tried; ++k) {
        const double least = ROUND_OFF_LEAST * c.size;
        if (best.off > least && tried[k].off < best.off) best = tried[k];
    }
    return best.off <= ROUND_OFF_MOST * c.size ? best : (round_profile){.kind = ROUND_NONE};
}

void round_profile_widen(round_profile *p, const double *points, const double *weights,
                         size_t count)
{
    const outline_points c = points_of(points, weights, count);
    const bool is_circle = p->kind == ROUND_CIRCLE;
    const bool may_cross = p->kind == ROUND_PLANE || (is_circle && p->ring == 0);
    const double off = is_circle ? circle_off(&c, p) : lines_off(&c, p);
    if (!(off <= p->off)) p->off = off;
    if (!c.is_beside && !may_cross) p->off = INFINITY;
}
