/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/touch.h"

#include <stdlib.h>
#include <string.h>

#include "tools/simulate/drift.h"
#include "tools/simulate/footprint.h"

/* --- The nearest points ----------------------------------------------------------------------- */

/* Patches of one body near a point, and their points nearest to it. */
enum { AROUND_MAX = 8 };
typedef struct around {
    imp_place place[AROUND_MAX];
    double p[AROUND_MAX][2];
    size_t count;
} around;

static bool is_near(const vec_box *box, vec x, double distance)
{
    for (int i = 0; i < 3; ++i)
        if (x.x[i] < box->lo.x[i] - distance || x.x[i] > box->hi.x[i] + distance) return false;
    return true;
}

/* The middle of a grid over the patch that is nearest to x, to start from. */
static imp_code start_on(const chart *c, vec x, double p[2], imp_error *why)
{
    enum { CELLS = 8 };
    double least = INFINITY;
    for (int i = 0; i <= CELLS; ++i) {
        double uv[CELLS + 1][2];
        vec y[CELLS + 1];
        for (int j = 0; j <= CELLS; ++j) {
            uv[j][0] = c->lo[0] + (c->hi[0] - c->lo[0]) * i / CELLS;
            uv[j][1] = c->lo[1] + (c->hi[1] - c->lo[1]) * j / CELLS;
        }
        const imp_code code =
            placed_eval(c->at, c->place, CELLS + 1, (const double(*)[2])uv, y, why);
        if (code != IMP_SUCCESS) return code;
        for (int j = 0; j <= CELLS; ++j)
            if (vec_length(vec_sub(y[j], x)) < least) {
                least = vec_length(vec_sub(y[j], x));
                memcpy(p, uv[j], sizeof uv[j]);
            }
    }
    return IMP_SUCCESS;
}

/* Finds the patch of the witness, and others of the body that come as near to x as `distance`. */
static imp_code look_around(const placed *at, const outline *o, imp_place own, const double p[2],
                            vec x, double distance, around *out, imp_error *why)
{
    *out = (around){.place = {own}, .p = {{p[0], p[1]}}, .count = 1};
    const vec inner = placed_inward(at, x);
    for (size_t i = 0; i < o->count && out->count < AROUND_MAX; ++i) {
        const outline_patch *patch = &o->patch[i];
        double uv[2];
        vec found;
        chart c;
        if (outline_is_at(patch, own) || !is_near(&patch->box, inner, distance)) continue;
        imp_code code = chart_make(&c, at, patch->place, why);
        if (code == IMP_SUCCESS) code = start_on(&c, x, uv, why);
        if (code == IMP_SUCCESS) code = closest_project(&c, uv, x, &found, why);
        if (code != IMP_SUCCESS) return code;
        if (!(vec_length(vec_sub(found, x)) <= distance)) continue;
        out->place[out->count] = patch->place;
        memcpy(out->p[out->count++], uv, sizeof uv);
    }
    return IMP_SUCCESS;
}

/* Finds the nearest points of all patches around the witness. */
static imp_code find_nearest(const touch_pair *pair, const witness *from, closest *out,
                             imp_error *why)
{
    around side[2];
    imp_code code = closest_find(out, pair->at, from->place, from->p, why);
    const vec middle = vec_scale(0.5, vec_add(out->jet[0].x, out->jet[1].x));
    const double distance = closest_gap(out) / 2 + pair->slack;
    for (int k = 0; k < 2 && code == IMP_SUCCESS; ++k)
        code = look_around(&pair->at[k], pair->outline[k], from->place[k], out->spot[k].p, middle,
                           distance, &side[k], why);
    if (code != IMP_SUCCESS) return code;
    for (size_t n = 1; n < side[0].count * side[1].count; ++n) {
        const size_t i = n / side[1].count, j = n % side[1].count;
        const imp_place place[2] = {side[0].place[i], side[1].place[j]};
        const double p[2][2] = {{side[0].p[i][0], side[0].p[i][1]},
                                {side[1].p[j][0], side[1].p[j][1]}};
        closest other;
        code = closest_find(&other, pair->at, place, p, why);
        if (code != IMP_SUCCESS) return code;
        if (closest_gap(&other) < closest_gap(out)) *out = other;
    }
    return IMP_SUCCESS;
}

/* --- The manifold ----------------------------------------------------------------------------- */

/* So much of the slack, to all sides, points and segments are taken for polygons. */
#define THICKNESS 0.0025

/* Returns the common part of each pair of parts. */
static point2 *intersect(const footprint *a, const footprint *b, double thick, size_t *count)
{
    *count = 0;
    point2 *all = malloc((a->count * b->count * POLYGON_MAX + 1) * sizeof *all);
    for (size_t i = 0; all != NULL && i < a->count; ++i) {
        const polygon wide = polygon_grow(&a->part[i], thick);
        for (size_t j = 0; j < b->count; ++j) {
            const polygon other = polygon_grow(&b->part[j], thick);
            const polygon common = polygon_intersect(&wide, &other);
            memcpy(all + *count, common.at, common.count * sizeof *all);
            *count += common.count;
        }
    }
    return all;
}

/* One part: the hull of all. */
static bool merge(footprint *f)
{
    point2 *all = malloc((f->count * POLYGON_MAX + 1) * sizeof *all);
    size_t count = 0;
    if (all == NULL) return false;
    for (size_t i = 0; i < f->count; ++i) {
        memcpy(all + count, f->part[i].at, f->part[i].count * sizeof *all);
        count += f->part[i].count;
    }
    f->part[0] = polygon_hull(all, count);
    f->count = 1;
    free(all);
    return true;
}

static imp_code find_corners(footprint f[2], const contact_plane *plane, touching *out)
{
    enum { PAIRS_MAX = 4096 };
    size_t count;
    for (int k = 0; k < 2; ++k)
        if (f[0].count * f[1].count > PAIRS_MAX && !merge(&f[k])) return IMP_ERROR_MEMORY;
    point2 *common = intersect(&f[0], &f[1], THICKNESS * plane->slack, &count);
    if (common == NULL) return IMP_ERROR_MEMORY;
    polygon p = polygon_hull(common, count);
    free(common);
    polygon_simplify(&p, plane->slack);
    polygon_reduce(&p, CONTACT_POINTS);
    out->count = p.count;
    for (size_t i = 0; i < p.count; ++i) out->corner[i] = plane_outward(plane, p.at[i]);
    if (p.count > 1) return IMP_SUCCESS;
    out->count = 1;
    out->corner[0] = out->point;
    return IMP_SUCCESS;
}

static imp_code find_manifold(const touch_pair *pair, const closest *n, touching *out,
                              imp_error *why)
{
    footprint f[2] = {{0}, {0}};
    imp_code code = IMP_SUCCESS;
    contact_plane plane = {.normal = out->normal, .slack = pair->slack};
    plane.tangent[0] = vec_normal_to(plane.normal);
    plane.tangent[1] = vec_cross(plane.normal, plane.tangent[0]);
    for (int k = 0; k < 2 && code == IMP_SUCCESS; ++k) {
        const placed *other = &pair->at[1 - k];
        const vec middle = other->moves ? other->position : out->point;
        const double reach =
            other->moves ? outline_reach(pair->outline[1 - k], other->center) : INFINITY;
        point2 own;
        plane.origin = n->jet[k].x;
        own = plane_inward(&plane, out->point);
        if (!footprint_add(&f[k], &own, 1)) code = IMP_ERROR_MEMORY;
        const bool round = closest_is_round(n, k, plane.slack);
        if (code == IMP_SUCCESS)
            code = footprint_find(&f[k], &pair->at[k], pair->outline[k], &plane, k == 0 ? 1 : -1,
                                  middle, reach, round ? &n->chart[k].place : NULL, why);
    }
    plane.origin = out->point;
    if (code == IMP_SUCCESS) code = find_corners(f, &plane, out);
    for (int k = 0; k < 2; ++k) footprint_free(&f[k]);
    return code;
}

/* --- All -------------------------------------------------------------------------------------- */

imp_code touching_find(const touch_pair *pair, const witness *from, touching *out, imp_error *why)
{
    closest n;
    drift d[2];
    imp_code code = find_nearest(pair, from, &n, why);
    if (code != IMP_SUCCESS) return code;
    *out = (touching){.point = vec_scale(0.5, vec_add(n.jet[0].x, n.jet[1].x)),
                      .normal = closest_normal(&n),
                      .gap = closest_gap(&n)};
    for (int k = 0; k < 2; ++k) {
        out->nearest.place[k] = n.chart[k].place;
        memcpy(out->nearest.p[k], n.spot[k].p, sizeof n.spot[k].p);
        code = drift_find(pair->setup, &n, k, pair->t, &d[k], why);
        if (code != IMP_SUCCESS) return code;
    }
    code = find_manifold(pair, &n, out, why);
    for (size_t i = 0; i < out->count; ++i)
        out->drift[i] = vec_sub(drift_at(&d[1], out->corner[i]), drift_at(&d[0], out->corner[i]));
    return code;
}
