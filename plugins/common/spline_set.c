/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spline.h"

size_t spline_bytes(int degree, size_t keys, size_t lanes, size_t further)
{
    const size_t width = SPLINE_COLUMNS * lanes + further;
    const size_t intervals = lanes * spline_controls(degree) + 2 * width;
    return keys * (sizeof(double) + intervals * sizeof(imp_interval));
}

spline spline_place(int degree, size_t keys, size_t lanes, size_t further, void *memory)
{
    spline s = {.pieces = keys - 1, .lanes = lanes, .width = SPLINE_COLUMNS * lanes + further};
    s.degree = degree;
    s.control = memory;
    s.tree = s.control + lanes * s.pieces * spline_controls(degree);
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
static void spline_set_line(const spline *s, const imp_interval *key, size_t piece, size_t lane)
{
    const imp_interval a = key[piece * s->lanes], b = key[(piece + 1) * s->lanes];
    const imp_interval secant = spline_secant(s, key, piece, piece + 1);
    const imp_interval none = imp_interval_make(0, 0), three = imp_interval_make(3, 3);
    imp_interval *value = spline_term(s, piece, lane, 0);
    value[0] = a;
    value[1] = imp_interval_div(imp_interval_add(imp_interval_scale(a, 2), b), three);
    value[2] = imp_interval_div(imp_interval_add(a, imp_interval_scale(b, 2)), three);
    value[3] = b;
    for (int k = 0; k < 3; ++k) spline_term(s, piece, lane, 1)[k] = secant;
    for (int k = 0; k < 2; ++k) spline_term(s, piece, lane, 2)[k] = none;
    *spline_term(s, piece, lane, 3) = none;
}

/* With g'' = a. Its slope is the secant - a h/2 at the start and + a h/2 at the end. */
static void spline_set_parabola(const spline *s, const imp_interval *key, size_t piece, size_t lane,
                                double a)
{
    const imp_interval h = spline_step(s, piece, piece + 1), three = imp_interval_make(3, 3);
    const imp_interval half = imp_interval_scale(imp_interval_scale(h, a), 0.5);
    imp_interval *value = spline_term(s, piece, lane, 0), *slope = spline_term(s, piece, lane, 1);
    imp_interval *bend = spline_term(s, piece, lane, 2);
    spline_set_line(s, key, piece, lane);
    slope[0] = imp_interval_sub(slope[1], half);
    slope[2] = imp_interval_add(slope[1], half);
    const imp_interval up = imp_interval_mul(h, slope[0]);
    const imp_interval down = imp_interval_mul(h, slope[2]);
    value[1] = imp_interval_add(value[0], imp_interval_div(up, three));
    value[2] = imp_interval_sub(value[3], imp_interval_div(down, three));
    for (int k = 0; k < 2; ++k) bend[k] = imp_interval_scale(imp_interval_make(a, a), 0.5);
}

/* Fills the terms after the first. Term k, of degree n - k, has the derivative k + 1 times term
 * k + 1, whose control points are therefore (n - k) / (k + 1) / h times the differences of its own.
 * Where that factor is no whole number, its divisor is an interval of its own. */
static void spline_set_terms(const spline *s, size_t piece, size_t lane)
{
    const imp_interval h = spline_step(s, piece, piece + 1);
    for (int k = 0; k < s->degree; ++k) {
        const imp_interval *from = spline_term(s, piece, lane, k);
        imp_interval *to = spline_term(s, piece, lane, k + 1);
        const int n = s->degree - k, parts = n % (k + 1) == 0 ? 1 : k + 1;
        const double factor = parts == 1 ? n / (k + 1) : n;
        for (int j = 0; j < n; ++j) {
            to[j] = spline_rise(from[j], from[j + 1], factor, h);
            if (parts > 1) to[j] = imp_interval_div(to[j], imp_interval_make(parts, parts));
        }
    }
}

/* The control points next to the ends are a third of a step up the slopes there. */
static void spline_set_cubic(const spline *s, const imp_interval *key, size_t piece, size_t lane,
                             imp_interval slope, imp_interval next)
{
    const imp_interval h = spline_step(s, piece, piece + 1), three = imp_interval_make(3, 3);
    const imp_interval up = imp_interval_mul(h, slope), down = imp_interval_mul(h, next);
    imp_interval *value = spline_term(s, piece, lane, 0);
    value[0] = key[piece * s->lanes];
    value[3] = key[(piece + 1) * s->lanes];
    value[1] = imp_interval_add(value[0], imp_interval_div(up, three));
    value[2] = imp_interval_sub(value[3], imp_interval_div(down, three));
    spline_set_terms(s, piece, lane);
}

/* The control points of one end of a quintic, from `end` inward in steps of `way`: with the value
 * g, the slope and g'' there, g, g + h g'/5 and g + 2 h g'/5 + h^2 g''/20. At the other end h is
 * the step back. */
static void spline_set_quintic_end(imp_interval *end, int way, imp_interval g, imp_interval slope,
                                   imp_interval bend, imp_interval h)
{
    const imp_interval five = imp_interval_make(5, 5), twenty = imp_interval_make(20, 20);
    const imp_interval up = imp_interval_div(imp_interval_mul(h, slope), five);
    const imp_interval curve =
        imp_interval_div(imp_interval_mul(imp_interval_sqr(h), bend), twenty);
    end[0] = g;
    end[way] = imp_interval_add(g, up);
    end[2 * way] = imp_interval_add(imp_interval_add(g, imp_interval_scale(up, 2)), curve);
}

imp_interval spline_hull(imp_interval x, imp_interval y)
{
    return imp_interval_make(imp_smaller(x.lo, y.lo), imp_larger(x.hi, y.hi));
}

imp_interval spline_hull_of(const imp_interval *x, int count)
{
    imp_interval hull = x[0];
    for (int k = 1; k < count; ++k) hull = spline_hull(hull, x[k]);
    return hull;
}

/* Ranges over a whole piece: those of its first terms. False: some term is not finite. */
static bool spline_set_leaf(const spline *s, size_t piece, size_t lane)
{
    imp_interval *node = spline_node(s, s->pieces + piece) + SPLINE_COLUMNS * lane;
    bool finite = true;
    for (int k = 0; k <= s->degree; ++k) {
        const imp_interval range =
            spline_hull_of(spline_term(s, piece, lane, k), s->degree + 1 - k);
        finite &= imp_interval_is_finite(range);
        if (k < SPLINE_COLUMNS) node[k] = range;
    }
    return finite;
}

bool spline_set(const spline *s, const imp_interval *keys, size_t *piece)
{
    for (size_t i = 0; i < s->pieces; ++i)
        for (size_t lane = 0; lane < s->lanes; ++lane) {
            const imp_interval *key = keys + lane;
            if (s->kinked)
                spline_set_line(s, key, i, lane);
            else
                spline_set_cubic(s, key, i, lane, spline_tangent(s, key, i),
                                 spline_tangent(s, key, i + 1));
            *piece = i;
            if (!spline_set_leaf(s, i, lane)) return false;
        }
    return true;
}

bool spline_set_hermite(const spline *s, const imp_interval *keys, const imp_interval *slopes,
                        const imp_interval *bends, size_t *piece)
{
    for (size_t i = 0; i < s->pieces; ++i)
        for (size_t lane = 0; lane < s->lanes; ++lane) {
            const size_t a = i * s->lanes + lane, b = a + s->lanes;
            imp_interval *value = spline_term(s, i, lane, 0);
            if (s->degree == SPLINE_CUBIC) {
                spline_set_cubic(s, keys + lane, i, lane, slopes[a], slopes[b]);
            } else {
                const imp_interval h = spline_step(s, i, i + 1);
                spline_set_quintic_end(value, 1, keys[a], slopes[a], bends[a], h);
                spline_set_quintic_end(value + SPLINE_QUINTIC, -1, keys[b], slopes[b], bends[b],
                                       imp_interval_neg(h));
                spline_set_terms(s, i, lane);
            }
            *piece = i;
            if (!spline_set_leaf(s, i, lane)) return false;
        }
    return true;
}

bool spline_set_parabolas(const spline *s, const imp_interval *keys, const double *accelerations,
                          size_t *piece)
{
    for (size_t i = 0; i < s->pieces; ++i)
        for (size_t lane = 0; lane < s->lanes; ++lane) {
            const double a = accelerations != NULL ? accelerations[3 * i + lane] : 0;
            if (a != 0)
                spline_set_parabola(s, keys + lane, i, lane, a);
            else
                spline_set_line(s, keys + lane, i, lane);
            *piece = i;
            if (!spline_set_leaf(s, i, lane)) return false;
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
