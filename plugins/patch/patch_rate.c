/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch_rate.h"

#include "plugins/patch/bernstein.h"
#include "plugins/patch/rows.h"

#include <impinge/interval.h>
#include <impinge/quad.h>

/* Lemma (roundings, in units of ROUNDING). A control point of the sub-patch: (4n + 4m + 2) most,
 * bernstein.h, and units most for the net. One of a derivative along a side of degree k: (4n + 4m +
 * 2) slope, and (2 units k most + 2 slope) for its net (patch_set_differences). Below, `shape_slip`
 * and `slope_slip` are these; what is computed from them adds a few of the same size, and so 4
 * more. */

/* Weights of all control points of a polynomial of degree n over [lo, hi]: point k has w_jk, as
 * patch_rows wants it. */
IMP_QUAD_INLINE void patch_weights(int n, double lo, double hi, double *w)
{
    for (int k = 0; k <= n; ++k) {
        double weight[PATCH_SIDE_MAX];
        bernstein_weights(weight, n - k, lo, k, hi);
        for (int j = 0; j <= n; ++j) w[j * (n + 1) + k] = weight[j];
    }
}

/* Control points over the region of a net of degrees n, m; `work` has room for as many. */
IMP_QUAD_INLINE void patch_restrict(const double *net, int n, int m, int lanes,
                                    const imp_region *region, double *out, double *work)
{
    const int group = lanes / IMP_QUAD, row = (m + 1) * group;
    double along_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    imp_quad *half = (imp_quad *)work, *whole = (imp_quad *)out;
    patch_weights(n, region->lo[0], region->hi[0], along_u);
    patch_weights(m, region->lo[1], region->hi[1], along_v);
    patch_rows(n, along_u, false, (const imp_quad *)net, half, row);
    for (int i = 0; i <= n; ++i)
        patch_rows(m, along_v, false, half + i * row, whole + i * row, group);
}

/* What is known of the sub-patch before its derivatives: for each end of time, |g - c| <= r. */
typedef struct patch_frame {
    double time[2], late; /* the ends; the greater |time| */
    double c[2][3], r[2][3];
    double weight;   /* least W, rounded down; 1 if polynomial */
    double speed[3]; /* max |drift + Y / W| */
} patch_frame;

static double patch_lane(const double *group, const patch *f, int axis, double t)
{
    return f->lanes == 8 ? group[axis] + t * group[4 + axis] : group[axis];
}

static double patch_slip(const double *per_lane, int axis, double late)
{
    return per_lane[axis] + late * per_lane[4 + axis];
}

/* c and r at one end of time. */
static void patch_frame_centre(const patch *f, patch_frame *frame, int end, int axis,
                               const double *shape, double unit)
{
    double lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i < patch_points(f->degree); ++i) {
        const double *group = shape + i * (size_t)f->lanes;
        double g = patch_lane(group, f, axis, frame->time[end]) / group[PATCH_W];
        lo = imp_smaller(lo, g);
        hi = imp_larger(hi, g);
    }
    double greatest = imp_larger(fabs(lo), fabs(hi));
    double slip = unit * (patch_slip(f->most, axis, frame->late) / frame->weight + greatest);
    frame->c[end][axis] = lo + (hi - lo) / 2;
    frame->r[end][axis] = ((hi - lo) / 2 + slip) * SLACK;
}

/* Least W over the sub-patch. */
static double patch_frame_weight(const patch *f, const double *shape, double unit)
{
    double least = INFINITY;
    if (!f->rational) return 1;
    for (size_t i = 0; i < patch_points(f->degree); ++i)
        least = imp_smaller(least, shape[i * (size_t)f->lanes + PATCH_W]);
    return least * (1 - 2 * unit);
}

/* Greatest |drift + Y / W|. */
static double patch_frame_speed(const patch *f, const patch_frame *frame, int axis,
                                const double *shape, double unit)
{
    double most = 0, slip = unit * (2 * f->most[4 + axis] / frame->weight + fabs(f->drift[axis]));
    if (f->lanes == 4) return 0;
    for (size_t i = 0; i < patch_points(f->degree); ++i) {
        const double *group = shape + i * (size_t)f->lanes;
        double change = group[4 + axis] / (f->rational ? group[PATCH_W] : 1);
        most = imp_larger(most, fabs(f->drift[axis] + change));
    }
    return (most + slip) * SLACK;
}

static patch_frame patch_make_frame(const patch *f, const imp_region *region, double *shape,
                                    double *work)
{
    const int n = f->degree[0], m = f->degree[1];
    const double unit = (4 * (n + m) + 6 + f->units) * ROUNDING * SLACK;
    patch_frame frame = {.time = {region->lo[2], region->hi[2]}};
    frame.late = imp_larger(fabs(region->lo[2]), fabs(region->hi[2]));
    patch_restrict(f->net, n, m, f->lanes, region, shape, work);
    frame.weight = patch_frame_weight(f, shape, unit);
    for (int axis = 0; axis < 3; ++axis) {
        frame.speed[axis] = patch_frame_speed(f, &frame, axis, shape, unit);
        for (int end = 0; end < 2 && f->rational; ++end)
            patch_frame_centre(f, &frame, end, axis, shape, unit);
    }
    return frame;
}

/* Greatest |d/du| (side 0) or |d/dv| of one coordinate, from the sub-patch's derivative net. */
static double patch_side_rate(const patch *f, const patch_frame *frame, int side, int axis,
                              const double *slopes)
{
    const int n = f->degree[0], m = f->degree[1];
    const size_t points =
        patch_points(f->degree) / (size_t)(f->degree[side] + 1) * (size_t)f->degree[side];
    double most = 0, slip = 0, unit = (4 * (n + m) + 4 + 2 * f->units) * ROUNDING * SLACK;
    for (int end = 0; end < 2; ++end) {
        const double c = frame->c[end][axis], r = frame->r[end][axis];
        double turn = fabs(c) + r;
        double shape = patch_slip(f->most, axis, frame->late) + turn * f->most[PATCH_W];
        double slope =
            patch_slip(f->slope[side], axis, frame->late) + turn * f->slope[side][PATCH_W];
        slip = imp_larger(slip, slope + f->degree[side] * shape);
        for (size_t i = 0; i < points; ++i) {
            const double *group = slopes + i * (size_t)f->lanes;
            double x = patch_lane(group, f, axis, frame->time[end]);
            most = imp_larger(most, fabs(x - c * group[PATCH_W]) + r * fabs(group[PATCH_W]));
        }
    }
    return (most + unit * slip) / frame->weight * SLACK + IMP_TINY;
}

imp_status patch_rate(const patch *f, const imp_region *region, imp_rate_matrix *rates)
{
    _Alignas(imp_quad) double shape[PATCH_NUMBERS_MAX], work[PATCH_NUMBERS_MAX];
    imp_status status = patch_region_status(region);
    if (status != IMP_STATUS_OK) return status;
    const patch_frame frame = patch_make_frame(f, region, shape, work);
    for (int side = 0; side < 2; ++side) {
        patch_restrict(f->difference[side], f->degree[0] - (side == 0), f->degree[1] - (side == 1),
                       f->lanes, region, shape, work);
        for (int axis = 0; axis < 3; ++axis)
            rates->m[axis][side] = patch_side_rate(f, &frame, side, axis, shape);
    }
    for (int axis = 0; axis < 3; ++axis) rates->m[axis][2] = frame.speed[axis];
    return IMP_STATUS_OK;
}
