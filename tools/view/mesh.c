/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/mesh.h"

#include <stdio.h>
#include <stdlib.h>

imp_code mesh_no_memory(imp_error *error)
{
    error->code = IMP_ERROR_MEMORY;
    snprintf(error->text, sizeof error->text, "%s", imp_code_text(IMP_ERROR_MEMORY));
    return IMP_ERROR_MEMORY;
}

/* --- What one cell costs ---------------------------------------------------------- */

typedef struct cell_error {
    double upper;    /* length: how far the surface is from the two triangles at most */
    double share[2]; /* what of that u and v bring, about */
    vec_box box;     /* around the surface there */
} cell_error;

/* Lemma. At a fixed time coordinate i of the cell is a + b_u s + b_v r + q_uu s^2 + q_uv s r +
 * q_vv r^2 within e, for s, r in [-1,1]. The triangles are linear and agree with the coordinate at
 * three corners each, so what is linear in s and r cancels; the rest differs by at most
 *   q_uu: |s^2 - 1| <= 1,   q_vv: |r^2 - 1| <= 1,
 *   q_uv: on the triangle s >= r, s r - (r - s + 1) = (s - 1)(r + 1) in [-1, 0], on the
 *         other (s + 1)(r - 1), likewise,
 *   e: once at the point, and once at the corners, of which a triangle's point is a mean.
 * The corners' own rounding, some 1e-16 of the coordinates, is left out: no picture shows it. Both
 * points also lie in [lo, hi], so no coordinate differs by more than that is wide. */
static double coordinate_error(const imp_model *m)
{
    const double bent = fabs(m->q[IMP_UU]) + fabs(m->q[IMP_UV]) + fabs(m->q[IMP_VV]) + 2 * m->e;
    const double wide = m->hi - m->lo;
    return bent < wide ? bent : wide;
}

static void take_shares(cell_error *cell, const imp_model *m)
{
    const double bu = fabs(m->b[0]), bv = fabs(m->b[1]), all = bu + bv;
    const double both = 0.5 * fabs(m->q[IMP_UV]), e = isfinite(m->e) ? m->e : 1;
    cell->share[0] += fabs(m->q[IMP_UU]) + both + e * (all > 0 ? bu / all : 0.5);
    cell->share[1] += fabs(m->q[IMP_VV]) + both + e * (all > 0 ? bv / all : 0.5);
}

static imp_code cell_measure(const imp_scene *scene, const mesh *m, size_t i, size_t j, double t,
                             cell_error *cell, imp_error *error)
{
    const double lo[3] = {m->u[i], m->v[j], t}, hi[3] = {m->u[i + 1], m->v[j + 1], t};
    imp_model model[3];
    const imp_code code = imp_piece_include(scene, mesh_place(m), lo, hi, model, error);
    if (code != IMP_SUCCESS) return code;
    *cell = (cell_error){0};
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double e = coordinate_error(&model[k]);
        sum += e * e;
        take_shares(cell, &model[k]);
        cell->box.lo.x[k] = model[k].lo, cell->box.hi.x[k] = model[k].hi;
    }
    cell->upper = sqrt(sum);
    return code;
}

static bool is_in_focus(vec focus, double radius, const vec_box *box)
{
    if (!(radius < INFINITY)) return true;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double x = focus.x[k];
        const double off = x < box->lo.x[k]   ? box->lo.x[k] - x
                           : x > box->hi.x[k] ? x - box->hi.x[k]
                                              : 0;
        sum += off * off;
    }
    return sqrt(sum) <= radius;
}

/* --- The grid ------------------------------------------------------------------------ */

typedef struct lines {
    double *at;
    bool *marked, *split; /* split: the step that begins at this line */
    size_t count, room;
} lines;

static bool lines_begin(lines *l, double lo, double hi, size_t steps, size_t room)
{
    *l = (lines){calloc(room, sizeof *l->at), calloc(room, sizeof *l->marked),
                 calloc(room, sizeof *l->split), steps + 1, room};
    if (l->at == NULL || l->marked == NULL || l->split == NULL) return false;
    for (size_t k = 0; k <= steps; ++k) {
        l->at[k] = k == steps ? hi : lo + (hi - lo) * ((double)k / (double)steps);
        l->marked[k] = true;
    }
    return true;
}

static void lines_free(lines *l)
{
    free(l->at);
    free(l->marked);
    free(l->split);
}

/* Puts a line into the middle of each step to be split, while there is room. */
static bool lines_split(lines *l)
{
    size_t more = 0;
    for (size_t k = 0; k + 1 < l->count; ++k) {
        const double middle = 0.5 * (l->at[k] + l->at[k + 1]);
        l->split[k] = l->split[k] && l->at[k] < middle && middle < l->at[k + 1];
        more += l->split[k];
    }
    if (more == 0 || l->count + more > l->room) return false;
    size_t to = l->count + more;
    l->count = to;
    for (size_t k = to - more; k-- > 0;) {
        if (l->split[k]) {
            l->at[--to] = 0.5 * (l->at[k] + l->at[k + 1]);
            l->marked[to] = false;
        }
        l->at[--to] = l->at[k];
        l->marked[to] = l->marked[k];
    }
    for (size_t k = 0; k < l->count; ++k) l->split[k] = false;
    return true;
}

/* Marks the steps of u and v that cell (i,j) wants halved at time t. */
static imp_code judge_cell(const imp_scene *scene, const mesh *view, const mesh_plan *plan,
                           double t, size_t i, size_t j, lines both[2], imp_error *error)
{
    cell_error cell;
    const imp_code code = cell_measure(scene, view, i, j, t, &cell, error);
    if (code != IMP_SUCCESS || cell.upper <= plan->tolerance) return code;
    if (!is_in_focus(plan->focus, plan->focus_radius, &cell.box)) return code;
    both[0].split[i] |= 2 * cell.share[0] >= cell.share[1];
    both[1].split[j] |= 2 * cell.share[1] >= cell.share[0];
    return code;
}

static imp_code judge_grid(const imp_scene *scene, const mesh *view, const mesh_plan *plan,
                           lines both[2], imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < plan->time_count; ++k) {
        if (!mesh_exists(scene, view, plan->times[k])) continue;
        for (size_t i = 0; i + 1 < both[0].count; ++i)
            for (size_t j = 0; j + 1 < both[1].count && code == IMP_SUCCESS; ++j)
                code = judge_cell(scene, view, plan, plan->times[k], i, j, both, error);
    }
    return code;
}

static imp_code refine(const imp_scene *scene, imp_place of, const mesh_plan *plan,
                       lines both[2], imp_error *error)
{
    for (bool split = true; split;) {
        const mesh view = {.body = of.body,
                           .surface = of.surface,
                           .piece = of.piece,
                           .u = both[0].at,
                           .v = both[1].at};
        const imp_code code = judge_grid(scene, &view, plan, both, error);
        if (code != IMP_SUCCESS) return code;
        if (both[0].count * both[1].count >= plan->max_cells) return code;
        const bool u = lines_split(&both[0]), v = lines_split(&both[1]);
        split = u || v;
    }
    return IMP_SUCCESS;
}

imp_code mesh_make(const imp_scene *scene, imp_place of, const mesh_plan *plan, mesh *made,
                   imp_error *error)
{
    double lo[3], hi[3];
    lines both[2];
    imp_piece_domain(scene, of, lo, hi);
    *made = (mesh){.body = of.body, .surface = of.surface, .piece = of.piece};
    bool room = true;
    for (int k = 0; k < 2; ++k)
        room &= lines_begin(&both[k], lo[k], hi[k], plan->lines, plan->max_cells + 1);
    imp_code code = room ? refine(scene, of, plan, both, error) : mesh_no_memory(error);
    if (code == IMP_SUCCESS) {
        const size_t n = both[0].count * both[1].count;
        *made = (mesh){of.body,
                       of.surface,
                       of.piece,
                       both[0].count,
                       both[1].count,
                       both[0].at,
                       both[1].at,
                       both[0].marked,
                       both[1].marked,
                       calloc(n, sizeof *made->point),
                       calloc(n, sizeof *made->normal),
                       plan->focus,
                       plan->focus_radius};
        both[0].at = both[1].at = NULL, both[0].marked = both[1].marked = NULL;
        if (made->point == NULL || made->normal == NULL) code = mesh_no_memory(error);
    }
    lines_free(&both[0]);
    lines_free(&both[1]);
    return code;
}

void mesh_free(mesh *m)
{
    free(m->u);
    free(m->v);
    free(m->marked_u);
    free(m->marked_v);
    free(m->point);
    free(m->normal);
    *m = (mesh){0};
}

bool mesh_exists(const imp_scene *scene, const mesh *m, double t)
{
    double lo[3], hi[3];
    imp_piece_domain(scene, mesh_place(m), lo, hi);
    return lo[2] <= t && t <= hi[2];
}

imp_code mesh_error(const imp_scene *scene, const mesh *m, double t, double *upper,
                    imp_error *error)
{
    *upper = 0;
    for (size_t i = 0; i + 1 < m->nu; ++i)
        for (size_t j = 0; j + 1 < m->nv; ++j) {
            cell_error cell;
            const imp_code code = cell_measure(scene, m, i, j, t, &cell, error);
            if (code != IMP_SUCCESS) return code;
            if (cell.upper <= *upper || !is_in_focus(m->focus, m->focus_radius, &cell.box))
                continue;
            *upper = cell.upper;
        }
    return IMP_SUCCESS;
}
