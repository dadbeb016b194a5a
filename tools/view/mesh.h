/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_MESH_H
#define TOOLS_VIEW_MESH_H

#include <impinge/impinge.h>

#include "tools/cli/vec.h"

/* Surfaces as triangles, with a known error
 * =========================================
 * A mesh is a grid of lines of constant u and v, each as dense as the surface's own Taylor models
 * ask for, so neighbouring cells share whole edges. Cell (i,j) is two triangles, cut from corner
 * (i,j) to corner (i+1,j+1). The grid is made once; points and normals are those of one time. */

typedef struct mesh {
    size_t body, surface, piece; /* in the scene */
    size_t nu, nv;        /* lines of constant u and of constant v; at least 2 each */
    double *u, *v;        /* ascending, over the whole domain */
    bool *marked_u;       /* lines that a picture shows */
    bool *marked_v;
    vec *point, *normal; /* [i * nv + j]; world space, unit length or 0 */
    vec focus;           /* as in its plan */
    double focus_radius;
} mesh;

static inline imp_place mesh_place(const mesh *m)
{
    return (imp_place){m->body, m->surface, m->piece};
}

/* How fine. Nothing more is split once there are max_cells. */
typedef struct mesh_plan {
    const double *times; /* at which the error is to be within the tolerance */
    size_t time_count;
    double tolerance; /* length */
    size_t lines;     /* equal steps between marked lines, in u and in v */
    size_t max_cells;
    double focus_radius; /* INFINITY: everywhere; else cells that stay out of this ball are left */
    vec focus;           /* as coarse as they begin */
} mesh_plan;

/* Makes the grid; points and normals are those of no time yet. */
imp_code mesh_make(const imp_scene *scene, imp_place of, const mesh_plan *plan,
                   mesh *made, imp_error *error);
void mesh_free(mesh *m);

/* Whether the surface exists at time t. */
bool mesh_exists(const imp_scene *scene, const mesh *m, double t);

/* Points and normals at time t, at which the surface exists. */
imp_code mesh_move(const imp_scene *scene, mesh *m, double t, imp_error *error);

/* How far the surface is at most from the triangles at time t, over all cells in focus: *upper, a
 * length. */
imp_code mesh_error(const imp_scene *scene, const mesh *m, double t, double *upper,
                    imp_error *error);

/* Calls `visit` with the corners of each triangle, as indices of point and normal. */
typedef void (*mesh_visitor)(void *context, const mesh *m, const size_t corner[3]);
void mesh_triangles(const mesh *m, mesh_visitor visit, void *context);
size_t mesh_triangle_count(const mesh *m);

/* Calls `visit` with the steps of each marked line: indices of point. */
typedef void (*mesh_step_visitor)(void *context, const mesh *m, size_t from, size_t to);
void mesh_marked_steps(const mesh *m, mesh_step_visitor visit, void *context);

/* Sets *error to memory that ran out, and answers the code. */
imp_code mesh_no_memory(imp_error *error);

#endif
