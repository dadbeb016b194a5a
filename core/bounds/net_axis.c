/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/net_axis.h"

#include "core/base/rounding.h"
#include "core/bounds/gjk.h"
#include "core/bounds/net_hull.h"

/* --- The search ------------------------------------------------------------------------------- */

typedef struct hulls {
    cloud a, b;
    int quads_a, quads_b;
    vec3 apart;
} hulls;

IMP_QUAD_INLINE vec3 lowest_with(const hulls *h, int quads_a, int quads_b, vec3 n)
{
    const lowest_points low = lowest_of_lanes(&h->b, &h->a, lanes_along(&h->b, quads_b, n),
                                              lanes_along(&h->a, quads_a, vec3_scale(n, -1)));
    return vec3_add(vec3_sub(low.p, low.q), h->apart);
}

IMP_QUAD_INLINE vec3 lowest_of(const void *set, vec3 n)
{
    const hulls *h = set;
    return lowest_with(h, h->quads_a, h->quads_b, n);
}

/* Unrolled for bicubic patches. */
IMP_QUAD_INLINE vec3 lowest_of_bicubic(const void *set, vec3 n)
{
    return lowest_with(set, 4, 4, n);
}

IMP_QUAD_INLINE bool seek(const node *a, const node *b, double t, vec3 *axis)
{
    const net *f = node_net_made(a), *g = node_net_made(b);
    hulls h;
    h.quads_a = f->stride / IMP_QUAD;
    h.quads_b = g->stride / IMP_QUAD;
    h.apart = places_apart(f, g, t);
    cloud_at(f, t, &h.a);
    cloud_at(g, t, &h.b);
    return h.quads_a == 4 && h.quads_b == 4
               ? gjk_search(lowest_of_bicubic, &h, TUNING_GJK_GAP, axis)
               : gjk_search(lowest_of, &h, TUNING_GJK_GAP, axis);
}

IMP_QUAD_WIDE static bool seek_wide(const node *a, const node *b, double t, vec3 *axis)
{
    return seek(a, b, t, axis);
}

bool net_axis_seek(const node *a, const node *b, double t, vec3 *axis)
{
    return imp_quad_is_wide() ? seek_wide(a, b, t, axis) : seek(a, b, t, axis);
}

/* --- The proof -------------------------------------------------------------------------------- */

/* Lemma (separating axis of two nets). At every moment each surface lies within its net's error of
 * the hull of its control points. So n.(y - x), for points x of A and y of B, is at least the
 * minimum of n.(q - p) over control points p of A and q of B, less both errors along n. Control
 * points move linearly, so that this minimum is concave in time, and lies above the line between
 * its values at the window's ends. Where that line, less errors and rounding (net_hull.h), exceeds
 * |n| gamma_clear, the nodes are farther apart than gamma_clear, since n.(y - x) <= |n| |y - x|.
 * One coordinate of n is about 1, so that no underflow matters; a NaN or infinity cuts nothing. */
IMP_QUAD_INLINE bool cut_along(const node *a, const node *b, vec3 axis, double gamma_clear,
                               time_window *window)
{
    const net *p = node_net_made(a), *q = node_net_made(b);
    vec3 n;
    if (!axis_scaled(axis, &n)) return true;
    const double limit = net_limit_upper(n, gamma_clear, slack_upper(p, q, n, window));
    const window_ends low = lowest_heights_of(q, window, n, 1);
    const window_ends high = lowest_heights_of(p, window, n, -1);
    const window_ends at = places_along(p, q, n, window);
    const double g0 = low.lo + high.lo + at.lo, g1 = low.hi + high.hi + at.hi;
    if (!(g0 < INFINITY && g1 < INFINITY && limit < INFINITY)) return true;
    return line_cut(g0, g1, limit, window);
}

IMP_QUAD_WIDE static bool cut_along_wide(const node *a, const node *b, vec3 axis,
                                         double gamma_clear, time_window *window)
{
    return cut_along(a, b, axis, gamma_clear, window);
}

bool net_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear, time_window *window)
{
    return imp_quad_is_wide() ? cut_along_wide(a, b, axis, gamma_clear, window)
                              : cut_along(a, b, axis, gamma_clear, window);
}
