/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_GLTF_PLACE_H
#define PLUGINS_MESH_MESH_GLTF_PLACE_H

#include <jansson.h>
#include <stdbool.h>

/* Where a node of a glTF document stands: an affine map of its points. */

typedef struct gltf_place {
    double at[3][4]; /* rows; the last column is the shift */
} gltf_place;

extern const gltf_place gltf_place_identity;

/* The place of a node below another: that place after the node's matrix, or after its scale, then
 * its rotation (a quaternion x, y, z, w), then its translation. False: they are not lists of
 * numbers. */
bool gltf_place_under(const gltf_place *above, const json_t *node, gltf_place *place);

void gltf_place_point(const gltf_place *place, const double x[3], double y[3]);

/* Whether it is a reflection, so that triangles go round the other way. */
bool gltf_place_is_turned(const gltf_place *place);

#endif
