/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/box_patch.h"

#include "plugins/patch/box_stencil.h"
#include "plugins/patch/patch_include.h"
#include "plugins/patch/patch_net.h"

#include <impinge/interval.h>

/* A patch whose numbers are on the stack. */
typedef struct box_patch {
    patch f;
    imp_quad points[BOX_POINTS * 2];
    double numbers[BOX_NUMBERS * PATCH_LANES_MAX]; /* its net or its series */
} box_patch;

static void begin(const box_data *data, box_patch *b)
{
    rough_begin(&data->points, BOX_POINTS, &b->f, b->points);
    b->f.degree[0] = b->f.degree[1] = BOX_DEGREE;
}

/* Lemma. A number is a sum of twelve products; each has 1 rounding of the point, 1 of the entry and
 * 1 of its own, and passes 11 sums: 14 units of the sum of |entries| times `most`. */
enum { TABLE_UNITS = 14 };

IMP_QUAD_INLINE void multiply_groups(const double *table, int groups, const imp_quad *points,
                                     imp_quad *to)
{
    for (int k = 0; k < BOX_NUMBERS; ++k, table += BOX_POINTS)
        for (int g = 0; g < groups; ++g) {
            imp_quad sum = table[0] * points[g];
            for (int p = 1; p < BOX_POINTS; ++p) sum += table[p] * points[p * groups + g];
            to[k * groups + g] = sum;
        }
}

static void multiply_narrow(const double *table, box_patch *b)
{
    multiply_groups(table, b->f.lanes / IMP_QUAD, b->points, (imp_quad *)b->numbers);
}

IMP_QUAD_WIDE static void multiply_wide(const double *table, box_patch *b)
{
    multiply_groups(table, b->f.lanes / IMP_QUAD, b->points, (imp_quad *)b->numbers);
}

static void multiply(const double *table, box_patch *b)
{
    if (imp_quad_is_wide())
        multiply_wide(table, b);
    else
        multiply_narrow(table, b);
}

/* --- Points ----------------------------------------------------------------------------------- */

/* Lemma (units of 2^-53). s and w are exact, as is 1 - w for w from 0 to 1 in steps of 2^-52, which
 * a mirrored w has. y = (1 + s) w / 2 is off by 2, so that 1 - s, s - y, y are off by 1, 3, 2 and 1
 * - y, s, y - s by 3, 0, 3; of a whole triangle 1 - s, s (1 - w), s w by 1, 2, 1. In all 6 at
 * most. */
enum { COORDINATE_UNITS = 6 };

static void barycentric(const box_data *data, const double p[3], double at[3])
{
    const double s = p[0], w = data->is_mirrored ? 1 - p[1] : p[1], y = 0.5 * ((1 + s) * w);
    switch (data->area) {
    case BOX_OUTER:
        at[0] = 1 - s, at[1] = s - y, at[2] = y;
        break;
    case BOX_INNER:
        at[0] = 1 - y, at[1] = s, at[2] = y - s;
        break;
    default:
        at[0] = 1 - s, at[1] = s * (1 - w), at[2] = s * w;
        break;
    }
}

/* Lemma. As a function of three independent coordinates that are >= 0 and add up to 1, the sum
 * changes by at most 4 `most` for each unit of one: 24. A weight has 4 products (whole factors are
 * exact up to 12, which is one more), a Bezier point 14 as above and a quotient, its product 1,
 * sums 14: 58 in all. A coordinate may come out as low as -4 units; so may a point of the curve
 * between two triangles be taken for one of the other: their polynomials differ by a third power of
 * that, which is nothing. */
enum { POINT_UNITS = 4 * COORDINATE_UNITS + 4 + 1 + TABLE_UNITS + 1 + 14 };

static void sum_points(const box_data *data, const box_patch *b, const double p[3],
                       double sum[PATCH_LANES_MAX])
{
    const int groups = b->f.lanes / IMP_QUAD, n = BOX_DEGREE;
    static const double ways[BOX_BEZIER] = {1, 4, 4, 6, 12, 6, 4, 12, 12, 4, 1, 4, 6, 4, 1};
    double at[3], power[3][BOX_SIDE];
    imp_quad all[2] = {{0}, {0}};
    barycentric(data, p, at);
    for (int i = 0; i < 3; ++i) {
        power[i][0] = 1;
        for (int k = 0; k < n; ++k) power[i][k + 1] = power[i][k] * at[i];
    }
    for (int k = 0, which = 0; k <= n; ++k)
        for (int j = 0; j <= k; ++j, ++which) {
            const double weight =
                ways[which] * (power[0][n - k] * power[1][k - j] * power[2][j]) / 24;
            for (int g = 0; g < groups; ++g) {
                imp_quad point = {0};
                for (int q = 0; q < BOX_POINTS; ++q)
                    point += (double)box_stencil[which][q] * b->points[q * groups + g];
                all[g] += weight * point;
            }
        }
    for (int g = 0; g < 2; ++g) imp_quad_store(sum + g * IMP_QUAD, all[g]);
}

/* Evaluates one point with the error bound of patch_point. */
void box_point(const box_data *data, const double p[3], double x[3], double error[3])
{
    box_patch b;
    double sum[PATCH_LANES_MAX];
    begin(data, &b);
    sum_points(data, &b, p, sum);
    for (int axis = 0; axis < 3; ++axis) {
        const double place = b.f.place[axis] + sum[axis];
        const double way = p[2] * (b.f.drift[axis] + sum[4 + axis]);
        const double size = b.f.most[axis] + fabs(p[2]) * b.f.most[4 + axis];
        x[axis] = place + way;
        error[axis] = (POINT_UNITS * ROUNDING * size + 3 * ROUNDING * (fabs(place) + fabs(way)) +
                       rough_slip_upper(&data->points, &b.f, axis, fabs(p[2]))) *
                          SLACK +
                      IMP_TINY;
    }
}

/* --- Regions ---------------------------------------------------------------------------------- */

/* Lemma (slopes). Along an edge of the grid, a box spline's derivative is a mean of the differences
 * of control points next to each other in that direction. Seen from the corner that halving
 * approaches, s leads along a mean of two of the triangle's edges, and w, times 1 at most, along
 * the third: for BOX_INNER, s along P_1 - P_0 and P_2 - P_1 and w along P_2 - P_0, else s along P_1
 * - P_0 and P_2 - P_0 and w along P_2 - P_1. */
static void set_slopes(const box_data *data, patch *f, const imp_quad *points)
{
    /* from point to point along (1,0), along (0,1), and along (-1,1) */
    static const signed char edge[3][8][2] = {
        {{10, 0}, {0, 1}, {1, 6}, {11, 4}, {4, 7}, {5, 2}, {2, 3}, {9, 8}},
        {{11, 0}, {0, 2}, {2, 8}, {4, 1}, {1, 3}, {7, 6}, {10, 5}, {5, 9}},
        {{11, 10}, {4, 0}, {0, 5}, {7, 1}, {1, 2}, {2, 9}, {6, 3}, {3, 8}}};
    const int groups = f->lanes / IMP_QUAD;
    const int across = data->area == BOX_INNER ? 1 : 2;
    for (int g = 0; g < groups; ++g) {
        imp_quad most[2] = {{0}, {0}};
        for (int e = 0; e < 3; ++e)
            for (int k = 0; k < 8; ++k) {
                const imp_quad step =
                    points[edge[e][k][1] * groups + g] - points[edge[e][k][0] * groups + g];
                most[e == across] = imp_quad_max(imp_quad_abs(step), most[e == across]);
            }
        for (int side = 0; side < 2; ++side)
            imp_quad_store(f->slope[side] + g * IMP_QUAD,
                           rough_slope_upper(&data->points, f, g, most[side]));
    }
}

/* Sets the noise of the series by the lemma of patch_set_series; net and basis are one table
 * here. */
static void set_noise(const box_data *data, patch *f)
{
    const int groups = f->lanes / IMP_QUAD;
    const imp_quad *series = (const imp_quad *)f->series;
    const double made = TABLE_UNITS * data->tables->series_size[data->area];
    for (int g = 0; g < groups; ++g) {
        imp_quad units = made * imp_quad_load(f->most + g * IMP_QUAD);
        for (int k = 0; k < BOX_NUMBERS; ++k)
            units += data->tables->shift_error[k] * imp_quad_abs(series[k * groups + g]);
        imp_quad_store(f->noise + g * IMP_QUAD, units * (ROUNDING * SLACK) + IMP_TINY);
    }
}

/* T_l(-y) = (-1)^l T_l(y). */
static void mirror_series(patch *f)
{
    const int groups = f->lanes / IMP_QUAD;
    imp_quad *series = (imp_quad *)f->series;
    for (int k = 0; k < BOX_NUMBERS; ++k)
        for (int g = 0; g < groups && k % BOX_SIDE % 2 == 1; ++g)
            series[k * groups + g] = -series[k * groups + g];
}

/* Radius and slopes are those of the spline over the triangle; the series is held against a region,
 * and the rest of what is said there is true of the polynomial all over it. */
imp_status box_include(const box_data *data, const imp_region *region, imp_model model[3])
{
    box_patch b;
    begin(data, &b);
    b.f.series = b.numbers;
    set_slopes(data, &b.f, b.points);
    multiply(data->tables->series[data->area], &b);
    if (data->is_mirrored) mirror_series(&b.f);
    set_noise(data, &b.f);
    const imp_status status = patch_include(&b.f, region, model);
    if (status == IMP_STATUS_OK) rough_widen_model(&data->points, &b.f, region, model);
    return status;
}

static void mirror_net(patch *f)
{
    const int groups = f->lanes / IMP_QUAD;
    imp_quad *net = (imp_quad *)f->net;
    for (int i = 0; i < BOX_SIDE; ++i)
        for (int j = 0; 2 * j < BOX_DEGREE; ++j)
            for (int g = 0; g < groups; ++g) {
                imp_quad *a = &net[(i * BOX_SIDE + j) * groups + g];
                imp_quad *b = &net[(i * BOX_SIDE + BOX_DEGREE - j) * groups + g];
                const imp_quad kept = *a;
                *a = *b, *b = kept;
            }
}

imp_status box_net(const box_data *data, const imp_region *region, imp_net *net)
{
    box_patch b;
    begin(data, &b);
    b.f.net = b.numbers;
    multiply(data->tables->net[data->area], &b);
    if (data->is_mirrored) mirror_net(&b.f);
    b.f.units = TABLE_UNITS;
    for (int lane = 0; lane < b.f.lanes; ++lane)
        b.f.most[lane] *= data->tables->net_size[data->area] * SLACK;
    const imp_status status = patch_net(&b.f, region, net);
    if (status == IMP_STATUS_OK) rough_widen_net(&data->points, &b.f, region, net);
    return status;
}
