/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/spline_patch.h"

#include "plugins/patch/chebyshev.h"
#include "plugins/patch/patch_include.h"
#include "plugins/patch/patch_net.h"

#include <impinge/interval.h>
#include <impinge/quad.h>
#include <string.h>

/* A patch whose net is on the stack. */
typedef struct spline_patch {
    patch f;
    double net[SPLINE_POINTS * PATCH_LANES_MAX], series[SPLINE_POINTS * PATCH_LANES_MAX];
} spline_patch;

/* --- From B-splines to another basis ---------------------------------------------------------- */

/* out_ij = sum_rs m_ri m_sj in_rs / scale^2 for all lanes; m is 4 by 4, row by row. */
static void change_basis(const double m[SPLINE_POINTS], double scale, int lanes, const double *in,
                         double *out)
{
    imp_quad half[SPLINE_POINTS * 2];
    const int group = lanes / IMP_QUAD, row = SPLINE_SIDE * group;
    const imp_quad *from = (const imp_quad *)in;
    imp_quad *to = (imp_quad *)out;
    const double shrink = 1 / (scale * scale);
    for (int i = 0; i < SPLINE_SIDE; ++i)
        for (int x = 0; x < row; ++x)
            half[i * row + x] = m[i] * from[x] + m[4 + i] * from[row + x] +
                                m[8 + i] * from[2 * row + x] + m[12 + i] * from[3 * row + x];
    for (int i = 0; i < SPLINE_SIDE; ++i)
        for (int j = 0; j < SPLINE_SIDE; ++j)
            for (int x = 0; x < group; ++x) {
                const imp_quad *r = half + i * row + x;
                to[i * row + j * group + x] =
                    shrink * (m[j] * r[0] + m[4 + j] * r[group] + m[8 + j] * r[2 * group] +
                              m[12 + j] * r[3 * group]);
            }
}

/* B-spline basis in Bernstein polynomials: N_r(u) = sum_i m_ri B_i(u) / 6. */
static const double to_bernstein[SPLINE_POINTS] = {1, 0, 0, 0, 4, 4, 2, 1, 1, 2, 4, 4, 0, 0, 0, 1};

/* B-spline basis in Chebyshev polynomials of x = 2u - 1: N_r(u) = sum_i m_ri T_i(x) / 192. For (1 -
 * u)^3 / 6 = (1 - x)^3 / 48 with x^2 = (1 + T_2) / 2, x^3 = (3 T_1 + T_3) / 4; the others
 * likewise. */
static const double to_chebyshev[SPLINE_POINTS] = {10, -15, 6,  -1, 86, -51, -6, 3,
                                                   86, 51,  -6, -3, 10, 15,  6,  1};

/* Lemma. The entries are whole numbers, so an entry of the result passes, in each of two steps, a
 * product and at most three sums, at last the quotient, which has 3: 11 roundings, each of a number
 * at most the sum of |m| over a column, over the scale, times `most` per step: 1 for Bezier points,
 * which are means; (192 + 132 + 24 + 8) / 192 < 1.86 in all for Chebyshev polynomials. */
enum { BASIS_ROUNDINGS = 11 };
#define CHEBYSHEV_SIZE (1.86 * 1.86)

/* --- The patch -------------------------------------------------------------------------------- */

static void begin(const rough_points *data, spline_patch *s)
{
    rough_begin(data, SPLINE_POINTS, &s->f, (imp_quad *)s->net);
    s->f.degree[0] = s->f.degree[1] = 3;
    s->f.net = s->net;
}

static void set_bezier(spline_patch *s)
{
    double points[SPLINE_POINTS * PATCH_LANES_MAX];
    memcpy(points, s->net, (size_t)(SPLINE_POINTS * s->f.lanes) * sizeof *points);
    change_basis(to_bernstein, 6, s->f.lanes, points, s->net);
    s->f.units = 2 + BASIS_ROUNDINGS;
}

/* The derivative of a B-spline has the differences of its control points. */
static void set_slopes(const rough_points *data, patch *f)
{
    const int groups = f->lanes / IMP_QUAD;
    const imp_quad *net = (const imp_quad *)f->net;
    for (int side = 0; side < 2; ++side)
        for (int g = 0; g < groups; ++g) {
            const int step = side == 0 ? SPLINE_SIDE : 1, rows = side == 0 ? 3 : 4;
            imp_quad most = {0};
            for (int i = 0; i < rows; ++i)
                for (int j = 0; j < 7 - rows; ++j) {
                    const int k = SPLINE_SIDE * i + j;
                    most = imp_quad_max(
                        imp_quad_abs(net[(k + step) * groups + g] - net[k * groups + g]), most);
                }
            imp_quad_store(f->slope[side] + g * IMP_QUAD, rough_slope_upper(data, f, g, most));
        }
}

/* Sets the noise of the series as patch_set_series does, with the terms of its lemma for n = m = 3:
 * reach_i = sqrt(2i + 1) and error_i = chebyshev_shift_error(i), rounded up. */
static void set_noise(patch *f)
{
    static const double reach[SPLINE_SIDE] = {1, 1.7321, 2.2361, 2.6458};
    static const double error[SPLINE_SIDE] = {0, 0.5, 16.86, 53.84};
    const int groups = f->lanes / IMP_QUAD;
    const imp_quad *series = (const imp_quad *)f->series;
    const double made = f->units + BASIS_ROUNDINGS * CHEBYSHEV_SIZE;
    for (int g = 0; g < groups; ++g) {
        imp_quad units = made * imp_quad_load(f->most + g * IMP_QUAD);
        for (int k = 0; k < SPLINE_POINTS; ++k) {
            const int i = k / SPLINE_SIDE, j = k % SPLINE_SIDE;
            const double weight = error[i] + error[j] + 8 * reach[i] * reach[j];
            units += weight * imp_quad_abs(series[k * groups + g]);
        }
        imp_quad_store(f->noise + g * IMP_QUAD, units * (ROUNDING * SLACK) + IMP_TINY);
    }
}

/* --- Points ----------------------------------------------------------------------------------- */

/* The four B-splines at u. Lemma. With v = 1 - u rounded once, 4 + u^2 (3u - 6) is off by 22 units
 * at most: 4 of its own, 3 of the product, 6 of u^2, 9 of 3u - 6; so each is within 6 units, v's
 * included. */
static void splines(double u, double n[SPLINE_SIDE])
{
    const double v = 1 - u;
    n[0] = v * v * v / 6;
    n[1] = (4 + u * u * (3 * u - 6)) / 6;
    n[2] = (4 + v * v * (3 * v - 6)) / 6;
    n[3] = u * u * u / 6;
}

/* Lemma. sum_ij N_i N_j p_ij, |p_ij| <= most: weights are off by 6 N_i + 6 N_j + N_i N_j units, 49
 * in all; products and sums add 16, and the differences p_ij one: POINT_UNITS. */
enum { POINT_UNITS = 49 + 16 + 1 };

static void sum_points(const spline_patch *s, const double p[3], double sum[PATCH_LANES_MAX])
{
    double along_u[SPLINE_SIDE], along_v[SPLINE_SIDE];
    const int groups = s->f.lanes / IMP_QUAD;
    const imp_quad *net = (const imp_quad *)s->f.net;
    splines(p[0], along_u);
    splines(p[1], along_v);
    for (int g = 0; g < groups; ++g) {
        imp_quad all = {0};
        for (int k = 0; k < SPLINE_POINTS; ++k)
            all += along_u[k / SPLINE_SIDE] * along_v[k % SPLINE_SIDE] * net[k * groups + g];
        imp_quad_store(sum + g * IMP_QUAD, all);
    }
}

/* Evaluates one point with the error bound of patch_point. */
void spline_point(const rough_points *data, const double p[3], double x[3], double error[3])
{
    spline_patch s;
    double sum[PATCH_LANES_MAX] = {0};
    begin(data, &s);
    sum_points(&s, p, sum);
    for (int axis = 0; axis < 3; ++axis) {
        const double place = s.f.place[axis] + sum[axis];
        const double way = p[2] * (s.f.drift[axis] + sum[4 + axis]);
        const double size = s.f.most[axis] + fabs(p[2]) * s.f.most[4 + axis];
        x[axis] = place + way;
        error[axis] = (POINT_UNITS * ROUNDING * size + 3 * ROUNDING * (fabs(place) + fabs(way)) +
                       rough_slip_upper(data, &s.f, axis, fabs(p[2]))) *
                          SLACK +
                      IMP_TINY;
    }
}

/* --- Regions ---------------------------------------------------------------------------------- */

imp_status spline_include(const rough_points *data, const imp_region *region, imp_model model[3])
{
    spline_patch s;
    begin(data, &s);
    s.f.series = s.series;
    set_slopes(data, &s.f);
    change_basis(to_chebyshev, 192, s.f.lanes, s.net, s.series);
    set_noise(&s.f);
    const imp_status status = patch_include(&s.f, region, model);
    if (status == IMP_STATUS_OK) rough_widen_model(data, &s.f, region, model);
    return status;
}

imp_status spline_net(const rough_points *data, const imp_region *region, imp_net *net)
{
    spline_patch s;
    begin(data, &s);
    set_bezier(&s);
    const imp_status status = patch_net(&s.f, region, net);
    if (status == IMP_STATUS_OK) rough_widen_net(data, &s.f, region, net);
    return status;
}
