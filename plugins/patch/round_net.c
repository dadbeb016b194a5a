/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/round_net.h"

#include <string.h>

/* A surface farther than this part of its size from a plane, or a ring of control points from a
 * circle, is no plane and no circle; a profile may be as far off as round_profile.c permits. */
#define ROUND_NET_OFF_MOST 0x1p-30

/* Nets of other sizes are not examined: squares and their squares, and all intervals, are finite,
 * so that there is no NaN. */
#define ROUND_NET_LEAST 1e-50
#define ROUND_NET_MOST 1e50

static bool has_size(double x) { return x >= ROUND_NET_LEAST && x <= ROUND_NET_MOST; }

/* --- Places ----------------------------------------------------------------------------------- */

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
        r->at.axis[i] = fabs(part) > ROUND_NET_ZERO ? part : 0;
        r->at.center[i] = fabs(center[i]) > ROUND_NET_ZERO * size ? center[i] : 0;
        along[i] = imp_num(r->at.axis[i]);
    }
    r->at.frame = frame_about(along);
    return true;
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
        ring_in_frame(&r->at, points + 3 * k, w);
        off = imp_larger(off, imp_interval_mag(w[2]));
    }
    r->profile = (round_profile){.kind = ROUND_PLANE, .off = off};
    return off <= ROUND_NET_OFF_MOST * size;
}

/* --- Rings ------------------------------------------------------------------------------------ */

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

/* What a net is off by, and how far each part of it goes. */
typedef struct ring_parts {
    double products, reach; /* ring_product_off */
    double ring;            /* what the unit ring is off by; 1 */
} ring_parts;

static bool is_ball(const round_profile *p) { return p->kind == ROUND_CIRCLE && p->ring == 0; }

/* Lemma. Let directions of E be within g of each direction. A rotation S about the axis takes a
 * point of the surface, `products` from c + z k + q E, and so products + |q| e from c + z k + q n,
 * n = E/|E|, to within that of c + z k + q S n, and some E' is within e + g of S n: with the same
 * (q, z), the surface has a point within 2 products + |q| (2 e + g). Let (q, z) also have
 * directions within h of each on one side of the axis, and be within `off` of a circle of radius R
 * about 0. A rotation about c takes a point products + |q| e + off from the ball's sphere, and
 * each point of that is within products + |q| (e + g) + off + R h of one of the surface. An angle
 * is no less than its chord. A rotation about the axis that takes E(u)'s direction to E(u')'s takes
 * the point of (u, v) to within 2 products + 2 |q| e of that of (u', v): these are orbits but for
 * that, of which images above are, too. Distances from a ball's center are within the profile's
 * `off` of its radius.
 *
 * Let H be ring_half_size_lower, and all of that be below s H, s = 2^-36. Two points of the surface
 * with opposite n, or at heights 2 H apart, are at least 2 H - 3 s H > H apart: so it is below s
 * times the greatest distance of two points. */
static uint32_t closed_of(const ring_net *n, const round_net *r, const ring_parts *parts)
{
    const double most = imp_round_down(IMP_NEARLY_SLACK * ring_half_size_lower(n));
    const ring_sweep around = ring_sweep_of(n, n->ring, ring_control);
    const double own = imp_sum_up(parts->products + imp_round_up(parts->reach * parts->ring));
    const double gap = imp_sum_up(2 * own + imp_round_up(parts->reach * ring_gap(&around)));
    if (!(gap <= most)) return 0;
    const uint32_t orbits = n->along == 0 ? IMP_SYMMETRY_ORBIT_U : IMP_SYMMETRY_ORBIT_V;
    if (!is_ball(&r->profile)) return IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_NEARLY | orbits;
    const ring_sweep up = ring_sweep_of(n, n->profile, ring_profile_control);
    const double poles = imp_round_up(r->profile.radius * ring_half_gap(&up));
    const double round = imp_sum_up(gap + 2 * r->profile.off), all = imp_sum_up(round + poles);
    return IMP_SYMMETRY_NEARLY | orbits | (round <= most ? IMP_SYMMETRY_ORBIT_ALL : 0) |
           (all <= most ? IMP_SYMMETRY_CLOSED : IMP_SYMMETRY_ZONE);
}

/* Lemma. With P'_ij = c + z_j k + q_j E_i and weights a_i b_j the surface is c + z(v) k + q(v)
 * E(u), (q, z) and E rational curves of one side each. Where ||E| - 1| <= e, it is within e max
 * |q| of the surface that (q, z) sweeps about the axis; and the true one within ring_product_off
 * of it. */
static bool judge(ring_net *n, round_net *r, round_profile shape)
{
    round_profile circle = {.kind = ROUND_CIRCLE, .radius = 1};
    ring_parts parts = {.reach = 0};
    n->at = &r->at;
    if (!ring_take_curve(n, n->ring, ring_control, &circle)) return false;
    if (!(circle.off <= ROUND_NET_OFF_MOST)) return false;
    if (!ring_take_curve(n, n->profile, ring_profile_control, &shape)) return false;
    parts.products = ring_product_off(n, &parts.reach);
    parts.ring = circle.off;
    shape.off =
        imp_sum_up(shape.off + imp_sum_up(parts.products + imp_round_up(parts.reach * parts.ring)));
    r->profile = shape;
    if (!(shape.off <= 0x1p-10 * n->radius)) return false;
    r->closed = closed_of(n, r, &parts);
    return true;
}

/* The center of a ball is the symmetry's, which is exact: it moves there. */
static bool find_ball(ring_net *n, round_net *r)
{
    round_profile ball = {.kind = ROUND_CIRCLE, .radius = r->profile.radius};
    double center[3];
    for (int i = 0; i < 3; ++i)
        center[i] = r->at.center[i] + r->profile.height * r->at.frame.k[i].value;
    return place(r, center, r->at.axis, ball.radius) && judge(n, r, ball);
}

static bool find_rings(round_net *r, const knots side[2], int along, const double *points,
                       const double *weights)
{
    const size_t row = side[1].count;
    ring_net n = {.ring = &side[along],
                  .profile = &side[1 - along],
                  .points = points,
                  .weights = weights,
                  .along = along,
                  .ring_step = along == 0 ? row : 1,
                  .profile_step = along == 0 ? 1 : row};
    if (n.ring->degree < 2) return false;
    n.widest = ring_widest(&n);
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
    axis_from_center(r->at.center, x, y, z, m);
    if (is_ball(&r->profile)) return round_profile_distance(&r->profile, m);
    const imp_model turned[3] = {axis_dot(r->at.frame.a, m), axis_dot(r->at.frame.b, m),
                                 axis_dot(r->at.frame.k, m)};
    return round_profile_distance(&r->profile, turned);
}

imp_status round_net_symmetry(const round_net *r, imp_symmetry *symmetry)
{
    if (r->profile.kind == ROUND_NONE) return IMP_STATUS_UNBOUNDED;
    round_profile_symmetry(&r->profile, symmetry);
    if (is_ball(&r->profile)) symmetry->kind = IMP_SYMMETRY_ABOUT_POINT;
    symmetry->is_closed = r->closed;
    memcpy(symmetry->center, r->at.center, sizeof r->at.center);
    memcpy(symmetry->axis, r->at.axis, sizeof r->at.axis);
    return IMP_STATUS_OK;
}
