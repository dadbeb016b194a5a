/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/view/mesh_cell.h"
#include "tools/view/mesh_grid.h"

imp_code mesh_no_memory(imp_error *error)
{
    error->code = IMP_ERROR_MEMORY;
    snprintf(error->text, sizeof error->text, "%s", imp_code_text(IMP_ERROR_MEMORY));
    return IMP_ERROR_MEMORY;
}

void mesh_free(mesh *m)
{
    free(m->patches);
    free(m->line);
    free(m->marked);
    free(m->point);
    free(m->normal);
    free(m->steps);
    free(m->home_point);
    free(m->home_normal);
    *m = (mesh){0};
}

bool mesh_exists(const imp_scene *scene, const mesh *m, double t)
{
    double lo[3], hi[3];
    imp_scene_domain(scene, m->body, m->surface, lo, hi);
    return lo[2] <= t && t <= hi[2];
}

/* --- Patches ---------------------------------------------------------------------------------- */

static bool reserve_lines(mesh *m, size_t more, size_t *room)
{
    if (m->line_count + more <= *room) return true;
    const size_t wanted = 2 * (m->line_count + more);
    double *line = realloc(m->line, wanted * sizeof *line);
    if (line != NULL) m->line = line;
    bool *marked = realloc(m->marked, wanted * sizeof *marked);
    if (marked != NULL) m->marked = marked;
    if (line == NULL || marked == NULL) return false;
    *room = wanted;
    return true;
}

static bool add_patch(mesh *m, size_t piece, const grid *g, size_t *room)
{
    const grid_lines *u = &g->of[0], *v = &g->of[1];
    if (!reserve_lines(m, u->count + v->count, room)) return false;
    m->patches[m->patch_count++] = (mesh_patch){.piece = piece,
                                                .nu = u->count,
                                                .nv = v->count,
                                                .first_line = m->line_count,
                                                .first_point = m->point_count,
                                                .first_cell = m->cell_count,
                                                .is_flat = g->is_flat};
    for (int k = 0; k < 2; ++k) {
        memcpy(m->line + m->line_count, g->of[k].at, g->of[k].count * sizeof *m->line);
        memcpy(m->marked + m->line_count, g->of[k].marked, g->of[k].count * sizeof *m->marked);
        m->line_count += g->of[k].count;
    }
    m->point_count += u->count * v->count;
    m->cell_count += (u->count - 1) * (v->count - 1);
    return true;
}

static imp_code make_patches(const imp_scene *scene, mesh *m, const mesh_plan *plan,
                             imp_error *error)
{
    const size_t pieces = imp_scene_piece_count(scene, m->body, m->surface);
    size_t room = 0;
    grid g = {.is_flat = false};
    m->patches = calloc(pieces, sizeof *m->patches);
    imp_code code = m->patches != NULL ? IMP_SUCCESS : mesh_no_memory(error);
    for (size_t k = 0; k < pieces && code == IMP_SUCCESS; ++k) {
        code = grid_make(scene, (imp_place){m->body, m->surface, k}, plan, &g, error);
        if (code == IMP_SUCCESS && !add_patch(m, k, &g, &room)) code = mesh_no_memory(error);
        if (!(g.upper <= m->home_error)) m->home_error = g.upper;
    }
    grid_free(&g);
    return code;
}

/* --- What stays as it is ---------------------------------------------------------------------- */

/* A patch is flat if its points are in a plane up to this part of its size. */
static const double plane_slack = 1e-9;

static bool is_plane(const vec *point, size_t count)
{
    vec far = {{0, 0, 0}}, normal = {{0, 0, 0}};
    for (size_t k = 1; k < count; ++k) {
        const vec d = vec_sub(point[k], point[0]);
        if (vec_dot(d, d) > vec_dot(far, far)) far = d;
    }
    for (size_t k = 1; k < count; ++k) {
        const vec n = vec_cross(far, vec_sub(point[k], point[0]));
        if (vec_dot(n, n) > vec_dot(normal, normal)) normal = n;
    }
    normal = vec_unit(normal);
    for (size_t k = 1; k < count; ++k)
        if (fabs(vec_dot(normal, vec_sub(point[k], point[0]))) > plane_slack * vec_length(far))
            return false;
    return true;
}

static bool coincide(vec a, vec b) { return memcmp(&a, &b, sizeof a) == 0; }

/* A triangle's grid has one cell, of which the corners at the ends of one side are one point.
 * Returns whether another time might refute the result. */
static bool look_at_patches(mesh *m, bool is_first)
{
    bool open = false;
    m->triangle_count = 0;
    for (size_t k = 0; k < m->patch_count; ++k) {
        mesh_patch *p = &m->patches[k];
        const vec *point = m->point + p->first_point;
        const bool one = p->nu == 2 && p->nv == 2 && coincide(point[0], point[1]);
        p->is_triangle = one && (is_first || p->is_triangle);
        if (!(p->nu == 2 && p->nv == 2))
            p->is_flat = (is_first || p->is_flat) && is_plane(point, p->nu * p->nv);
        m->triangle_count += 2 * (p->nu - 1) * (p->nv - 1) - p->is_triangle;
        open |= p->is_triangle || p->is_flat;
    }
    return open;
}

/* Checks all times of the plan at which it exists. */
static imp_code look_at_times(const imp_scene *scene, mesh *m, const mesh_plan *plan,
                              imp_error *error)
{
    bool is_first = true, open = true;
    for (size_t k = 0; k < plan->time_count && open; ++k) {
        if (!mesh_exists(scene, m, plan->times[k])) continue;
        const imp_code code = mesh_move(scene, m, plan->times[k], plan->allowance, error);
        if (code != IMP_SUCCESS) return code;
        open = look_at_patches(m, is_first);
        is_first = false;
    }
    if (is_first) look_at_patches(m, true);
    return IMP_SUCCESS;
}

enum { PIECES_A_LOOK = 256 }; /* pieces between looks at the limits */

/* Finds out whether it moves rigidly between the first and the last time of the plan at which it
 * exists. */
static imp_code find_rigid(const imp_scene *scene, mesh *m, const mesh_plan *plan, imp_error *error)
{
    const size_t pieces = imp_scene_piece_count(scene, m->body, m->surface);
    double first = INFINITY, last = -INFINITY;
    for (size_t k = 0; k < plan->time_count; ++k)
        if (mesh_exists(scene, m, plan->times[k]))
            first = fmin(first, plan->times[k]), last = fmax(last, plan->times[k]);
    imp_code code = IMP_SUCCESS;
    m->home = first;
    m->is_rigid = first <= last;
    for (size_t k = 0; k < pieces && m->is_rigid && code == IMP_SUCCESS; ++k) {
        imp_rigid_motion motion;
        const imp_place at = {m->body, m->surface, k};
        if (k % PIECES_A_LOOK == 0)
            code = allowance_check(plan->allowance, "triangles were made", error);
        if (code == IMP_SUCCESS) code = imp_piece_motion(scene, at, first, last, &motion, error);
        m->is_rigid = code == IMP_SUCCESS && motion.is_known;
    }
    return code;
}

/* Evaluates a rigid mesh at its home time, and bounds its error there. */
static imp_code settle(const imp_scene *scene, mesh *m, allowance *l, imp_error *error)
{
    m->is_rigid = false;
    const imp_code code = mesh_move(scene, m, m->home, l, error);
    if (code != IMP_SUCCESS) return code;
    m->home_point = malloc(m->point_count * sizeof *m->home_point);
    m->home_normal = malloc(m->point_count * sizeof *m->home_normal);
    if (m->home_point == NULL || m->home_normal == NULL) return mesh_no_memory(error);
    memcpy(m->home_point, m->point, m->point_count * sizeof *m->point);
    memcpy(m->home_normal, m->normal, m->point_count * sizeof *m->normal);
    m->is_rigid = true;
    return code;
}

static imp_code make_points(const imp_scene *scene, mesh *m, allowance *l, imp_error *error)
{
    const size_t bytes = m->point_count * (m->is_rigid ? 4 : 2) * sizeof *m->point;
    const imp_code code = allowance_check_bytes(l, bytes, "triangles were made", error);
    if (code != IMP_SUCCESS) return code;
    m->point = calloc(m->point_count, sizeof *m->point);
    m->normal = calloc(m->point_count, sizeof *m->normal);
    if (m->point == NULL || m->normal == NULL) return mesh_no_memory(error);
    return m->is_rigid ? settle(scene, m, l, error) : code;
}

imp_code mesh_make(const imp_scene *scene, size_t body, size_t surface, const mesh_plan *plan,
                   mesh *made, imp_error *error)
{
    mesh_plan own = *plan;
    *made = (mesh){
        .body = body, .surface = surface, .focus = plan->focus, .focus_radius = plan->focus_radius};
    imp_code code = find_rigid(scene, made, plan, error);
    if (made->is_rigid) own.times = &made->home, own.time_count = 1;
    if (code == IMP_SUCCESS) code = make_patches(scene, made, &own, error);
    if (code == IMP_SUCCESS) code = make_points(scene, made, plan->allowance, error);
    return code == IMP_SUCCESS ? look_at_times(scene, made, &own, error) : code;
}
