/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spline.h"

#include <string.h>

/* --- One time --------------------------------------------------------------------------------- */

/* The part of a piece that has passed at t; exactly, it is in [0, 1]. */
static imp_interval spline_part(const spline *s, size_t piece, double t)
{
    const double start = s->time[piece];
    if (t == start || t == s->time[piece + 1]) return imp_interval_make(t != start, t != start);
    imp_interval passed =
        imp_interval_sub(imp_interval_make(t, t), imp_interval_make(start, start));
    imp_interval part = imp_interval_div(passed, spline_step(s, piece, piece + 1));
    return imp_interval_intersect(part, imp_interval_make(0, 1));
}

imp_interval spline_at(const imp_interval *control, int count, imp_interval part)
{
    const imp_interval rest = imp_interval_sub(imp_interval_make(1, 1), part);
    imp_interval x[SPLINE_QUINTIC + 1];
    memcpy(x, control, (size_t)count * sizeof *x);
    for (int n = count - 1; n > 0; --n)
        for (int k = 0; k < n; ++k)
            x[k] = imp_interval_add(imp_interval_mul(rest, x[k]), imp_interval_mul(part, x[k + 1]));
    return x[0];
}

/* --- Spans ------------------------------------------------------------------------------------ */

/* The last piece that begins at t or before; from `least` on. */
static size_t spline_find(const spline *s, double t, size_t least)
{
    size_t lo = least, hi = s->pieces; /* time[lo] <= t, or lo is least; time[hi] > t, or the end */
    while (hi - lo > 1) {
        size_t middle = lo + (hi - lo) / 2;
        if (s->time[middle] <= t)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

spline_span spline_span_of(const spline *s, double lo, double m, double hi)
{
    spline_span span = {.lo = lo, .hi = hi, .m = m};
    span.first = spline_find(s, lo, 0);
    span.at = spline_find(s, m, span.first);
    span.last = spline_find(s, hi, span.at);
    if (span.last > span.at && s->time[span.last] == hi) --span.last;
    return span;
}

static void spline_join(const spline *s, size_t k, imp_interval *node)
{
    for (size_t j = 0; j < s->width; ++j) node[j] = spline_hull(node[j], spline_node(s, k)[j]);
}

/* Joins the pieces first ... last to a node: those that are right children, or left ones at the
 * other end, go by themselves, all others as their parents. */
static void spline_ask(const spline *s, size_t first, size_t last, imp_interval *node)
{
    size_t from = s->pieces + first, to = s->pieces + last + 1;
    for (; from < to; from /= 2, to /= 2) {
        if (from % 2) spline_join(s, from++, node);
        if (to % 2) spline_join(s, --to, node);
    }
}

/* Bounds g''/2 over the span. It is linear in each piece of a cubic spline; of a quintic one, over
 * its first and last piece, it is in the hull of the control points, since it is a cubic there. */
static imp_interval spline_bend_over(const spline *s, const spline_span *span, size_t lane,
                                     const imp_interval *between)
{
    const imp_interval *first = spline_term(s, span->first, lane, 2);
    const imp_interval *last = spline_term(s, span->last, lane, 2);
    imp_interval lo, hi;
    if (s->degree == SPLINE_CUBIC) {
        lo = spline_hull(spline_at(first, 2, spline_part(s, span->first, span->lo)), first[1]);
        hi = spline_hull(last[0], spline_at(last, 2, spline_part(s, span->last, span->hi)));
    } else {
        lo = spline_hull_of(first, s->degree - 1);
        hi = spline_hull_of(last, s->degree - 1);
    }
    imp_interval bend = spline_hull(lo, hi);
    return between != NULL ? spline_hull(bend, between[SPLINE_COLUMNS * lane + SPLINE_BEND]) : bend;
}

/* Slopes of one piece of a curve with kinks between two times in it; of a straight one the secant
 * as it is. */
static imp_interval spline_slopes_within(const spline *s, size_t piece, size_t lane, double lo,
                                         double hi)
{
    const imp_interval *slope = spline_term(s, piece, lane, 1);
    const imp_interval *bend = spline_term(s, piece, lane, 2);
    if (bend[0].lo == 0 && bend[0].hi == 0) return slope[0];
    return spline_hull(spline_at(slope, 3, spline_part(s, piece, lo)),
                       spline_at(slope, 3, spline_part(s, piece, hi)));
}

/* Slopes over a span of several pieces of a curve with kinks: monotonic in each piece. */
static imp_interval spline_slopes_over(const spline *s, const spline_span *span, size_t lane,
                                       const imp_interval *between)
{
    imp_interval first =
        spline_slopes_within(s, span->first, lane, span->lo, s->time[span->first + 1]);
    imp_interval last = spline_slopes_within(s, span->last, lane, s->time[span->last], span->hi);
    imp_interval slopes = spline_hull(first, last);
    return between != NULL ? spline_hull(slopes, between[SPLINE_COLUMNS * lane + SPLINE_SLOPE])
                           : slopes;
}

/* The middle of x; adds to *e what x has on either side of it, times scale. */
static double spline_middle(imp_interval x, double scale, double *e)
{
    double m = imp_interval_mid(x);
    *e = (*e + imp_interval_radius_upper(x, m) * scale) * IMP_SLACK;
    return m;
}

/* The terms of one lane at the middle of a span: with y = t - m, g(m + y) = sum_k term_k y^k, where
 * the terms after g''/2 are 0 and g''/2 is that of some time of the span, if it has several pieces.
 * `between`: the node of what lies between the first piece and the last, NULL: nothing. */
static void spline_terms_at(const spline *s, const spline_span *span, size_t lane,
                            const imp_interval *between, imp_interval term[SPLINE_QUINTIC + 1])
{
    const imp_interval part = spline_part(s, span->at, span->m);
    const bool whole = span->first == span->last;
    for (int k = 0; k <= SPLINE_QUINTIC; ++k) {
        const bool known = k <= s->degree && (whole || k < 2);
        term[k] = known ? spline_at(spline_term(s, span->at, lane, k), s->degree + 1 - k, part)
                        : imp_interval_make(0, 0);
    }
    if (!whole) term[2] = spline_bend_over(s, span, lane, between);
}

/* Returns the terms 4 and 5 of the slope over y, 4 term_4 y^3 + 5 term_5 y^4; adds those of the
 * value to *e. */
static imp_interval spline_beyond(const imp_interval *term, imp_interval y, imp_interval square,
                                  double *e)
{
    const double r = y.hi;
    *e = (*e + imp_interval_mag(term[4]) * (r * r * (r * r))) * IMP_SLACK;
    *e = (*e + imp_interval_mag(term[5]) * (r * r * (r * r) * r)) * IMP_SLACK;
    const imp_interval cube = imp_interval_mul(y, square), fourth = imp_interval_sqr(square);
    return imp_interval_add(imp_interval_mul(imp_interval_scale(term[4], 4), cube),
                            imp_interval_mul(imp_interval_scale(term[5], 5), fourth));
}

/* The series of one lane around span->m, and at least its |g'|; g->r is set. Across several pieces
 * slopes change by at most twice g''/2 per unit of time. What is beyond the third power is counted
 * as an error: |term_4| r^4 + |term_5| r^5. */
static double spline_series(const spline *s, const spline_span *span, size_t lane,
                            const imp_interval *between, imp_series *g)
{
    imp_interval term[SPLINE_QUINTIC + 1];
    const double r = g->r;
    const imp_interval y = imp_interval_make(-r, r), square = imp_interval_sqr(y);
    spline_terms_at(s, span, lane, between, term);
    g->e = 0;
    g->c[0] = spline_middle(term[0], 1, &g->e);
    g->c[1] = spline_middle(term[1], r, &g->e);
    g->c[2] = spline_middle(term[2], r * r, &g->e);
    g->c[3] = spline_middle(term[3], r * r * r, &g->e);
    imp_interval rise = imp_interval_add(imp_interval_mul(imp_interval_scale(term[2], 2), y),
                                         imp_interval_mul(imp_interval_scale(term[3], 3), square));
    if (s->degree > SPLINE_CUBIC)
        rise = imp_interval_add(rise, spline_beyond(term, y, square, &g->e));
    return imp_interval_mag(imp_interval_add(term[1], rise));
}

/* Makes the series of a curve with kinks across several pieces with those slopes, and returns its
 * greatest slope. */
static double spline_fan(const spline *s, const spline_span *span, size_t lane, imp_interval slopes,
                         imp_series *g)
{
    const imp_interval *value = spline_term(s, span->at, lane, 0);
    g->e = 0;
    g->c[0] = spline_middle(spline_at(value, 4, spline_part(s, span->at, span->m)), 1, &g->e);
    g->c[1] = spline_middle(slopes, g->r, &g->e);
    g->c[2] = g->c[3] = 0;
    return imp_interval_mag(slopes);
}

/* The node of all pieces of a span; and of those between its first and its last, where there are
 * any: true. */
static bool spline_nodes(const spline *s, const spline_span *span, imp_interval *node,
                         imp_interval *between)
{
    const size_t size = s->width * sizeof *node;
    memcpy(node, spline_node(s, s->pieces + span->first), size);
    spline_join(s, s->pieces + span->last, node);
    if (span->last <= span->first + 1) return false;
    memcpy(between, spline_node(s, s->pieces + span->first + 1), size);
    spline_ask(s, span->first + 1, span->last - 1, between);
    for (size_t j = 0; j < s->width; ++j) node[j] = spline_hull(node[j], between[j]);
    return true;
}

imp_model spline_hold(const spline *s, imp_model t)
{
    return imp_min(imp_max(t, imp_num(s->time[0])), imp_num(s->time[s->pieces]));
}

void spline_models(const spline *s, imp_model t, imp_model *lanes, imp_interval *node)
{
    imp_series g = imp_series_around(imp_model_range(&t));
    const spline_span span = spline_span_of(s, t.lo, g.m, t.hi);
    imp_interval between[SPLINE_WIDTH_MAX];
    const bool far = spline_nodes(s, &span, node, between);
    for (size_t lane = 0; lane < s->lanes; ++lane) {
        const imp_interval *whole = node + SPLINE_COLUMNS * lane;
        const imp_interval *inner = far ? between : NULL;
        const double slope =
            s->kinked && span.first != span.last
                ? spline_fan(s, &span, lane, spline_slopes_over(s, &span, lane, inner), &g)
                : spline_series(s, &span, lane, inner, &g);
        lanes[lane] = imp_compose(&t, &g, whole[SPLINE_VALUE],
                                  imp_smaller(slope, imp_interval_mag(whole[SPLINE_SLOPE])));
    }
}
