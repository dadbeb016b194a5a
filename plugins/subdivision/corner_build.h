/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_CORNER_BUILD_H
#define PLUGINS_SUBDIVISION_CORNER_BUILD_H

#include "plugins/subdivision/corner.h"

/* What is different for quads of Catmull and Clark and for triangles of Loop. */

/* Fill grid, is_border and missing; the fan is there. */
void quad_find(const control_mesh *m, uint32_t h, corner_points *to);
void triangle_find(const control_mesh *m, uint32_t h, corner_points *to);

/* Set points beyond a border, of a grid with so many points a side. */
void quad_reflect(corner_net *n, int side);
void triangle_reflect(corner_net *n, int side);

/* Set grid and fan of the next level. */
void quad_step(const corner_net *from, corner_net *to);
void triangle_step(const corner_net *from, corner_net *to);

/* Roundings of a step, beside one for each face at the corner, in units of 2^-53 `most`. */
enum { CORNER_STEP_UNITS = 12 };

#endif
