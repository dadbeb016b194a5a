/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/triangle.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/patch_include.h"

#include <stdlib.h>
#include <string.h>

enum {
    TRIANGLE_SIDE_MAX = TRIANGLE_DEGREE_MAX + 1,
    TRIANGLE_NET_MAX = TRIANGLE_SIDE_MAX * TRIANGLE_SIDE_MAX
};

/* Rows of n + 1 control points each, of which row k has k + 1, and then copies of its last. */
typedef struct triangle_rows {
    double points[3 * TRIANGLE_NET_MAX], velocities[3 * TRIANGLE_NET_MAX];
    double weights[TRIANGLE_NET_MAX];
} triangle_rows;

static void triangle_gather(const triangle_data *data, triangle_rows *to)
{
    const int n = data->degree;
    size_t count = 0;
    for (int k = 0; k <= n; ++k)
        for (int i = 0; i <= n; ++i, ++count) {
            const size_t at = (size_t)(k * (k + 1) / 2 + (i < k ? i : k));
            const size_t from = data->which != NULL ? (size_t)data->which[at] : at;
            memcpy(to->points + 3 * count, data->points + 3 * from, 3 * sizeof(double));
            if (data->velocities != NULL)
                memcpy(to->velocities + 3 * count, data->velocities + 3 * from, 3 * sizeof(double));
            to->weights[count] = data->weights != NULL ? data->weights[from] : 1;
        }
}

/* Equal weights cancel: the triangle is polynomial. */
static bool triangle_is_rational(const triangle_rows *rows, size_t count)
{
    for (size_t k = 1; k < count; ++k)
        if (rows->weights[k] != rows->weights[0]) return true;
    return false;
}

/* Raises the degree of a curve from k to n, in place: point i becomes
 * sum_j choose(k, j) choose(n-k, i-j) / choose(n, i) P_j.
 *
 * Lemma (units). The sum of these weights is 1 and each is >= 0. Up to n = 10 binomials and their
 * products are exact; the quotient, its product with a number and at most k sums are k + 2
 * roundings. In row 0 and at both ends the only weight is 1, so corners and the edge u = 0 are
 * exact. */
static void curve_raise(double *row, int k, int n, int lanes)
{
    double raised[TRIANGLE_SIDE_MAX * PATCH_LANES_MAX] = {0};
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= k && j <= i; ++j) {
            if (i - j > n - k) continue;
            const double ways = bernstein_choose(k, j) * bernstein_choose(n - k, i - j);
            const double weight = ways / bernstein_choose(n, i);
            for (int lane = 0; lane < lanes; ++lane)
                raised[i * lanes + lane] += weight * row[j * lanes + lane];
        }
    memcpy(row, raised, (size_t)((n + 1) * lanes) * sizeof *row);
}

patch *triangle_new(const triangle_data *data)
{
    const int n = data->degree;
    triangle_rows rows;
    triangle_gather(data, &rows);
    const patch_data whole = {
        .degree = {n, n},
        .points = rows.points,
        .velocities = data->velocities != NULL ? rows.velocities : NULL,
        .weights =
            triangle_is_rational(&rows, (size_t)(n + 1) * (size_t)(n + 1)) ? rows.weights : NULL};
    patch *f = patch_allocate(&whole);
    if (f == NULL) return NULL;
    patch_set_net(f, &whole);
    for (int k = 0; k <= n; ++k) curve_raise(f->net + k * (n + 1) * f->lanes, k, n, f->lanes);
    f->units += n + 2;
    patch_finish(f, &whole);
    return f;
}
