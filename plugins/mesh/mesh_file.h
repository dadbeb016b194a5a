/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_FILE_H
#define PLUGINS_MESH_MESH_FILE_H

#include "plugins/mesh/triangles.h"

/* Triangles from files
 * ====================
 * Wavefront OBJ, OFF, STL (text and binary), PLY (text and binary) and glTF 2.0 (.gltf and .glb).
 * Nothing that a file says of its own size is believed before it is there. What a file describes
 * beside its faces is left out and counted (to->left_out). */

typedef enum mesh_format { MESH_OBJ, MESH_OFF, MESH_STL, MESH_PLY, MESH_GLTF } mesh_format;

/* Adds the points and triangles of a whole file of `length` bytes. A glTF document may name files
 * in `folder`, which ends in '/' or is empty; NULL: such files are refused. IMP_STATUS_PARAMETER:
 * it cannot be read, and the fault says where. */
imp_status mesh_read_bytes(mesh_format format, const char *bytes, size_t length, const char *folder,
                           triangles *to, triangles_fault *fault);

/* Adds the points and triangles of a file; the end of its name says its format. `row`: the
 * parameter with the path. */
imp_status mesh_read_file(const char *path, int row, triangles *to, imp_create_error *why);

/* One per format; for mesh_read_bytes. */
imp_status mesh_read_obj(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_off(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_stl(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_ply(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_gltf(const char *bytes, size_t length, const char *folder, triangles *to,
                          triangles_fault *fault);

#endif
