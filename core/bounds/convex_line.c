/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/convex_line.h"

#include <math.h>
#include <stdbool.h>

#include "core/base/rounding.h"

/* p(x) = a + b.x + x' h x of x = (s_u, s_v, w); h is symmetric. */
typedef struct convex_form {
    double a, b[3], h[3][3];
} convex_form;

static convex_form form_of(const imp_model *g, double sign, double middle, double reach)
{
    const double *b = g->b, *q = g->q;
    const double uv = 0.5 * sign * q[IMP_UV], uw = 0.5 * sign * reach * q[IMP_UT],
                 vw = 0.5 * sign * reach * q[IMP_VT];
    return (convex_form){sign * (g->a + (b[2] + q[IMP_TT] * middle) * middle),
                         {sign * (b[0] + q[IMP_UT] * middle), sign * (b[1] + q[IMP_VT] * middle),
                          sign * reach * (b[2] + 2 * q[IMP_TT] * middle)},
                         {{sign * q[IMP_UU], uv, uw},
                          {uv, sign * q[IMP_VV], vw},
                          {uw, vw, sign * reach * reach * q[IMP_TT]}}};
}

/* --- How far from convex ---------------------------------------------------------------------- */

/* How far x is from the place of the tangent plane, at most. */
static const double apart[3] = {2, 2, 1};

#define PIVOT_LEAST 0x1p-20 /* of the form's size: below it, terms are bounded one by one */

/* Takes the square of a linear form, whose pivot is h_kk, off h. False: entries would become larger
 * than the form was. */
static bool take_square(double h[3][3], int k, double size)
{
    double row[3];
    for (int i = 0; i < 3; ++i) row[i] = h[k][i];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(fabs(row[i] * row[j] / row[k]) <= size)) return false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            h[i][j] = i == k || j == k ? 0 : h[i][j] - row[i] * row[j] / row[k];
    return true;
}

/* A bound of -d' h d from above for |d_i| <= apart_i. Lemma. With a pivot h_kk > 0,
 *
 *   d' h d = (sum_i h_ki d_i)^2 / h_kk + d' h' d,   h'_ij = h_ij - h_ki h_kj / h_kk,
 *
 * where row and column k of h' vanish. The square is not negative; what is left in the end is at
 * least - sum_i max(-h_ii, 0) d_i^2 - sum_(i != j) |h_ij| |d_i| |d_j|. */
static double concave_upper(const convex_form *p, double size)
{
    double h[3][3], sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) h[i][j] = p->h[i][j];
    for (int round = 0; round < 3; ++round) {
        const int first = h[0][0] >= h[1][1] ? 0 : 1, k = h[first][first] >= h[2][2] ? first : 2;
        if (!(h[k][k] > PIVOT_LEAST * size) || !take_square(h, k, size)) break;
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double most = i == j ? (h[i][i] < 0 ? -h[i][i] : 0) : fabs(h[i][j]);
            sum += most * apart[i] * apart[j];
        }
    return sum;
}

/* --- The place of the tangent plane ----------------------------------------------------------- */

enum { DESCENTS = 6 };

static double clamped(double x) { return x < -1 ? -1 : x > 1 ? 1 : x; }

/* Seeks the least value for w = 0 along u and v in turn. Any place will do. */
static void seek_least(const convex_form *p, double y[2])
{
    y[0] = y[1] = 0;
    for (int round = 0; round < DESCENTS; ++round)
        for (int i = 0; i < 2; ++i) {
            const double slope = p->b[i] + 2 * p->h[i][!i] * y[!i], bend = 2 * p->h[i][i];
            if (bend > 0)
                y[i] = clamped(-slope / bend);
            else
                y[i] = slope > 0 ? -1 : 1;
            if (!(fabs(y[i]) <= 1)) y[i] = 0; /* NaN */
        }
}

/* Lemma. With any y = (y_u, y_v, 0) of the square, p(x) = p(y) + grad p(y).(x - y) + d' h d, where
 * d = x - y is at most `apart`; and grad_i x_i is at least -|grad_i|. So
 *
 *   p(x) >= p(y) - sum_(u, v) (|grad_i| + grad_i y_i) + grad_w w - concave_upper.
 *
 * Rounding, in units of u size, all coefficients together being `size` at most, |y| <= 1:
 *
 *   middle, reach              48: quotients and sums before, 4 each, in terms of at most 2 size,
 *                                  and in grad and p(y), which have each coefficient 6 times
 *   coefficients               24: 4 operations, 6 times
 *   p(y), grad                 64: fewer than 8 operations on sums of at most 8 size
 *   their sum                  64: 8 operations on at most 8 size
 *   squares taken off        1600: quotient, product, difference of at most 2 size, 3 rounds; 25 in
 *                                  all of apart_i apart_j, so 25 * 3 * (4 * 2 + 2), and as much
 *                                  again for the rows with which the next rounds go on
 *   the sum of what is left   512: 20 operations on at most 25 size */
enum { CONVEX_ROUNDING = 4096 };
_Static_assert(48 + 24 + 64 + 64 + 1600 + 512 <= CONVEX_ROUNDING, "rounding of a convex line");

convex_line convex_line_below(const imp_model *g, double sign, double middle, double reach,
                              double size)
{
    const convex_form p = form_of(g, sign, middle, reach);
    double y[2], least = p.a, grad[3];
    seek_least(&p, y);
    for (int i = 0; i < 3; ++i) grad[i] = p.b[i] + 2 * (p.h[i][0] * y[0] + p.h[i][1] * y[1]);
    for (int i = 0; i < 2; ++i) {
        least += (p.b[i] + p.h[i][0] * y[0] + p.h[i][1] * y[1]) * y[i];
        least -= fabs(grad[i]) + grad[i] * y[i];
    }
    const double slack = concave_upper(&p, size) + size * (CONVEX_ROUNDING * UNIT_ROUNDOFF);
    return (convex_line){least - slack, grad[2]};
}
