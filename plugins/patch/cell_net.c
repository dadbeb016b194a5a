/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/cell_net.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/patch_series.h"

#include <impinge/quad.h>
#include <string.h>

/* --- From Chebyshev to Bernstein -------------------------------------------------------------- */

/* T_k of degree k has the Bernstein coefficients (-1)^(k-j) choose(2k, 2j) / choose(k, j), because
 * T_k(cos x) is the real part of (cos x/2 + i sin x/2)^2k; raised to degree n, coefficient i is
 * sum_j (-1)^(k-j) choose(2k, 2j) choose(n-k, i-j) / choose(n, i).
 *
 * Lemma. The sum's terms are whole numbers of at most 2^(n + k) in sum, so that up to n = 20 all is
 * exact but the quotient: one rounding. */
static double bernstein_of_chebyshev(int n, int k, int i)
{
    double sum = 0;
    for (int j = 0; j <= k && j <= i; ++j) {
        if (i - j > n - k) continue;
        const double ways = bernstein_choose(2 * k, 2 * j) * bernstein_choose(n - k, i - j);
        sum += (k - j) % 2 ? -ways : ways;
    }
    return sum / bernstein_choose(n, i);
}

/* matrix[i * (n+1) + k], and the greatest |entry| for each k. */
static void fill_matrix(int n, double *matrix, double *greatest)
{
    memset(greatest, 0, (size_t)(n + 1) * sizeof *greatest);
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) {
            const double entry = bernstein_of_chebyshev(n, k, i);
            matrix[i * (n + 1) + k] = entry;
            greatest[k] = imp_larger(greatest[k], fabs(entry));
        }
}

/* --- The net without place -------------------------------------------------------------------- */

/* The numbers of a patch over a region: of each control point, lane by lane; what they are off by;
 * and how large they can be. */
typedef struct local_net {
    double number[IMP_NET_POINTS * PATCH_LANES_MAX];
    double error[PATCH_LANES_MAX], size[PATCH_LANES_MAX];
} local_net;

/* Lemma (error of a number). The series is off by its noise, as a function. Entries of both
 * matrices have one rounding each, products with them two, sums n and m: n + m + 4 units of what
 * the terms add up to, which is at most `size`. */
static void set_local_net(const patch *f, const imp_region *region, local_net *to)
{
    const int n = f->degree[0], m = f->degree[1], lanes = f->lanes, row = (m + 1) * lanes;
    imp_quad series[IMP_NET_POINTS * PATCH_LANES_MAX / IMP_QUAD];
    imp_quad room[IMP_NET_POINTS * PATCH_LANES_MAX / IMP_QUAD];
    double c[IMP_NET_POINTS * PATCH_LANES_MAX], work[IMP_NET_POINTS * PATCH_LANES_MAX];
    double along_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    double greatest_u[PATCH_SIDE_MAX], greatest_v[PATCH_SIDE_MAX];
    fill_matrix(n, along_u, greatest_u);
    fill_matrix(m, along_v, greatest_v);
    patch_localize(f, n, m, lanes, region, series, room);
    memcpy(c, series, patch_points(f->degree) * (size_t)lanes * sizeof *c);
    patch_multiply(n + 1, along_u, c, work, row);
    for (int i = 0; i <= n; ++i)
        patch_multiply(m + 1, along_v, work + i * row, to->number + i * row, lanes);
    memset(to->size, 0, sizeof to->size);
    memset(to->error, 0, sizeof to->error);
    for (int lane = 0; lane < lanes; ++lane) {
        for (int k = 0; k <= n; ++k)
            for (int l = 0; l <= m; ++l)
                to->size[lane] +=
                    greatest_u[k] * greatest_v[l] * fabs(c[k * row + l * lanes + lane]);
        to->error[lane] = (f->noise[lane] + (n + m + 4) * ROUNDING * to->size[lane]) * SLACK;
    }
}

/* --- The net of a region ---------------------------------------------------------------------- */

/* Lemma (error). As for a whole patch (patch_net.c), with W' the computed weights, all >= `weight`,
 * and E what a number of X + t Y is off by, 3 roundings of S = size X + late size Y for c Y, the
 * sum and the quotient included: |X' / W' - X / W| <= (E + |X / W| error W) / weight, where |X / W|
 * is at most the radius of points and velocities. Rounding of the place: 3 (|place| + late
 * |drift|). */
static double net_error(const patch *f, const local_net *local, int axis, double late,
                        double weight)
{
    const double size = local->size[axis] + late * local->size[4 + axis];
    const double off = local->error[axis] + late * local->error[4 + axis] + 3 * ROUNDING * size;
    const double radius = f->place_radius[axis] + late * f->drift_radius[axis];
    const double far = fabs(f->place[axis]) + late * fabs(f->drift[axis]);
    const double turned = f->rational ? radius * local->error[PATCH_W] : 0;
    return ((off + turned) / weight + 3 * ROUNDING * far) * SLACK + IMP_TINY / weight;
}

/* The least weight; 1 without weights. */
static double take_weights(const patch *f, const local_net *local, imp_net *net)
{
    double least = f->rational ? INFINITY : 1;
    for (size_t k = 0; k < patch_points(f->degree) && f->rational; ++k) {
        net->weight[k] = local->number[k * (size_t)f->lanes + PATCH_W];
        least = imp_smaller(least, net->weight[k]);
    }
    return least;
}

static void take_points(const patch *f, const local_net *local, double middle, int axis,
                        imp_net *net)
{
    for (size_t k = 0; k < patch_points(f->degree); ++k) {
        const double *group = local->number + k * (size_t)f->lanes;
        const double w = f->rational ? net->weight[k] : 1;
        const double speed = net->is_moving ? group[4 + axis] : 0;
        net->point[axis][k] = (group[axis] + middle * speed) / w;
        net->velocity[axis][k] = speed / w;
    }
}

/* Lemma. In one parameter the net stands for x' = c' + d' (2 s - 1), where s runs from 0 at lo to 1
 * at hi, and the surface has x = (u - k) / h. Their difference is linear in u, so greatest at an
 * end. */
static double shift_at_ends(const knots *k, size_t span, const imp_region *region,
                            const imp_region *local, int side)
{
    const double from = k->ends[span], h = k->ends[span + 1] - from;
    const double c = local->c[side], d = local->d[side];
    const double lo = fabs((region->lo[side] - from) / h - (c - d));
    const double hi = fabs((region->hi[side] - from) / h - (c + d));
    return imp_larger(lo, hi) + 2 * CELL_SLIP;
}

imp_status nurbs_cell_net(const nurbs_instance *f, const imp_region *region, imp_net *net)
{
    const cell_range cells = nurbs_cells_of(f, region);
    const cell *c = nurbs_cell(f, cells.from[0], cells.from[1]);
    const patch *shape = &c->shape;
    const double middle = region->c[2], late = fabs(middle) + region->d[2];
    imp_region part = *region;
    local_net local;
    if (cell_range_count(&cells) > 1 || patch_points(shape->degree) > IMP_NET_POINTS)
        return IMP_STATUS_UNBOUNDED;
    double shift[2];
    for (int side = 0; side < 2; ++side) {
        cell_localize(&f->side[side], cells.from[side], region, side, &part);
        shift[side] = shift_at_ends(&f->side[side], cells.from[side], region, &part, side);
        net->degree[side] = (uint32_t)shape->degree[side];
    }
    set_local_net(shape, &part, &local);
    net->is_moving = f->moves;
    net->is_weighted = f->rational;
    const double weight = take_weights(shape, &local, net);
    if (!(weight > 0)) return IMP_STATUS_UNBOUNDED;
    for (int axis = 0; axis < 3; ++axis) {
        take_points(shape, &local, middle, axis, net);
        net->place[axis] = shape->place[axis] + middle * shape->drift[axis];
        net->drift[axis] = shape->drift[axis];
        net->error[axis] = imp_sum_up(net_error(shape, &local, axis, late, weight) +
                                      cell_slip(c, axis, late, shift));
    }
    return IMP_STATUS_OK;
}
