/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_MESH_GRID_H
#define TOOLS_VIEW_MESH_GRID_H

#include "tools/view/mesh.h"

/* The lines of one piece's grid. */

/* Lines of one parameter: its values, ascending. */
typedef struct grid_lines {
    double *at;
    bool *marked, *split; /* split: the step that begins at this line */
    size_t count, room;
} grid_lines;

/* Scratch of many pieces, one after another. */
typedef struct grid {
    grid_lines of[2]; /* u, v */
    bool is_flat;     /* one cell is enough, and its image is flat */
    double upper; /* how far the piece is from its triangles, over all cells in focus and times */
} grid;

/* Makes a grid. *g begins as zeros; free it in any case. */
imp_code grid_make(const imp_scene *scene, imp_place at, const mesh_plan *plan, grid *g,
                   imp_error *error);
void grid_free(grid *g);

#endif
