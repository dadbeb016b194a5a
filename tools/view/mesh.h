/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_MESH_H
#define TOOLS_VIEW_MESH_H

#include <impinge/impinge.h>

#include "tools/cli/vec.h"
#include "tools/view/allowance.h"

/* A surface as triangles, with a known error
 * ==========================================
 * Each piece of the surface is a patch: a grid of lines of constant u and v, as dense as the
 * surface's Taylor models require; neighbouring cells of a patch share whole edges. Cell (i,j) is
 * two triangles, cut from corner (i,j) to corner (i+1,j+1). A flat triangle or quadrilateral is one
 * cell.
 *
 * The grids are made once; points and normals are those of one time. A surface that moves rigidly
 * is evaluated once, at its home time, and then moved. */

typedef struct mesh_patch {
    size_t piece;
    size_t nu, nv;      /* lines of constant u and of constant v; at least 2 each */
    size_t first_line;  /* line[first_line...]: the nu values of u, then the nv of v */
    size_t first_point; /* point[first_point + i * nv + j] */
    size_t first_cell;  /* cells of the patches before: that of (i,j) is i * (nv - 1) + j on */
    bool is_flat;       /* it is flat: lines of constant u and v are not shown */
    bool is_triangle;   /* one cell whose second triangle is empty */
} mesh_patch;

typedef enum mesh_step_kind {
    MESH_LINE, /* of constant u or v, on a curved patch */
    MESH_FOLD, /* between flat patches that meet at a small angle */
    MESH_EDGE  /* where a patch ends alone, or two meet at a large angle */
} mesh_step_kind;

/* From one point to another. */
typedef struct mesh_step {
    uint32_t from, to;
    mesh_step_kind kind;
} mesh_step;

typedef struct mesh {
    size_t body, surface; /* in the scene */
    mesh_patch *patches;
    size_t patch_count;
    double *line; /* ascending in each patch, over its whole domain */
    bool *marked; /* the lines that a picture shows */
    size_t line_count, point_count, cell_count, triangle_count;
    vec *point, *normal; /* world space, unit length or 0; of the last mesh_move */
    mesh_step *steps;    /* the steps that are shown: mesh_find_steps */
    size_t step_count, step_room;
    double home;   /* a time at which the surface exists: the first of its plan, if there is one */
    bool is_rigid; /* during its plan's times */
    vec *home_point, *home_normal; /* of a rigid one; else NULL */
    double home_error;             /* at its home time; mesh_error returns slightly more */
    vec focus;                     /* as in its plan */
    double focus_radius;
} mesh;

static inline imp_place mesh_place(const mesh *m, size_t patch)
{
    return (imp_place){m->body, m->surface, m->patches[patch].piece};
}

static inline const double *mesh_u(const mesh *m, const mesh_patch *p)
{
    return m->line + p->first_line;
}

static inline const double *mesh_v(const mesh *m, const mesh_patch *p)
{
    return m->line + p->first_line + p->nu;
}

/* How finely to divide. No patch is refined once it has max_cells. */
typedef struct mesh_plan {
    const double *times; /* ascending; the error is to be within the tolerance at all of them */
    size_t time_count;
    double tolerance; /* length */
    size_t lines;     /* equal steps between marked lines, in u and in v, of a curved patch */
    size_t max_cells;
    double focus_radius;  /* INFINITY: everywhere; else cells that stay out of this ball are left */
    vec focus;            /* as coarse as they begin */
    allowance *allowance; /* NULL: none */
} mesh_plan;

/* Makes the grids, and evaluates a surface that is rigid; points and normals are those of no time
 * yet. To be freed in any case. */
imp_code mesh_make(const imp_scene *scene, size_t body, size_t surface, const mesh_plan *plan,
                   mesh *made, imp_error *error);
void mesh_free(mesh *m);

/* Returns whether the surface exists at time t. */
bool mesh_exists(const imp_scene *scene, const mesh *m, double t);

/* Points and normals at time t, at which the surface exists. */
imp_code mesh_move(const imp_scene *scene, mesh *m, double t, allowance *l, imp_error *error);

/* Returns the motion of a rigid mesh from its home time to t; fails for one that deforms. */
imp_code mesh_motion(const imp_scene *scene, const mesh *m, double t, imp_rigid_motion *motion,
                     imp_error *error);

/* Bounds in *upper the distance of the surface from the triangles at time t, over all cells in
 * focus; length. */
imp_code mesh_error(const imp_scene *scene, const mesh *m, double t, allowance *l, double *upper,
                    imp_error *error);

/* Calls `visit` with the corners of each triangle, as indices of point and normal, and its cell. */
typedef void (*mesh_visitor)(void *context, const mesh *m, const size_t corner[3], size_t cell);
void mesh_triangles(const mesh *m, mesh_visitor visit, void *context);
void mesh_patch_triangles(const mesh *m, const mesh_patch *p, mesh_visitor visit, void *context);

/* Finds the steps of the meshes of one body together, at their present time: an edge is a side
 * where no other patch of the body continues. `size` is the scene's, a length. */
imp_code mesh_find_steps(mesh *meshes, size_t count, double size, allowance *l, imp_error *error);

/* Sets *error to IMP_ERROR_MEMORY, and returns it. */
imp_code mesh_no_memory(imp_error *error);

#endif
