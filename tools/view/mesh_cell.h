/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_MESH_CELL_H
#define TOOLS_VIEW_MESH_CELL_H

#include <impinge/impinge.h>

#include "tools/cli/vec.h"

/* Bounds for one cell of a grid: [u[0], u[1]] x [v[0], v[1]] of a piece at one time. */

typedef struct cell_error {
    double upper;    /* length: how far the surface is from the cell's two triangles at most */
    double share[2]; /* about how much of that u and v bring */
    vec_box box;     /* around the surface there */
} cell_error;

imp_code cell_measure(const imp_scene *scene, imp_place at, const double u[2], const double v[2],
                      double t, cell_error *cell, imp_error *error);

/* Returns whether a point of the box may be within the radius of the focus. */
bool cell_is_in_focus(vec focus, double radius, const vec_box *box);

#endif
