/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_CLOUD_H
#define TOOLS_VIEW_CLOUD_H

#include "tools/view/allowance.h"
#include "tools/view/mesh.h"

/* The extent of a scene: the box around all surfaces at some moments, and points for framing
 * pictures: of each surface, the farthest ones in some hundred directions. */

typedef struct cloud {
    vec_box box;
    vec *point;
    size_t count, room;
} cloud;

/* Adds the surface at the moments at which it exists, by a coarse grid of each piece. */
imp_code cloud_add(cloud *c, const imp_scene *scene, size_t body, size_t surface,
                   const double *moments, size_t count, allowance *l, imp_error *error);
void cloud_free(cloud *c);

#endif
