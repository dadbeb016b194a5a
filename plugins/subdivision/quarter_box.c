/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/quarter.h"

#include "plugins/patch/box_patch.h"

/* A ring, 1 <= u 2^level <= 2, has two halves, v up to 1/2 and from there; each has a triangle at
 * the outer side and one that reaches to the inner (box_patch.h). The upper half is the lower one
 * with x and y of the grid exchanged. */

/* --- The control points ----------------------------------------------------------------------- */

/* Where P_0 of an area lies on the grid, and the edges to P_1 and P_2. */
static const int area_frame[BOX_AREAS][3][2] = {
    [BOX_WHOLE] = {{0, 0}, {1, 0}, {0, 1}},
    [BOX_OUTER] = {{1, 0}, {1, 0}, {0, 1}},
    [BOX_INNER] = {{1, 0}, {0, 1}, {-1, 1}},
};

static void take_points(const walk *w, box_area area, bool is_mirrored, box_data *to)
{
    const corner_net *n = w->now;
    const int(*frame)[2] = area_frame[area];
    to->tables = w->mesh->loop;
    to->area = area;
    to->is_mirrored = is_mirrored;
    to->points.moves = n->groups == 2;
    for (int k = 0; k < BOX_POINTS; ++k) {
        int at[2];
        for (int i = 0; i < 2; ++i)
            at[i] = frame[0][i] + box_place[k][0] * frame[1][i] + box_place[k][1] * frame[2][i];
        const imp_quad *p = n->grid[at[is_mirrored] + 1][at[!is_mirrored] + 1];
        to->points.points[k] = p[0];
        if (to->points.moves) to->points.velocities[k] = p[1];
    }
    walk_place(w, &to->points);
}

/* --- Points ----------------------------------------------------------------------------------- */

/* v of a half, as w from 0 to 1: exact. */
static double across_half(double v, bool is_upper) { return is_upper ? 2 * v - 1 : 2 * v; }

static void box_at(const walk *w, int u, int v, const double p[3], double x[3], double error[3])
{
    box_data data;
    (void)v;
    if (u != FAR) {
        take_points(w, BOX_WHOLE, false, &data);
        box_point(&data, p, x, error);
        return;
    }
    const bool is_upper = p[1] > 0.5;
    const double local[3] = {walk_local(w, p[0], FAR), across_half(p[1], is_upper), p[2]};
    const double from_side = is_upper ? 1 - local[1] : local[1];
    const bool is_outer = 0.5 * ((1 + local[0]) * from_side) <= local[0];
    take_points(w, is_outer ? BOX_OUTER : BOX_INNER, is_upper, &data);
    box_point(&data, local, x, error);
}

/* --- Which triangles a region reaches into ---------------------------------------------------- */

/* A box that holds the region's share of a triangle. */
typedef struct share {
    box_area area;
    bool is_mirrored;
    imp_region region;
} share;

enum { SHARES_MAX = 4 };

/* Parameters of one half: y = u 2^level, from 1 to 2, and w from the side v = 0 or v = 1. */
typedef struct half_box {
    double y[2], w[2];
} half_box;

/* Pads for rounding: y w and 2 (y - 1) have one, 2 / (2 - w) two; 2 - 2 / y is off by 2^-52, and 1
 * - w / 2 by 2^-54. */
#define SHARE_PAD 0x1p-49

/* Lemma. A point is in the outer triangle where y w <= 2 (y - 1), which grows less true with w and
 * more with y; so the box has points of it if its corner (y[1], w[0]) is one, and such have w <= 2
 * - 2 / y[1] and y >= 2 / (2 - w[0]). */
static bool outer_share(const half_box *b, half_box *to)
{
    if (b->y[1] * b->w[0] * (1 - SHARE_PAD) > 2 * (b->y[1] - 1)) return false;
    *to = *b;
    to->y[0] = imp_larger(b->y[0], 2 / (2 - b->w[0]) * (1 - SHARE_PAD));
    to->y[0] = imp_smaller(to->y[0], b->y[1]);
    to->w[1] = imp_smaller(b->w[1], 2 - 2 / b->y[1] + SHARE_PAD);
    to->w[1] = imp_larger(to->w[1], b->w[0]);
    return true;
}

/* A bound from the corner (y[0], w[1]): w >= 2 - 2 / y[0] and y <= 2 / (2 - w[1]). */
static bool inner_share(const half_box *b, half_box *to)
{
    if (b->y[0] * b->w[1] * (1 + SHARE_PAD) < 2 * (b->y[0] - 1)) return false;
    *to = *b;
    to->y[1] = imp_smaller(b->y[1], 2 / (2 - b->w[1]) * (1 + SHARE_PAD));
    to->y[1] = imp_larger(to->y[1], b->y[0]);
    to->w[0] = imp_larger(b->w[0], 2 - 2 / b->y[0] - SHARE_PAD);
    to->w[0] = imp_smaller(to->w[0], b->w[1]);
    return true;
}

/* The box back in u and v, within the region. */
static imp_region region_of(const walk *w, const imp_region *region, const half_box *b,
                            bool is_upper)
{
    double lo[3], hi[3];
    memcpy(lo, region->lo, sizeof lo);
    memcpy(hi, region->hi, sizeof hi);
    lo[0] = ldexp(b->y[0], -w->level), hi[0] = ldexp(b->y[1], -w->level);
    const double from = is_upper ? 1 - 0.5 * b->w[1] : 0.5 * b->w[0];
    const double to = is_upper ? 1 - 0.5 * b->w[0] : 0.5 * b->w[1];
    lo[1] = imp_larger(lo[1], from), hi[1] = imp_smaller(hi[1], to);
    return imp_region_between(lo, hi);
}

/* Finds the shares of a region in the ring and answers how many there are. */
static int shares_of(const walk *w, const imp_region *region, share shares[SHARES_MAX])
{
    int count = 0;
    for (int upper = 0; upper <= 1; ++upper) {
        const bool reaches =
            upper ? region->hi[1] > 0.5 || region->lo[1] >= 0.5 : region->lo[1] < 0.5;
        const double from = upper ? imp_larger(region->lo[1], 0.5) : region->lo[1];
        const double to = upper ? region->hi[1] : imp_smaller(region->hi[1], 0.5);
        const half_box box = {{ldexp(region->lo[0], w->level), ldexp(region->hi[0], w->level)},
                              {2 * (upper ? 1 - to : from), 2 * (upper ? 1 - from : to)}};
        half_box part;
        if (reaches && outer_share(&box, &part))
            shares[count++] = (share){BOX_OUTER, upper, region_of(w, region, &part, upper)};
        if (reaches && inner_share(&box, &part))
            shares[count++] = (share){BOX_INNER, upper, region_of(w, region, &part, upper)};
    }
    if (count == 1) shares[0].region = *region;
    return count;
}

static bool is_one(const walk *w, const imp_region *region, int u, int v)
{
    share shares[SHARES_MAX];
    (void)v;
    return u == NEAR || (u == FAR && shares_of(w, region, shares) == 1);
}

/* --- Bounds ----------------------------------------------------------------------------------- */

/* The region in the half's parameters s and w, exactly. */
static imp_region region_in_half(const walk *w, const imp_region *region, bool is_upper)
{
    imp_region local = *region;
    local.lo[0] = walk_local(w, region->lo[0], FAR),
    local.lo[1] = across_half(region->lo[1], is_upper);
    local.hi[0] = walk_local(w, region->hi[0], FAR),
    local.hi[1] = across_half(region->hi[1], is_upper);
    local.c[0] = walk_local(w, region->c[0], FAR), local.c[1] = across_half(region->c[1], is_upper);
    local.d[0] = ldexp(region->d[0], w->level), local.d[1] = 2 * region->d[1];
    return local;
}

static imp_status include_share(const walk *w, const share *part, imp_model model[3])
{
    box_data data;
    const imp_region local = region_in_half(w, &part->region, part->is_mirrored);
    take_points(w, part->area, part->is_mirrored, &data);
    const imp_status status = box_include(&data, &local, model);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i) {
        model[i].rate[0] = ldexp(model[i].rate[0], w->level);
        model[i].rate[1] *= 2;
    }
    return status;
}

static imp_status include(const walk *w, const imp_region *region, int u, int v, imp_model model[3])
{
    share shares[SHARES_MAX];
    box_data data;
    (void)v;
    if (u == FAR) {
        shares_of(w, region, shares);
        return include_share(w, &shares[0], model);
    }
    take_points(w, BOX_WHOLE, false, &data);
    return box_include(&data, region, model);
}

static imp_status add(const walk *w, const imp_region *whole, const imp_region *part, int u, int v,
                      imp_model sum[3])
{
    share shares[SHARES_MAX];
    imp_status status = IMP_STATUS_OK;
    const int count = shares_of(w, part, shares);
    (void)u, (void)v;
    for (int k = 0; k < count && status == IMP_STATUS_OK; ++k) {
        imp_model g[3];
        status = include_share(w, &shares[k], g);
        if (status == IMP_STATUS_OK) quarter_add_model(whole, &shares[k].region, g, sum);
    }
    return status;
}

/* Where several triangles meet, a net of one of them, with how far the others are from it as its
 * error, is of no more use than the quadratics: it took as many pairs or a few more. */
static imp_status net_of(const walk *w, const imp_region *region, int u, int v, imp_net *net)
{
    share shares[SHARES_MAX];
    box_data data;
    (void)v;
    if (u == NEAR) {
        take_points(w, BOX_WHOLE, false, &data);
        return box_net(&data, region, net);
    }
    if (u != FAR || shares_of(w, region, shares) > 1) return IMP_STATUS_UNBOUNDED;
    const imp_region local = region_in_half(w, region, shares[0].is_mirrored);
    take_points(w, shares[0].area, shares[0].is_mirrored, &data);
    return box_net(&data, &local, net);
}

const quarter_type quarter_box = {box_at, is_one, include, add, net_of};
