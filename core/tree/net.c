/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/net.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/tree/net_rows.h"

/* --- From an imp_net -------------------------------------------------------------------------- */

static int stride_of(int points) { return (points + IMP_QUAD - 1) / IMP_QUAD * IMP_QUAD; }

size_t net_bytes(const net *n)
{
    const int columns = 3 + (n->is_moving ? 3 : 0) + (n->is_weighted ? 1 : 0);
    return sizeof(net) + (size_t)(n->stride * columns) * sizeof(double);
}

static void take_column(double *to, int stride, const double *from, int points)
{
    memcpy(to, from, (size_t)points * sizeof *to);
    for (int k = points; k < stride; ++k) to[k] = from[points - 1];
}

static double greatest(const double *x, int points)
{
    double most = 0;
    for (int k = 0; k < points; ++k)
        if (fabs(x[k]) > most) most = fabs(x[k]);
    return most;
}

/* Products of two numbers, and of a number and two weights, stay within a double; so do those of an
 * axis, a velocity and a time, and an underflow of the first two times a time is far below
 * 2^-490. */
#define NET_LARGE 0x1p300

static bool is_moderate(const imp_net *given, const net *n, const imp_region *region, int points)
{
    bool fine = fabs(region->c[PARAMETER_T]) + region->d[PARAMETER_T] < NET_LARGE;
    for (int i = 0; i < 3; ++i)
        fine = fine && fabs(given->place[i]) < NET_LARGE && fabs(given->drift[i]) < NET_LARGE &&
               (!n->is_moving || greatest(given->velocity[i], points) < NET_LARGE) &&
               n->most[i] < NET_LARGE && given->error[i] < NET_LARGE;
    for (int k = 0; k < points && given->is_weighted; ++k)
        fine = fine && given->weight[k] < NET_LARGE && given->weight[k] > 1 / NET_LARGE;
    return fine;
}

PAD_COVERS(4, 2); /* most: a product and a sum */

bool net_take(net *n, const imp_net *given, const imp_region *region)
{
    const int points = (int)((given->degree[0] + 1) * (given->degree[1] + 1));
    *n = (net){.degree = {(int)given->degree[0], (int)given->degree[1]},
               .stride = stride_of(points),
               .is_moving = given->is_moving != 0,
               .is_weighted = given->is_weighted != 0,
               .time = region->c[PARAMETER_T]};
    for (int i = 0; i < 3; ++i) {
        n->place[i] = given->place[i];
        n->drift[i] = given->drift[i];
        n->error[i] = given->error[i];
        n->most[i] = greatest(given->point[i], points);
        if (n->is_moving)
            n->most[i] = padded_upper(
                n->most[i] + region->d[PARAMETER_T] * greatest(given->velocity[i], points), 4);
    }
    if (!is_moderate(given, n, region, points)) return false;
    double *to = n->numbers;
    for (int i = 0; i < 3; ++i, to += n->stride)
        take_column(to, n->stride, given->point[i], points);
    for (int i = 0; i < 3 && n->is_moving; ++i, to += n->stride)
        take_column(to, n->stride, given->velocity[i], points);
    if (n->is_weighted) take_column(to, n->stride, given->weight, points);
    return true;
}

/* --- Halves ----------------------------------------------------------------------------------- */

/* Runs de Casteljau at the middle, in place: x[0], x[step], ... of degree n become those of a
 * half. */
static void halve_plain(double *x, int n, int step, int side)
{
    for (int used = 1; used <= n; ++used)
        if (side == 0)
            for (int i = n; i >= used; --i) x[i * step] = 0.5 * (x[(i - 1) * step] + x[i * step]);
        else
            for (int i = 0; i <= n - used; ++i)
                x[i * step] = 0.5 * (x[i * step] + x[(i + 1) * step]);
}

/* Halves a column x of a bicubic patch into `half`, which may be x. */
IMP_QUAD_INLINE void halve_column(const double *x, parameter j, int side, double *half)
{
    const halved_rows both = rows_halved(rows_along(rows_at(x), j));
    rows_store(half, rows_along(rows_of_half(&both, side), j));
}

IMP_QUAD_INLINE void halve_columns(const double *x, int columns, parameter j, int side,
                                   double *half)
{
    for (int c = 0; c < columns; ++c) halve_column(x + 16 * c, j, side, half + 16 * c);
}

/* Halves the columns x of a bicubic patch, one after the other, into `half`, which may be x. */
IMP_QUAD_INLINE void halve_bicubic(const double *x, int columns, parameter j, int side,
                                   double *half)
{
    if (j == PARAMETER_U && side == 0)
        halve_columns(x, columns, PARAMETER_U, 0, half);
    else if (j == PARAMETER_U)
        halve_columns(x, columns, PARAMETER_U, 1, half);
    else if (side == 0)
        halve_columns(x, columns, PARAMETER_V, 0, half);
    else
        halve_columns(x, columns, PARAMETER_V, 1, half);
}

/* Returns the mean of two numbers by their weights. */
static double mean(double x, double w, double y, double z) { return (w * x + z * y) / (w + z); }

/* Halves `columns` columns that are `apart` from each other, by the weights w. */
static void halve_weighted(double *x, double *w, int columns, int apart, int n, int step, int side)
{
    for (int used = 1; used <= n; ++used)
        for (int k = 0; k <= n - used; ++k) {
            const int lower = side == 0 ? n - 1 - k : k, upper = lower + 1;
            const int to = (side == 0 ? upper : lower) * step;
            const double low = w[lower * step], high = w[upper * step];
            for (int c = 0; c < columns; ++c) {
                double *y = x + c * apart;
                y[to] = mean(y[lower * step], low, y[upper * step], high);
            }
            w[to] = 0.5 * (low + high);
        }
}

/* The weights of a rational bicubic patch, four lines at a time: those of the control points, then
 * of the means of two, of three and of all four points. */
typedef struct row_weights {
    imp_quad point[4], two[3], three[2], all;
} row_weights;

IMP_QUAD_INLINE row_weights weights_of_rows(const rows *w)
{
    const imp_quad half = imp_quad_all(0.5);
    row_weights of;
    for (int k = 0; k < 4; ++k) of.point[k] = w->row[k];
    for (int k = 0; k < 3; ++k) of.two[k] = half * (of.point[k] + of.point[k + 1]);
    for (int k = 0; k < 2; ++k) of.three[k] = half * (of.two[k] + of.two[k + 1]);
    of.all = half * (of.three[0] + of.three[1]);
    return of;
}

IMP_QUAD_INLINE imp_quad mean_of_rows(imp_quad x, imp_quad w, imp_quad y, imp_quad z)
{
    return (w * x + z * y) / (w + z);
}

IMP_QUAD_INLINE rows rows_halved_weighted(const rows *x, const row_weights *w, int side)
{
    const imp_quad *const r = x->row;
    imp_quad two[3], three[2];
    for (int k = 0; k < 3; ++k) two[k] = mean_of_rows(r[k], w->point[k], r[k + 1], w->point[k + 1]);
    for (int k = 0; k < 2; ++k)
        three[k] = mean_of_rows(two[k], w->two[k], two[k + 1], w->two[k + 1]);
    const imp_quad all = mean_of_rows(three[0], w->three[0], three[1], w->three[1]);
    return side == 0 ? (rows){{r[0], two[0], three[0], all}}
                     : (rows){{all, three[1], two[2], r[3]}};
}

IMP_QUAD_INLINE void halve_bicubic_weighted(double *x, int columns, parameter j, int side)
{
    double *w = x + 16 * columns;
    const rows lines = rows_along(rows_at(w), j);
    const row_weights of = weights_of_rows(&lines);
    for (int c = 0; c < columns; ++c, x += 16) {
        const rows whole = rows_along(rows_at(x), j);
        rows_store(x, rows_along(rows_halved_weighted(&whole, &of, side), j));
    }
    const rows half = side == 0 ? (rows){{of.point[0], of.two[0], of.three[0], of.all}}
                                : (rows){{of.all, of.three[1], of.two[2], of.point[3]}};
    rows_store(w, rows_along(half, j));
}

IMP_QUAD_WIDE static void halve_bicubic_weighted_wide(double *x, int columns, parameter j, int side)
{
    halve_bicubic_weighted(x, columns, j, side);
}

/* Lemma (error). Over the region's times a number is at most M = `most` in size, and so are means
 * of such, but for a factor below 2 that the budgets allow for. Halving goes through n steps.
 * In units of u M:
 *
 *   without weights   a step rounds the sum                                          1
 *   with weights      a step rounds two products, two sums and the quotient          5
 *                     weights, computed, are off by a factor of 1 + n u at most,
 *                     which moves a mean of points 2 M apart by                    2 n
 *                     and the patch itself, of the half, once more, by             2 n
 *
 * so n units without weights, and n (5 + 2 n) + 2 n with weights; twice that is added. A step's two
 * products underflow by 2^-1075 each, over weights that add up to 2^-299 at least: n <= 35 steps by
 * less than 2^-769, of velocities times less than 2^300 (NET_LARGE). */
#define HALVING_UNDERFLOW 0x1p-468

static double halving_units(const net *p, int n)
{
    return 2 * (p->is_weighted ? n * (5 + 2 * n) + 2 * n : n);
}

static double halving_upper(double units, double most)
{
    return units * UNIT_ROUNDOFF * most + HALVING_UNDERFLOW;
}

/* Halves any patch, line after line, then the copies of the last point. */
static void halve_lines(const net *f, parameter j, int side, double *x, int columns)
{
    const int n = f->degree[j], other = f->degree[!j], inner = f->degree[1] + 1;
    const int step = j == PARAMETER_U ? inner : 1, next = j == PARAMETER_U ? 1 : inner;
    const int points = (n + 1) * (other + 1);
    double *w = x + columns * f->stride;
    for (int line = 0; line <= other; ++line)
        if (f->is_weighted)
            halve_weighted(x + line * next, w + line * next, columns, f->stride, n, step, side);
        else
            for (int c = 0; c < columns; ++c)
                halve_plain(x + c * f->stride + line * next, n, step, side);
    for (int c = 0; c < columns + (f->is_weighted ? 1 : 0); ++c)
        for (int k = points; k < f->stride; ++k)
            x[c * f->stride + k] = x[c * f->stride + points - 1];
}

IMP_QUAD_NARROW static void halve_bicubic_narrow(const double *x, int columns, parameter j,
                                                 int side, double *half)
{
    halve_bicubic(x, columns, j, side, half);
}

IMP_QUAD_WIDE static void halve_bicubic_wide(const double *x, int columns, parameter j, int side,
                                             double *half)
{
    halve_bicubic(x, columns, j, side, half);
}

void net_halve_columns(const net *p, parameter j, int side, double *x, int columns)
{
    if (p->degree[0] != 3 || p->degree[1] != 3)
        halve_lines(p, j, side, x, columns);
    else if (p->is_weighted && imp_quad_is_wide())
        halve_bicubic_weighted_wide(x, columns, j, side);
    else if (p->is_weighted)
        halve_bicubic_weighted(x, columns, j, side);
    else if (imp_quad_is_wide())
        halve_bicubic_wide(x, columns, j, side, x);
    else
        halve_bicubic_narrow(x, columns, j, side, x);
}

double net_halving_upper(const net *p, parameter j, double most)
{
    return halving_upper(halving_units(p, p->degree[j]), most);
}

/* Lemma. Errors are not negative, so that halving_upper, which is not 0, makes their sums positive.
 * The fourth lane stays 0. */
IMP_QUAD_INLINE void add_halving(const net *p, double units, net *half)
{
    const imp_quad_mask three = {-1, -1, -1, 0};
    const imp_quad rounding = imp_quad_all(units * UNIT_ROUNDOFF) * imp_quad_load(p->most) +
                              imp_quad_all(HALVING_UNDERFLOW);
    const imp_quad sum = quad_above(imp_quad_load(p->error) + rounding);
    imp_quad_store(half->error, (imp_quad)((imp_quad_mask)sum & three));
}

/* Halves a bicubic patch without weights. */
IMP_QUAD_INLINE void halve_plain_net(const net *p, parameter j, int side, net *half)
{
    if (half != p) *half = *p; /* all fields but the numbers */
    add_halving(p, halving_units(p, 3), half);
    halve_bicubic(p->numbers, p->is_moving ? 6 : 3, j, side, half->numbers);
}

IMP_QUAD_NARROW static void halve_plain_net_narrow(const net *p, parameter j, int side, net *half)
{
    halve_plain_net(p, j, side, half);
}

IMP_QUAD_WIDE static void halve_plain_net_wide(const net *p, parameter j, int side, net *half)
{
    halve_plain_net(p, j, side, half);
}

static void halve_any_net(const net *p, parameter j, int side, net *half)
{
    if (half != p) memcpy(half, p, net_bytes(p));
    net_halve_columns(p, j, side, half->numbers, p->is_moving ? 6 : 3);
    add_halving(p, halving_units(p, p->degree[j]), half);
}

void net_halve(const net *p, parameter j, int side, net *half)
{
    if (p->degree[0] != 3 || p->degree[1] != 3 || p->is_weighted)
        halve_any_net(p, j, side, half);
    else if (imp_quad_is_wide())
        halve_plain_net_wide(p, j, side, half);
    else
        halve_plain_net_narrow(p, j, side, half);
}
