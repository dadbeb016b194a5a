/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_NET_HULL_H
#define CORE_BOUNDS_NET_HULL_H

#include "core/base/rounding.h"
#include "core/bounds/difference.h"

#include <impinge/quad.h>

/* The hull of a control net along an axis
 * =======================================
 * Functions that net_axis.c, net_model_axis.c and net_halves.c share. The height of a point x along
 * an axis n is n.x. Control points are kept relative to the net's place (net.h), so that large
 * offsets cancel before they round. */

enum { QUADS_MAX = (IMP_NET_POINTS + IMP_QUAD - 1) / IMP_QUAD };

/* --- At one time ------------------------------------------------------------------------------ */

/* The control points of a net at one time, relative to its place. */
typedef struct cloud {
    imp_quad x[3][QUADS_MAX];
} cloud;

IMP_QUAD_INLINE void cloud_take(const net *f, double t, int quads, bool is_moving, cloud *z)
{
    const imp_quad tau = imp_quad_all(t - f->time);
    const int stride = IMP_QUAD * quads;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < quads; ++k) {
            const double *x = f->numbers + i * stride + IMP_QUAD * k;
            z->x[i][k] = imp_quad_load(x);
            if (is_moving) z->x[i][k] += tau * imp_quad_load(x + 3 * stride);
        }
}

/* Unrolled for bicubic patches. */
IMP_QUAD_INLINE void cloud_at(const net *f, double t, cloud *z)
{
    if (f->stride != 16)
        cloud_take(f, t, f->stride / IMP_QUAD, f->is_moving, z);
    else if (f->is_moving)
        cloud_take(f, t, 4, true, z);
    else
        cloud_take(f, t, 4, false, z);
}

IMP_QUAD_INLINE imp_quad height(const cloud *z, int k, const imp_quad n[3])
{
    return n[0] * z->x[0][k] + n[1] * z->x[1][k] + n[2] * z->x[2][k];
}

/* The least height of each lane, and the index of the first point that has it. */
typedef struct lowest_lanes {
    imp_quad low;
    imp_quad_mask at;
} lowest_lanes;

IMP_QUAD_INLINE lowest_lanes lanes_along(const cloud *z, int quads, vec3 axis)
{
    const imp_quad n[3] = {imp_quad_all(axis.x[0]), imp_quad_all(axis.x[1]),
                           imp_quad_all(axis.x[2])};
    lowest_lanes l = {height(z, 0, n), {0, 1, 2, 3}};
    for (int k = 1; k < quads; ++k) {
        const imp_quad here = height(z, k, n);
        const imp_quad_mask lower = here < l.low;
        const int64_t first = IMP_QUAD * k;
        l.at = (lower & (imp_quad_mask){first, first + 1, first + 2, first + 3}) | (~lower & l.at);
        l.low = imp_quad_min(here, l.low);
    }
    return l;
}

/* Unrolled for bicubic patches. */
IMP_QUAD_INLINE lowest_lanes lanes_of_cloud(const cloud *z, int quads, vec3 n)
{
    return quads == 4 ? lanes_along(z, 4, n) : lanes_along(z, quads, n);
}

/* The lowest points of two clouds; of several, the first of the lowest lane. */
typedef struct lowest_points {
    vec3 p, q;
} lowest_points;

IMP_QUAD_INLINE vec3 point_of_cloud(const cloud *z, int64_t at)
{
    const double *x = (const double *)z->x + at;
    return (vec3){{x[0], x[IMP_QUAD * QUADS_MAX], x[2 * IMP_QUAD * QUADS_MAX]}};
}

/* Lanes of both are compared side by side: 0 with 1, and 2 with 3, then the lower of these. */
IMP_QUAD_INLINE lowest_points lowest_of_lanes(const cloud *z, const cloud *y, lowest_lanes p,
                                              lowest_lanes q)
{
    const imp_quad even = IMP_QUAD_SHUFFLE(p.low, q.low, 0, 4, 2, 6),
                   odd = IMP_QUAD_SHUFFLE(p.low, q.low, 1, 5, 3, 7);
    const imp_quad at_even = IMP_QUAD_SHUFFLE((imp_quad)p.at, (imp_quad)q.at, 0, 4, 2, 6),
                   at_odd = IMP_QUAD_SHUFFLE((imp_quad)p.at, (imp_quad)q.at, 1, 5, 3, 7);
    const imp_quad_mask lower = odd < even;
    const imp_quad low = imp_quad_min(odd, even);
    const imp_quad_mask at = (lower & (imp_quad_mask)at_odd) | (~lower & (imp_quad_mask)at_even);
    return (lowest_points){point_of_cloud(z, low[2] < low[0] ? at[2] : at[0]),
                           point_of_cloud(y, low[3] < low[1] ? at[3] : at[1])};
}

/* The lowest point of one cloud. */
IMP_QUAD_INLINE vec3 lowest_of_cloud(const cloud *z, int quads, vec3 n)
{
    const lowest_lanes l = lanes_of_cloud(z, quads, n);
    return lowest_of_lanes(z, z, l, l).p;
}

/* --- Over a window ---------------------------------------------------------------------------- */

/* A number at the start and at the end of a window. */
typedef struct window_ends {
    double lo, hi;
} window_ends;

IMP_QUAD_INLINE double least_of(imp_quad x)
{
    const double p = x[0] < x[1] ? x[0] : x[1], q = x[2] < x[3] ? x[2] : x[3];
    return p < q ? p : q;
}

IMP_QUAD_INLINE imp_quad heights_along(const double *x, int stride, const imp_quad n[3])
{
    return n[0] * imp_quad_load(x) + n[1] * imp_quad_load(x + stride) +
           n[2] * imp_quad_load(x + 2 * stride);
}

/* Returns the least height of the net's control points, relative to its place, at both ends of the
 * window. */
IMP_QUAD_INLINE window_ends lowest_heights(const net *f, const time_window *w, const imp_quad n[3],
                                           int stride)
{
    const imp_quad t0 = imp_quad_all(w->lo - f->time), t1 = imp_quad_all(w->hi - f->time);
    imp_quad early = imp_quad_all(INFINITY), late = early;
    for (int k = 0; k < stride; k += IMP_QUAD) {
        const imp_quad p = heights_along(f->numbers + k, stride, n);
        if (f->is_moving) {
            const imp_quad v = heights_along(f->numbers + 3 * stride + k, stride, n);
            early = imp_quad_min(p + t0 * v, early);
            late = imp_quad_min(p + t1 * v, late);
        } else {
            early = late = imp_quad_min(p, early);
        }
    }
    return (window_ends){least_of(early), least_of(late)};
}

/* Unrolled for bicubic patches. */
IMP_QUAD_INLINE window_ends lowest_heights_of(const net *f, const time_window *w, vec3 axis,
                                              double sign)
{
    const imp_quad n[3] = {imp_quad_all(sign * axis.x[0]), imp_quad_all(sign * axis.x[1]),
                           imp_quad_all(sign * axis.x[2])};
    return f->stride == 16 ? lowest_heights(f, w, n, 16) : lowest_heights(f, w, n, f->stride);
}

/* Cuts the window to the times at which the line from g0 at its start to g1 at its end is not above
 * `limit`. False: no time is left. Rounding in units of u: the two differences and the quotient 3
 * of what is cut; its product with the length, itself rounded, 2; the sum 1 of |t|. WINDOW_TINY
 * covers underflow. */
enum { CUT_ROUNDING = 8 };
_Static_assert(3 + 2 + 1 <= CUT_ROUNDING, "rounding of a cut");

static inline bool line_cut(double g0, double g1, double limit, time_window *w)
{
    const double length = w->hi - w->lo;
    const double slack =
        CUT_ROUNDING * UNIT_ROUNDOFF * (fabs(w->lo) + fabs(w->hi) + length) + WINDOW_TINY;
    const bool early = g0 > limit, late = g1 > limit;
    if (early && late) return false;
    const double share = (g0 - limit) / (g0 - g1), at = w->lo + length * share;
    if (early && at - slack > w->lo) w->lo = at - slack < w->hi ? at - slack : w->hi;
    if (late && at + slack < w->hi) w->hi = at + slack > w->lo ? at + slack : w->lo;
    return true;
}

/* --- Along an axis ---------------------------------------------------------------------------- */

/* Scales the axis to a longest coordinate of about 1. False: it is too short or too long to prove
 * anything. */
static inline bool axis_scaled(vec3 axis, vec3 *n)
{
    double longest = fabs(axis.x[0]);
    for (int i = 1; i < 3; ++i)
        if (fabs(axis.x[i]) > longest) longest = fabs(axis.x[i]);
    *n = vec3_scale(axis, 1 / longest);
    return longest > 0x1p-400 && longest < 0x1p400;
}

PAD_COVERS(16, 4); /* |n| gamma_clear: square 1, sums 2, root (1 + 2) / 2 + 1, product 1 */
PAD_COVERS(4, 1);  /* its sum with the slack */

/* |n| gamma_clear plus the slack. */
static inline double net_limit_upper(vec3 n, double gamma_clear, double slack)
{
    return padded_upper(padded_upper(vec3_norm(n) * gamma_clear, 16) + slack, 4);
}

/* --- Between two nets ------------------------------------------------------------------------- */

/* Returns B's place minus A's at time t. */
IMP_QUAD_INLINE imp_quad places_between(const net *a, const net *b, double t)
{
    const imp_quad apart = imp_quad_load(b->place) - imp_quad_load(a->place);
    return apart + (imp_quad_all(t - b->time) * imp_quad_load(b->drift) -
                    imp_quad_all(t - a->time) * imp_quad_load(a->drift));
}

IMP_QUAD_INLINE vec3 places_apart(const net *a, const net *b, double t)
{
    const imp_quad x = places_between(a, b, t);
    return (vec3){{x[0], x[1], x[2]}};
}

/* Lemma (rounding of a gap). n.(y - x) of two control points at time t, in units of u R with R =
 * sum_i |n_i| (most of both + |places apart| + |their motions|):
 *
 *   t - time, its product with a velocity or drift        2
 *   a point plus that                                      1
 *   places and drifts: two differences and their sum       3
 *   dots                                                   3
 *   sums of the three parts                                2
 *   R itself                                               6 */
enum { GAP_ROUNDING = 32 };
_Static_assert(2 + 1 + 3 + 3 + 2 + 6 <= GAP_ROUNDING, "rounding of a gap");

/* The sum of x, y and z. */
IMP_QUAD_INLINE double sum_of(imp_quad x) { return x[0] + x[1] + x[2]; }

/* Bounds the nets' errors along n plus the rounding of a gap (GAP_ROUNDING u R), at any time of the
 * window. */
IMP_QUAD_INLINE double slack_upper(const net *a, const net *b, vec3 n, const time_window *w)
{
    const double early = fabs(w->lo - a->time) + fabs(w->lo - b->time);
    const double after = fabs(w->hi - a->time) + fabs(w->hi - b->time);
    const imp_quad late = imp_quad_all(early > after ? early : after);
    const imp_quad along = imp_quad_abs((imp_quad){n.x[0], n.x[1], n.x[2], 0});
    const imp_quad drift =
        imp_quad_abs(imp_quad_load(a->drift)) + imp_quad_abs(imp_quad_load(b->drift));
    const imp_quad apart = imp_quad_abs(imp_quad_load(b->place) - imp_quad_load(a->place));
    const imp_quad most = imp_quad_load(a->most) + imp_quad_load(b->most) + apart + late * drift;
    const double size = sum_of(along * most);
    const double error = sum_of(along * (imp_quad_load(a->error) + imp_quad_load(b->error)));
    return padded_upper(error, 8) + size * (GAP_ROUNDING * UNIT_ROUNDOFF) + 0x1p-490;
}

PAD_COVERS(8, 6); /* errors: their sum 1, product 1, sums of coordinates 2; of the return value 2 */

/* Returns n.(B's place - A's place) at the window's ends. */
IMP_QUAD_INLINE window_ends places_along(const net *a, const net *b, vec3 n, const time_window *w)
{
    const imp_quad along = {n.x[0], n.x[1], n.x[2], 0};
    return (window_ends){sum_of(along * places_between(a, b, w->lo)),
                         sum_of(along * places_between(a, b, w->hi))};
}

#endif
