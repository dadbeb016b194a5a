/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tools/verify/net_internal.h"

/* --- Taylor polynomials ----------------------------------------------------------------------- */

/* c + sum of g[j] s[j] + sum of h[j][k] s[j] s[k], j <= k, for s in [-1, 1]. */
typedef struct quadratic {
    double c, g[3], h[3][3], error;
} quadratic;

/* The box relative to `at`: p - at = half s + rest, |s| <= 1. Lemma. `at` is the middle but for one
 * rounding of an end, and `half` is half the width but for one more. */
typedef struct scale {
    double half[3], rest[3];
} scale;

static scale scale_of(int n, const double lo[], const double hi[])
{
    scale x = {.half = {0}};
    for (int j = 0; j < n; ++j) {
        x.half[j] = 0.5 * (hi[j] - lo[j]);
        if (hi[j] > lo[j])
            x.rest[j] = net_padded(4 * ROUNDING * proof_larger(fabs(lo[j]), fabs(hi[j])));
    }
    return x;
}

/* Lemma. A function is c + d (p - at) with its slopes d over the box, and c + d (p - at) +
 * 1/2 h (p - at)^2 with its slopes at the point, and its second derivatives h over the box
 * (jet_values). Middles stand for intervals, which are off by no more than net_off. */
static quadratic first_order(const jet *wide, const jet *centre, const scale *by)
{
    quadratic q = {.c = ld_interval_mid(centre->v)};
    q.error = net_off(centre->v, q.c);
    double size = fabs(q.c);
    for (int j = 0; j < wide->n; ++j) {
        const double d = ld_interval_mid(wide->d[j]);
        q.g[j] = d * by->half[j];
        q.error += net_off(wide->d[j], d) * (by->half[j] + by->rest[j]) + fabs(d) * by->rest[j];
        size += fabs(q.g[j]);
    }
    q.error = net_padded(q.error + 16 * ROUNDING * size);
    return q;
}

static quadratic second_order(const jet *wide, const jet *centre, const scale *by)
{
    quadratic q = {.c = ld_interval_mid(centre->v)};
    q.error = net_off(centre->v, q.c);
    double size = fabs(q.c);
    for (int j = 0; j < wide->n; ++j) {
        const double d = ld_interval_mid(centre->d[j]), most = by->half[j] + by->rest[j];
        q.g[j] = d * by->half[j];
        q.error += net_off(centre->d[j], d) * most + fabs(d) * by->rest[j];
        size += fabs(q.g[j]);
        for (int k = j; k < wide->n; ++k) {
            const double h = ld_interval_mid(wide->h[j][k]), part = j == k ? 0.5 : 1;
            const double most2 = by->half[k] + by->rest[k];
            q.h[j][k] = part * h * by->half[j] * by->half[k];
            q.error += part * (net_off(wide->h[j][k], h) * most * most2 +
                               fabs(h) * (most * by->rest[k] + by->rest[j] * by->half[k]));
            size += fabs(q.h[j][k]);
        }
    }
    q.error = net_padded(q.error + 64 * ROUNDING * size);
    return q;
}

/* The closest polynomial of degree 0 to 2, and its error. */
static quadratic closest(const jet *wide, const jet *centre, const scale *by)
{
    quadratic best = {.c = ld_interval_is_finite(wide->v) ? ld_interval_mid(wide->v) : 0};
    best.error = net_off(wide->v, best.c);
    const quadratic other[2] = {first_order(wide, centre, by), second_order(wide, centre, by)};
    for (int k = 0; k < 2; ++k)
        if (other[k].error < best.error) best = other[k];
    return best;
}

/* s and s^2 in Bernstein form of degree 2, s in [-1, 1]: -1, 0, 1 and 1, -1, 1. */
static double bernstein(const quadratic *q, int n, const int at[3])
{
    double sum = q->c;
    for (int j = 0; j < n; ++j) {
        sum += q->g[j] * (at[j] - 1) + q->h[j][j] * (at[j] == 1 ? -1 : 1);
        for (int k = j + 1; k < n; ++k) sum += q->h[j][k] * (at[j] - 1) * (at[k] - 1);
    }
    return sum;
}

/* What the error is due to: how much the function depends on a variable, by its derivatives; where
 * these have no bounds, by the widths. */
static void take_share(const jet *wide, const scale *by, double error, double share[3])
{
    double sum = 0, width = 0;
    for (int j = 0; j < 3; ++j) {
        share[j] = ld_interval_mag(wide->d[j]) * by->half[j];
        sum += share[j];
        width += jet_has(wide, j) ? by->half[j] : 0;
    }
    const bool is_known = sum > 0 && sum < INFINITY;
    for (int j = 0; j < 3; ++j) {
        if (!is_known) share[j] = jet_has(wide, j) ? by->half[j] : 0;
        share[j] *= error / (is_known ? sum : width > 0 ? width : 1);
    }
}

bool net_of_jets(const jet wide[3], const jet centre[3], const double lo[3], const double hi[3],
                 net *to)
{
    const scale by = scale_of(3, lo, hi);
    for (int j = 0; j < 3; ++j) {
        const bool depends = jet_has(&wide[0], j) || jet_has(&wide[1], j) || jet_has(&wide[2], j);
        to->n[j] = depends && hi[j] > lo[j] ? 3 : 1;
        to->lo[j] = lo[j], to->hi[j] = hi[j];
    }
    double *p = to->p;
    for (int c = 0; c < 3; ++c) {
        const quadratic q = closest(&wide[c], &centre[c], &by);
        for (int i = 0; i < to->n[0]; ++i)
            for (int j = 0; j < to->n[1]; ++j)
                for (int k = 0; k < to->n[2]; ++k) *p++ = bernstein(&q, 3, (int[]){i, j, k});
        to->error[c] = q.error;
        to->blur[c] = proof_smaller(net_off(centre[c].v, ld_interval_mid(centre[c].v)), q.error);
        take_share(&wide[c], &by, q.error - to->blur[c], to->share[c]);
    }
    return net_take_sizes(to);
}

bool motion_of_jets(const jet *wide, const jet *centre, double lo, double hi,
                    double coefficients[3], double *error, double *size)
{
    const scale by = scale_of(1, &lo, &hi);
    const quadratic q = closest(wide, centre, &by);
    *size = 0;
    for (int k = 0; k < 3; ++k) {
        coefficients[k] = bernstein(&q, 1, (int[]){k, 0, 0});
        *size = proof_larger(*size, fabs(coefficients[k]));
    }
    *error = net_padded(q.error + 16 * ROUNDING * *size);
    *size = net_padded(*size + *error);
    return *size < INFINITY;
}

/* Lemma. h s^2 is h / 2 but for |h| / 2. */
void motion_line_of_jets(const jet *wide, const jet *centre, double lo, double hi, double line[2],
                         double *error)
{
    const scale by = scale_of(1, &lo, &hi);
    const quadratic q = closest(wide, centre, &by);
    const double bend = 0.5 * q.h[0][0];
    line[0] = q.c + bend;
    line[1] = q.g[0];
    *error = net_padded(q.error + fabs(bend) + 16 * ROUNDING * (fabs(q.c) + fabs(bend)));
}
