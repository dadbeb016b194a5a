/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/stage.h"

#include <stdio.h>
#include <stdlib.h>

#include "tools/cli/scene_info.h"

vec stage_spot_point(const stage *s)
{
    return vec_scale(0.5, vec_add(s->spot.point[0], s->spot.point[1]));
}

double stage_size(const stage *s)
{
    const double size = vec_length(vec_sub(s->cloud.box.hi, s->cloud.box.lo));
    return size > 0 && size < INFINITY ? size : 1;
}

bool stage_is_there(const stage *s, const mesh *m) { return mesh_exists(s->scene, m, s->now); }

static size_t surfaces_of(const stage *s)
{
    size_t count = 0;
    for (size_t b = 0; b < s->body_count; ++b) count += imp_scene_surface_count(s->scene, b);
    return count;
}

/* Marked lines: some 16 across a body of one piece, fewer across each of many; an even number of
 * steps, so that one line is in the middle, by which patches that join are known. */
static size_t lines_across(const stage *s, size_t body)
{
    const double n = 8 / sqrt((double)scene_info_pieces(s->scene, body));
    return n < 1 ? 2 : 2 * (size_t)n;
}

static imp_code measure(stage *s, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t b = 0; b < s->body_count; ++b)
        for (size_t k = 0; k < imp_scene_surface_count(s->scene, b) && code == IMP_SUCCESS; ++k)
            code = cloud_add(&s->cloud, s->scene, b, k, s->moments, s->moment_count, s->allowance,
                             error);
    return code;
}

static imp_code make_body(stage *s, size_t body, mesh_plan *plan, size_t max_cells,
                          imp_error *error)
{
    const size_t first = s->count, pieces = scene_info_pieces(s->scene, body);
    imp_code code = IMP_SUCCESS;
    plan->lines = lines_across(s, body);
    plan->max_cells = max_cells / (pieces + (pieces == 0)) + 16;
    for (size_t k = 0; k < imp_scene_surface_count(s->scene, body) && code == IMP_SUCCESS; ++k)
        code = mesh_make(s->scene, body, k, plan, &s->meshes[s->count++], error);
    /* Steps are found with all meshes at one time. */
    for (size_t k = first; k < s->count && code == IMP_SUCCESS; ++k)
        if (s->meshes[k].home < INFINITY)
            code = mesh_move(s->scene, &s->meshes[k], s->meshes[k].home, s->allowance, error);
    if (code != IMP_SUCCESS) return code;
    return mesh_find_steps(s->meshes + first, s->count - first, stage_size(s), s->allowance, error);
}

/* Coordinates beyond this overflow where lengths are squared. */
static const double coordinate_max = 1e150;

static imp_code check_size(const stage *s, imp_error *error)
{
    double most = 0;
    for (int i = 0; i < 3 && s->cloud.count > 0; ++i)
        most = fmax(most, fmax(fabs(s->cloud.box.lo.x[i]), fabs(s->cloud.box.hi.x[i])));
    if (most <= coordinate_max) return IMP_SUCCESS;
    error->code = IMP_ERROR_USAGE;
    snprintf(error->text, sizeof error->text,
             "coordinates up to %.3g are too large for a picture; at most %g can be drawn: choose "
             "a larger unit of length",
             most, coordinate_max);
    return error->code;
}

imp_code stage_make(stage *s, const stage_detail *detail, imp_error *error)
{
    imp_code code = measure(s, error);
    if (code == IMP_SUCCESS) code = check_size(s, error);
    if (code != IMP_SUCCESS) return code;
    s->meshes = calloc(surfaces_of(s) + 1, sizeof *s->meshes);
    if (s->meshes == NULL) return mesh_no_memory(error);
    mesh_plan plan = {.times = s->moments,
                      .time_count = s->moment_count,
                      .tolerance = detail->tolerance > 0 ? detail->tolerance : stage_size(s) / 2000,
                      .focus_radius = detail->focus_radius,
                      .allowance = s->allowance};
    if (detail->focus_radius < INFINITY) plan.focus = stage_spot_point(s);
    const size_t max_cells = detail->max_cells / (s->body_count + 1) + 512;
    for (size_t b = 0; b < s->body_count && code == IMP_SUCCESS; ++b)
        code = make_body(s, b, &plan, max_cells, error);
    return code;
}

void stage_free(stage *s)
{
    for (size_t k = 0; k < s->count; ++k) mesh_free(&s->meshes[k]);
    free(s->meshes);
    cloud_free(&s->cloud);
    free(s->moments);
    *s = (stage){0};
}

imp_code stage_move(stage *s, double t, imp_error *error)
{
    s->now = t;
    for (size_t k = 0; k < s->count; ++k) {
        mesh *m = &s->meshes[k];
        double upper = 0;
        if (!stage_is_there(s, m)) continue;
        imp_code code = mesh_move(s->scene, m, t, s->allowance, error);
        if (code == IMP_SUCCESS) code = mesh_error(s->scene, m, t, s->allowance, &upper, error);
        if (code != IMP_SUCCESS) return code;
        if (!(upper <= s->error_upper)) s->error_upper = upper;
    }
    return IMP_SUCCESS;
}
