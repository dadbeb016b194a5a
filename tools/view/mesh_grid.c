/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/mesh_grid.h"

#include <stdlib.h>

#include "tools/view/mesh_cell.h"

/* --- Lines ------------------------------------------------------------------------------------ */

static bool lines_reserve(grid_lines *l, size_t room)
{
    if (room <= l->room) return true;
    double *at = realloc(l->at, room * sizeof *at);
    if (at != NULL) l->at = at;
    bool *marked = realloc(l->marked, room * sizeof *marked);
    if (marked != NULL) l->marked = marked;
    bool *split = realloc(l->split, room * sizeof *split);
    if (split != NULL) l->split = split;
    if (at == NULL || marked == NULL || split == NULL) return false;
    l->room = room;
    return true;
}

static bool lines_begin(grid_lines *l, double lo, double hi, size_t steps)
{
    if (!lines_reserve(l, steps + 1)) return false;
    l->count = steps + 1;
    for (size_t k = 0; k <= steps; ++k) {
        l->at[k] = k == steps ? hi : lo + (hi - lo) * ((double)k / (double)steps);
        l->marked[k] = true, l->split[k] = false;
    }
    return true;
}

/* Puts a line into the middle of each step to be split. *more: how many there were. False: no
 * memory. */
static bool lines_split(grid_lines *l, size_t *more)
{
    *more = 0;
    for (size_t k = 0; k + 1 < l->count; ++k) {
        const double middle = 0.5 * (l->at[k] + l->at[k + 1]);
        l->split[k] = l->split[k] && l->at[k] < middle && middle < l->at[k + 1];
        *more += l->split[k];
    }
    size_t to = l->count + *more, k = l->count;
    if (!lines_reserve(l, to)) return false;
    l->count = to;
    while (k-- > 0) {
        if (l->split[k]) {
            l->at[--to] = 0.5 * (l->at[k] + l->at[k + 1]);
            l->marked[to] = false;
        }
        l->at[--to] = l->at[k];
        l->marked[to] = l->marked[k];
    }
    for (k = 0; k < l->count; ++k) l->split[k] = false;
    return true;
}

void grid_free(grid *g)
{
    for (int k = 0; k < 2; ++k) {
        free(g->of[k].at);
        free(g->of[k].marked);
        free(g->of[k].split);
    }
    *g = (grid){.is_flat = false};
}

/* --- Which cells are too coarse --------------------------------------------------------------- */

static bool exists_at(const double lo[3], const double hi[3], double t)
{
    return lo[2] <= t && t <= hi[2];
}

/* Marks the steps of u and v that cell (i,j) wants halved at time t. */
static imp_code judge_cell(const imp_scene *scene, imp_place at, const mesh_plan *plan, double t,
                           size_t i, size_t j, grid *g, imp_error *error)
{
    cell_error cell;
    grid_lines *u = &g->of[0], *v = &g->of[1];
    const imp_code code = cell_measure(scene, at, u->at + i, v->at + j, t, &cell, error);
    if (code != IMP_SUCCESS) return code;
    if (cell.upper <= plan->tolerance && cell.upper <= g->upper) return code;
    if (!cell_is_in_focus(plan->focus, plan->focus_radius, &cell.box)) return code;
    if (!(cell.upper <= g->upper)) g->upper = cell.upper;
    if (cell.upper <= plan->tolerance) return code;
    u->split[i] |= 2 * cell.share[0] >= cell.share[1];
    v->split[j] |= 2 * cell.share[1] >= cell.share[0];
    return code;
}

static imp_code judge_row(const imp_scene *scene, imp_place at, const mesh_plan *plan, double t,
                          size_t i, grid *g, imp_error *error)
{
    imp_code code = allowance_check(plan->allowance, "triangles were made", error);
    for (size_t j = 0; j + 1 < g->of[1].count && code == IMP_SUCCESS; ++j)
        code = judge_cell(scene, at, plan, t, i, j, g, error);
    return code;
}

static imp_code judge(const imp_scene *scene, imp_place at, const mesh_plan *plan,
                      const double lo[3], const double hi[3], grid *g, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    g->upper = 0;
    for (size_t k = 0; k < plan->time_count; ++k) {
        if (!exists_at(lo, hi, plan->times[k])) continue;
        for (size_t i = 0; i + 1 < g->of[0].count && code == IMP_SUCCESS; ++i)
            code = judge_row(scene, at, plan, plan->times[k], i, g, error);
    }
    return code;
}

static imp_code refine(const imp_scene *scene, imp_place at, const mesh_plan *plan,
                       const double lo[3], const double hi[3], grid *g, imp_error *error)
{
    for (size_t more = 1; more > 0;) {
        size_t of[2];
        const imp_code code = judge(scene, at, plan, lo, hi, g, error);
        if (code != IMP_SUCCESS) return code;
        if (g->of[0].count * g->of[1].count >= plan->max_cells) return code;
        if (allowance_is_near(plan->allowance)) return code;
        if (!lines_split(&g->of[0], &of[0]) || !lines_split(&g->of[1], &of[1]))
            return mesh_no_memory(error);
        more = of[0] + of[1];
    }
    return IMP_SUCCESS;
}

/* A piece is flat if it is this part of its own size off a plane, and within the tolerance, at all
 * times. */
static const double flat_share = 1e-6;

static imp_code find_flat(const imp_scene *scene, imp_place at, const mesh_plan *plan,
                          const double lo[3], const double hi[3], grid *g, imp_error *error)
{
    const double u[2] = {lo[0], hi[0]}, v[2] = {lo[1], hi[1]};
    imp_code code = allowance_check(plan->allowance, "triangles were made", error);
    g->is_flat = plan->time_count > 0;
    g->upper = 0;
    for (size_t k = 0; k < plan->time_count && g->is_flat && code == IMP_SUCCESS; ++k) {
        cell_error cell;
        if (!exists_at(lo, hi, plan->times[k])) continue;
        code = cell_measure(scene, at, u, v, plan->times[k], &cell, error);
        if (code != IMP_SUCCESS) return code;
        const double size = vec_length(vec_sub(cell.box.hi, cell.box.lo));
        g->is_flat = cell.upper <= flat_share * size && cell.upper <= plan->tolerance;
        if (!(cell.upper <= g->upper)) g->upper = cell.upper;
    }
    return code;
}

imp_code grid_make(const imp_scene *scene, imp_place at, const mesh_plan *plan, grid *g,
                   imp_error *error)
{
    double lo[3], hi[3];
    imp_piece_domain(scene, at, lo, hi);
    const imp_code code = find_flat(scene, at, plan, lo, hi, g, error);
    if (code != IMP_SUCCESS) return code;
    for (int k = 0; k < 2; ++k)
        if (!lines_begin(&g->of[k], lo[k], hi[k], g->is_flat ? 1 : plan->lines))
            return mesh_no_memory(error);
    return g->is_flat ? code : refine(scene, at, plan, lo, hi, g, error);
}
