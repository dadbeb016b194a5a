/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/rough_points.h"

#include <impinge/interval.h>
#include <string.h>

/* The middle of the numbers, how far they are from it, and what is left of them: one rounding
 * each. */
static void set_group(const imp_quad *in, int count, int groups, double middle[4], double radius[4],
                      double most[4], imp_quad *net)
{
    imp_quad lo = in[0], hi = in[0], greatest = {0};
    for (int k = 1; k < count; ++k) {
        lo = imp_quad_min(in[k], lo);
        hi = imp_quad_max(in[k], hi);
    }
    const imp_quad centre = lo + 0.5 * (hi - lo);
    for (int k = 0; k < count; ++k) {
        net[k * groups] = in[k] - centre;
        greatest = imp_quad_max(imp_quad_abs(net[k * groups]), greatest);
    }
    imp_quad_store(middle, centre);
    imp_quad_store(radius, imp_quad_max(hi - centre, centre - lo) * SLACK);
    imp_quad_store(most, greatest);
}

/* Sets the net as patch_set_net does. What adding the places rounds is left to rough_slip_upper. */
void rough_begin(const rough_points *data, int count, patch *f, imp_quad *net)
{
    const int groups = data->moves ? 2 : 1;
    memset(f, 0, sizeof *f);
    f->lanes = groups * IMP_QUAD;
    f->units = 2;
    f->weight_lo = 1;
    set_group(data->points, count, groups, f->place, f->place_radius, f->most, net);
    if (data->moves)
        set_group(data->velocities, count, groups, f->drift, f->drift_radius, f->most + IMP_QUAD,
                  net + 1);
    for (int axis = 0; axis < 3; ++axis) {
        f->place[axis] += data->place[axis];
        f->drift[axis] += data->drift[axis];
    }
}

double rough_slip_upper(const rough_points *data, const patch *f, int axis, double late)
{
    const double still = data->slip[axis] + ROUNDING * fabs(f->place[axis]);
    const double motion = data->slip_motion[axis] + ROUNDING * fabs(f->drift[axis]);
    return (still + late * motion) * SLACK;
}

imp_quad rough_slope_upper(const rough_points *data, const patch *f, int group, imp_quad slope)
{
    const double *slip = group == 0 ? data->slip : data->slip_motion;
    return (slope + ROUGH_SLOPE * imp_quad_of(slip[0], slip[1], slip[2], 0) +
            2 * (f->units + 1) * ROUNDING * imp_quad_load(f->most + group * IMP_QUAD)) *
           SLACK;
}

void rough_widen_model(const rough_points *data, const patch *f, const imp_region *region,
                       imp_model model[3])
{
    const double late = fabs(region->c[2]) + region->d[2];
    for (int axis = 0; axis < 3; ++axis) {
        imp_model *g = &model[axis];
        const double slip = rough_slip_upper(data, f, axis, late) + IMP_TINY;
        const double slope = ROUGH_SLOPE * (data->slip[axis] + late * data->slip_motion[axis]);
        g->e = imp_sum_up(g->e + slip);
        g->lo = imp_sum_down(g->lo - slip);
        g->hi = imp_sum_up(g->hi + slip);
        for (int side = 0; side < 2; ++side) g->rate[side] = (g->rate[side] + slope) * SLACK;
        if (data->moves)
            g->rate[2] =
                (g->rate[2] + data->slip_motion[axis] + ROUNDING * fabs(f->drift[axis])) * SLACK;
    }
}

void rough_widen_net(const rough_points *data, const patch *f, const imp_region *region,
                     imp_net *net)
{
    const double late = fabs(region->c[2]) + region->d[2];
    for (int axis = 0; axis < 3; ++axis)
        net->error[axis] =
            imp_sum_up(net->error[axis] + rough_slip_upper(data, f, axis, late) + IMP_TINY);
}
