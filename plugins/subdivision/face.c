/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/face.h"

#include "plugins/subdivision/quarter.h"

/* Levels of rings that a region may reach into beside the first before the rest counts as a box. */
enum { RINGS = 4 };

/* --- Points ----------------------------------------------------------------------------------- */

static bool has_point(const double *p)
{
    return p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1 && fabs(p[2]) <= PATCH_LATE;
}

/* The corner (0,0); of a triangle all of u = 0. */
static bool is_corner(const walk *w, const double p[3])
{
    return p[0] == 0 && (p[1] == 0 || w->points.is_loop);
}

/* A point of the last square, where the surface is within `most` of the limit; the limit point
 * itself at the corner. Two sums and a product are rounded. */
static void point_of_limit(const walk *w, const double p[3], double x[3], double error[3])
{
    const bool is_limit = is_corner(w, p);
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

static void point_at(const face *q, walk *w, const double p[3], double x[3], double error[3])
{
    int u = NEAR, v = NEAR;
    walk_again(w);
    if (q->gauge != NULL) {
        const bool is_limit = is_corner(w, p);
        while (u == NEAR && v == NEAR && !is_limit && w->level < q->gauge->depth) {
            walk_step(w);
            u = walk_parts(w, 0, p[0], p[0]), v = walk_parts(w, 1, p[1], p[1]);
        }
        if (u == NEAR && v == NEAR) {
            point_of_limit(w, p, x, error);
            return;
        }
    }
    quarter_of(q->mesh)->point(w, u, v, p, x, error);
}

imp_status face_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const face *q = self;
    double unwanted[3];
    walk w;
    walk_begin(q, &w);
    for (size_t k = 0; k < n; ++k) {
        if (!has_point(p + 3 * k)) return IMP_STATUS_DOMAIN;
        point_at(q, &w, p + 3 * k, x + 3 * k, error != NULL ? error + 3 * k : unwanted);
    }
    return IMP_STATUS_OK;
}

/* --- Regions ---------------------------------------------------------------------------------- */

/* Steps to the first level of which the region reaches into more than the corner's quarter. False:
 * it is inside the last square. */
static bool walk_to(const face *q, const imp_region *region, walk *w, int *u, int *v)
{
    *u = *v = NEAR;
    while (*u == NEAR && *v == NEAR && w->level < q->gauge->depth) {
        walk_step(w);
        *u = walk_parts(w, 0, region->lo[0], region->hi[0]);
        *v = walk_parts(w, 1, region->lo[1], region->hi[1]);
    }
    return *u != NEAR || *v != NEAR;
}

/* The box of the control points, at any time t = c + d s of the region: |f - (place + t drift)| <=
 * most + |t| most of the velocities. Six roundings at most are of numbers no greater than `far`.
 * Points of this and all finer levels lie there, but p + q - r beyond a border: differences are at
 * most 6 times as large, and |df/dv| of a triangle twice these (gauge.c). */
static void include_square(const face *q, const walk *w, const imp_region *region,
                           imp_model model[3])
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
        if (n->is_loop)
            g->rate[1] = imp_smaller(
                g->rate[1], 12 * (n->most[i] + n->slip[i] + late * speed) * SLACK + IMP_TINY);
        g->rate[2] = moves ? (fabs(drift) + speed) * SLACK : 0;
        g->depends = moves ? 7 : 3;
    }
}

/* The parts but the corner's. */
static imp_status add_quarters(const walk *w, const imp_region *region, const imp_region *rest,
                               int u, int v, imp_model whole[3])
{
    imp_status status = IMP_STATUS_OK;
    for (int a = NEAR; a <= FAR; ++a)
        for (int b = NEAR; b <= FAR && status == IMP_STATUS_OK; ++b) {
            if ((a == NEAR && b == NEAR) || !(a & u) || !(b & v)) continue;
            const imp_region part = walk_part(w, rest, a, b);
            status = quarter_of(w->mesh)->add(w, region, &part, a, b, whole);
        }
    return status;
}

static imp_status include_rings(const face *q, walk *w, const imp_region *region, int u, int v,
                                imp_model model[3])
{
    const int last = w->level + RINGS < q->gauge->depth ? w->level + RINGS : q->gauge->depth;
    imp_region rest = *region;
    imp_status status = pieces_sample(face_eval, q, region, model);
    for (int i = 0; i < 3; ++i) pieces_begin(&model[i]);
    while (status == IMP_STATUS_OK) {
        status = add_quarters(w, region, &rest, u, v, model);
        if (status != IMP_STATUS_OK || !(u & NEAR) || !(v & NEAR)) break;
        rest = walk_part(w, &rest, NEAR, NEAR);
        if (w->level >= last) {
            imp_model g[3];
            include_square(q, w, &rest, g);
            quarter_add_model(region, &rest, g, model);
            break;
        }
        walk_step(w);
        u = walk_parts(w, 0, rest.lo[0], rest.hi[0]), v = walk_parts(w, 1, rest.lo[1], rest.hi[1]);
    }
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i) model[i] = pieces_end(&model[i]);
    return status;
}

imp_status face_include(const face *q, const imp_region *region, imp_model model[3])
{
    walk w;
    int u = NEAR, v = NEAR;
    const imp_status status = patch_region_status(region);
    if (status != IMP_STATUS_OK) {
        for (int i = 0; i < 3; ++i) model[i] = imp_unbounded(7);
        return status;
    }
    walk_begin(q, &w);
    if (q->gauge != NULL && !walk_to(q, region, &w, &u, &v)) {
        include_square(q, &w, region, model);
        return IMP_STATUS_OK;
    }
    const quarter_type *quarter = quarter_of(q->mesh);
    if (quarter->is_one(&w, region, u, v)) return quarter->include(&w, region, u, v, model);
    return include_rings(q, &w, region, u, v, model);
}

imp_status face_net(const face *q, const imp_region *region, imp_net *net)
{
    walk w;
    int u = NEAR, v = NEAR;
    const imp_status status = patch_region_status(region);
    if (status != IMP_STATUS_OK) return status;
    walk_begin(q, &w);
    if (q->gauge != NULL && !walk_to(q, region, &w, &u, &v)) return IMP_STATUS_UNBOUNDED;
    return quarter_of(q->mesh)->net(&w, region, u, v, net);
}
