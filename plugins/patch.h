/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_H
#define PLUGINS_PATCH_H

#include "bernstein.h"
#include "chebyshev.h"
#include "quad.h"

#include <impinge/interval.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A moving patch, polynomial or rational
 * ======================================
 * Over (u, v) in [0, 1]^2, with the Bernstein polynomials B of degrees n and m,
 *
 *   f(u, v, t) = place + t drift + (X + t Y) / W
 *   X = sum_ij B_i(u) B_j(v) w_ij (P_ij - place),   W = sum_ij B_i(u) B_j(v) w_ij
 *   Y = sum_ij B_i(u) B_j(v) w_ij (V_ij - drift)
 *
 * for control points P_ij, velocities V_ij and weights w_ij > 0. `place` and `drift` lie in the
 * middle of the points and of the velocities: what is left is small even far from the origin,
 * and rounding errors scale with it. A polynomial patch has no W; a patch at rest has no Y.
 *
 * The net holds a quad of numbers per control point, (X, W), and if the patch moves a second
 * one, (Y, 0). patch_rate.h and
 * patch_include.h bound a patch over a region; this file makes and evaluates it. */

enum {
    PATCH_DEGREE_MAX = 20, /* buffers on the stack: under 100 kB */
    PATCH_SIDE_MAX = PATCH_DEGREE_MAX + 1,
    PATCH_LANES_MAX = 8,
    PATCH_NUMBERS_MAX = PATCH_SIDE_MAX * PATCH_SIDE_MAX * PATCH_LANES_MAX,
    PATCH_W = 3 /* the lane of W */
};

/* Limits that keep every number below finite: |P|, |V| <= PATCH_FAR, |t| <= PATCH_LATE, and weights
 * from 1 / PATCH_HEAVY to PATCH_HEAVY. */
#define PATCH_FAR 1e100
#define PATCH_LATE 1e50
#define PATCH_HEAVY 1e50

#define ROUNDING 0x1p-53 /* relative error of one operation */
/* Covers what the lemmas drop: second-order terms and the rounding of a bound itself, up to some
 * thousand operations on positive terms. */
#define SLACK (1 + 0x1p-40)

/* Control points, and velocities if the patch moves (else NULL), of 3 numbers each; weights if it
 * is rational (else NULL). Point i, j is at index i (degree[1] + 1) + j. */
typedef struct patch_data {
    int degree[2];
    const double *points, *velocities, *weights;
} patch_data;

typedef struct patch {
    int degree[2];
    int lanes; /* numbers per control point: 4 at rest, 8 moving */
    bool rational;
    double units;                     /* error of the net is units ROUNDING most at most */
    double weight_lo;                 /* least weight; 1 if polynomial */
    double place[4], drift[4];        /* of x, y, z, and a 0 */
    double place_radius[4];           /* max |P - place| */
    double drift_radius[4];           /* max |V - drift| */
    double most[PATCH_LANES_MAX];     /* max |net|, per lane */
    double slope[2][PATCH_LANES_MAX]; /* max |difference|, per lane, for d/du and d/dv */
    double noise[PATCH_LANES_MAX];    /* rounding of the series, see patch_series.h */
    double *net;                      /* (n+1)(m+1) groups */
    double *series;                   /* the same polynomials in Chebyshev form */
    double *difference[2];            /* nets of d/du and d/dv: n (m+1), (n+1) m groups */
} patch;

static inline size_t patch_points(const int degree[2])
{
    return (size_t)(degree[0] + 1) * (size_t)(degree[1] + 1);
}

/* --- Making one --- */

static inline double *patch_groups(double **memory, size_t count, int lanes)
{
    double *groups = *memory;
    *memory += count * (size_t)lanes;
    return groups;
}

/* The struct and its arrays as one block, for free(); NULL: no memory. */
static inline patch *patch_allocate(const patch_data *data)
{
    const int n = data->degree[0], m = data->degree[1], lanes = data->velocities ? 8 : 4;
    size_t points = patch_points(data->degree);
    size_t along_u = points - (size_t)(m + 1), along_v = points - (size_t)(n + 1);
    size_t head = (sizeof(patch) + 63) / 64 * 64;
    size_t numbers = (2 * points + along_u + along_v) * (size_t)lanes;
    patch *f = aligned_alloc(64, head + (numbers * sizeof(double) + 63) / 64 * 64);
    if (!f) return NULL;
    memset(f, 0, sizeof *f);
    double *memory = (double *)((char *)f + head);
    f->degree[0] = n, f->degree[1] = m, f->lanes = lanes;
    f->net = patch_groups(&memory, points, lanes);
    f->series = patch_groups(&memory, points, lanes);
    f->difference[0] = patch_groups(&memory, along_u, lanes);
    f->difference[1] = patch_groups(&memory, along_v, lanes);
    return f;
}

/* Middle of n numbers that are 3 apart, and how far they are from it, rounded up. */
static inline double patch_middle(size_t n, const double *x, double *radius)
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

static inline double patch_greatest(const double *x, size_t count, int step)
{
    double most = 0;
    for (size_t i = 0; i < count; ++i) most = imp_larger(most, fabs(x[i * (size_t)step]));
    return most;
}

/* Each number of the net takes at most two roundings: units is 2. */
static inline void patch_set_net(patch *f, const patch_data *data)
{
    const size_t points = patch_points(f->degree);
    for (size_t axis = 0; axis < 3; ++axis) {
        f->place[axis] = patch_middle(points, data->points + axis, &f->place_radius[axis]);
        if (data->velocities)
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
            if (data->velocities)
                group[4 + axis] = w * (data->velocities[3 * i + axis] - f->drift[axis]);
        }
        if (f->rational) group[PATCH_W] = w;
        f->weight_lo = imp_smaller(f->weight_lo, w);
    }
    for (int lane = 0; lane < f->lanes; ++lane)
        f->most[lane] = patch_greatest(f->net + lane, points, f->lanes);
}

/* d/du of sum_i B_i(u) P_i, degree n, is the like sum of degree n - 1 with n (P_(i+1) - P_i).
 * Rounding: of both numbers of the net, of the difference and of the product, together at
 * most (2 units n most + 2 |result|) ROUNDING. */
static inline void patch_set_differences(patch *f, int side)
{
    const int m = f->degree[1], lanes = f->lanes;
    int rows = f->degree[0] + (side ? 1 : 0), columns = m + (side ? 0 : 1);
    int step = (side ? 1 : m + 1) * lanes;
    double *out = f->difference[side];
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            for (int lane = 0; lane < lanes; ++lane) {
                const double *here = f->net + (i * (m + 1) + j) * lanes + lane;
                *out++ = f->degree[side] * (here[step] - here[0]);
            }
    for (int lane = 0; lane < lanes; ++lane)
        f->slope[side][lane] =
            patch_greatest(f->difference[side] + lane, (size_t)(rows * columns), lanes) * SLACK +
            2 * f->units * f->degree[side] * ROUNDING * f->most[lane] * SLACK;
}

/* --- Points --- */

/* sum_ij B_i(u) B_j(v) net_ij, per lane; 0 in lanes that are not there. */
static inline void patch_sums(const patch *f, double u, double v, double sum[PATCH_LANES_MAX])
{
    const int n = f->degree[0], m = f->degree[1], stride = f->lanes / QUAD;
    const quad *net = (const quad *)f->net;
    double along_u[PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX];
    double weight[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    int points = 0;
    bernstein_weights(along_u, n, u, 0, 0);
    bernstein_weights(along_v, m, v, 0, 0);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) weight[points++] = along_u[i] * along_v[j];
    for (int h = 0; h < PATCH_LANES_MAX / QUAD; ++h) {
        quad all = {0};
        for (int k = 0; h < stride && k < points; ++k) all += weight[k] * net[k * stride + h];
        memcpy(sum + QUAD * h, &all, sizeof all);
    }
}

/* One point and its error.
 *
 * Lemma. A sum is off by at most (3n + 3m + 1 + 1 + (n+1)(m+1) - 1 + units) ROUNDING most: the
 * weights (3n and 3m, bernstein.h), their product, its product with the net, the additions, the net
 * itself. W has positive terms only: the same holds relative to W. So X / W is off by that count
 * and 1 for the division, times most / W + |X / W|. The last steps round place + X / W (once), the
 * speed and its product with t (twice), and the sum: 2 |place| + 3 |way|. IMP_TINY stands for
 * underflows. */
static inline void patch_point(const patch *f, const double p[3], double x[3], double error[3])
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

static inline bool patch_has(double lo, double hi) { return 0 <= lo && hi <= 1; }

/* As imp_surface_type.eval. */
static inline imp_status patch_eval(const patch *f, size_t count, const double *p, double *x,
                                    double *error)
{
    double unwanted[3];
    for (size_t k = 0; k < count; ++k, p += 3, x += 3) {
        if (!patch_has(p[0], p[0]) || !patch_has(p[1], p[1])) return IMP_DOMAIN;
        if (!(fabs(p[2]) <= PATCH_LATE)) return IMP_DOMAIN;
        patch_point(f, p, x, error ? error + 3 * k : unwanted);
    }
    return IMP_OK;
}

/* Whether rate and include can answer for a region: the lemmas need c + d within rounding of
 * the domain, not more. */
static inline imp_status patch_region_status(const imp_region *region)
{
    for (int j = 0; j < 2; ++j) {
        const double c = region->c[j], d = region->d[j];
        if (!patch_has(region->lo[j], region->hi[j])) return IMP_DOMAIN;
        if (!patch_has(c - d + 0x1p-50, c + d - 0x1p-50)) return IMP_DOMAIN;
    }
    return fabs(region->c[2]) + region->d[2] <= PATCH_LATE ? IMP_OK : IMP_UNBOUNDED;
}

#endif
