/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spline.h"

#include <string.h>

/* --- Making one ------------------------------------------------------------------------------- */

size_t spline_bytes(size_t keys, size_t lanes, size_t further)
{
    const size_t width = SPLINE_COLUMNS * lanes + further;
    return keys *
           (sizeof(double) + lanes * sizeof(spline_cubic) + 2 * width * sizeof(imp_interval));
}

spline spline_place(size_t keys, size_t lanes, size_t further, void *memory)
{
    spline s = {.pieces = keys - 1, .lanes = lanes, .width = SPLINE_COLUMNS * lanes + further};
    s.cubic = memory;
    s.tree = (imp_interval *)(s.cubic + lanes * s.pieces);
    s.time = (double *)(s.tree + 2 * s.width * s.pieces);
    return s;
}

imp_interval spline_step(const spline *s, size_t from, size_t to)
{
    return imp_interval_sub(imp_interval_make(s->time[to], s->time[to]),
                            imp_interval_make(s->time[from], s->time[from]));
}

/* (g_to - g_from) / (t_to - t_from); `key` has the values of one lane, `lanes` apart. */
static imp_interval spline_secant(const spline *s, const imp_interval *key, size_t from, size_t to)
{
    return imp_interval_div(imp_interval_sub(key[to * s->lanes], key[from * s->lanes]),
                            spline_step(s, from, to));
}

/* Slope at key i. At an end that of a parabola whose slope at the next key is known: both
 * together are twice the secant. */
static imp_interval spline_tangent(const spline *s, const imp_interval *key, size_t i)
{
    const size_t last = s->pieces;
    if (last == 1) return spline_secant(s, key, 0, 1);
    if (i > 0 && i < last) return spline_secant(s, key, i - 1, i + 1);
    const size_t next = i == 0 ? 1 : last - 1;
    imp_interval secant = spline_secant(s, key, i == 0 ? 0 : next, i == 0 ? 1 : last);
    return imp_interval_sub(imp_interval_scale(secant, 2), spline_tangent(s, key, next));
}

/* factor (b - a) / h. */
static imp_interval spline_rise(imp_interval a, imp_interval b, double factor, imp_interval h)
{
    return imp_interval_div(imp_interval_scale(imp_interval_sub(b, a), factor), h);
}

/* Sets the cubic of a straight piece. The control points between the ends divide the way, so that
 * values stay in the hull of the ends: (2 a + b) / 3 and (a + 2 b) / 3. */
static void spline_set_line(const spline *s, const imp_interval *key, size_t piece, spline_cubic *c)
{
    const imp_interval a = key[piece * s->lanes], b = key[(piece + 1) * s->lanes];
    const imp_interval secant = spline_secant(s, key, piece, piece + 1);
    const imp_interval none = imp_interval_make(0, 0), three = imp_interval_make(3, 3);
    c->value[0] = a;
    c->value[1] = imp_interval_div(imp_interval_add(imp_interval_scale(a, 2), b), three);
    c->value[2] = imp_interval_div(imp_interval_add(a, imp_interval_scale(b, 2)), three);
    c->value[3] = b;
    for (int k = 0; k < 3; ++k) c->slope[k] = secant;
    for (int k = 0; k < 2; ++k) c->bend[k] = none;
    c->third = none;
}

/* With g'' = a. Its slope is the secant - a h/2 at the start and + a h/2 at the end. */
static void spline_set_parabola(const spline *s, const imp_interval *key, size_t piece, double a,
                                spline_cubic *c)
{
    const imp_interval h = spline_step(s, piece, piece + 1), three = imp_interval_make(3, 3);
    const imp_interval half = imp_interval_scale(imp_interval_scale(h, a), 0.5);
    spline_set_line(s, key, piece, c);
    c->slope[0] = imp_interval_sub(c->slope[1], half);
    c->slope[2] = imp_interval_add(c->slope[1], half);
    const imp_interval up = imp_interval_mul(h, c->slope[0]);
    const imp_interval down = imp_interval_mul(h, c->slope[2]);
    c->value[1] = imp_interval_add(c->value[0], imp_interval_div(up, three));
    c->value[2] = imp_interval_sub(c->value[3], imp_interval_div(down, three));
    for (int k = 0; k < 2; ++k) c->bend[k] = imp_interval_scale(imp_interval_make(a, a), 0.5);
}

/* The control points next to the ends are a third of a step up their slopes. */
static void spline_set_cubic(const spline *s, const imp_interval *key, size_t piece,
                             spline_cubic *c)
{
    const imp_interval h = spline_step(s, piece, piece + 1), three = imp_interval_make(3, 3);
    if (s->kinked) {
        spline_set_line(s, key, piece, c);
        return;
    }
    imp_interval up = imp_interval_mul(h, spline_tangent(s, key, piece));
    imp_interval down = imp_interval_mul(h, spline_tangent(s, key, piece + 1));
    c->value[0] = key[piece * s->lanes];
    c->value[3] = key[(piece + 1) * s->lanes];
    c->value[1] = imp_interval_add(c->value[0], imp_interval_div(up, three));
    c->value[2] = imp_interval_sub(c->value[3], imp_interval_div(down, three));
    for (int k = 0; k < 3; ++k) c->slope[k] = spline_rise(c->value[k], c->value[k + 1], 3, h);
    for (int k = 0; k < 2; ++k) c->bend[k] = spline_rise(c->slope[k], c->slope[k + 1], 1, h);
    c->third = imp_interval_div(spline_rise(c->bend[0], c->bend[1], 1, h), three);
}

imp_interval spline_hull(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_smaller(x.lo, y.lo), imp_larger(x.hi, y.hi));
}

static imp_interval spline_hull_of(const imp_interval *x, int count)
{
    imp_interval hull = x[0];
    for (int k = 1; k < count; ++k) hull = spline_hull(hull, x[k]);
    return hull;
}

/* Ranges over a whole piece. False: not finite. */
static bool spline_set_leaf(const spline_cubic *c, imp_interval node[SPLINE_COLUMNS])
{
    node[SPLINE_VALUE] = spline_hull_of(c->value, 4);
    node[SPLINE_SLOPE] = spline_hull_of(c->slope, 3);
    node[SPLINE_BEND] = spline_hull_of(c->bend, 2);
    return imp_interval_is_finite(node[SPLINE_VALUE]) &&
           imp_interval_is_finite(node[SPLINE_SLOPE]) &&
           imp_interval_is_finite(node[SPLINE_BEND]) && imp_interval_is_finite(c->third);
}

bool spline_set(const spline *s, const imp_interval *keys, size_t *piece)
{
    for (size_t i = 0; i < s->pieces; ++i)
        for (size_t lane = 0; lane < s->lanes; ++lane) {
            imp_interval *node = spline_node(s, s->pieces + i) + SPLINE_COLUMNS * lane;
            spline_set_cubic(s, keys + lane, i, spline_lane(s, i, lane));
            *piece = i;
            if (!spline_set_leaf(spline_lane(s, i, lane), node)) return false;
        }
    return true;
}

bool spline_set_parabolas(const spline *s, const imp_interval *keys, const double *accelerations,
                          size_t *piece)
{
    for (size_t i = 0; i < s->pieces; ++i)
        for (size_t lane = 0; lane < s->lanes; ++lane) {
            const double a = accelerations != NULL ? accelerations[3 * i + lane] : 0;
            spline_cubic *c = spline_lane(s, i, lane);
            if (a != 0)
                spline_set_parabola(s, keys + lane, i, a, c);
            else
                spline_set_line(s, keys + lane, i, c);
            *piece = i;
            if (!spline_set_leaf(c, spline_node(s, s->pieces + i) + SPLINE_COLUMNS * lane))
                return false;
        }
    return true;
}

void spline_grow(const spline *s)
{
    for (size_t k = s->pieces - 1; k > 0; --k)
        for (size_t j = 0; j < s->width; ++j)
            spline_node(s, k)[j] =
                spline_hull(spline_node(s, 2 * k)[j], spline_node(s, 2 * k + 1)[j]);
}

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
    imp_interval x[4];
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

/* g''/2 over the span: linear in each piece. */
static imp_interval spline_bend_over(const spline *s, const spline_span *span, size_t lane,
                                     const imp_interval *between)
{
    const imp_interval *first = spline_lane(s, span->first, lane)->bend;
    const imp_interval *last = spline_lane(s, span->last, lane)->bend;
    imp_interval lo = spline_at(first, 2, spline_part(s, span->first, span->lo));
    imp_interval hi = spline_at(last, 2, spline_part(s, span->last, span->hi));
    imp_interval bend = spline_hull(spline_hull(lo, first[1]), spline_hull(last[0], hi));
    return between != NULL ? spline_hull(bend, between[SPLINE_COLUMNS * lane + SPLINE_BEND]) : bend;
}

/* Slopes of one piece of a curve with kinks between two times in it; of a straight one the secant
 * as it is. */
static imp_interval spline_slopes_within(const spline *s, size_t piece, size_t lane, double lo,
                                         double hi)
{
    const spline_cubic *c = spline_lane(s, piece, lane);
    if (c->bend[0].lo == 0 && c->bend[0].hi == 0) return c->slope[0];
    return spline_hull(spline_at(c->slope, 3, spline_part(s, piece, lo)),
                       spline_at(c->slope, 3, spline_part(s, piece, hi)));
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

/* The series of one lane around span->m, and at least its |g'|; g->r is set. `between`: the node of
 * what lies between the first piece and the last, NULL if there is nothing. Within one piece it is
 * the cubic itself; across several, slopes change by at most twice g''/2 per unit of time. */
static double spline_series(const spline *s, const spline_span *span, size_t lane,
                            const imp_interval *between, imp_series *g)
{
    const spline_cubic *c = spline_lane(s, span->at, lane);
    const double r = g->r;
    const imp_interval part = spline_part(s, span->at, span->m), y = imp_interval_make(-r, r);
    imp_interval slope = spline_at(c->slope, 3, part), bend = spline_at(c->bend, 2, part);
    imp_interval third = c->third;
    if (span->first != span->last) {
        bend = spline_bend_over(s, span, lane, between);
        third = imp_interval_make(0, 0);
    }
    g->e = 0;
    g->c[0] = spline_middle(spline_at(c->value, 4, part), 1, &g->e);
    g->c[1] = spline_middle(slope, r, &g->e);
    g->c[2] = spline_middle(bend, r * r, &g->e);
    g->c[3] = spline_middle(third, r * r * r, &g->e);
    imp_interval rise =
        imp_interval_add(imp_interval_mul(imp_interval_scale(bend, 2), y),
                         imp_interval_mul(imp_interval_scale(third, 3), imp_interval_sqr(y)));
    return imp_interval_mag(imp_interval_add(slope, rise));
}

/* Makes the series of a curve with kinks across several pieces with those slopes, and answers its
 * greatest slope. */
static double spline_fan(const spline *s, const spline_span *span, size_t lane, imp_interval slopes,
                         imp_series *g)
{
    const spline_cubic *c = spline_lane(s, span->at, lane);
    g->e = 0;
    g->c[0] = spline_middle(spline_at(c->value, 4, spline_part(s, span->at, span->m)), 1, &g->e);
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
