/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/chebyshev.h"

#include <impinge/interval.h>
#include <impinge/quad.h>
#include <stdlib.h>
#include <string.h>

/* --- Making one ------------------------------------------------------------------------------- */

static double *patch_groups(double **memory, size_t count, int lanes)
{
    double *groups = *memory;
    *memory += count * (size_t)lanes;
    return groups;
}

static int patch_lanes(const patch_data *data) { return data->velocities != NULL ? 8 : 4; }

static size_t patch_square(int degree) { return (size_t)(degree + 1) * (size_t)(degree + 1); }

/* The tables of the degrees, which all patches of these have in common. */
static void patch_set_beta(patch *f)
{
    const int n = f->degree[0], m = f->degree[1];
    chebyshev_of_bernstein(n, f->beta[0]);
    if (m == n)
        memcpy(f->beta[1], f->beta[0], patch_square(n) * sizeof(double));
    else
        chebyshev_of_bernstein(m, f->beta[1]);
}

patch *patch_allocate(const patch_data *data)
{
    const int n = data->degree[0], m = data->degree[1], lanes = patch_lanes(data);
    size_t points = patch_points(data->degree);
    size_t along_u = points - (size_t)(m + 1), along_v = points - (size_t)(n + 1);
    size_t head = (sizeof(patch) + 63) / 64 * 64;
    size_t of_groups = (2 * points + along_u + along_v) * (size_t)lanes;
    size_t numbers = of_groups + 8 * points + patch_square(n) + patch_square(m);
    patch *f = aligned_alloc(64, head + (numbers * sizeof(double) + 63) / 64 * 64);
    if (f == NULL) return NULL;
    memset(f, 0, sizeof *f);
    double *memory = (double *)((char *)f + head);
    f->degree[0] = n, f->degree[1] = m, f->lanes = lanes;
    f->net = patch_groups(&memory, points, lanes);
    f->series = patch_groups(&memory, points, lanes);
    f->difference[0] = patch_groups(&memory, along_u, lanes);
    f->difference[1] = patch_groups(&memory, along_v, lanes);
    f->given = patch_groups(&memory, points, 8);
    f->beta[0] = patch_groups(&memory, patch_square(n), 1);
    f->beta[1] = memory;
    patch_set_beta(f);
    return f;
}

bool patch_has_room(const patch *f, const patch_data *data)
{
    return f->degree[0] == data->degree[0] && f->degree[1] == data->degree[1] &&
           f->lanes == patch_lanes(data);
}

void patch_keep(patch *f, const patch_data *data)
{
    const size_t points = patch_points(f->degree), moving = data->velocities != NULL ? points : 0;
    memcpy(f->given, data->points, 3 * points * sizeof(double));
    if (moving > 0) memcpy(f->given + 3 * points, data->velocities, 3 * points * sizeof(double));
    if (data->weights != NULL)
        memcpy(f->given + 3 * (points + moving), data->weights, points * sizeof(double));
}

/* Middle of n numbers that are 3 apart, and how far they are from it, rounded up. */
static double patch_middle(size_t n, const double *x, double *radius)
{
    double lo = x[0], hi = x[0];
    for (size_t i = 1; i < n; ++i) {
        lo = imp_smaller(lo, x[3 * i]);
        hi = imp_larger(hi, x[3 * i]);
    }
    double middle = lo + (hi - lo) / 2;
    *radius = imp_larger(hi - middle, middle - lo) * SLACK;
    return middle;
}

/* most[lane] = max |x| of `count` groups, per lane. */
static void patch_greatest(const double *x, size_t count, int lanes, double *most)
{
    for (int from = 0; from < lanes; from += IMP_QUAD) {
        imp_quad all = {0};
        for (size_t i = 0; i < count; ++i)
            all = imp_quad_max(all, imp_quad_abs(imp_quad_load(x + i * (size_t)lanes + from)));
        imp_quad_store(most + from, all);
    }
}

/* Each number of the net takes at most two roundings: units is 2. */
void patch_set_net(patch *f, const patch_data *data)
{
    const size_t points = patch_points(f->degree);
    for (size_t axis = 0; axis < 3; ++axis) {
        f->place[axis] = patch_middle(points, data->points + axis, &f->place_radius[axis]);
        if (data->velocities != NULL)
            f->drift[axis] = patch_middle(points, data->velocities + axis, &f->drift_radius[axis]);
    }
    f->units = 2;
    f->rational = data->weights != NULL;
    f->weight_lo = f->rational ? INFINITY : 1;
    for (size_t i = 0; i < points; ++i) {
        double *group = f->net + i * (size_t)f->lanes, w = f->rational ? data->weights[i] : 1;
        memset(group, 0, (size_t)f->lanes * sizeof *group);
        for (size_t axis = 0; axis < 3; ++axis) {
            group[axis] = w * (data->points[3 * i + axis] - f->place[axis]);
            if (data->velocities != NULL)
                group[4 + axis] = w * (data->velocities[3 * i + axis] - f->drift[axis]);
        }
        if (f->rational) group[PATCH_W] = w;
        f->weight_lo = imp_smaller(f->weight_lo, w);
    }
    patch_greatest(f->net, points, f->lanes, f->most);
}

/* d/du of sum_i B_i(u) P_i, degree n, is the like sum of degree n - 1 with n (P_(i+1) - P_i).
 * Rounding: of both numbers of the net, of the difference and of the product, together at
 * most (2 units n most + 2 |result|) ROUNDING. */
void patch_set_differences(patch *f, int side)
{
    const int m = f->degree[1], lanes = f->lanes, groups = lanes / IMP_QUAD;
    int rows = f->degree[0] + (side ? 1 : 0), columns = m + (side ? 0 : 1);
    int step = (side ? 1 : m + 1) * groups;
    const imp_quad *net = (const imp_quad *)f->net;
    imp_quad *out = (imp_quad *)f->difference[side];
    const double degree = f->degree[side];
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            for (int h = 0; h < groups; ++h) {
                const imp_quad *here = net + (i * (m + 1) + j) * groups + h;
                *out++ = degree * (here[step] - here[0]);
            }
    double *slope = f->slope[side];
    patch_greatest(f->difference[side], (size_t)(rows * columns), lanes, slope);
    for (int lane = 0; lane < lanes; ++lane)
        slope[lane] =
            slope[lane] * SLACK + 2 * f->units * f->degree[side] * ROUNDING * f->most[lane] * SLACK;
}

/* --- Points ----------------------------------------------------------------------------------- */

/* Sums of weights times the net's numbers. */
IMP_QUAD_INLINE void weighted_sums(const patch *f, const double *weight, int points, int lanes,
                                   double sum[PATCH_LANES_MAX])
{
    const double *net = f->net;
    imp_quad all[2] = {{0}, {0}};
    for (int k = 0; k < points; ++k)
        for (int h = 0; h < lanes / IMP_QUAD; ++h, net += IMP_QUAD)
            all[h] += imp_quad_all(weight[k]) * imp_quad_load(net);
    for (int h = 0; h < 2; ++h) imp_quad_store(sum + IMP_QUAD * h, all[h]);
}

IMP_QUAD_INLINE void sums_of(const patch *f, const double *weight, int points,
                             double sum[PATCH_LANES_MAX])
{
    if (f->lanes == PATCH_LANES_MAX)
        weighted_sums(f, weight, points, PATCH_LANES_MAX, sum);
    else
        weighted_sums(f, weight, points, f->lanes, sum);
}

IMP_QUAD_WIDE static void sums_of_wide(const patch *f, const double *weight, int points,
                                       double sum[PATCH_LANES_MAX])
{
    sums_of(f, weight, points, sum);
}

/* sum_ij B_i(u) B_j(v) net_ij, per lane; 0 in lanes that are not there. */
static void patch_sums(const patch *f, double u, double v, double sum[PATCH_LANES_MAX])
{
    const int n = f->degree[0], m = f->degree[1];
    double along_u[PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX];
    double weight[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    int points = 0;
    bernstein_weights(along_u, n, u, 0, 0);
    bernstein_weights(along_v, m, v, 0, 0);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) weight[points++] = along_u[i] * along_v[j];
    if (imp_quad_is_wide())
        sums_of_wide(f, weight, points, sum);
    else
        sums_of(f, weight, points, sum);
}

/* One point and its error.
 *
 * Lemma. A sum is off by at most (3n + 3m + 1 + 1 + (n+1)(m+1) - 1 + units) ROUNDING most: the
 * weights (3n and 3m, bernstein.h), their product, its product with the net, the additions, the net
 * itself. W has positive terms only: the same holds relative to W. So X / W is off by that count
 * and 1 for the division, times most / W + |X / W|. The last steps round place + X / W (once), the
 * speed and its product with t (twice), and the sum: 2 |place| + 3 |way|. IMP_TINY stands for
 * underflows. */
void patch_point(const patch *f, const double p[3], double x[3], double error[3])
{
    const int n = f->degree[0], m = f->degree[1];
    double sum[PATCH_LANES_MAX], t = p[2];
    double unit = (3 * (n + m) + (n + 1) * (m + 1) + 2 + f->units) * ROUNDING * SLACK;
    patch_sums(f, p[0], p[1], sum);
    double w = f->rational ? sum[PATCH_W] : 1, twice = f->rational ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
        double shape = sum[axis] / w, change = sum[4 + axis] / w;
        double place = f->place[axis] + shape, way = t * (f->drift[axis] + change);
        double slip = f->most[axis] / w + twice * fabs(shape);
        double slide = f->most[4 + axis] / w + twice * fabs(change);
        x[axis] = place + way;
        error[axis] = unit * (slip + fabs(t) * slide) +
                      3 * SLACK * ROUNDING * (fabs(place) + fabs(way)) + IMP_TINY / f->weight_lo;
    }
}

static bool patch_has(double lo, double hi) { return 0 <= lo && hi <= 1; }

imp_status patch_eval(const patch *f, size_t count, const double *p, double *x, double *error)
{
    double unwanted[3];
    for (size_t k = 0; k < count; ++k, p += 3, x += 3) {
        if (!patch_has(p[0], p[0]) || !patch_has(p[1], p[1])) return IMP_STATUS_DOMAIN;
        if (!(fabs(p[2]) <= PATCH_LATE)) return IMP_STATUS_DOMAIN;
        patch_point(f, p, x, error != NULL ? error + 3 * k : unwanted);
    }
    return IMP_STATUS_OK;
}

/* Whether rate and include can answer for a region: the lemmas need c + d within rounding of
 * the domain, not more. */
imp_status patch_region_status(const imp_region *region)
{
    for (int j = 0; j < 2; ++j) {
        const double c = region->c[j], d = region->d[j];
        if (!patch_has(region->lo[j], region->hi[j])) return IMP_STATUS_DOMAIN;
        if (!patch_has(c - d + 0x1p-50, c + d - 0x1p-50)) return IMP_STATUS_DOMAIN;
    }
    return fabs(region->c[2]) + region->d[2] <= PATCH_LATE ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}
