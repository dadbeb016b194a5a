/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/net_halves.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/solver/net_hull.h"

/* Heights of one net's control points along an axis, without its place: at the window's start, at its end,
 * then the weights. */
typedef struct heights {
    const net *net;
    double x[3 * IMP_QUAD * QUADS_MAX];
    window_ends low; /* the least */
    double most;     /* >= |height|, but for rounding */
} heights;

IMP_QUAD_INLINE window_ends least_heights(const net *f, const double *x)
{
    imp_quad early = imp_quad_load(x), late = imp_quad_load(x + f->stride);
    for (int k = IMP_QUAD; k < f->stride; k += IMP_QUAD) {
        early = imp_quad_min(imp_quad_load(x + k), early);
        late = imp_quad_min(imp_quad_load(x + f->stride + k), late);
    }
    return (window_ends){least_of(early), least_of(late)};
}

IMP_QUAD_INLINE void heights_take(const net *f, const time_window *w, vec3 axis, double sign,
                                  heights *h)
{
    const imp_quad n[3] = {imp_quad_all(sign * axis.x[0]), imp_quad_all(sign * axis.x[1]),
                           imp_quad_all(sign * axis.x[2])};
    const imp_quad t0 = imp_quad_all(w->lo - f->time), t1 = imp_quad_all(w->hi - f->time);
    h->net = f;
    int k = 0;
    do {
        const imp_quad p = along(f->numbers + k, f->stride, n);
        imp_quad v = imp_quad_all(0);
        if (f->is_moving) v = along(f->numbers + 3 * f->stride + k, f->stride, n);
        imp_quad_store(h->x + k, p + t0 * v);
        imp_quad_store(h->x + f->stride + k, p + t1 * v);
    } while ((k += IMP_QUAD) < f->stride);
    if (f->is_weighted)
        memcpy(h->x + 2 * f->stride, f->numbers + (f->is_moving ? 6 : 3) * f->stride,
               (size_t)f->stride * sizeof(double));
    h->low = least_heights(f, h->x);
    h->most = 0;
    for (int i = 0; i < 3; ++i) h->most += fabs(axis.x[i]) * f->most[i];
}

/* The least heights of both halves along j. */
IMP_QUAD_INLINE void halve_any(const heights *h, parameter j, window_ends low[2])
{
    const size_t columns = h->net->is_weighted ? 3 : 2;
    for (int half = 0; half < 2; ++half) {
        double x[3 * IMP_QUAD * QUADS_MAX];
        memcpy(x, h->x, columns * (size_t)h->net->stride * sizeof *x);
        net_halve_columns(h->net, j, half, x, 2);
        low[half] = least_heights(h->net, x);
    }
}

/* Control points of the halves of four cubics: the lower has the first four, the upper the last four. */
typedef struct halved {
    imp_quad x[7];
} halved;

IMP_QUAD_INLINE halved halve_cubics(const imp_quad r[4])
{
    const imp_quad half = imp_quad_all(0.5);
    const imp_quad p = half * (r[0] + r[1]), q = half * (r[1] + r[2]), s = half * (r[2] + r[3]);
    const imp_quad pq = half * (p + q), qs = half * (q + s), mid = half * (pq + qs);
    return (halved){{r[0], p, pq, mid, qs, s, r[3]}};
}

/* Rows along j of a bicubic patch's numbers. */
IMP_QUAD_INLINE void rows_along(const double *x, parameter j, imp_quad r[4])
{
    for (int k = 0; k < 4; ++k)
        r[k] = j == PARAMETER_U ? imp_quad_load(x + 4 * k)
                                : (imp_quad){x[k], x[4 + k], x[8 + k], x[12 + k]};
}

/* Lemma. Of a rational patch, heights times weights and weights are halved like any numbers; their quotients
 * are the heights. In units of u most: the products and their halving n + 1 in all, weights n, quotients 1,
 * less than halving_units (net.c). */
IMP_QUAD_INLINE void halve_bicubic_heights(const heights *h, const double *x, parameter j,
                                           double low[2])
{
    imp_quad r[4], w[4];
    halved z;
    rows_along(x, j, r);
    if (h->net->is_weighted) {
        rows_along(h->x + 2 * 16, j, w);
        for (int k = 0; k < 4; ++k) r[k] = r[k] * w[k];
        const halved of = halve_cubics(r), by = halve_cubics(w);
        for (int k = 0; k < 7; ++k) z.x[k] = of.x[k] / by.x[k];
    } else {
        z = halve_cubics(r);
    }
    for (int half = 0; half < 2; ++half) {
        const imp_quad *y = z.x + 3 * half;
        low[half] = least_of(imp_quad_min(imp_quad_min(y[0], y[1]), imp_quad_min(y[2], y[3])));
    }
}

/* Lemma. Over the window n.(y - x) of points of a half and of the other node is no less than the least
 * difference of heights of their control points, and that is concave in time: heights are linear, and halving
 * takes fixed means of them. So where it is above the limit at both ends of the window, the half is out of
 * reach. The least heights of the half, computed, are off by net_halving_upper. In units of u R (net_hull.h):
 * heights, their places and R itself are GAP_ROUNDING; the limit less the rest rounds twice, and the half's
 * height less the error of halving once: slack is counted twice. A NaN excludes nothing. */
_Static_assert(2 + 1 <= GAP_ROUNDING, "rounding of a half's limit");

/* Bits of the halves along j that may be near; `most` are heights at the window's ends above which a half is
 * not. */
IMP_QUAD_INLINE int halves_left(const heights *h, parameter j, window_ends most)
{
    int left = 0;
    window_ends low[2];
    if (h->net->degree[0] == 3 && h->net->degree[1] == 3) {
        double early[2], late[2];
        halve_bicubic_heights(h, h->x, j, early);
        halve_bicubic_heights(h, h->x + 16, j, late);
        for (int half = 0; half < 2; ++half) low[half] = (window_ends){early[half], late[half]};
    } else {
        halve_any(h, j, low);
    }
    const double off = padded_upper(net_halving_upper(h->net, j, h->most), 8);
    for (int half = 0; half < 2; ++half)
        if (!(low[half].lo - off > most.lo && low[half].hi - off > most.hi)) left |= 1 << half;
    return left;
}

PAD_COVERS(8, 3 + 3); /* h->most: products and two sums; its own product, the sum */

/* The first half that is found, of A along u, v, then of B. */
IMP_QUAD_INLINE bool find_half(const node *const nodes[2], const heights of[2], vec3 n,
                               double limit, const time_window *w, net_half *found)
{
    const double at0 = vec3_dot(n, places_apart(of[0].net, of[1].net, w->lo));
    const double at1 = vec3_dot(n, places_apart(of[0].net, of[1].net, w->hi));
    if (!(limit < INFINITY && fabs(at0) < INFINITY && fabs(at1) < INFINITY)) return false;
    for (int side = 0; side < 2; ++side) {
        const window_ends other = of[!side].low;
        const window_ends most = {limit - (other.lo + at0), limit - (other.hi + at1)};
        for (parameter j = PARAMETER_U; j <= PARAMETER_V; ++j) {
            const imp_region *r = &nodes[side]->region;
            if (!region_can_split(r, j) || !net_can_halve(r, j)) continue;
            const int left = halves_left(&of[side], j, most);
            if (left == 3) continue;
            *found = (net_half){side, j, left == 1 ? 0 : left == 2 ? 1 : -1};
            return true;
        }
    }
    return false;
}

PAD_COVERS(16, 4); /* |n| clearance: square 1, sums 2, root (1 + 2) / 2 + 1, product 1 */
PAD_COVERS(4, 1);  /* its sum with the slack */

IMP_QUAD_INLINE bool find(const node *a, const node *b, vec3 axis, double clearance,
                          const time_window *w, net_half *found)
{
    const net *p = node_net_made(a), *q = node_net_made(b);
    if (p == NULL || q == NULL) return false;
    double longest = fabs(axis.x[0]);
    for (int i = 1; i < 3; ++i)
        if (fabs(axis.x[i]) > longest) longest = fabs(axis.x[i]);
    if (!(longest > 0x1p-400 && longest < 0x1p400)) return false;
    const vec3 n = vec3_scale(axis, 1 / longest);
    const double early = fabs(w->lo - p->time) + fabs(w->lo - q->time);
    const double late = fabs(w->hi - p->time) + fabs(w->hi - q->time);
    const double slack = slack_upper(p, q, n, early > late ? early : late);
    const double limit = padded_upper(padded_upper(vec3_norm(n) * clearance, 16) + 2 * slack, 4);
    const node *const nodes[2] = {a, b};
    heights of[2];
    heights_take(p, w, n, -1, &of[0]);
    heights_take(q, w, n, 1, &of[1]);
    return find_half(nodes, of, n, limit, w, found);
}

IMP_QUAD_WIDE static bool find_wide(const node *a, const node *b, vec3 axis, double clearance,
                                    const time_window *w, net_half *found)
{
    return find(a, b, axis, clearance, w, found);
}

bool net_halves_find(const node *a, const node *b, vec3 axis, double clearance,
                     const time_window *window, net_half *found)
{
    return imp_quad_is_wide() ? find_wide(a, b, axis, clearance, window, found)
                              : find(a, b, axis, clearance, window, found);
}
