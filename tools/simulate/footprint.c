/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/footprint.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

/* --- The plane -------------------------------------------------------------------------------- */

static double height_of(const contact_plane *plane, vec x)
{
    return vec_dot(plane->normal, vec_sub(x, plane->origin));
}

point2 plane_inward(const contact_plane *plane, vec x)
{
    const vec d = vec_sub(x, plane->origin);
    return (point2){{vec_dot(d, plane->tangent[0]), vec_dot(d, plane->tangent[1])}};
}

vec plane_outward(const contact_plane *plane, point2 x)
{
    const vec along = vec_along(plane->origin, x.x[0], plane->tangent[0]);
    return vec_along(along, x.x[1], plane->tangent[1]);
}

/* --- Which patches ---------------------------------------------------------------------------- */

/* Computes the least and greatest of n.x over a box. */
static void range_along(const vec_box *box, vec n, double *lo, double *hi)
{
    *lo = *hi = 0;
    for (int i = 0; i < 3; ++i) {
        const double a = n.x[i] * box->lo.x[i], b = n.x[i] * box->hi.x[i];
        *lo += n.x[i] == 0 ? 0 : fmin(a, b);
        *hi += n.x[i] == 0 ? 0 : fmax(a, b);
    }
}

static bool may_stand(const placed *at, const outline_patch *p, const contact_plane *plane,
                      vec middle, double reach)
{
    double lo, hi;
    const vec origin = placed_inward(at, plane->origin), x = placed_inward(at, middle);
    const vec n = at->moves ? mat3_apply_transposed(&at->turn, plane->normal) : plane->normal;
    range_along(&p->box, n, &lo, &hi);
    const double height = vec_dot(n, origin), slack = 2 * plane->slack;
    if (lo > height + slack || hi < height - slack) return false;
    for (int i = 0; i < 3; ++i)
        if (x.x[i] < p->box.lo.x[i] - reach || x.x[i] > p->box.hi.x[i] + reach) return false;
    return true;
}

/* --- One patch -------------------------------------------------------------------------------- */

enum { CELLS_MAX = 16, ROW_MAX = CELLS_MAX + 1, FOUND_MAX = ROW_MAX * ROW_MAX };

typedef struct sampler {
    const placed *at;
    const contact_plane *plane;
    imp_place place;
    double side, lo[2], hi[2];
    int cells;
    vec grid[ROW_MAX * ROW_MAX];
    point2 found[FOUND_MAX];
    size_t count;
    imp_error *why;
} sampler;

/* Meshes of many triangles, which are flat, need their corners only. */
static int cells_for(size_t patches) { return patches <= 8 ? 16 : patches <= 64 ? 8 : 2; }

static double parameter(const sampler *s, int k, double number)
{
    return number >= s->cells ? s->hi[k] : s->lo[k] + (s->hi[k] - s->lo[k]) * number / s->cells;
}

static imp_code read_grid(sampler *s)
{
    const int row = s->cells + 1;
    for (int first = 0; first < row * row; first += PLACED_POINTS_MAX) {
        double uv[PLACED_POINTS_MAX][2];
        const int n = row * row - first < PLACED_POINTS_MAX ? row * row - first : PLACED_POINTS_MAX;
        for (int i = 0; i < n; ++i) {
            uv[i][0] = parameter(s, 0, (first + i) / row);
            uv[i][1] = parameter(s, 1, (first + i) % row);
        }
        const imp_code code = placed_eval(s->at, s->place, (size_t)n, (const double(*)[2])uv,
                                          s->grid + first, s->why);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

static void keep(sampler *s, vec x)
{
    if (!(fabs(height_of(s->plane, x)) <= s->plane->slack) || s->count == FOUND_MAX) return;
    s->found[s->count++] = plane_inward(s->plane, x);
}

/* Returns whether all points of the grid are in one plane. */
static bool is_flat(const sampler *s)
{
    const int n = (s->cells + 1) * (s->cells + 1);
    const vec a = s->grid[0];
    vec b = a, normal = {{0, 0, 0}};
    for (int i = 1; i < n; ++i)
        if (vec_length(vec_sub(s->grid[i], a)) > vec_length(vec_sub(b, a))) b = s->grid[i];
    for (int i = 1; i < n; ++i) {
        const vec one = vec_cross(vec_sub(b, a), vec_sub(s->grid[i], a));
        if (vec_length(one) > vec_length(normal)) normal = one;
    }
    const vec unit = vec_unit(normal);
    const double most = 1e-9 * vec_length(vec_sub(b, a));
    for (int i = 1; i < n; ++i)
        if (!(fabs(vec_dot(unit, vec_sub(s->grid[i], a))) <= most)) return false;
    return true;
}

/* Computes the point farthest towards the plane near number j of a row of parameter k, at number i
 * of the other one, by golden section. */
static imp_code refine(const sampler *s, int k, double i, int j, vec *best)
{
    const double ratio = 0.6180339887498949;
    double a = j > 0 ? j - 1 : 0, b = j < s->cells ? j + 1 : s->cells, most = -INFINITY;
    for (int n = 0; n < 30; ++n) {
        const double number[2] = {b - ratio * (b - a), a + ratio * (b - a)};
        double uv[2][2], height[2];
        vec x[2];
        for (int m = 0; m < 2; ++m) {
            uv[m][k] = parameter(s, k, number[m]);
            uv[m][1 - k] = parameter(s, 1 - k, i);
        }
        const imp_code code = placed_eval(s->at, s->place, 2, (const double(*)[2])uv, x, s->why);
        if (code != IMP_SUCCESS) return code;
        for (int m = 0; m < 2; ++m) {
            height[m] = s->side * height_of(s->plane, x[m]);
            if (height[m] > most) most = height[m], *best = x[m];
        }
        if (height[0] > height[1])
            b = number[1];
        else
            a = number[0];
    }
    return IMP_SUCCESS;
}

/* Returns the number of the highest point of row i along parameter k. Of a closed row, whose ends
 * are one point, the end that goes on higher. */
static int highest(const sampler *s, int k, int i)
{
    double height[ROW_MAX];
    int best = 0;
    for (int j = 0; j <= s->cells; ++j) {
        const int at = k == 0 ? j * (s->cells + 1) + i : i * (s->cells + 1) + j;
        height[j] = s->side * height_of(s->plane, s->grid[at]);
        if (height[j] > height[best]) best = j;
    }
    const bool closed = best == 0 && height[s->cells] >= height[0] - 1e-3 * s->plane->slack;
    return closed && height[s->cells - 1] > height[1] ? s->cells : best;
}

/* The highest points of the rows along one parameter, and of rows halfway between two. */
typedef struct ridge {
    vec x[2 * ROW_MAX];
    double height[2 * ROW_MAX]; /* towards the plane; by twice the number of the row */
} ridge;

static imp_code ridge_find(const sampler *s, int k, int twice, ridge *r)
{
    const imp_code code = refine(s, k, 0.5 * twice, highest(s, k, twice / 2), &r->x[twice]);
    r->height[twice] = s->side * height_of(s->plane, r->x[twice]);
    return code;
}

/* Whether the ridge is straight from place i to place j, by this part of the slack. */
#define STRAIGHT (1.0 / 32)

static bool is_straight(const ridge *r, int i, int j, double slack)
{
    const int step = j > i ? 1 : -1;
    for (int n = i; n != j; n += step) {
        const double line = r->height[i] + (r->height[j] - r->height[i]) * (n - i) / (j - i);
        if (!(fabs(r->height[n] - line) <= STRAIGHT * slack)) return false;
    }
    return true;
}

/* Keeps the points of the ridge that are on a straight line with its highest, if that is in the
 * plane: it is where a cylinder touches, or a torus, while a sphere bends away. */
static imp_code keep_ridge(sampler *s, int k)
{
    ridge r;
    int top = 0;
    imp_code code = IMP_SUCCESS;
    for (int i = 0; i <= s->cells && code == IMP_SUCCESS; ++i) {
        code = ridge_find(s, k, 2 * i, &r);
        if (r.height[2 * i] > r.height[top]) top = 2 * i;
    }
    if (code != IMP_SUCCESS || !(fabs(r.height[top]) <= STRAIGHT * s->plane->slack)) return code;
    keep(s, r.x[top]);
    for (int way = -1; way <= 1; way += 2)
        for (int i = top + 2 * way; i >= 0 && i <= 2 * s->cells && code == IMP_SUCCESS;
             i += 2 * way) {
            code = ridge_find(s, k, i - way, &r);
            if (!is_straight(&r, top, i, s->plane->slack)) break;
            keep(s, r.x[i]);
        }
    return code;
}

static imp_code sample_patch(footprint *f, sampler *s)
{
    double lo[3], hi[3];
    imp_piece_domain(s->at->still, s->place, lo, hi);
    memcpy(s->lo, lo, sizeof s->lo);
    memcpy(s->hi, hi, sizeof s->hi);
    s->count = 0;
    imp_code code = read_grid(s);
    if (code != IMP_SUCCESS) return code;
    if (is_flat(s)) {
        for (int i = 0; i < (s->cells + 1) * (s->cells + 1); ++i) keep(s, s->grid[i]);
    } else {
        code = keep_ridge(s, 0);
        if (code == IMP_SUCCESS) code = keep_ridge(s, 1);
    }
    if (code != IMP_SUCCESS || s->count == 0) return code;
    return footprint_add(f, s->found, s->count) ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

/* --- All -------------------------------------------------------------------------------------- */

bool footprint_add(footprint *f, point2 *points, size_t count)
{
    polygon *grown = array_reserve(f->part, f->count, &f->capacity, sizeof *grown);
    if (grown == NULL) return false;
    f->part = grown;
    f->part[f->count++] = polygon_hull(points, count);
    return true;
}

void footprint_free(footprint *f) { free(f->part); }

imp_code footprint_find(footprint *f, const placed *at, const outline *o,
                        const contact_plane *plane, double side, vec middle, double reach,
                        const imp_place *but, imp_error *why)
{
    sampler *s = malloc(sizeof *s);
    imp_code code = s != NULL ? IMP_SUCCESS : IMP_ERROR_MEMORY;
    for (size_t i = 0; i < o->count && code == IMP_SUCCESS; ++i) {
        if (but != NULL && outline_is_at(&o->patch[i], *but)) continue;
        if (!may_stand(at, &o->patch[i], plane, middle, reach)) continue;
        *s = (sampler){.at = at, .plane = plane, .side = side, .why = why};
        s->place = o->patch[i].place;
        s->cells = cells_for(o->count);
        code = sample_patch(f, s);
    }
    free(s);
    return code;
}
