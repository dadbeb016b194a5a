/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DIVIDED_HEIGHTS_H
#define CORE_BOUNDS_DIVIDED_HEIGHTS_H

#include "core/bounds/net_hull.h"
#include "core/tree/net_rows.h"

/* The least heights of two patches, by halving Bernstein coefficients
 * ===================================================================
 * The height of a bicubic patch above a paraboloid (net_paraboloid.h) is a polynomial of order
 * (6, 6), or (3, 3) above a plane. A part of the patch is no lower than its least coefficient; the
 * coefficients at its corners are heights of points. The part that may be lowest is halved until
 * the sum of both patches' least heights is known to exceed a limit, or cannot. */

enum {
    DIVIDED_ROW = 2 * IMP_QUAD, /* numbers in a row of order 6, the last of which repeats */
    DIVIDED_PARTS = 40,
    DIVIDED_DEPTH = 24 /* most halvings of one part */
};

typedef struct divided_part {
    double x[DIVIDED_ROW * DIVIDED_ROW]; /* coefficients: seven rows, or four rows of four */
    double low;                          /* the least */
    parameter along;                     /* along which it bends more */
    int depth;
} divided_part;

typedef struct divided_heights {
    divided_part part[DIVIDED_PARTS];
    int count;
    double top; /* the least height of a corner so far */
} divided_heights;

/* Rounding of coefficients in units of u (V + B V^2), V the most of z and x, B >= 2 (|by_0| +
 * |by_1|) what by_i are rounded of (net_paraboloid.c). A coefficient of a square is a mean of
 * products:
 *
 *   by_i                                                        4
 *   binomials and `by` times a number, both factors             2 + 3
 *   sixteen products and their sums, of both squares and z      1 + 22
 *   over binomials: two quotients, their product, one product   4
 *   DIVIDED_DEPTH halvings of six steps, of which each rounds a sum and halves it */
enum { DIVIDED_ROUNDING = 256 };
_Static_assert(4 + 5 + 23 + 4 + 6 * DIVIDED_DEPTH <= DIVIDED_ROUNDING, "rounding of coefficients");

/* --- Products of cubics ----------------------------------------------------------------------- */

/* Seven numbers; the eighth is 0. */
typedef struct divided_row {
    imp_quad of[2];
} divided_row;

/* Adds four numbers to those from place k on. */
IMP_QUAD_INLINE void add_at(divided_row *sum, int k, imp_quad x)
{
    const imp_quad none = imp_quad_all(0);
    switch (k) {
    case 0:
        sum->of[0] += x;
        return;
    case 1:
        sum->of[0] += IMP_QUAD_SHUFFLE(none, x, 0, 4, 5, 6);
        sum->of[1] += IMP_QUAD_SHUFFLE(none, x, 7, 0, 0, 0);
        return;
    case 2:
        sum->of[0] += IMP_QUAD_SHUFFLE(none, x, 0, 0, 4, 5);
        sum->of[1] += IMP_QUAD_SHUFFLE(none, x, 6, 7, 0, 0);
        return;
    default:
        sum->of[0] += IMP_QUAD_SHUFFLE(none, x, 0, 0, 0, 4);
        sum->of[1] += IMP_QUAD_SHUFFLE(none, x, 5, 6, 7, 0);
    }
}

/* Adds the products of two cubics whose coefficients have been multiplied by binomials. */
IMP_QUAD_INLINE void add_product(divided_row *sum, imp_quad x, imp_quad y)
{
    for (int k = 0; k < 4; ++k) add_at(sum, k, imp_quad_all(x[k]) * y);
}

static const double divided_cubic[4] = {1, 3, 3, 1};
static const double divided_over[8] = {1, 1.0 / 6, 1.0 / 15, 1.0 / 20, 1.0 / 15, 1.0 / 6, 1, 1};

/* Multiplies the coefficients of a bicubic patch by binomials. */
IMP_QUAD_INLINE void multiply_out(const imp_quad x[4], imp_quad out[4])
{
    const imp_quad row = imp_quad_load(divided_cubic);
    for (int k = 0; k < 4; ++k) out[k] = imp_quad_all(divided_cubic[k]) * row * x[k];
}

/* Adds `by` times the square of a patch to the rows of its coefficients. */
IMP_QUAD_INLINE void add_square(divided_row sum[7], const imp_quad patch[4], double by)
{
    imp_quad x[4];
    multiply_out(patch, x);
    for (int i = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j)
            add_product(&sum[i + j], imp_quad_all(i == j ? by : 2 * by) * x[i], x[j]);
}

/* Adds a patch. */
IMP_QUAD_INLINE void add_raised(divided_row sum[7], const imp_quad patch[4], double by)
{
    const imp_quad ones = imp_quad_load(divided_cubic);
    imp_quad x[4];
    multiply_out(patch, x);
    for (int i = 0; i < 4; ++i) {
        divided_row wide = {{imp_quad_all(0), imp_quad_all(0)}};
        add_product(&wide, ones, imp_quad_all(by) * x[i]);
        for (int j = 0; j < 4; ++j)
            for (int q = 0; q < 2; ++q)
                sum[i + j].of[q] += imp_quad_all(divided_cubic[j]) * wide.of[q];
    }
}

/* --- Parts ------------------------------------------------------------------------------------ */

/* Keeps the least coefficient, the least corner, and the direction of the greater second
 * difference. Which parameter is halved is of no consequence but for work. */
IMP_QUAD_INLINE void part_measure(divided_part *p, bool is_flat, double *top)
{
    const int last = is_flat ? 3 : 6, row = is_flat ? IMP_QUAD : DIVIDED_ROW;
    const double *const first = p->x, *const middle = p->x + (is_flat ? 1 : 3) * row,
                        *const end = p->x + last * row;
    imp_quad low = imp_quad_load(p->x);
    for (int k = IMP_QUAD; k < (last + 1) * row; k += IMP_QUAD)
        low = imp_quad_min(imp_quad_load(p->x + k), low);
    p->low = least_of(low);
    const double corner[4] = {first[0], first[last], end[0], end[last]};
    for (int k = 0; k < 4; ++k)
        if (corner[k] < *top) *top = corner[k];
    double bend[2] = {0, 0};
    const int at[3] = {0, is_flat ? 1 : 3, last};
    const double *const of[3] = {first, middle, end};
    for (int k = 0; k < 3; ++k) {
        const double u = fabs(first[at[k]] - 2 * middle[at[k]] + end[at[k]]);
        const double v = fabs(of[k][0] - 2 * of[k][at[1]] + of[k][last]);
        if (u > bend[0]) bend[0] = u;
        if (v > bend[1]) bend[1] = v;
    }
    p->along = bend[0] > bend[1] ? PARAMETER_U : PARAMETER_V;
}

/* De Casteljau at the middle, for four polynomials of order 6 at once. */
IMP_QUAD_INLINE void halve_lines_of_7(imp_quad r[7], imp_quad lower[7], imp_quad upper[7])
{
    const imp_quad half = imp_quad_all(0.5);
    for (int k = 0; k < 7; ++k) {
        lower[k] = r[0];
        upper[6 - k] = r[6 - k];
        for (int i = 0; i < 6 - k; ++i) r[i] = half * (r[i] + r[i + 1]);
    }
}

IMP_QUAD_INLINE void halve_along_u(const divided_part *p, divided_part *const half[2])
{
    for (int q = 0; q < DIVIDED_ROW; q += IMP_QUAD) {
        imp_quad r[7], out[2][7];
        for (int k = 0; k < 7; ++k) r[k] = imp_quad_load(p->x + DIVIDED_ROW * k + q);
        halve_lines_of_7(r, out[0], out[1]);
        for (int h = 0; h < 2; ++h)
            for (int k = 0; k < 7; ++k) imp_quad_store(half[h]->x + DIVIDED_ROW * k + q, out[h][k]);
    }
}

/* The eighth row is not set, nor is it used. */
IMP_QUAD_INLINE void halve_along_v(const divided_part *p, divided_part *const half[2])
{
    for (int first = 0; first < 7; first += IMP_QUAD) {
        const int count = first == 0 ? 4 : 3;
        imp_quad r[8], out[2][8];
        for (int k = 0; k < 4; ++k)
            for (int q = 0; q < 2; ++q)
                r[4 * q + k] = k < count ? imp_quad_load(p->x + DIVIDED_ROW * (first + k) + 4 * q)
                                         : imp_quad_all(0);
        imp_quad_transpose(r);
        imp_quad_transpose(r + 4);
        halve_lines_of_7(r, out[0], out[1]);
        for (int h = 0; h < 2; ++h) {
            out[h][7] = out[h][6];
            imp_quad_transpose(out[h]);
            imp_quad_transpose(out[h] + 4);
            for (int k = 0; k < count; ++k)
                for (int q = 0; q < 2; ++q)
                    imp_quad_store(half[h]->x + DIVIDED_ROW * (first + k) + 4 * q,
                                   out[h][4 * q + k]);
        }
    }
}

IMP_QUAD_INLINE void part_halve(const divided_part *p, bool is_flat, divided_part *const half[2])
{
    if (is_flat) {
        const halved_rows both = rows_halved(rows_along(rows_at(p->x), p->along));
        for (int h = 0; h < 2; ++h)
            rows_store(half[h]->x, rows_along(rows_of_half(&both, h), p->along));
    } else if (p->along == PARAMETER_U) {
        halve_along_u(p, half);
    } else {
        halve_along_v(p, half);
    }
}

/* --- The search ------------------------------------------------------------------------------- */

/* Returns the least height of a patch's corners: sign z - sum_i by_i x_i^2. */
IMP_QUAD_INLINE double divided_top(const imp_quad z[4], const imp_quad x[2][4], double sign,
                                   const double by[2], bool is_flat)
{
    double top = INFINITY;
    for (int row = 0; row < 4; row += 3) {
        imp_quad h = imp_quad_all(sign) * z[row];
        for (int i = 0; i < 2 && !is_flat; ++i) h -= imp_quad_all(by[i]) * (x[i][row] * x[i][row]);
        if (h[0] < top) top = h[0];
        if (h[3] < top) top = h[3];
    }
    return top;
}

/* Fills the heights of a bicubic patch with those of its corners' least. */
IMP_QUAD_INLINE void divided_begin(divided_heights *h, const imp_quad z[4], const imp_quad x[2][4],
                                   double sign, const double by[2], bool is_flat)
{
    divided_part *p = &h->part[0];
    h->count = 1;
    h->top = INFINITY;
    p->depth = 0;
    if (is_flat) {
        for (int k = 0; k < 4; ++k) imp_quad_store(p->x + IMP_QUAD * k, imp_quad_all(sign) * z[k]);
    } else {
        divided_row sum[7];
        for (int k = 0; k < 7; ++k) sum[k].of[0] = sum[k].of[1] = imp_quad_all(0);
        add_raised(sum, z, sign);
        for (int i = 0; i < 2; ++i) add_square(sum, x[i], -by[i]);
        for (int k = 0; k < 7; ++k)
            for (int q = 0; q < 2; ++q)
                imp_quad_store(p->x + DIVIDED_ROW * k + IMP_QUAD * q,
                               sum[k].of[q] * (imp_quad_all(divided_over[k]) *
                                               imp_quad_load(divided_over + IMP_QUAD * q)));
        for (int k = 0; k < 7; ++k) p->x[DIVIDED_ROW * k + 7] = p->x[DIVIDED_ROW * k + 6];
    }
    part_measure(p, is_flat, &h->top);
}

static inline int lowest_part(const divided_heights *h)
{
    int best = 0;
    for (int k = 1; k < h->count; ++k)
        if (h->part[k].low < h->part[best].low) best = k;
    return best;
}

/* Replaces a part by its halves, but one that is higher than a corner of the patch, so that it does
 * not have the least height. False: there is no room. */
IMP_QUAD_INLINE bool divide(divided_heights *h, int at, bool is_flat)
{
    divided_part *p = &h->part[at], *q = &h->part[h->count];
    if (h->count == DIVIDED_PARTS || p->depth == DIVIDED_DEPTH) return false;
    q->depth = ++p->depth;
    part_halve(p, is_flat, (divided_part *const[2]){p, q});
    part_measure(p, is_flat, &h->top);
    part_measure(q, is_flat, &h->top);
    if (p->low > h->top)
        *p = *q;
    else if (!(q->low > h->top))
        h->count += 1;
    return true;
}

/* Whether the sum of both patches' least heights exceeds the limit. */
IMP_QUAD_INLINE bool divided_exceed(divided_heights h[2], double limit, bool is_flat)
{
    int at[2] = {0, 0};
    for (;;) {
        const double low[2] = {h[0].part[at[0]].low, h[1].part[at[1]].low};
        if (low[0] + low[1] > limit) return true;
        if (!(h[0].top + h[1].top > limit)) return false;
        const int side = h[0].top - low[0] > h[1].top - low[1] ? 0 : 1;
        if (!divide(&h[side], at[side], is_flat)) return false;
        at[side] = lowest_part(&h[side]);
    }
}

#endif
