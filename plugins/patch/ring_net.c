/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/ring_net.h"

#include <string.h>

/* Nets that reach farther than this many radii are not examined. */
#define ROUND_NET_WIDE 0x1p20

enum { SIDE_MAX = RING_DEGREE_MOST + 1 };

/* --- Coordinates in the frame ----------------------------------------------------------------- */

static imp_interval coordinate(const near_constant k[3], const imp_interval w[3])
{
    imp_interval sum = number(0);
    for (int i = 0; i < 3; ++i) {
        const imp_interval part =
            imp_interval_add(number(k[i].value), imp_interval_make(-k[i].error, k[i].error));
        sum = imp_interval_add(sum, imp_interval_mul(part, w[i]));
    }
    return sum;
}

void ring_in_frame(const ring_place *r, const double *point, imp_interval out[3])
{
    imp_interval w[3];
    for (int i = 0; i < 3; ++i) w[i] = imp_interval_sub(number(point[i]), number(r->center[i]));
    out[0] = coordinate(r->frame.a, w);
    out[1] = coordinate(r->frame.b, w);
    out[2] = coordinate(r->frame.k, w);
}

static void middle_in_frame(const ring_place *r, const double *point, double out[3])
{
    imp_interval w[3];
    ring_in_frame(r, point, w);
    for (int i = 0; i < 3; ++i) out[i] = imp_interval_mid(w[i]);
}

/* --- Rings of control points ----------------------------------------------------------------- */

void ring_point(const ring_net *n, size_t j, double part, double out[3])
{
    const knots *k = n->ring;
    const double lo = knots_lo(k), u = lo + part * (knots_hi(k) - lo);
    const size_t span = knots_span(k, u), first = k->last[span] - (size_t)k->degree;
    double basis[SIDE_MAX], sum = 0;
    knots_basis(k, span, u, basis);
    memset(out, 0, 3 * sizeof *out);
    for (size_t i = 0; i <= (size_t)k->degree; ++i) {
        const double share = basis[i] * weight_of(n, first + i, j);
        sum += share;
        for (size_t axis = 0; axis < 3; ++axis)
            out[axis] += share * n->points[3 * index_of(n, first + i, j) + axis];
    }
    for (int axis = 0; axis < 3; ++axis) out[axis] /= sum;
}

size_t ring_widest(const ring_net *n)
{
    double most = -1;
    size_t widest = 0;
    for (size_t j = 0; j < n->profile->count; ++j) {
        double sum = 0;
        for (size_t i = 1; i < n->ring->count; ++i)
            sum += apart(n->points + 3 * index_of(n, i, j), n->points + 3 * index_of(n, 0, j));
        if (!(sum > most)) continue;
        most = sum;
        widest = j;
    }
    return widest;
}

/* --- Curves of one side ----------------------------------------------------------------------- */

void ring_control(const ring_net *n, size_t i, double out[3])
{
    double w[3];
    middle_in_frame(n->at, n->points + 3 * index_of(n, i, n->widest), w);
    out[0] = w[0] / n->radius;
    out[1] = w[1] / n->radius;
    out[2] = weight_of(n, i, n->widest);
}

void ring_profile_control(const ring_net *n, size_t j, double out[3])
{
    double share = 0, square = 0, height = 0;
    for (size_t i = 0; i < n->ring->count; ++i) {
        double w[3], unit[3];
        middle_in_frame(n->at, n->points + 3 * index_of(n, i, j), w);
        ring_control(n, i, unit);
        share += w[0] * unit[0] + w[1] * unit[1];
        square += unit[0] * unit[0] + unit[1] * unit[1];
        height += w[2];
    }
    const double q = share / square;
    out[0] = fabs(q) > ROUND_NET_ZERO * n->radius ? q : 0;
    out[1] = height / (double)n->ring->count;
    out[2] = weight_of(n, 0, j) / weight_of(n, 0, n->widest);
}

/* Bezier control points of a span, x and y of each, and their weights. Returns the greatest |x| +
 * |y| of a control point. */
static double span_points(const ring_net *n, const knots *k, size_t span, control_point *control,
                          double *points, double *weights)
{
    const int degree = k->degree;
    const size_t first = k->last[span] - (size_t)degree;
    double given[SIDE_MAX][3], matrix[SIDE_MAX * SIDE_MAX], most = 0;
    for (int i = 0; i <= degree; ++i) {
        control(n, first + (size_t)i, given[i]);
        most = imp_larger(most, imp_sum_up(fabs(given[i][0]) + fabs(given[i][1])));
    }
    knots_extract(k, span, matrix);
    for (int i = 0; i <= degree; ++i) {
        double sum[3] = {0};
        for (int j = 0; j <= degree; ++j) {
            const double share = matrix[i * (degree + 1) + j] * given[j][2];
            sum[0] += share * given[j][0];
            sum[1] += share * given[j][1];
            sum[2] += share;
        }
        points[2 * i] = sum[0] / sum[2];
        points[2 * i + 1] = sum[1] / sum[2];
        weights[i] = sum[2];
    }
    return most;
}

/* Takes a span of the curve into a profile, or makes one of it. Returns span_points. */
static double take_span(const ring_net *n, const knots *k, size_t span, control_point *control,
                        round_profile *p)
{
    double points[2 * SIDE_MAX], weights[SIDE_MAX];
    const size_t count = (size_t)k->degree + 1;
    const double most = span_points(n, k, span, control, points, weights);
    if (p->kind == ROUND_NONE)
        *p = round_profile_of(points, weights, count);
    else
        round_profile_widen(p, points, weights, count);
    return most;
}

/* Lemma. The matrix is within 5 p units of itself, p the degree. The computed weights of a span are
 * within 6 p + 2 units, and its points within 12 p + 6 units of X, the greatest |x| + |y|. Control
 * points whose weights change by factors from r to R move a curve by at most R / r - 1 of their
 * diameter: x - x' = sum (b_k - b'_k) (P_k - x'), sum b_k = sum b'_k = 1, |b_k - b'_k| <= (R / r -
 * 1) b'_k. In all that is less than (12 p + 6 + 2 (12 p + 5)) units of X <= 736 units < 2^-43. */
bool ring_take_curve(const ring_net *n, const knots *k, control_point *control, round_profile *p)
{
    double most = 0;
    for (size_t span = 0; span < k->spans; ++span) {
        most = imp_larger(most, take_span(n, k, span, control, p));
        if (p->kind == ROUND_NONE || !(p->off < INFINITY)) return false;
    }
    p->off = imp_sum_up(p->off + 0x1p-43 * most);
    return true;
}

/* Lemma. The ends of a span are points of the curve, known within 2^-43 X (ring_take_curve), X the
 * greatest |x| + |y| of a control point; roundings here are below 2^-52 X. */
double ring_half_size_lower(const ring_net *n)
{
    double points[2 * SIDE_MAX], weights[SIDE_MAX], wide = 0, low = INFINITY, high = -INFINITY;
    for (size_t span = 0; span < n->profile->spans; ++span) {
        const double most = span_points(n, n->profile, span, ring_profile_control, points, weights);
        for (int k = 0; k < 2; ++k) {
            const double *end = points + 2 * (size_t)(k * n->profile->degree);
            const double off = 0x1p-42 * most;
            wide = imp_larger(wide, fabs(end[0]) - off);
            low = imp_smaller(low, end[1] + off);
            high = imp_larger(high, end[1] - off);
        }
    }
    return imp_larger(wide, 0.5 * (high - low));
}

/* --- What the net is off by ------------------------------------------------------------------- */

double ring_product_off(const ring_net *n, double *reach)
{
    double off = 0, low = INFINITY, high = 0, size = 0;
    for (size_t j = 0; j < n->profile->count; ++j) {
        double outer[3];
        ring_profile_control(n, j, outer);
        *reach = imp_larger(*reach, fabs(outer[0]));
        for (size_t i = 0; i < n->ring->count; ++i) {
            double unit[3];
            imp_interval w[3];
            ring_control(n, i, unit);
            ring_in_frame(n->at, n->points + 3 * index_of(n, i, j), w);
            double beside = 0, extent = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const imp_interval product =
                    axis == 2 ? number(outer[1])
                              : imp_interval_mul(number(outer[0]), number(unit[axis]));
                beside = imp_sum_up(beside + imp_interval_mag(imp_interval_sub(w[axis], product)));
                extent = imp_sum_up(extent + imp_interval_mag(w[axis]));
            }
            if (!(extent <= ROUND_NET_WIDE * n->radius)) return INFINITY;
            off = imp_larger(off, beside);
            size = imp_larger(size, extent);
            const imp_interval ratio = imp_interval_div(
                number(weight_of(n, i, j)), imp_interval_mul(number(outer[2]), number(unit[2])));
            low = imp_smaller(low, ratio.lo);
            high = imp_larger(high, ratio.hi);
        }
    }
    const imp_interval spread =
        imp_interval_sub(imp_interval_div(number(high), number(low)), number(1));
    return imp_sum_up(off + imp_round_up(2 * size * imp_interval_mag(spread)));
}

/* --- Whether curves go around ----------------------------------------------------------------- */

static double plane_dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

/* Returns >= the angle between a and b if that is small; INFINITY: it is not. */
static double small_angle(const double a[2], const double b[2])
{
    const double sine = a[0] * b[1] - a[1] * b[0], cosine = plane_dot(a, b);
    return fabs(sine) <= 0x1p-20 * cosine ? 1.001 * fabs(sine) / cosine : INFINITY;
}

/* Whether a span's points, `most` in size, are all surely on the side of 0 on which its ends
 * are. */
static bool is_beside_zero(const double *points, int degree, double most)
{
    const double *a = points, *b = points + 2 * (size_t)degree;
    const double of_a = sqrt(plane_dot(a, a)), of_b = sqrt(plane_dot(b, b));
    const double to[2] = {a[0] / of_a + b[0] / of_b, a[1] / of_a + b[1] / of_b};
    bool all = of_a >= 0x1p-10 * most && of_b >= 0x1p-10 * most;
    for (int i = 0; i <= degree; ++i)
        all = all && plane_dot(to, points + 2 * (size_t)i) >= 0x1p-10 * most;
    return all;
}

/* Lemma. A span's Bezier points are known within 2^-43 X (ring_take_curve), X the greatest |x| +
 * |y| of a control point. If all have a product with one vector no longer than 2 that is >= 2^-10
 * X, the true ones, and so the span, are in an open half plane beside 0. Then its direction, which
 * is continuous, passes all between those of its ends, and has turned by their angle. The ends are
 * 2^-10 X from 0 at least, and off by 2^-33 ... 2^-43 X / |end| in direction; that is added to
 * each gap, once for either side. */
ring_sweep ring_sweep_of(const ring_net *n, const knots *k, control_point *control)
{
    ring_sweep s = {.gap = 0};
    double points[2 * SIDE_MAX], weights[SIDE_MAX];
    for (size_t span = 0; span < k->spans; ++span) {
        const double *a = points, *b = points + 2 * (size_t)k->degree;
        const double most = span_points(n, k, span, control, points, weights);
        if (!is_beside_zero(points, k->degree, most)) s.gap = INFINITY;
        const double near = imp_smaller(sqrt(plane_dot(a, a)), sqrt(plane_dot(b, b)));
        const double between = span > 0 ? small_angle(s.last, a) : 0;
        s.gap = imp_larger(s.gap, imp_sum_up(between + 0x1p-41 * most / near));
        s.angle += atan2(a[0] * b[1] - a[1] * b[0], plane_dot(a, b));
        if (span == 0) memcpy(s.first, a, sizeof s.first);
        memcpy(s.last, b, sizeof s.last);
    }
    if (!(s.gap <= 0x1p-20) || k->spans > 0x1000) s.gap = INFINITY;
    return s;
}

/* Lemma. The spans' directions, and short arcs from one's end to the next one's start, make a
 * closed path on the circle. It goes around a whole number of times; the spans turn by more than
 * 6, and all arcs by 2^12 2^-20 at most, so that this is not 0: the path passes each direction.
 * Those of the arcs are within a gap of an end. */
double ring_gap(const ring_sweep *s)
{
    const double last = small_angle(s->last, s->first);
    return fabs(s->angle) > 6 && last <= 0x1p-20 ? imp_sum_up(s->gap + last) : INFINITY;
}

/* Lemma. A path from one half of the second axis to the other, or from nearby, that turns
 * by more than 3 and less than 4, so by about pi, passes each direction on one side of the axis but
 * for those nearby. */
double ring_half_gap(const ring_sweep *s)
{
    const double first[2] = {0, s->first[1] > 0 ? 1 : -1}, last[2] = {0, -first[1]};
    const double off = imp_larger(small_angle(first, s->first), small_angle(last, s->last));
    const double turned = fabs(s->angle);
    return turned > 3 && turned < 4 && off <= 0x1p-20 ? imp_sum_up(s->gap + off) : INFINITY;
}
