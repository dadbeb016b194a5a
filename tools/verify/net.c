/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/net_internal.h"

static int points_of(const net *x) { return x->n[0] * x->n[1] * x->n[2]; }

/* --- Restriction ------------------------------------------------------------------------------ */

/* Lemma. De Casteljau's scheme takes the mean (1 - s) x + s y over and over. If s is a quotient of
 * differences of doubles, it is off by less than 4 roundings, and the mean by less than 8 roundings
 * of the greater of |x| and |y| for that, and by 4 for its own operations. Means are no greater
 * than the points: all points are off by at most 16 roundings of the greatest of them for each
 * level. */
static double mean(double x, double y, double s) { return (1 - s) * x + s * y; }

static void keep_first(double *row, int n, size_t step, double s)
{
    for (int level = 1; level < n; ++level)
        for (int m = n - 1; m >= level; --m)
            row[(size_t)m * step] = mean(row[(size_t)(m - 1) * step], row[(size_t)m * step], s);
}

static void keep_last(double *row, int n, size_t step, double s)
{
    for (int level = 1; level < n; ++level)
        for (int m = 0; m < n - level; ++m)
            row[(size_t)m * step] = mean(row[(size_t)m * step], row[(size_t)(m + 1) * step], s);
}

/* Restricts variable j; returns the levels of means. */
static int restrict_along(net *x, int j, double lo, double hi)
{
    const size_t step = j == 0 ? (size_t)(x->n[1] * x->n[2]) : j == 1 ? (size_t)x->n[2] : 1;
    const size_t all = 3 * (size_t)points_of(x), block = step * (size_t)x->n[j];
    const bool first = x->n[j] > 1 && hi<x->hi[j], last = x->n[j]> 1 && lo > x->lo[j];
    const double width = x->hi[j] - x->lo[j], here = first ? hi - x->lo[j] : width;
    for (size_t k = 0; k < all && (first || last); k += block)
        for (size_t i = k; i < k + step; ++i) {
            if (first) keep_first(x->p + i, x->n[j], step, here / width);
            if (last) keep_last(x->p + i, x->n[j], step, here > 0 ? (lo - x->lo[j]) / here : 0);
        }
    x->lo[j] = lo, x->hi[j] = hi;
    return (first + last) * (x->n[j] - 1);
}

bool net_take_sizes(net *x)
{
    const int points = points_of(x);
    double zero = 0;
    for (int c = 0; c < 3; ++c) {
        double most = 0;
        for (int k = 0; k < points; ++k) {
            const double size = fabs(x->p[c * points + k]);
            zero += 0 * size;
            if (size > most) most = size;
        }
        x->error[c] = net_padded(x->error[c]);
        x->size[c] = net_padded(most + x->error[c]);
        zero += 0 * x->size[c];
    }
    return zero == 0;
}

bool net_restrict(const net *from, const double lo[3], const double hi[3], net *to)
{
    for (int j = 0; j < 3; ++j) /* one point alone holds at all values of the variable */
        if (!(lo[j] <= hi[j]) ||
            !(from->n[j] == 1 || (from->lo[j] <= lo[j] && hi[j] <= from->hi[j])))
            return false;
    memcpy(to, from, net_bytes(from));
    int levels = 0;
    for (int j = 0; j < 3; ++j) levels += restrict_along(to, j, lo[j], hi[j]);
    for (int c = 0; c < 3; ++c) to->error[c] += 16 * levels * ROUNDING * from->size[c];
    return net_take_sizes(to);
}

/* --- Along an axis ---------------------------------------------------------------------------- */

/* Raises the degree from d to NET_TIMES - 1, by means that are off by less than 6 roundings of the
 * greater number each: s is rounded once. */
static void raise_degree(double *b, int d)
{
    for (; d < NET_TIMES - 1; ++d) {
        b[d + 1] = b[d];
        for (int k = d; k > 0; --k) b[k] = mean(b[k], b[k - 1], (double)k / (d + 1));
    }
}

/* Adds the product of polynomials of degree 2 and n - 1, in Bernstein form. */
static void add_product(const double a[3], const double *b, int n, double *sum)
{
    static const double share[3][3][3] = {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}},
                                          {{1, 1. / 3, 0}, {2. / 3, 2. / 3, 0}, {1. / 3, 1, 0}},
                                          {{1, .5, 1. / 6}, {.5, 2. / 3, .5}, {1. / 6, .5, 1}}};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < n; ++k) sum[i + k] += share[n - 1][i][k] * a[i] * b[k];
}

/* n.M and n.d, and what bounds n.x and its error. */
typedef struct row {
    double w[4][3], size, error, share[3], blur;
} row;

/* Lemma. x is off by error[c], M by its errors: n.M x by the sum of |n| |M| error, |n| times the
 * errors of M times |x|. Here, |M| and |x| are sizes, which include errors. */
static row take_row(const form *x, const double n[3])
{
    row r = {.size = 0};
    const motion *m = x->motion;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3 && m == NULL; ++j) r.share[j] += fabs(n[i]) * x->net->share[i][j];
        r.size += m != NULL ? 0 : fabs(n[i]) * x->net->size[i];
        r.error += m != NULL ? 0 : fabs(n[i]) * x->net->error[i];
        r.blur += m != NULL ? 0 : fabs(n[i]) * x->net->blur[i];
        for (int c = 0; c < 4 && m != NULL; ++c) {
            const double p = c < 3 ? x->net->size[c] : 1, off = c < 3 ? x->net->error[c] : 0;
            r.size += fabs(n[i]) * m->size[i][c] * p;
            r.error += fabs(n[i]) * (m->size[i][c] * off + m->error[i][c] * p);
            r.share[2] += fabs(n[i]) * (m->error[i][c] - m->blur[i][c]) * p;
            r.blur += fabs(n[i]) * m->blur[i][c] * p;
            if (c < 3) r.blur += fabs(n[i]) * m->size[i][c] * x->net->blur[c];
            for (int j = 0; j < 3 && c < 3; ++j)
                r.share[j] += fabs(n[i]) * m->size[i][c] * x->net->share[c][j];
            for (int k = 0; k < 3; ++k) r.w[c][k] += n[i] * m->m[i][c][k];
        }
    }
    return r;
}

/* Returns how many coefficients each point has. */
static int take_points(const form *x, const double n[3], const row *r, double *g)
{
    const int points = points_of(x->net), times = x->net->n[2];
    const int count = x->motion != NULL ? times + 2 : times;
    const double *p[3] = {x->net->p, x->net->p + points, x->net->p + 2 * points};
    for (int i = 0; i < points && x->motion == NULL; ++i)
        g[i] = n[0] * p[0][i] + n[1] * p[1][i] + n[2] * p[2][i];
    for (int i = 0; i < points && x->motion != NULL; i += times, g += count) {
        static const double one[3] = {1, 1, 1};
        for (int k = 0; k < count; ++k) g[k] = 0;
        for (int c = 0; c < 3; ++c) add_product(r->w[c], p[c] + i, times, g);
        add_product(r->w[3], one, times, g);
    }
    return count;
}

/* Lemma. Each way adds h s to n.x, |s| <= 1, h being a convex combination of what it is for the
 * control points: no more than the combination of their |h|, the coefficients' by time. Sets
 * more[i] to the sum of |h| of all ways for coefficient i of the points; returns how many ways. */
static size_t add_ways(const form *x, const double n[3], int count, double *more, double *way)
{
    const motion *m = x->motion;
    double h[NET_POINTS * NET_TIMES];
    for (int i = 0; i < count; ++i) more[i] = 0;
    for (size_t k = 0; m != NULL && k < m->way_count; ++k) {
        row by = {.size = 0};
        double most = 0;
        for (int i = 0; i < 3; ++i)
            for (int c = 0; c < 4; ++c)
                for (int l = 0; l < 3; ++l) by.w[c][l] += n[i] * m->ways[k].m[i][c][l];
        take_points(x, n, &by, h);
        for (int i = 0; i < count; ++i) {
            more[i] += fabs(h[i]);
            most = proof_larger(most, fabs(h[i]));
        }
        if (way != NULL) way[k] = most;
    }
    return m != NULL ? m->way_count : 0;
}

/* Lemma. n.x is a convex combination of its control points at each time, whose greatest are thus
 * coefficients of an upper bound. They are off by less than 64 roundings of `size`: 4 of n.M, 3 of
 * a share, 2 of its products, 12 of their sum, 24 of four means, one of the error that is added;
 * and, since `size` is that with all ways, one for the sum with each way. */
void net_along(const form *x, const double n[3], reach *r, double *way)
{
    const row by = take_row(x, n);
    const int times = r->n[2] = take_points(x, n, &by, r->g);
    const int last = x->net->n[0] * x->net->n[1] * times;
    double more[NET_POINTS * NET_TIMES];
    const size_t ways = add_ways(x, n, last, more, way);
    const double error = r->error =
        net_padded(by.error + (64 + (double)ways) * ROUNDING * net_padded(by.size));
    r->blur = by.blur;
    for (int j = 0; j < 3; ++j) r->share[j] = by.share[j];
    r->n[0] = x->net->n[0], r->n[1] = x->net->n[1];
    r->least = INFINITY;
    for (int i = 0; i < last; ++i) r->least = proof_smaller(r->least, r->g[i]);
    for (int k = 0; k < times; ++k) {
        r->upper[k] = r->g[k] + more[k];
        for (int i = k; i < last; i += times)
            if (!(r->g[i] + more[i] <= r->upper[k])) r->upper[k] = r->g[i] + more[i];
    }
    const int v = (r->n[1] - 1) * times, u = last - times - v;
    for (int end = 0; end < 2; ++end) {
        const double *at = r->g + end * (times - 1), *by_ways = more + end * (times - 1);
        const int corners[4] = {0, v, u, u + v};
        double sum = 0;
        for (int i = 0; i < last; i += times) sum += at[i] + by_ways[i];
        r->ends[end] = -INFINITY;
        for (int i = 0; i < 4; ++i)
            r->ends[end] = proof_larger(r->ends[end], at[corners[i]] + by_ways[corners[i]]);
        r->ends[end] = proof_larger(r->ends[end], sum * times / last);
    }
    raise_degree(r->upper, times - 1);
    for (int k = 0; k < NET_TIMES; ++k)
        r->upper[k] = error < INFINITY ? r->upper[k] + error : INFINITY;
}

double net_points(const form *x, double corner[8][3], double centre[3])
{
    double error = 0;
    reach r;
    for (int c = 0; c < 3; ++c) {
        net_along(x, (double[3]){c == 0, c == 1, c == 2}, &r, NULL);
        const int v = (r.n[1] - 1) * r.n[2], u = (r.n[0] - 1) * r.n[1] * r.n[2], t = r.n[2] - 1;
        const int last = u + v + t;
        for (int k = 0; k < 8; ++k)
            corner[k][c] = r.g[(k & 1) * u + (k >> 1 & 1) * v + (k >> 2) * t];
        centre[c] = 0;
        for (int k = 0; k <= last; ++k) centre[c] += r.g[k] / (last + 1);
        error += r.error;
    }
    return net_padded(error);
}
