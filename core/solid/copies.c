/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/copies.h"

#include <math.h>
#include <stdlib.h>

/* --- Is a point on a patch? ------------------------------------------------------------------- */

static double distance(vec3 a, vec3 b) { return vec3_norm(vec3_sub(a, b)); }

/* Points in rows over a patch, from which the search for the nearest one begins. */
enum { ROWS = 5, STARTS = ROWS * ROWS, STEPS = 30 };

static bool start_near(const patch *p, double t, vec3 x, double uv[2])
{
    double at[STARTS][2];
    vec3 y[STARTS];
    int best = 0;
    for (int k = 0; k < STARTS; ++k) {
        at[k][0] = patch_between(p->lo[0], p->hi[0], k / ROWS, ROWS - 1);
        at[k][1] = patch_between(p->lo[1], p->hi[1], k % ROWS, ROWS - 1);
    }
    if (patch_eval(p, t, STARTS, (const double(*)[2])at, y, NULL, NULL) != IMP_SUCCESS)
        return false;
    for (int k = 1; k < STARTS; ++k)
        if (distance(y[k], x) < distance(y[best], x)) best = k;
    for (int i = 0; i < 2; ++i) uv[i] = at[best][i];
    return true;
}

/* Takes a step of Gauss and Newton from uv towards the point of the patch nearest to x: y are the
 * points at uv and at uv + h along u and along v. False: the tangents are parallel. */
static bool step(const patch *p, vec3 x, const vec3 y[3], const double h[2], double uv[2])
{
    const vec3 du = vec3_scale(vec3_sub(y[1], y[0]), 1 / h[0]);
    const vec3 dv = vec3_scale(vec3_sub(y[2], y[0]), 1 / h[1]), off = vec3_sub(x, y[0]);
    const double uu = vec3_dot(du, du), vv = vec3_dot(dv, dv), both = vec3_dot(du, dv);
    const double det = uu * vv - both * both, a = vec3_dot(du, off), b = vec3_dot(dv, off);
    if (!(det > 1e-12 * uu * vv)) return false;
    uv[0] = fmin(fmax(uv[0] + (vv * a - both * b) / det, p->lo[0]), p->hi[0]);
    uv[1] = fmin(fmax(uv[1] + (uu * b - both * a) / det, p->lo[1]), p->hi[1]);
    return true;
}

static bool lies_on(const patch *p, double t, vec3 x, double slack)
{
    const double small = 1e-6; /* part of the domain: a difference quotient's step */
    double uv[2];
    if (!start_near(p, t, x, uv)) return false;
    for (int k = 0; k < STEPS; ++k) {
        double at[3][2], h[2];
        vec3 y[3];
        for (int i = 0; i < 2; ++i) {
            const double width = p->hi[i] - p->lo[i];
            h[i] = uv[i] + small * width <= p->hi[i] ? small * width : -small * width;
            for (int n = 0; n < 3; ++n) at[n][i] = uv[i] + (n == i + 1 ? h[i] : 0);
        }
        if (patch_eval(p, t, 3, (const double(*)[2])at, y, NULL, NULL) != IMP_SUCCESS) return false;
        if (distance(y[0], x) <= slack) return true;
        if (!step(p, x, y, h, uv)) return false;
    }
    return false;
}

/* --- Are two patches the same? ---------------------------------------------------------------- */

/* Returns whether each edge of patch p but points is one of q, too, and q has no more of them. */
static bool share_edges(const edges *e, size_t p, size_t q)
{
    int lines = 0;
    for (size_t i = 4 * p; i < 4 * p + 4; ++i) {
        bool found = edge_is_point(e, i);
        lines += found ? 0 : 1;
        for (size_t j = 4 * q; j < 4 * q + 4 && !found; ++j)
            found = !edge_is_point(e, j) && edge_compare(e, i, j) != 0;
        if (!found) return false;
    }
    for (size_t j = 4 * q; j < 4 * q + 4; ++j) lines -= edge_is_point(e, j) ? 0 : 1;
    return lines == 0;
}

static bool are_same(const edges *e, size_t p, size_t q)
{
    enum { INNER = 3 };
    const patch *one = &e->patches->patch[p];
    double uv[INNER * INNER][2];
    vec3 x[INNER * INNER];
    if (!share_edges(e, p, q)) return false;
    for (int k = 0; k < INNER * INNER; ++k) {
        uv[k][0] = patch_between(one->lo[0], one->hi[0], k / INNER + 1, INNER + 1);
        uv[k][1] = patch_between(one->lo[1], one->hi[1], k % INNER + 1, INNER + 1);
    }
    if (patch_eval(one, e->patches->t, INNER * INNER, (const double(*)[2])uv, x, NULL, NULL) !=
        IMP_SUCCESS)
        return false;
    for (int k = 0; k < INNER * INNER; ++k)
        if (!lies_on(&e->patches->patch[q], e->patches->t, x[k], e->slack)) return false;
    return true;
}

/* --- All -------------------------------------------------------------------------------------- */

/* A patch, and how far the mean of its edges' points is along a direction in which few patches are
 * level. Points within slack of each other have means within sqrt(3) slack. */
typedef struct mark {
    double height;
    size_t index;
} mark;

static double height_of(const edges *e, size_t p)
{
    const vec3 along = vec3_from((const double[3]){0.5773, 0.2115, 0.7887});
    double sum = 0;
    int count = 0;
    for (size_t i = 4 * p; i < 4 * p + 4; ++i)
        for (int k = 0; k <= e->steps; ++k) {
            if (edge_is_point(e, i)) break;
            sum += vec3_dot(vec3_sub(edge_points(e, i)[k], e->at[0]), along);
            count += 1;
        }
    return count > 0 ? sum / count : vec3_dot(vec3_sub(edge_points(e, 4 * p)[0], e->at[0]), along);
}

static int order_marks(const void *a, const void *b)
{
    const mark *x = a, *y = b;
    if (x->height != y->height) return x->height < y->height ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

bool copies_find(const edges *e, size_t *one)
{
    const size_t count = e->patches->count;
    mark *marks = malloc((count + 1) * sizeof *marks);
    if (marks == NULL) return false;
    for (size_t i = 0; i < count; ++i) marks[i] = (mark){height_of(e, i), i}, one[i] = i;
    qsort(marks, count, sizeof *marks, order_marks);
    for (size_t n = 0; n < count; ++n) {
        const size_t i = marks[n].index;
        for (size_t k = n; k-- > 0 && marks[n].height - marks[k].height <= 2 * e->slack;) {
            const size_t j = marks[k].index;
            if (one[j] != j || !are_same(e, i, j)) continue;
            one[i] = j;
            break;
        }
    }
    free(marks);
    return true;
}
