/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/moving_boxes.h"

#include "core/bounds/quadratic.h"
#include "core/bounds/window_lanes.h"
#include "core/tree/triple.h"

/* Bounds the distance of a node's points from a + bt s; rounding is not included. */
IMP_QUAD_INLINE imp_quad reach_of(const node *n)
{
    const quadratic3 *f = &n->f;
    const imp_quad slopes = imp_quad_abs(triple_load(f->bu)) + imp_quad_abs(triple_load(f->bv));
    const imp_quad still = imp_quad_abs(triple_load(f->quu)) + imp_quad_abs(triple_load(f->quv)) +
                           imp_quad_abs(triple_load(f->qvv));
    const imp_quad turning = imp_quad_abs(triple_load(f->qut)) + imp_quad_abs(triple_load(f->qvt)) +
                             imp_quad_abs(triple_load(f->qtt));
    return slopes + still + turning + triple_load(n->e);
}

/* Encloses B - A over the window t = mid + half w, coordinate by coordinate: delta + drift w, plus
 * and minus reach. */
typedef struct passing {
    imp_quad delta, drift, reach;
} passing;

/* Lemma. In a node s = s0 + k w, and |s| <= 1 since the window lies in its times, so that each term
 * in s is at most its coefficient; bt is in delta and drift. Rounding, in units of u of |apart| +
 * |bt| of both + reach of both: s0 2, k 1 and their products 2; differences and sums 4; of reach 9;
 * low 1, low -+ drift 1, each of two of them at most; and of `size` itself, to first order 0. */
enum { PASSING_ROUNDING = 32 };
_Static_assert(2 + 1 + 2 + 4 + 9 + 2 * (1 + 1) <= PASSING_ROUNDING, "rounding along a coordinate");

IMP_QUAD_INLINE passing passing_of(const node *a, const node *b, double mid, double half)
{
    const imp_region *r = &a->region, *s = &b->region;
    const int t = PARAMETER_T;
    const double a0 = r->d[t] > 0 ? (mid - r->c[t]) / r->d[t] : 0;
    const double b0 = s->d[t] > 0 ? (mid - s->c[t]) / s->d[t] : 0;
    const double ak = r->d[t] > 0 ? half / r->d[t] : 0, bk = s->d[t] > 0 ? half / s->d[t] : 0;
    const imp_quad ta = triple_load(a->f.bt), tb = triple_load(b->f.bt);
    const imp_quad apart = triple_load(b->f.a) - triple_load(a->f.a);
    const imp_quad reach = reach_of(a) + reach_of(b);
    const imp_quad size = imp_quad_abs(apart) + imp_quad_abs(ta) + imp_quad_abs(tb) + reach;
    return (passing){apart + (tb * imp_quad_all(b0) - ta * imp_quad_all(a0)),
                     tb * imp_quad_all(bk) - ta * imp_quad_all(ak),
                     reach + size * imp_quad_all(PASSING_ROUNDING * UNIT_ROUNDOFF) +
                         imp_quad_all(QUADRATIC_UNDERFLOW)};
}

IMP_QUAD_INLINE bool cut_by_boxes(const node *a, const node *b, double gamma_clear, double mid,
                                  double half, w_range *s)
{
    const passing p = passing_of(a, b, mid, half);
    const imp_quad most = imp_quad_abs(p.delta) + imp_quad_abs(p.drift) - p.reach;
    const imp_quad_mask some = most > imp_quad_all(gamma_clear);
    if (!imp_quad_any(some)) return true;
    const imp_quad limit = imp_quad_pick(some, imp_quad_all(gamma_clear), imp_quad_all(INFINITY));
    window_lanes c = window_lanes_none();
    window_lanes_add(&c, p.delta - p.reach, p.drift, limit);
    window_lanes_add(&c, -p.delta - p.reach, -p.drift, limit);
    return window_lanes_take(s, &c);
}

IMP_QUAD_NARROW static bool cut_by_boxes_narrow(const node *a, const node *b, double gamma_clear,
                                                double mid, double half, w_range *s)
{
    return cut_by_boxes(a, b, gamma_clear, mid, half, s);
}

IMP_QUAD_WIDE static bool cut_by_boxes_wide(const node *a, const node *b, double gamma_clear,
                                            double mid, double half, w_range *s)
{
    return cut_by_boxes(a, b, gamma_clear, mid, half, s);
}

bool moving_boxes_cut(const node *a, const node *b, double gamma_clear, time_window *window)
{
    w_range s = {-1, 1};
    if (!a->bounded || !b->bounded) return true;
    const double mid = 0.5 * window->lo + 0.5 * window->hi, half = window_half_upper(window, mid);
    const bool some = imp_quad_is_wide() ? cut_by_boxes_wide(a, b, gamma_clear, mid, half, &s)
                                         : cut_by_boxes_narrow(a, b, gamma_clear, mid, half, &s);
    if (some) window_cut(window, mid, half, &s);
    return some;
}
