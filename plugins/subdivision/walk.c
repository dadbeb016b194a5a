/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/walk.h"

#include <impinge/formula.h>

void walk_begin(const face *q, walk *w)
{
    w->mesh = q->mesh;
    corner_find(q->mesh, q->start, &w->points);
    memset(&w->frame, 0, sizeof w->frame);
    if (w->points.has_fan) corner_limit(&w->points, q->mesh, &w->frame, &w->error);
    corner_take(&w->points, q->mesh, &w->frame, &w->first);
    walk_again(w);
}

void walk_again(walk *w)
{
    w->now = &w->first;
    w->level = 0;
}

void walk_step(walk *w)
{
    corner_net *to = &w->next[w->now == &w->next[0]];
    corner_step(w->now, to);
    w->now = to;
    w->level += 1;
}

int walk_parts(const walk *w, int side, double lo, double hi)
{
    const double h = ldexp(1, -w->level);
    if (side == 1 && w->points.is_loop) return NEAR;
    return (lo < h ? NEAR : 0) | (hi > h || lo >= h ? FAR : 0);
}

imp_region walk_part(const walk *w, const imp_region *region, int u, int v)
{
    const int part[2] = {u, v};
    const double h = ldexp(1, -w->level);
    double lo[3] = {0, 0, region->lo[2]}, hi[3] = {0, 0, region->hi[2]};
    for (int side = 0; side < 2; ++side) {
        const bool is_cut = side == 0 || !w->points.is_loop;
        lo[side] = part[side] == FAR ? imp_larger(region->lo[side], h) : region->lo[side];
        hi[side] =
            part[side] == NEAR && is_cut ? imp_smaller(region->hi[side], h) : region->hi[side];
    }
    return imp_region_between(lo, hi);
}

double walk_local(const walk *w, double x, int part)
{
    return ldexp(x, w->level) - (part == FAR ? 1 : 0);
}

void walk_place(const walk *w, rough_points *to)
{
    const corner_net *n = w->now;
    bool is_border = n->faces > 0;
    for (int side = 0; side < 4; ++side) is_border = is_border || n->is_border[side];
    for (int k = 0; k < 3; ++k) is_border = is_border || n->missing[k] != 0;
    const double reflection = is_border ? CORNER_REFLECTION : 0;
    for (int i = 0; i < 3; ++i) {
        to->place[i] = w->frame.place[i];
        to->drift[i] = w->frame.drift[i];
        to->slip[i] = n->slip[i] + reflection * n->most[i];
        to->slip_motion[i] =
            to->moves ? n->slip[IMP_QUAD + i] + reflection * n->most[IMP_QUAD + i] : 0;
    }
}
