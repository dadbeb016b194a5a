/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_CLOUD_H
#define TOOLS_VIEW_CLOUD_H

#include "tools/view/allowance.h"
#include "tools/view/mesh.h"

/* How large things are: the box around all that stands at some moments, and points by which
 * pictures are framed, of each surface those that lie farthest out in some hundred directions. */

typedef struct cloud {
    vec_box box;
    vec *point;
    size_t count, room;
} cloud;

/* Adds the surface where it stands at the moments at which it exists, by a coarse grid of each
 * piece. */
imp_code cloud_add(cloud *c, const imp_scene *scene, size_t body, size_t surface,
                   const double *moments, size_t count, allowance *l, imp_error *error);
void cloud_free(cloud *c);

#endif
