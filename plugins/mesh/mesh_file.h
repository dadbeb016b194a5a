/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_FILE_H
#define PLUGINS_MESH_MESH_FILE_H

#include "plugins/mesh/triangles.h"

/* Triangles from files
 * ====================
 * Wavefront OBJ (points and polygons), OFF, and STL, as text and binary. Nothing that a file says
 * of its own size is believed before it is there. Whatever else a file describes that would touch
 * something (lines, free-form patches) is refused, not left out. */

typedef enum mesh_format { MESH_OBJ, MESH_OFF, MESH_STL } mesh_format;

/* Adds the points and triangles of a whole file of `length` bytes. */
imp_status mesh_read_bytes(mesh_format format, const char *bytes, size_t length, triangles *to,
                           triangles_fault *fault);

/* Adds the points and triangles of a file; the end of its name says its format. `row`: the
 * parameter with the path. */
imp_status mesh_read_file(const char *path, int row, triangles *to, imp_create_error *why);

/* One per format; for mesh_read_bytes. */
imp_status mesh_read_obj(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_off(const char *bytes, size_t length, triangles *to, triangles_fault *fault);
imp_status mesh_read_stl(const char *bytes, size_t length, triangles *to, triangles_fault *fault);

#endif
