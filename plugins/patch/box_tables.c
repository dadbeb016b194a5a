/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/box_patch.h"
#include "plugins/patch/box_stencil.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/chebyshev.h"

#include <impinge/interval.h>

const int box_place[BOX_POINTS][2] = {{0, 0}, {1, 0},  {0, 1}, {1, 1},  {1, -1}, {-1, 1},
                                      {2, 0}, {2, -1}, {0, 2}, {-1, 2}, {-1, 0}, {0, -1}};

/* They follow from limits of Loop's rules at the fifteen points with fourths as coordinates, of
 * which a quartic polynomial has 15 independent values. Each row adds up to 24. */
const signed char box_stencil[BOX_BEZIER][BOX_POINTS] = {
    {12, 2, 2, 0, 2, 2, 0, 0, 0, 0, 2, 2}, {12, 4, 3, 0, 3, 1, 0, 0, 0, 0, 0, 1},
    {12, 3, 4, 0, 1, 3, 0, 0, 0, 0, 1, 0}, {8, 8, 4, 0, 4, 0, 0, 0, 0, 0, 0, 0},
    {10, 6, 6, 0, 1, 1, 0, 0, 0, 0, 0, 0}, {8, 4, 8, 0, 0, 4, 0, 0, 0, 0, 0, 0},
    {4, 12, 3, 1, 3, 0, 0, 1, 0, 0, 0, 0}, {6, 10, 6, 1, 1, 0, 0, 0, 0, 0, 0, 0},
    {6, 6, 10, 1, 0, 1, 0, 0, 0, 0, 0, 0}, {4, 3, 12, 1, 0, 3, 0, 0, 0, 1, 0, 0},
    {2, 12, 2, 2, 2, 0, 2, 2, 0, 0, 0, 0}, {3, 12, 4, 3, 1, 0, 1, 0, 0, 0, 0, 0},
    {4, 8, 8, 4, 0, 0, 0, 0, 0, 0, 0, 0},  {3, 4, 12, 3, 0, 1, 0, 0, 1, 0, 0, 0},
    {2, 2, 12, 2, 0, 2, 0, 0, 2, 2, 0, 0}};

/* The corners of each area, (s, w) = (0,0), (0,1), (1,0), (1,1), in barycentric coordinates. */
static const double area_corner[BOX_AREAS][4][3] = {
    [BOX_WHOLE] = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    [BOX_OUTER] = {{1, 0, 0}, {1, -0.5, 0.5}, {0, 1, 0}, {0, 0, 1}},
    [BOX_INNER] = {{1, 0, 0}, {0.5, 0, 0.5}, {1, 1, -1}, {0, 1, 0}},
};

/* The blossom of a triangle of degree 4 with control points `given`, by de Casteljau: at corner k
 * of the area, times[k] times. */
static double blossom(const double given[BOX_BEZIER], const double corner[4][3], const int times[4])
{
    double b[BOX_BEZIER];
    int degree = BOX_DEGREE;
    for (int k = 0; k < BOX_BEZIER; ++k) b[k] = given[k];
    for (int which = 0; which < 4; ++which)
        for (int used = 0; used < times[which]; ++used, --degree)
            for (int k = 0, at = 0; k < degree; ++k)
                for (int j = 0; j <= k; ++j, ++at)
                    b[at] = corner[which][0] * b[at] + corner[which][1] * b[at + k + 1] +
                            corner[which][2] * b[at + k + 2];
    return b[0];
}

/* 288 times control point i, j of the patch, where `given` are 24 times those of the triangle: the
 * mean of the blossom over all ways to choose, of four places, i where s is 1 and j where w is 1.
 * 288 is 24 times the least common multiple of all choose(4, j). */
static double area_point(const double given[BOX_BEZIER], const double corner[4][3], int i, int j)
{
    const int n = BOX_DEGREE;
    double sum = 0;
    for (int both = 0; both <= i && both <= j; ++both) {
        if (j - both > n - i) continue;
        const int times[4] = {n - i - j + both, j - both, i - both, both};
        sum += bernstein_choose(i, both) * bernstein_choose(n - i, j - both) *
               blossom(given, corner, times);
    }
    return sum * (12 / bernstein_choose(n, j));
}

static void to_series(const double net[BOX_NUMBERS], const double beta[BOX_NUMBERS],
                      double series[BOX_NUMBERS])
{
    for (int k = 0; k < BOX_SIDE; ++k)
        for (int l = 0; l < BOX_SIDE; ++l) {
            double *to = &series[k * BOX_SIDE + l];
            *to = 0;
            for (int i = 0; i < BOX_SIDE; ++i)
                for (int j = 0; j < BOX_SIDE; ++j)
                    *to += beta[k * BOX_SIDE + i] * beta[l * BOX_SIDE + j] * net[i * BOX_SIDE + j];
        }
}

/* Lemma. Up to the last quotient all is exact: corners are multiples of 1/2, so blossoms are of
 * 2^-4, and beta, of degree 4, of 2^-7; no sum of |terms| is above 288 * 3^4 * 2^8 < 2^23. So each
 * entry is rounded once. */
static void fill_area(box_area area, const double beta[BOX_NUMBERS], box_tables *to)
{
    for (int p = 0; p < BOX_POINTS; ++p) {
        double given[BOX_BEZIER], net[BOX_NUMBERS], series[BOX_NUMBERS];
        for (int k = 0; k < BOX_BEZIER; ++k) given[k] = box_stencil[k][p];
        for (int k = 0; k < BOX_NUMBERS; ++k)
            net[k] = area_point(given, area_corner[area], k / BOX_SIDE, k % BOX_SIDE);
        to_series(net, beta, series);
        for (int k = 0; k < BOX_NUMBERS; ++k) {
            to->net[area][k * BOX_POINTS + p] = net[k] / 288;
            to->series[area][k * BOX_POINTS + p] = series[k] / 288;
        }
    }
}

static double row_size(const double *row)
{
    double size = 0;
    for (int p = 0; p < BOX_POINTS; ++p) size += fabs(row[p]);
    return size * SLACK;
}

void box_make_tables(box_tables *to)
{
    double beta[BOX_NUMBERS] = {0};
    chebyshev_of_bernstein(BOX_DEGREE, beta);
    for (int area = 0; area < BOX_AREAS; ++area) {
        fill_area((box_area)area, beta, to);
        to->net_size[area] = to->series_size[area] = 0;
        for (int k = 0; k < BOX_NUMBERS; ++k) {
            to->net_size[area] =
                imp_larger(to->net_size[area], row_size(to->net[area] + k * BOX_POINTS));
            to->series_size[area] += row_size(to->series[area] + k * BOX_POINTS);
        }
    }
    for (int k = 0; k < BOX_NUMBERS; ++k) {
        const int i = k / BOX_SIDE, j = k % BOX_SIDE;
        to->shift_error[k] = chebyshev_shift_error(i) + chebyshev_shift_error(j) +
                             (2 * BOX_DEGREE + 2) * chebyshev_reach(i) * chebyshev_reach(j);
    }
}
