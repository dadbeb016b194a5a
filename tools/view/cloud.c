/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/cloud.h"

#include <stdlib.h>

#include "core/common/array.h"

void cloud_free(cloud *c)
{
    free(c->point);
    *c = (cloud){.point = NULL};
}

/* --- Points that lie far out ------------------------------------------------------------------ */

enum { DIRECTIONS = 128 };

/* Returns direction k of a set that is spread evenly over the sphere, along a spiral with steps of
 * the golden angle. */
static vec direction_of(size_t k)
{
    const double height = 1 - (2 * (double)k + 1) / DIRECTIONS,
                 turn = 2.399963229728653 * (double)k;
    const double radius = sqrt(1 - height * height);
    return (vec){{radius * cos(turn), radius * sin(turn), height}};
}

static bool add_point(cloud *c, vec p)
{
    vec *grown = array_reserve(c->point, c->count, &c->room, sizeof *grown);
    if (grown == NULL) return false;
    c->point = grown;
    c->point[c->count++] = p;
    return true;
}

static imp_code add_farthest(cloud *c, const vec *point, size_t count, allowance *l,
                             imp_error *error)
{
    for (size_t k = 0; k < DIRECTIONS; ++k) {
        const imp_code code = allowance_check(l, "the view was chosen", error);
        if (code != IMP_SUCCESS) return code;
        const vec direction = direction_of(k);
        size_t best = 0;
        for (size_t i = 1; i < count; ++i)
            if (vec_dot(direction, point[i]) > vec_dot(direction, point[best])) best = i;
        if (count > 0 && !add_point(c, point[best])) return mesh_no_memory(error);
    }
    return IMP_SUCCESS;
}

static imp_code add_points(cloud *c, const vec *point, size_t count, allowance *l, imp_error *error)
{
    for (size_t i = 0; i < count; ++i) vec_box_add(&c->box, point[i]);
    if (count > DIRECTIONS) return add_farthest(c, point, count, l, error);
    for (size_t i = 0; i < count; ++i)
        if (!add_point(c, point[i])) return mesh_no_memory(error);
    return IMP_SUCCESS;
}

/* --- Coarse grids ----------------------------------------------------------------------------- */

/* Points along a side: enough for the size of curved pieces; corners and middle if there are
 * many. */
enum { COARSE = 9, COARSE_OF_MANY = 3, MANY = 100 };

imp_code cloud_add(cloud *c, const imp_scene *scene, size_t body, size_t surface,
                   const double *moments, size_t count, allowance *l, imp_error *error)
{
    const size_t many = imp_scene_piece_count(scene, body, surface) > MANY;
    const size_t side = many ? COARSE_OF_MANY : COARSE;
    const mesh_plan plan = {.times = moments,
                            .time_count = count,
                            .tolerance = INFINITY,
                            .lines = side - 1,
                            .focus_radius = INFINITY,
                            .allowance = l};
    mesh m;
    if (c->count == 0) c->box = vec_box_empty();
    imp_code code = mesh_make(scene, body, surface, &plan, &m, error);
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k) {
        if (!mesh_exists(scene, &m, moments[k])) continue;
        code = mesh_move(scene, &m, moments[k], l, error);
        if (code == IMP_SUCCESS) code = add_points(c, m.point, m.point_count, l, error);
    }
    mesh_free(&m);
    return code;
}
