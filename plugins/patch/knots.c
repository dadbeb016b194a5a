/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/knots.h"

#include "plugins/patch/patch.h"

#include <stdlib.h>
#include <string.h>

/* --- What is given ---------------------------------------------------------------------------- */

static int64_t knot_element(const knot_row *row, size_t k)
{
    return row->element < 0 ? (int64_t)k : row->element;
}

/* Never falling, never nearly equal. */
static imp_status knots_check_order(const knot_row *row, imp_create_error *why)
{
    const double *k = row->number;
    for (size_t i = 1; i < row->length; ++i) {
        if (k[i] < k[i - 1])
            return imp_reject(why, row->parameter, knot_element(row, i),
                              "knot %zu is %g, after %g: knots must not fall", i, k[i], k[i - 1]);
        if (k[i] > k[i - 1] && k[i] - k[i - 1] < KNOT_NEAR)
            return imp_reject(why, row->parameter, knot_element(row, i),
                              "knots %zu and %zu are %g apart, must be 0 or at least %g", i - 1, i,
                              k[i] - k[i - 1], KNOT_NEAR);
    }
    return IMP_STATUS_OK;
}

/* More than `degree` equal knots inside would tear the surface. */
static imp_status knots_check_multiplicity(const knot_row *row, size_t degree,
                                           imp_create_error *why)
{
    const double *k = row->number;
    for (size_t i = 0; i + degree < row->length; ++i)
        if (k[i] == k[i + degree] && k[i] > k[degree] && k[i] < k[row->length - 1 - degree])
            return imp_reject(why, row->parameter, knot_element(row, i),
                              "knot %g occurs more than %zu times inside the domain, which tears a "
                              "surface of degree %zu",
                              k[i], degree, degree);
    return IMP_STATUS_OK;
}

imp_status knots_check(const knot_row *row, int degree, imp_create_error *why)
{
    const size_t p = (size_t)degree, length = row->length;
    if (length < 2 * p + 2)
        return imp_reject(why, row->parameter, row->element,
                          "got %zu knots, must be at least 2 * degree + 2 = %zu", length,
                          2 * p + 2);
    imp_status status = knots_check_order(row, why);
    if (status != IMP_STATUS_OK) return status;
    const double lo = row->number[p], hi = row->number[length - 1 - p];
    if (!(lo < hi))
        return imp_reject(why, row->parameter, row->element,
                          "the domain from knot %zu to knot %zu is empty: both are %g", p,
                          length - 1 - p, lo);
    return knots_check_multiplicity(row, p, why);
}

/* --- Making ----------------------------------------------------------------------------------- */

void knots_free(knots *k)
{
    free(k->at);
    free(k->ends);
    free(k->last);
}

static void fill(knots *k, const knot_row *row)
{
    k->spans = 0;
    memcpy(k->at, row->number, row->length * sizeof k->at[0]);
    for (size_t i = (size_t)k->degree; i < k->count; ++i)
        if (k->at[i] < k->at[i + 1]) {
            k->ends[k->spans] = k->at[i];
            k->last[k->spans++] = i;
        }
    k->ends[k->spans] = k->at[k->count];
}

bool knots_make(knots *k, const knot_row *row, int degree)
{
    k->degree = degree;
    k->count = row->length - (size_t)degree - 1;
    k->at = malloc(row->length * sizeof k->at[0]);
    k->ends = malloc((k->count + 1) * sizeof k->ends[0]);
    k->last = malloc(k->count * sizeof k->last[0]);
    if (k->at == NULL || k->ends == NULL || k->last == NULL) return false;
    fill(k, row);
    return true;
}

bool knots_renew(knots *k, const knot_row *row, int degree)
{
    const size_t spans = k->spans;
    if (k->degree != degree || k->count != row->length - (size_t)degree - 1) return false;
    fill(k, row);
    return k->spans == spans;
}

/* --- Asking ----------------------------------------------------------------------------------- */

size_t knots_span(const knots *k, double u)
{
    size_t low = 0, high = k->spans;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (k->ends[middle] <= u)
            low = middle;
        else
            high = middle;
    }
    return low;
}

size_t knots_last_span(const knots *k, double hi, size_t first)
{
    const size_t last = knots_span(k, hi);
    return last > first && k->ends[last] == hi ? last - 1 : last;
}

/* --- Basis ------------------------------------------------------------------------------------ */

/* The p + 1 basis functions at u that are not 0 in a span, within 6 p units of themselves.
 *
 * Lemma. Each step of Cox and de Boor's recursion, N = (u - a) / (b - a) N' + (c - u) / (c - b)
 * N'', costs a term the rounding of two differences and their sum as the divisor (2), quotient,
 * product, and sum: 6 with the factor's own. */
void knots_basis(const knots *k, size_t span, double u, double *basis)
{
    const double *at = k->at + k->last[span];
    double left[PATCH_SIDE_MAX], right[PATCH_SIDE_MAX];
    basis[0] = 1;
    for (int j = 1; j <= k->degree; ++j) {
        double carried = 0;
        left[j] = u - at[1 - j];
        right[j] = at[j] - u;
        for (int r = 0; r < j; ++r) {
            const double share = basis[r] / (right[r + 1] + left[j - r]);
            basis[r] = carried + right[r + 1] * share;
            carried = left[j - r] * share;
        }
        basis[j] = carried;
    }
}

/* Bezier control points of a span: point i is sum_j matrix[i * (p + 1) + j] times the span's j-th
 * control point; entries are >= 0, within 5 p units of themselves.
 *
 * Point i is the blossom at a (p - i times) and b (i times), the span's ends. Lemma: each argument
 * w replaces neighbours by (c - w) / (c - d) of one and (w - d) / (c - d) of the other, d <= a <= w
 * <= b <= c: two differences, quotient, product, sum. */
void knots_extract(const knots *k, size_t span, double *matrix)
{
    const int p = k->degree;
    const double a = k->ends[span], b = k->ends[span + 1];
    for (int i = 0; i <= p; ++i) {
        double value[PATCH_SIDE_MAX][PATCH_SIDE_MAX] = {{0}};
        for (int j = 0; j <= p; ++j) value[j][j] = 1;
        for (int step = 1; step <= p; ++step) {
            const double w = step <= p - i ? a : b;
            for (int l = p; l >= step; --l) {
                const double *at = k->at + k->last[span] - p + l;
                const double low = at[0], high = at[p + 1 - step];
                const double before = (high - w) / (high - low), here = (w - low) / (high - low);
                for (int j = 0; j <= p; ++j)
                    value[l][j] = before * value[l - 1][j] + here * value[l][j];
            }
        }
        memcpy(matrix + i * (p + 1), value[p], (size_t)(p + 1) * sizeof *matrix);
    }
}
