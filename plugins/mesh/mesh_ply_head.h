/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_PLY_HEAD_H
#define PLUGINS_MESH_MESH_PLY_HEAD_H

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/mesh_scalar.h"
#include "plugins/mesh/mesh_text.h"

/* The head of a PLY file: which elements follow, how many of each, with which properties. Points
 * are the elements "vertex" with x, y and z, faces those called "face" with a list "vertex_indices"
 * or "vertex_index". */

typedef enum ply_format { PLY_TEXT, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_format;

typedef enum ply_role { PLY_X, PLY_Y, PLY_Z, PLY_CORNERS, PLY_UNUSED } ply_role;

typedef struct ply_property {
    ply_role role;
    mesh_scalar type, count_type; /* count_type: of a list's length */
    bool is_list;
} ply_property;

typedef enum ply_kind { PLY_POINTS, PLY_FACES, PLY_OTHER } ply_kind;

typedef struct ply_element {
    ply_kind kind;
    int64_t number;      /* as the head says, which may be more than the file has */
    size_t first, count; /* its properties */
} ply_element;

enum { PLY_ELEMENTS_MAX = 32, PLY_PROPERTIES_MAX = 256 };

typedef struct ply_head {
    ply_format format;
    ply_element element[PLY_ELEMENTS_MAX];
    size_t elements;
    ply_property property[PLY_PROPERTIES_MAX]; /* of all elements */
    size_t properties;
} ply_head;

/* Reads the lines up to "end_header"; the elements begin at text->at. */
imp_status ply_read_head(ply_head *head, mesh_text *text, triangles_fault *fault);

#endif
