/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/quarter.h"

#include "plugins/patch/spline_patch.h"

/* The control points of a quarter, or of the whole quad at level 0. */
static void take_patch(const walk *w, int u, int v, rough_points *data)
{
    const corner_net *n = w->now;
    data->moves = n->groups == 2;
    for (int k = 0; k < SPLINE_POINTS; ++k) {
        const imp_quad *p = n->grid[k / SPLINE_SIDE + (u == FAR)][k % SPLINE_SIDE + (v == FAR)];
        data->points[k] = p[0];
        if (data->moves) data->velocities[k] = p[1];
    }
    walk_place(w, data);
}

static void spline_at(const walk *w, int u, int v, const double p[3], double x[3], double error[3])
{
    rough_points data;
    take_patch(w, u, v, &data);
    spline_point(&data, (double[3]){walk_local(w, p[0], u), walk_local(w, p[1], v), p[2]}, x,
                 error);
}

static imp_region region_in_patch(const walk *w, const imp_region *region, int u, int v)
{
    const int part[2] = {u, v};
    imp_region local = *region;
    for (int side = 0; side < 2; ++side) {
        local.lo[side] = walk_local(w, region->lo[side], part[side]);
        local.hi[side] = walk_local(w, region->hi[side], part[side]);
        local.c[side] = walk_local(w, region->c[side], part[side]);
        local.d[side] = ldexp(region->d[side], w->level);
    }
    return local;
}

static bool is_one(const walk *w, const imp_region *region, int u, int v)
{
    (void)w, (void)region;
    return u != (NEAR | FAR) && v != (NEAR | FAR);
}

static imp_status include(const walk *w, const imp_region *region, int u, int v, imp_model model[3])
{
    rough_points data;
    const imp_region local = region_in_patch(w, region, u, v);
    take_patch(w, u, v, &data);
    const imp_status status = spline_include(&data, &local, model);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        for (int side = 0; side < 2; ++side)
            model[i].rate[side] = ldexp(model[i].rate[side], w->level);
    return status;
}

static imp_status add(const walk *w, const imp_region *whole, const imp_region *part, int u, int v,
                      imp_model sum[3])
{
    imp_model g[3];
    const imp_status status = include(w, part, u, v, g);
    if (status == IMP_STATUS_OK) quarter_add_model(whole, part, g, sum);
    return status;
}

static imp_status net_of(const walk *w, const imp_region *region, int u, int v, imp_net *net)
{
    rough_points data;
    if (!is_one(w, region, u, v)) return IMP_STATUS_UNBOUNDED;
    const imp_region local = region_in_patch(w, region, u, v);
    take_patch(w, u, v, &data);
    return spline_net(&data, &local, net);
}

const quarter_type quarter_spline = {spline_at, is_one, include, add, net_of};
