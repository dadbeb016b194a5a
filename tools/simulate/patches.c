/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/patches.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/scene_info.h"

#define COORDINATE_MAX 1e50 /* so that fifth powers do not overflow */

/* 0 and 1 are met exactly. */
static double between(double from, double to, int k, int n)
{
    return k == n ? to : from + (to - from) * k / n;
}

shape_verdict patch_line(const patches *p, size_t index, const double from[2], const double to[2],
                         int n, vec *x, imp_error *why)
{
    double at[3 * PATCH_POINTS_MAX] = {0}, found[3 * PATCH_POINTS_MAX];
    for (int k = 0; k < n; ++k) {
        at[3 * k] = between(from[0], to[0], k, n - 1);
        at[3 * k + 1] = between(from[1], to[1], k, n - 1);
        at[3 * k + 2] = p->t;
    }
    const imp_code code =
        imp_piece_eval(p->scene, p->patch[index].place, (size_t)n, at, found, NULL, why);
    if (code != IMP_SUCCESS) return code == IMP_ERROR_MEMORY ? SHAPE_NO_MEMORY : SHAPE_FAULT;
    for (int k = 0; k < 3 * n; ++k)
        if (!(fabs(found[k]) <= COORDINATE_MAX)) return SHAPE_UNBOUNDED;
    for (int k = 0; k < n; ++k) x[k] = vec_of(found + 3 * k);
    return SHAPE_FOUND;
}

shape_verdict patch_grid(const patches *p, size_t index, int cells, vec *at, imp_error *why)
{
    const patch *one = &p->patch[index];
    for (int i = 0; i <= cells; ++i) {
        const double u = between(one->lo[0], one->hi[0], i, cells);
        const double from[2] = {u, one->lo[1]}, to[2] = {u, one->hi[1]};
        const shape_verdict verdict =
            patch_line(p, index, from, to, cells + 1, at + i * (cells + 1), why);
        if (verdict != SHAPE_FOUND) return verdict;
    }
    return SHAPE_FOUND;
}

static shape_verdict read_domain(patches *p, imp_place place)
{
    double lo[3], hi[3];
    imp_piece_domain(p->scene, place, lo, hi);
    patch *one = &p->patch[p->count++];
    one->place = place;
    memcpy(one->lo, lo, sizeof one->lo);
    memcpy(one->hi, hi, sizeof one->hi);
    for (int k = 0; k < 2; ++k)
        if (!(hi[k] - lo[k] < INFINITY)) return SHAPE_UNBOUNDED;
    return SHAPE_FOUND;
}

/* Takes a few points of each patch into the box whose diagonal is the size. */
static shape_verdict measure(patches *p, imp_error *why)
{
    enum { ROWS = 5 };
    vec_box box = vec_box_empty();
    for (size_t i = 0; i < p->count; ++i) {
        if (limits_reached(p->limits) != IMP_REASON_NONE) return SHAPE_STOPPED;
        const patch *one = &p->patch[i];
        for (int k = 0; k < ROWS; ++k) {
            const double v = between(one->lo[1], one->hi[1], k, ROWS - 1);
            const double from[2] = {one->lo[0], v}, to[2] = {one->hi[0], v};
            vec x[ROWS];
            const shape_verdict verdict = patch_line(p, i, from, to, ROWS, x, why);
            if (verdict != SHAPE_FOUND) return verdict;
            for (int j = 0; j < ROWS; ++j) vec_box_add(&box, x[j]);
        }
    }
    p->size = vec_length(vec_sub(box.hi, box.lo));
    return p->count > 0 && p->size > 0 ? SHAPE_FOUND : SHAPE_FLAT;
}

shape_verdict patches_read(patches *p, const imp_scene *scene, size_t body, double t,
                           const limits *end, imp_error *why)
{
    *p = (patches){.scene = scene, .t = t, .limits = end};
    p->patch = calloc(scene_info_pieces(scene, body) + 1, sizeof *p->patch);
    if (p->patch == NULL) return SHAPE_NO_MEMORY;
    for (size_t s = 0; s < imp_scene_surface_count(scene, body); ++s)
        for (size_t k = 0; k < imp_scene_piece_count(scene, body, s); ++k) {
            const shape_verdict verdict = read_domain(p, (imp_place){body, s, k});
            if (verdict != SHAPE_FOUND) return verdict;
        }
    return measure(p, why);
}

void patches_free(patches *p)
{
    free(p->patch);
    *p = (patches){0};
}
