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

#define DIVIDED_UNROLL _Pragma("GCC unroll 4")

typedef struct divided_part {
    double x[DIVIDED_ROW * DIVIDED_ROW]; /* coefficients: seven rows, or four rows of four */
    int depth;
} divided_part;

typedef struct divided_heights {
    divided_part part[DIVIDED_PARTS];
    double low[DIVIDED_PARTS]; /* the least coefficient of each */
    int count;
    double top; /* the least height of a corner so far */
} divided_heights;

/* Rounding of coefficients in units of u (V + B V^2), V the most of z and x, B >= 2 (|by_0| +
 * |by_1|) what by_i are rounded of (net_paraboloid.c). A coefficient of a square is a mean of
 * products:
 *
 *   by_i                                                        4
 *   binomials and `by` times a number, both factors             2 + 3
 *   a product, and at most 22 sums, of both squares and z       1 + 22
 *   over binomials: two quotients, their product, one product   4
 *   DIVIDED_DEPTH halvings of six steps, of which each rounds a sum and halves it */
enum { DIVIDED_ROUNDING = 256 };
_Static_assert(4 + 5 + 23 + 4 + 6 * DIVIDED_DEPTH <= DIVIDED_ROUNDING, "rounding of coefficients");

/* --- Products of cubics ----------------------------------------------------------------------- */

/* Products of two cubics, whose coefficients have been multiplied by binomials, by the coefficient
 * of the first: those of the k-th count from place k on. */
typedef struct cubic_products {
    imp_quad from[4];
} cubic_products;

IMP_QUAD_INLINE void add_product(cubic_products *sum, imp_quad x, imp_quad y)
{
    for (int k = 0; k < 4; ++k) sum->from[k] += imp_quad_all(x[k]) * y;
}

/* Seven numbers; the eighth is 0. */
typedef struct divided_row {
    imp_quad of[2];
} divided_row;

IMP_QUAD_INLINE divided_row products_summed(const cubic_products *p)
{
    const imp_quad none = imp_quad_all(0), *x = p->from;
    divided_row sum = {{x[0], IMP_QUAD_SHUFFLE(none, x[1], 7, 0, 0, 0)}};
    sum.of[0] += IMP_QUAD_SHUFFLE(none, x[1], 0, 4, 5, 6);
    sum.of[0] += IMP_QUAD_SHUFFLE(none, x[2], 0, 0, 4, 5);
    sum.of[1] += IMP_QUAD_SHUFFLE(none, x[2], 6, 7, 0, 0);
    sum.of[0] += IMP_QUAD_SHUFFLE(none, x[3], 0, 0, 0, 4);
    sum.of[1] += IMP_QUAD_SHUFFLE(none, x[3], 5, 6, 7, 0);
    return sum;
}

static const double divided_cubic[4] = {1, 3, 3, 1};
static const double divided_over[8] = {1, 1.0 / 6, 1.0 / 15, 1.0 / 20, 1.0 / 15, 1.0 / 6, 1, 1};

/* Multiplies the coefficients of a bicubic patch by binomials. */
IMP_QUAD_INLINE void multiply_out(const imp_quad x[4], imp_quad out[4])
{
    const imp_quad row = imp_quad_load(divided_cubic);
    for (int k = 0; k < 4; ++k) out[k] = imp_quad_all(divided_cubic[k]) * row * x[k];
}

/* The patches of a height, multiplied out: `sign` times z, across, and `by` times across. */
typedef struct divided_patches {
    imp_quad z[4], x[2][4], times[2][4];
} divided_patches;

IMP_QUAD_INLINE void patches_take(const imp_quad z[4], const imp_quad x[2][4], double sign,
                                  const double by[2], divided_patches *p)
{
    multiply_out(z, p->z);
    for (int k = 0; k < 4; ++k) p->z[k] = imp_quad_all(sign) * p->z[k];
    for (int i = 0; i < 2; ++i) {
        multiply_out(x[i], p->x[i]);
        for (int k = 0; k < 4; ++k) p->times[i][k] = imp_quad_all(-by[i]) * p->x[i][k];
    }
}

/* Row r of the height: z raised by three degrees, less by_i times the squares of x_i. */
IMP_QUAD_INLINE divided_row height_row(const divided_patches *p, int r)
{
    const int first = r > 3 ? r - 3 : 0;
    const imp_quad none = imp_quad_all(0);
    cubic_products sum = {{none, none, none, none}};
    imp_quad raised = none;
    DIVIDED_UNROLL
    for (int i = first; i <= r - first; ++i) raised += imp_quad_all(divided_cubic[r - i]) * p->z[i];
    add_product(&sum, imp_quad_load(divided_cubic), raised);
    DIVIDED_UNROLL
    for (int i = first; 2 * i <= r; ++i)
        for (int j = 0; j < 2; ++j) {
            imp_quad x = p->times[j][i];
            if (2 * i != r) x += x;
            add_product(&sum, x, p->x[j][r - i]);
        }
    return products_summed(&sum);
}

/* --- Parts ------------------------------------------------------------------------------------ */

/* The greatest of three numbers and 0; a NaN counts for nothing. */
IMP_QUAD_INLINE double greatest_of_three(double x, double y, double z)
{
    double most = 0;
    if (x > most) most = x;
    if (y > most) most = y;
    if (z > most) most = z;
    return most;
}

IMP_QUAD_INLINE double bend_along(const double *first, const double *middle, const double *end)
{
    return fabs(*first - 2 * *middle + *end);
}

/* Returns the parameter with the greater second difference. Which one is halved is of no
 * consequence but for work. */
IMP_QUAD_INLINE parameter bent_along(const divided_part *p, bool is_flat)
{
    const int last = is_flat ? 3 : 6, mid = is_flat ? 1 : 3, row = is_flat ? IMP_QUAD : DIVIDED_ROW;
    const double *const a = p->x, *const b = p->x + mid * row, *const c = p->x + last * row;
    const imp_quad two = imp_quad_all(2);
    const imp_quad u = imp_quad_abs(imp_quad_load(a) - two * imp_quad_load(b) + imp_quad_load(c));
    const double end = is_flat ? u[mid] : bend_along(a + last, b + last, c + last);
    const double along_u = greatest_of_three(u[0], u[3], end);
    const double along_v =
        greatest_of_three(bend_along(a, a + mid, a + last), bend_along(b, b + mid, b + last),
                          bend_along(c, c + mid, c + last));
    return along_u > along_v ? PARAMETER_U : PARAMETER_V;
}

/* Keeps the least corner, and returns the least coefficient. */
IMP_QUAD_INLINE double part_measure(const divided_part *p, bool is_flat, double *top)
{
    const int last = is_flat ? 3 : 6, row = is_flat ? IMP_QUAD : DIVIDED_ROW;
    const double *const end = p->x + last * row;
    imp_quad low = imp_quad_load(p->x);
    for (int k = IMP_QUAD; k < (last + 1) * row; k += IMP_QUAD)
        low = imp_quad_min(imp_quad_load(p->x + k), low);
    double least = *top;
    least = p->x[0] < least ? p->x[0] : least;
    least = p->x[last] < least ? p->x[last] : least;
    least = end[0] < least ? end[0] : least;
    least = end[last] < least ? end[last] : least;
    *top = least;
    return least_of(low);
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
    const parameter along = bent_along(p, is_flat);
    if (is_flat) {
        const halved_rows both = rows_halved(rows_along(rows_at(p->x), along));
        for (int h = 0; h < 2; ++h)
            rows_store(half[h]->x, rows_along(rows_of_half(&both, h), along));
    } else if (along == PARAMETER_U) {
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
        divided_patches of;
        patches_take(z, x, sign, by, &of);
        _Pragma("GCC unroll 7") for (int k = 0; k < 7; ++k)
        {
            const divided_row row = height_row(&of, k);
            for (int q = 0; q < 2; ++q)
                imp_quad_store(p->x + DIVIDED_ROW * k + IMP_QUAD * q,
                               row.of[q] * (imp_quad_all(divided_over[k]) *
                                            imp_quad_load(divided_over + IMP_QUAD * q)));
        }
        for (int k = 0; k < 7; ++k) p->x[DIVIDED_ROW * k + 7] = p->x[DIVIDED_ROW * k + 6];
    }
    h->low[0] = part_measure(p, is_flat, &h->top);
}

static inline int lowest_part(const divided_heights *h)
{
    int best = 0;
    double least = h->low[0];
    for (int k = 1; k < h->count; ++k) {
        if (!(h->low[k] < least)) continue;
        least = h->low[k];
        best = k;
    }
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
    const double low = part_measure(p, is_flat, &h->top), other = part_measure(q, is_flat, &h->top);
    const bool is_replaced = low > h->top;
    if (is_replaced) *p = *q;
    h->low[at] = is_replaced ? other : low;
    h->low[h->count] = other;
    if (!is_replaced && !(other > h->top)) h->count += 1;
    return true;
}

/* Whether the sum of both patches' least heights exceeds the limit. It may go on with a greater
 * limit, once it exceeds one: which parts are halved does not depend on it. */
IMP_QUAD_INLINE bool divided_exceed(divided_heights h[2], double limit, bool is_flat)
{
    int at[2] = {lowest_part(&h[0]), lowest_part(&h[1])};
    for (;;) {
        const double low[2] = {h[0].low[at[0]], h[1].low[at[1]]};
        if (low[0] + low[1] > limit) return true;
        if (!(h[0].top + h[1].top > limit)) return false;
        const int side = h[0].top - low[0] > h[1].top - low[1] ? 0 : 1;
        if (!divide(&h[side], at[side], is_flat)) return false;
        at[side] = lowest_part(&h[side]);
    }
}

#endif
