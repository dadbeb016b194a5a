/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/round_net.h"

#include <impinge/interval.h>
#include <stdbool.h>
#include <string.h>

/* A surface farther than this part of its size from a plane, or a ring of control points from a
 * circle, is no plane and no circle; a profile may be as far off as round_profile.c permits. */
#define ROUND_NET_OFF_MOST 0x1p-30

/* Coordinates of axes and centers that are smaller, by this part of the whole, are rounding. */
#define ROUND_NET_ZERO 0x1p-45

/* Nets of other sizes, or that reach farther than this many radii, are not examined: squares and
 * their squares, and all intervals, are finite, so that there is no NaN. */
#define ROUND_NET_LEAST 1e-50
#define ROUND_NET_MOST 1e50
#define ROUND_NET_WIDE 0x1p20

enum { SIDE_MAX = 21 };

static bool has_size(double x) { return x >= ROUND_NET_LEAST && x <= ROUND_NET_MOST; }

/* A net by rings, rows of control points along one side, one for each control point of the other
 * side, the profile. */
typedef struct ring_net {
    const knots *ring, *profile;
    const double *points, *weights;
    size_t ring_step, profile_step; /* between neighbours, in control points */
    size_t widest;                  /* the ring whose points lie farthest from its first */
    double radius;                  /* of that ring; length */
    const round_net *at;            /* center and frame */
} ring_net;

static size_t index_of(const ring_net *n, size_t i, size_t j)
{
    return i * n->ring_step + j * n->profile_step;
}

static double weight_of(const ring_net *n, size_t i, size_t j)
{
    return n->weights != NULL ? n->weights[index_of(n, i, j)] : 1;
}

static imp_interval number(double x) { return imp_interval_make(x, x); }

/* --- Vectors, not rounded outward ------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double apart(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(d, d));
}

/* Sets center, axis and frame. The axis is made to point to the positive side of the coordinate
 * that is its greatest. False: it has no length. */
static bool place(round_net *r, const double center[3], const double axis[3], double size)
{
    const double length = sqrt(dot(axis, axis));
    imp_model along[3];
    int greatest = 0;
    if (!(length > 0 && length < INFINITY)) return false;
    for (int i = 1; i < 3; ++i)
        if (fabs(axis[i]) > fabs(axis[greatest])) greatest = i;
    for (int i = 0; i < 3; ++i) {
        const double part = axis[i] / (axis[greatest] < 0 ? -length : length);
        r->axis[i] = fabs(part) > ROUND_NET_ZERO ? part : 0;
        r->center[i] = fabs(center[i]) > ROUND_NET_ZERO * size ? center[i] : 0;
        along[i] = imp_num(r->axis[i]);
    }
    r->frame = frame_about(along);
    return true;
}

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

/* A point's exact coordinates along the frame, from the center. */
static void in_frame(const round_net *r, const double *point, imp_interval out[3])
{
    imp_interval w[3];
    for (int i = 0; i < 3; ++i) w[i] = imp_interval_sub(number(point[i]), number(r->center[i]));
    out[0] = coordinate(r->frame.a, w);
    out[1] = coordinate(r->frame.b, w);
    out[2] = coordinate(r->frame.k, w);
}

static void middle_in_frame(const round_net *r, const double *point, double out[3])
{
    imp_interval w[3];
    in_frame(r, point, w);
    for (int i = 0; i < 3; ++i) out[i] = imp_interval_mid(w[i]);
}

/* --- Planes ----------------------------------------------------------------------------------- */

/* The farthest of all points from p. */
static const double *farthest(const double *points, size_t count, const double p[3])
{
    const double *best = points;
    for (size_t k = 1; k < count; ++k)
        if (apart(points + 3 * k, p) > apart(best, p)) best = points + 3 * k;
    return best;
}

/* Lemma. The surface is in the hull of its control points, and so between the same two planes. */
static bool find_plane(round_net *r, const double *points, size_t count)
{
    const double *far = farthest(points, count, points);
    const double size = apart(far, points);
    const double u[3] = {far[0] - points[0], far[1] - points[1], far[2] - points[2]};
    double normal[3] = {0}, most = 0, off = 0;
    for (size_t k = 1; k < count; ++k) {
        const double *p = points + 3 * k;
        const double v[3] = {p[0] - points[0], p[1] - points[1], p[2] - points[2]};
        double n[3];
        cross(u, v, n);
        if (!(dot(n, n) > most)) continue;
        most = dot(n, n);
        memcpy(normal, n, sizeof n);
    }
    if (!has_size(size) || !place(r, points, normal, 0)) return false;
    for (size_t k = 0; k < count && off <= ROUND_NET_OFF_MOST * size; ++k) {
        imp_interval w[3];
        in_frame(r, points + 3 * k, w);
        off = imp_larger(off, imp_interval_mag(w[2]));
    }
    r->profile = (round_profile){.kind = ROUND_PLANE, .off = off};
    return off <= ROUND_NET_OFF_MOST * size;
}

/* --- Rings ------------------------------------------------------------------------------------ */

/* The point of a ring of control points at a part of its domain. */
static void ring_point(const ring_net *n, size_t j, double part, double out[3])
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

static size_t widest_ring(const ring_net *n)
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

/* The circle through three points of the widest ring. */
static bool find_axis(ring_net *n, round_net *r)
{
    double p[3][3], end[3], x[3], y[3], normal[3], a[3], b[3], center[3];
    ring_point(n, n->widest, 0, p[0]);
    ring_point(n, n->widest, 1. / 3, p[1]);
    ring_point(n, n->widest, 2. / 3, p[2]);
    ring_point(n, n->widest, 1, end);
    if (apart(end, p[0]) > 0.1 * apart(p[1], p[0])) memcpy(p[2], end, sizeof end);
    for (int i = 0; i < 3; ++i) {
        x[i] = p[1][i] - p[0][i];
        y[i] = p[2][i] - p[0][i];
    }
    cross(x, y, normal);
    cross(y, normal, a);
    cross(normal, x, b);
    const double square = dot(normal, normal);
    if (!(square > 0x1p-60 * dot(x, x) * dot(y, y))) return false;
    for (int i = 0; i < 3; ++i)
        center[i] = p[0][i] + (dot(x, x) * a[i] + dot(y, y) * b[i]) / (2 * square);
    n->radius = apart(center, p[0]);
    return has_size(n->radius) && place(r, center, normal, n->radius);
}

/* --- Curves of one side ----------------------------------------------------------------------- */

/* Control point k of a plane curve: x, y and the weight. */
typedef void control_point(const ring_net *n, size_t k, double out[3]);

/* The widest ring over its radius. */
static void ring_control(const ring_net *n, size_t i, double out[3])
{
    double w[3];
    middle_in_frame(n->at, n->points + 3 * index_of(n, i, n->widest), w);
    out[0] = w[0] / n->radius;
    out[1] = w[1] / n->radius;
    out[2] = weight_of(n, i, n->widest);
}

/* By how much ring j is wider than the unit ring, as a least square, and its mean height. */
static void profile_control(const ring_net *n, size_t j, double out[3])
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

/* Takes a span of the curve into a profile, or makes one of it. Returns the greatest |x| + |y| of a
 * control point. */
static double take_span(const ring_net *n, const knots *k, size_t span, control_point *control,
                        round_profile *p)
{
    const int degree = k->degree;
    const size_t first = k->last[span] - (size_t)degree;
    double given[SIDE_MAX][3], matrix[SIDE_MAX * SIDE_MAX], points[2 * SIDE_MAX], weights[SIDE_MAX],
        most = 0;
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
    if (p->kind == ROUND_NONE)
        *p = round_profile_of(points, weights, (size_t)degree + 1);
    else
        round_profile_widen(p, points, weights, (size_t)degree + 1);
    return most;
}

/* Fills or widens a profile by all spans of a curve.
 *
 * Lemma. The matrix is within 5 p units of itself, p the degree. The computed weights of a span are
 * within 6 p + 2 units, and its points within 12 p + 6 units of X, the greatest |x| + |y|. Control
 * points whose weights change by factors from r to R move a curve by at most R / r - 1 of their
 * diameter: x - x' = sum (b_k - b'_k) (P_k - x'), sum b_k = sum b'_k = 1, |b_k - b'_k| <= (R / r -
 * 1) b'_k. In all that is less than (12 p + 6 + 2 (12 p + 5)) units of X <= 736 units < 2^-43. */
static bool take_curve(const ring_net *n, const knots *k, control_point *control, round_profile *p)
{
    double most = 0;
    for (size_t span = 0; span < k->spans; ++span) {
        most = imp_larger(most, take_span(n, k, span, control, p));
        if (p->kind == ROUND_NONE || !(p->off < INFINITY)) return false;
    }
    p->off = imp_sum_up(p->off + 0x1p-43 * most);
    return true;
}

/* --- What the net is off by ------------------------------------------------------------------- */

/* How far control points are from products q_j (x_i, y_i), z_j, at most; and what weights that are
 * no products of two numbers move (take_curve). Also the greatest |q_j|. */
static double product_off(const ring_net *n, double *reach)
{
    double off = 0, low = INFINITY, high = 0, size = 0;
    for (size_t j = 0; j < n->profile->count; ++j) {
        double outer[3];
        profile_control(n, j, outer);
        *reach = imp_larger(*reach, fabs(outer[0]));
        for (size_t i = 0; i < n->ring->count; ++i) {
            double unit[3];
            imp_interval w[3];
            ring_control(n, i, unit);
            in_frame(n->at, n->points + 3 * index_of(n, i, j), w);
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

/* Lemma. With P'_ij = c + z_j k + q_j E_i and weights a_i b_j the surface is c + z(v) k + q(v)
 * E(u), (q, z) and E rational curves of one side each. Where ||E| - 1| <= e, it is within e max |q|
 * of the surface that (q, z) sweeps about the axis; and the true one within product_off of it. */
static bool judge(ring_net *n, round_net *r, round_profile shape)
{
    round_profile circle = {.kind = ROUND_CIRCLE, .radius = 1};
    double reach = 0;
    n->at = r;
    if (!take_curve(n, n->ring, ring_control, &circle)) return false;
    if (!(circle.off <= ROUND_NET_OFF_MOST)) return false;
    if (!take_curve(n, n->profile, profile_control, &shape)) return false;
    const double products = product_off(n, &reach);
    shape.off = imp_sum_up(shape.off + imp_sum_up(products + imp_round_up(reach * circle.off)));
    r->profile = shape;
    return shape.off <= 0x1p-10 * n->radius;
}

static bool is_ball(const round_profile *p) { return p->kind == ROUND_CIRCLE && p->ring == 0; }

/* The center of a ball is the symmetry's, which is exact: it moves there. */
static bool find_ball(ring_net *n, round_net *r)
{
    round_profile ball = {.kind = ROUND_CIRCLE, .radius = r->profile.radius};
    double center[3];
    for (int i = 0; i < 3; ++i) center[i] = r->center[i] + r->profile.height * r->frame.k[i].value;
    return place(r, center, r->axis, ball.radius) && judge(n, r, ball);
}

static bool find_rings(round_net *r, const knots side[2], int along, const double *points,
                       const double *weights)
{
    const size_t row = side[1].count;
    ring_net n = {.ring = &side[along],
                  .profile = &side[1 - along],
                  .points = points,
                  .weights = weights,
                  .ring_step = along == 0 ? row : 1,
                  .profile_step = along == 0 ? 1 : row};
    if (n.ring->degree < 2) return false;
    n.widest = widest_ring(&n);
    const round_profile none = {.kind = ROUND_NONE};
    if (!find_axis(&n, r) || !judge(&n, r, none)) return false;
    return !is_ball(&r->profile) || find_ball(&n, r);
}

/* --- Answers ---------------------------------------------------------------------------------- */

round_net round_net_of(const knots side[2], const double *points, const double *weights)
{
    round_net r;
    memset(&r, 0, sizeof r);
    if (find_plane(&r, points, side[0].count * side[1].count)) return r;
    for (int along = 0; along < 2; ++along)
        if (find_rings(&r, side, along, points, weights)) return r;
    memset(&r, 0, sizeof r);
    return r;
}

imp_model round_net_distance(const round_net *r, imp_model x, imp_model y, imp_model z)
{
    imp_model m[3];
    if (r->profile.kind == ROUND_NONE) return imp_unbounded(0);
    axis_from_center(r->center, x, y, z, m);
    if (is_ball(&r->profile)) return round_profile_distance(&r->profile, m);
    const imp_model turned[3] = {axis_dot(r->frame.a, m), axis_dot(r->frame.b, m),
                                 axis_dot(r->frame.k, m)};
    return round_profile_distance(&r->profile, turned);
}

imp_status round_net_symmetry(const round_net *r, imp_symmetry *symmetry)
{
    if (r->profile.kind == ROUND_NONE) return IMP_STATUS_UNBOUNDED;
    round_profile_symmetry(&r->profile, symmetry);
    if (is_ball(&r->profile)) symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = 0; /* a part of the whole, or closed but for rounding */
    memcpy(symmetry->center, r->center, sizeof r->center);
    memcpy(symmetry->axis, r->axis, sizeof r->axis);
    return IMP_STATUS_OK;
}
