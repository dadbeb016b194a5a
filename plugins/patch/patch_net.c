/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch_net.h"

#include <impinge/interval.h>
#include <string.h>

/* The control points of the part from lo to hi of a curve of degree n, in place; x[0], x[step], ...
 * are the numbers. Point k of the part is the blossom of n - k times lo and k times hi. Lemma. Each
 * of the n steps of de Casteljau is a mean of two numbers with three roundings, so it adds 3
 * ROUNDING times the greatest of all, which means do not exceed but for SLACK. */
enum { STEP_ROUNDING = 3 };

static void curve_part(int n, double lo, double hi, double *x, int step)
{
    double given[PATCH_SIDE_MAX], part[PATCH_SIDE_MAX];
    if (lo == 0 && hi == 1) return; /* all of it */
    for (int i = 0; i <= n; ++i) given[i] = x[i * step];
    for (int k = 0; k <= n; ++k) {
        memcpy(part, given, sizeof part);
        for (int used = 0; used < n; ++used) {
            const double at = used < n - k ? lo : hi;
            for (int i = 0; i < n - used; ++i) part[i] = (1 - at) * part[i] + at * part[i + 1];
        }
        x[k * step] = part[0];
    }
}

/* One lane of the patch's net over the region. */
static void lane_part(const patch *f, int lane, const imp_region *region, double x[IMP_NET_POINTS])
{
    const int n = f->degree[0], m = f->degree[1];
    for (int k = 0; k < (n + 1) * (m + 1); ++k) x[k] = f->net[k * f->lanes + lane];
    for (int j = 0; j <= m; ++j) curve_part(n, region->lo[0], region->hi[0], x + j, m + 1);
    for (int i = 0; i <= n; ++i) curve_part(m, region->lo[1], region->hi[1], x + i * (m + 1), 1);
}

/* Lemma (error). With place_c = place + c drift, X_c = X + c Y at the region's middle time c, and
 * late >= |t| there,
 *
 *   f = place_c + tau drift + (X_c + tau Y) / W.
 *
 * Let S = most X + late most Y >= |X + t Y|, and K count the roundings of a number of X or Y, in
 * units of ROUNDING most: the net's own and STEP_ROUNDING in each of n + m steps.
 *
 *   X_c and tau Y        K S, and 2 S for X + c Y
 *   place_c, tau drift   3 (|place| + late |drift|)
 *   divided by W         1 of a point w P: together K + 3 of S / least weight
 *   weights              off by a factor of 1 + K at most, all positive: |X + t Y| / W, which is at
 *                        most the radius of points and velocities, times K once below and once
 *                        above */
static double net_error(const patch *f, int axis, const imp_region *region)
{
    const double middle = fabs(region->c[2]), late = middle + region->d[2];
    const double steps = f->units + STEP_ROUNDING * (f->degree[0] + f->degree[1]);
    const double size = f->most[axis] + late * f->most[4 + axis];
    const double radius = f->place_radius[axis] + late * f->drift_radius[axis];
    const double far = fabs(f->place[axis]) + late * fabs(f->drift[axis]);
    const double quotient = f->rational ? 2 * steps * radius : 0;
    return ((steps + 3) * size / f->weight_lo + quotient + 3 * far) * ROUNDING * SLACK +
           IMP_TINY / f->weight_lo;
}

imp_status patch_net(const patch *f, const imp_region *region, imp_net *net)
{
    const int points = (int)patch_points(f->degree);
    const double middle = region->c[2];
    const imp_status status = patch_region_status(region);
    if (status != IMP_STATUS_OK) return status;
    if (points > IMP_NET_POINTS) return IMP_STATUS_UNBOUNDED;
    for (int side = 0; side < 2; ++side) net->degree[side] = (uint32_t)f->degree[side];
    net->is_moving = f->lanes == 8;
    net->is_weighted = f->rational;
    if (f->rational) lane_part(f, PATCH_W, region, net->weight);
    for (int axis = 0; axis < 3; ++axis) {
        double *x = net->point[axis], *y = net->velocity[axis];
        lane_part(f, axis, region, x);
        if (net->is_moving) lane_part(f, 4 + axis, region, y);
        for (int k = 0; k < points; ++k) {
            const double w = f->rational ? net->weight[k] : 1;
            x[k] = (x[k] + middle * y[k]) / w;
            y[k] /= w;
        }
        net->place[axis] = f->place[axis] + middle * f->drift[axis];
        net->drift[axis] = f->drift[axis];
        net->error[axis] = net_error(f, axis, region);
    }
    return IMP_STATUS_OK;
}
