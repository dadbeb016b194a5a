/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/quad.h"

#include "plugins/patch/pieces.h"
#include "plugins/patch/spline_patch.h"

/* Levels of rings that a region may reach into beside the first before the rest counts as a box. */
enum { RINGS = 4 };

/* --- From level to level ---------------------------------------------------------------------------- */

/* The control points of the corner's square of side 2^-level. */
typedef struct walk {
    corner_points points;
    corner_frame frame, error; /* the limit point, and what it may be off */
    corner_net first, next[2];
    const corner_net *now;
    int level;
} walk;

static void walk_begin(const quad *q, walk *w)
{
    corner_find(q->mesh, q->start, &w->points);
    memset(&w->frame, 0, sizeof w->frame);
    if (w->points.has_fan) corner_limit(&w->points, q->mesh, &w->frame, &w->error);
    corner_take(&w->points, q->mesh, &w->frame, &w->first);
    w->now = &w->first;
    w->level = 0;
}

static void walk_again(walk *w)
{
    w->now = &w->first;
    w->level = 0;
}

static void walk_step(walk *w)
{
    corner_net *to = &w->next[w->now == &w->next[0]];
    corner_step(w->now, to);
    w->now = to;
    w->level += 1;
}

/* Which quarters of the square before the last step something reaches into, along one side. */
enum { NEAR = 1, FAR = 2 };

static int quarters(const walk *w, double lo, double hi)
{
    const double h = ldexp(1, -w->level);
    return (lo < h ? NEAR : 0) | (hi > h || lo >= h ? FAR : 0);
}

/* The control points of one of those quarters, or of the whole quad at level 0. */
static void take_patch(const walk *w, int u, int v, spline_data *data)
{
    const corner_net *n = w->now;
    bool is_border = n->faces > 0;
    data->moves = n->groups == 2;
    for (int k = 0; k < SPLINE_POINTS; ++k) {
        const imp_quad *p = n->grid[k / SPLINE_SIDE + (u == FAR)][k % SPLINE_SIDE + (v == FAR)];
        data->points[k] = p[0];
        if (data->moves) data->velocities[k] = p[1];
    }
    for (int side = 0; side < 4; ++side) is_border = is_border || n->is_border[side];
    const double reflection = is_border ? CORNER_REFLECTION : 0;
    for (int i = 0; i < 3; ++i) {
        data->place[i] = w->frame.place[i];
        data->drift[i] = w->frame.drift[i];
        data->slip[i] = n->slip[i] + reflection * n->most[i];
        data->slip_motion[i] =
            data->moves ? n->slip[IMP_QUAD + i] + reflection * n->most[IMP_QUAD + i] : 0;
    }
}

/* A part of the quad as one of such a quarter: exact, as 2^level is a power of two and a number from 1 to
 * 2 less 1 is exact. */
static double in_patch(const walk *w, double x, int part)
{
    return ldexp(x, w->level) - (part == FAR ? 1 : 0);
}

static imp_region region_in_patch(const walk *w, const imp_region *region, int u, int v)
{
    const int part[2] = {u, v};
    imp_region local = *region;
    for (int side = 0; side < 2; ++side) {
        local.lo[side] = in_patch(w, region->lo[side], part[side]);
        local.hi[side] = in_patch(w, region->hi[side], part[side]);
        local.c[side] = in_patch(w, region->c[side], part[side]);
        local.d[side] = ldexp(region->d[side], w->level);
    }
    return local;
}

/* --- The gauge ----------------------------------------------------------------------------------------- */

/* The greatest step along u (side 0) or v between control points, but that at (-1,-1), of all lanes. */
static void greater_steps(const corner_net *n, int side, double steps[CORNER_LANES])
{
    for (int g = 0; g < n->groups; ++g) {
        imp_quad most = {0};
        for (int x = 0; x < CORNER_FINE - (side == 0); ++x)
            for (int y = x == 0; y < CORNER_FINE - (side == 1); ++y)
                most = imp_quad_max(imp_quad_abs(n->grid[x + (side == 0)][y + (side == 1)][g] -
                                                 n->grid[x][y][g]),
                                    most);
        most += 2 * imp_quad_load(n->slip + g * IMP_QUAD) +
                (2 * CORNER_REFLECTION + 0x1p-52) * imp_quad_load(n->most + g * IMP_QUAD);
        imp_quad_store(steps + g * IMP_QUAD, most);
    }
}

static bool is_small(const corner_net *n, const corner_net *first)
{
    for (int lane = 0; lane < n->groups * IMP_QUAD; ++lane)
        if (n->most[lane] > 0x1p-50 * first->most[lane]) return false;
    return true;
}

/* Lemma (the last square). Let w = max(u, v), h its side, q(u, v) the surface on w = h less the limit
 * point, |q| <= r. There the surface is replaced by limit + (w / h) q(u h / w, v h / w). Where u >= v its
 * derivative by v is that of q along the border u = h, and by u it is q / h - (v / u) times that: at most
 * r / h + rate_v. Likewise where v >= u. */
static double with_last_square(double own, double other, double r, int level)
{
    return imp_larger(own, ldexp(r, level) + other) * SLACK + IMP_TINY;
}

/* A step's four-by-four grids span cells of side 2^-level, and B-splines change by no more than their
 * control points do from one to the next. */
void quad_measure(const quad *q, quad_gauge *gauge)
{
    walk w;
    double rate[2][CORNER_LANES] = {{0}};
    walk_begin(q, &w);
    while (w.level < QUAD_DEPTH_MAX && !is_small(w.now, &w.first)) {
        walk_step(&w);
        for (int side = 0; side < 2; ++side) {
            double steps[CORNER_LANES];
            greater_steps(w.now, side, steps);
            for (int lane = 0; lane < w.now->groups * IMP_QUAD; ++lane)
                rate[side][lane] = imp_larger(rate[side][lane], ldexp(steps[lane], w.level));
        }
    }
    gauge->depth = w.level;
    for (int side = 0; side < 2; ++side)
        for (int i = 0; i < 3; ++i) {
            const int m = IMP_QUAD + i;
            const double r = w.now->most[i] + w.now->slip[i] + w.error.place[i];
            gauge->rate[side][i] = with_last_square(rate[side][i], rate[!side][i], r, w.level);
            gauge->rate_motion[side][i] = 0;
            if (w.now->groups == 1) continue;
            const double r_motion = w.now->most[m] + w.now->slip[m] + w.error.drift[i];
            gauge->rate_motion[side][i] =
                with_last_square(rate[side][m], rate[!side][m], r_motion, w.level);
        }
}

/* --- Points ----------------------------------------------------------------------------------------------- */

static bool has_point(const double *p)
{
    return p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1 && fabs(p[2]) <= PATCH_LATE;
}

/* A point of the last square, where the surface is within `most` of the limit; the limit point itself at
 * the corner. Two sums and a product are rounded. */
static void point_of_limit(const walk *w, const double p[3], double x[3], double error[3])
{
    const bool is_limit = p[0] == 0 && p[1] == 0;
    for (int i = 0; i < 3; ++i) {
        const double way = p[2] * w->frame.drift[i];
        double slip = w->error.place[i] + fabs(p[2]) * w->error.drift[i];
        if (!is_limit) {
            slip += w->now->most[i] + w->now->slip[i];
            if (w->now->groups == 2)
                slip += fabs(p[2]) * (w->now->most[IMP_QUAD + i] + w->now->slip[IMP_QUAD + i]);
        }
        x[i] = w->frame.place[i] + way;
        error[i] = (slip + 2 * ROUNDING * (fabs(x[i]) + fabs(way))) * SLACK + IMP_TINY;
    }
}

static void point_at(const quad *q, walk *w, const double p[3], double x[3], double error[3])
{
    spline_data data;
    int u = NEAR, v = NEAR;
    walk_again(w);
    if (q->gauge != NULL) {
        const bool is_limit = p[0] == 0 && p[1] == 0;
        while (u == NEAR && v == NEAR && !is_limit && w->level < q->gauge->depth) {
            walk_step(w);
            u = quarters(w, p[0], p[0]), v = quarters(w, p[1], p[1]);
        }
        if (u == NEAR && v == NEAR) {
            point_of_limit(w, p, x, error);
            return;
        }
    }
    take_patch(w, u, v, &data);
    spline_point(&data, (double[3]){in_patch(w, p[0], u), in_patch(w, p[1], v), p[2]}, x, error);
}

imp_status quad_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const quad *q = self;
    double unwanted[3];
    walk w;
    walk_begin(q, &w);
    for (size_t k = 0; k < n; ++k) {
        if (!has_point(p + 3 * k)) return IMP_DOMAIN;
        point_at(q, &w, p + 3 * k, x + 3 * k, error != NULL ? error + 3 * k : unwanted);
    }
    return IMP_OK;
}

/* --- Regions ------------------------------------------------------------------------------------------------ */

/* Steps to the first level of which the region reaches into more than the corner's quarter. False: it is
 * inside the last square. */
static bool walk_to(const quad *q, const imp_region *region, walk *w, int *u, int *v)
{
    *u = *v = NEAR;
    while (*u == NEAR && *v == NEAR && w->level < q->gauge->depth) {
        walk_step(w);
        *u = quarters(w, region->lo[0], region->hi[0]);
        *v = quarters(w, region->lo[1], region->hi[1]);
    }
    return *u != NEAR || *v != NEAR;
}

static bool is_one(int u, int v) { return u != (NEAR | FAR) && v != (NEAR | FAR); }

/* Bounds over a part of one quarter, which lies within the region. */
static imp_status include_patch(const walk *w, const imp_region *region, int u, int v,
                                imp_model model[3])
{
    spline_data data;
    const imp_region local = region_in_patch(w, region, u, v);
    take_patch(w, u, v, &data);
    const imp_status status = spline_include(&data, &local, model);
    for (int i = 0; i < 3 && status == IMP_OK; ++i)
        for (int side = 0; side < 2; ++side)
            model[i].rate[side] = ldexp(model[i].rate[side], w->level);
    return status;
}

/* The box of the control points, at any time t = c + d s of the region: |f - (place + t drift)| <= most +
 * |t| most of the velocities. Six roundings at most are of numbers no greater than `far`. */
static void include_square(const quad *q, const walk *w, const imp_region *region, imp_model model[3])
{
    const double c = region->c[2], d = region->d[2], late = fabs(c) + d;
    const corner_net *n = w->now;
    for (int i = 0; i < 3; ++i) {
        imp_model *g = &model[i];
        const bool moves = n->groups == 2;
        const double speed = moves ? n->most[IMP_QUAD + i] + n->slip[IMP_QUAD + i] : 0;
        const double place = w->frame.place[i], drift = w->frame.drift[i];
        const double far = fabs(place) + late * fabs(drift);
        *g = imp_model_zero();
        g->a = place + c * drift;
        g->b[2] = d * drift;
        g->e = (n->most[i] + n->slip[i] + late * speed + 6 * ROUNDING * far) * SLACK + IMP_TINY;
        const double reach = (g->e + fabs(g->b[2])) * SLACK;
        g->lo = imp_sum_down(g->a - reach);
        g->hi = imp_sum_up(g->a + reach);
        for (int side = 0; side < 2; ++side)
            g->rate[side] =
                (q->gauge->rate[side][i] + late * q->gauge->rate_motion[side][i]) * SLACK;
        g->rate[2] = moves ? (fabs(drift) + speed) * SLACK : 0;
        g->depends = moves ? 7 : 3;
    }
}

/* The part of the region in quarter u, v of the square before the last step. */
static imp_region part_in(const walk *w, const imp_region *region, int u, int v)
{
    const int part[2] = {u, v};
    const double h = ldexp(1, -w->level);
    double lo[3] = {0, 0, region->lo[2]}, hi[3] = {0, 0, region->hi[2]};
    for (int side = 0; side < 2; ++side) {
        lo[side] = part[side] == FAR ? imp_larger(region->lo[side], h) : region->lo[side];
        hi[side] = part[side] == NEAR ? imp_smaller(region->hi[side], h) : region->hi[side];
    }
    return imp_region_between(lo, hi);
}

static void add_part(const imp_region *region, const imp_region *part, const imp_model g[3],
                     imp_model whole[3])
{
    const pieces_shift shift = pieces_shift_of(region, part);
    for (int i = 0; i < 3; ++i) pieces_add(&whole[i], &g[i], &shift);
}

/* The quarters but the corner's. */
static imp_status add_quarters(const walk *w, const imp_region *region, const imp_region *rest, int u,
                               int v, imp_model whole[3])
{
    imp_status status = IMP_OK;
    for (int a = NEAR; a <= FAR; ++a)
        for (int b = NEAR; b <= FAR && status == IMP_OK; ++b) {
            imp_model g[3];
            if ((a == NEAR && b == NEAR) || !(a & u) || !(b & v)) continue;
            const imp_region part = part_in(w, rest, a, b);
            status = include_patch(w, &part, a, b, g);
            if (status == IMP_OK) add_part(region, &part, g, whole);
        }
    return status;
}

static imp_status include_rings(const quad *q, walk *w, const imp_region *region, int u, int v,
                                imp_model model[3])
{
    const int last = w->level + RINGS < q->gauge->depth ? w->level + RINGS : q->gauge->depth;
    imp_region rest = *region;
    imp_status status = pieces_sample(quad_eval, q, region, model);
    for (int i = 0; i < 3; ++i) pieces_begin(&model[i]);
    while (status == IMP_OK) {
        status = add_quarters(w, region, &rest, u, v, model);
        if (status != IMP_OK || !(u & NEAR) || !(v & NEAR)) break;
        rest = part_in(w, &rest, NEAR, NEAR);
        if (w->level >= last) {
            imp_model g[3];
            include_square(q, w, &rest, g);
            add_part(region, &rest, g, model);
            break;
        }
        walk_step(w);
        u = quarters(w, rest.lo[0], rest.hi[0]), v = quarters(w, rest.lo[1], rest.hi[1]);
    }
    for (int i = 0; i < 3 && status == IMP_OK; ++i) model[i] = pieces_end(&model[i]);
    return status;
}

imp_status quad_include(const quad *q, const imp_region *region, imp_model model[3])
{
    walk w;
    int u = NEAR, v = NEAR;
    const imp_status status = patch_region_status(region);
    if (status != IMP_OK) {
        for (int i = 0; i < 3; ++i) model[i] = imp_unbounded(7);
        return status;
    }
    walk_begin(q, &w);
    if (q->gauge == NULL) return include_patch(&w, region, u, v, model);
    if (!walk_to(q, region, &w, &u, &v)) {
        include_square(q, &w, region, model);
        return IMP_OK;
    }
    if (is_one(u, v)) return include_patch(&w, region, u, v, model);
    return include_rings(q, &w, region, u, v, model);
}

imp_status quad_net(const quad *q, const imp_region *region, imp_net *net)
{
    walk w;
    spline_data data;
    int u = NEAR, v = NEAR;
    const imp_status status = patch_region_status(region);
    if (status != IMP_OK) return status;
    walk_begin(q, &w);
    if (q->gauge != NULL && (!walk_to(q, region, &w, &u, &v) || !is_one(u, v))) return IMP_UNBOUNDED;
    const imp_region local = region_in_patch(&w, region, u, v);
    take_patch(&w, u, v, &data);
    return spline_net(&data, &local, net);
}
