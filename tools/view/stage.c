/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/stage.h"

#include <stdlib.h>

vec stage_contact_point(const stage *s)
{
    return vec_scale(0.5, vec_add(s->contact.point[0], s->contact.point[1]));
}

double stage_size(const stage *s)
{
    const double size = vec_length(vec_sub(s->box.hi, s->box.lo));
    return size > 0 && size < INFINITY ? size : 1;
}

bool stage_is_there(const stage *s, const mesh *m) { return mesh_exists(s->scene, m, s->now); }

/* The pieces of all surfaces of a body are drawn one by one. */
static size_t pieces_of(const stage *s, size_t body)
{
    size_t count = 0;
    for (size_t k = 0; k < imp_scene_surface_count(s->scene, body); ++k)
        count += imp_scene_piece_count(s->scene, body, k);
    return count;
}

static size_t surfaces_of(const stage *s)
{
    size_t count = 0;
    for (size_t b = 0; b < s->body_count; ++b) count += pieces_of(s, b);
    return count;
}

/* The place after another; false: there is none. */
static bool next_place(const stage *s, imp_place *at)
{
    at->piece += 1;
    while (at->body < s->body_count) {
        if (at->piece < imp_scene_piece_count(s->scene, at->body, at->surface)) return true;
        at->piece = 0;
        if (++at->surface < imp_scene_surface_count(s->scene, at->body)) return true;
        at->surface = 0;
        if (++at->body < s->body_count && imp_scene_surface_count(s->scene, at->body) > 0) return true;
    }
    return false;
}

/* Marked lines: some 16 across a body of one surface, fewer across each of many. */
static size_t lines_across(const stage *s, size_t body)
{
    const double n = 16 / sqrt((double)pieces_of(s, body));
    return n < 2 ? 2 : (size_t)n;
}

/* Coarse meshes, to see how large things are: points along a side, fewer where there are many. */
enum { COARSE = 9, COARSE_OF_MANY = 3, MANY = 1000 };

static size_t coarse_of(size_t surfaces) { return surfaces < MANY ? COARSE : COARSE_OF_MANY; }

static imp_code measure_surface(stage *s, imp_place at, size_t coarse, imp_error *error)
{
    const mesh_plan plan = {.tolerance = INFINITY,
                            .lines = coarse - 1,
                            .max_cells = coarse * coarse,
                            .focus_radius = INFINITY};
    mesh m;
    imp_code code = mesh_make(s->scene, at, &plan, &m, error);
    for (size_t k = 0; k < s->moment_count && code == IMP_SUCCESS; ++k) {
        if (!mesh_exists(s->scene, &m, s->moments[k])) continue;
        code = mesh_move(s->scene, &m, s->moments[k], error);
        for (size_t i = 0; i < m.nu * m.nv && code == IMP_SUCCESS; ++i) {
            vec_box_add(&s->box, m.point[i]);
            s->cloud[s->cloud_count++] = m.point[i];
        }
    }
    mesh_free(&m);
    return code;
}

static imp_code measure(stage *s, imp_error *error)
{
    const size_t coarse = coarse_of(surfaces_of(s));
    const size_t most = surfaces_of(s) * s->moment_count * coarse * coarse;
    s->box = vec_box_empty();
    s->cloud = calloc(most + 1, sizeof *s->cloud);
    if (s->cloud == NULL) return mesh_no_memory(error);
    for (imp_place at = {0, 0, SIZE_MAX}; next_place(s, &at);) {
        const imp_code code = measure_surface(s, at, coarse, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

imp_code stage_make(stage *s, const stage_detail *detail, imp_error *error)
{
    const size_t surfaces = surfaces_of(s);
    imp_code code = measure(s, error);
    if (code != IMP_SUCCESS) return code;
    s->meshes = calloc(surfaces + 1, sizeof *s->meshes);
    if (s->meshes == NULL) return mesh_no_memory(error);
    mesh_plan plan = {.times = s->moments,
                      .time_count = s->moment_count,
                      .tolerance = detail->tolerance > 0 ? detail->tolerance : stage_size(s) / 2000,
                      .max_cells = detail->max_cells / (surfaces + 1) + 512,
                      .focus_radius = detail->focus_radius};
    if (detail->focus_radius < INFINITY) plan.focus = stage_contact_point(s);
    size_t body = SIZE_MAX;
    for (imp_place at = {0, 0, SIZE_MAX}; next_place(s, &at);) {
        if (at.body != body) plan.lines = lines_across(s, at.body);
        body = at.body;
        code = mesh_make(s->scene, at, &plan, &s->meshes[s->count++], error);
        if (code != IMP_SUCCESS) return code;
    }
    return code;
}

void stage_free(stage *s)
{
    for (size_t k = 0; k < s->count; ++k) mesh_free(&s->meshes[k]);
    free(s->meshes);
    free(s->cloud);
    free(s->moments);
    *s = (stage){0};
}

imp_code stage_move(stage *s, double t, imp_error *error)
{
    s->now = t;
    for (size_t k = 0; k < s->count; ++k) {
        double upper = 0;
        if (!stage_is_there(s, &s->meshes[k])) continue;
        imp_code code = mesh_move(s->scene, &s->meshes[k], t, error);
        if (code == IMP_SUCCESS) code = mesh_error(s->scene, &s->meshes[k], t, &upper, error);
        if (code != IMP_SUCCESS) return code;
        if (!(upper <= s->error_upper)) s->error_upper = upper;
    }
    return IMP_SUCCESS;
}
