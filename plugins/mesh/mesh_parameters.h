/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_PARAMETERS_H
#define PLUGINS_MESH_MESH_PARAMETERS_H

#include "plugins/mesh/triangles.h"

/* Points and faces as parameters: a file, or lists. Types that take them begin their tables with
 * these rows, in this order. */

enum { MESH_FILE, MESH_POINTS, MESH_FACES, MESH_VELOCITIES, MESH_SCALE, MESH_ROWS };

#define ROW_MESH_FILE(DOC) IMP_ROW_FILE("file", IMP_PARAMETER_OPTIONAL, DOC)
#define ROW_MESH_POINTS                                                                            \
    IMP_ROW("points", "length", NULL, IMP_PARAMETER_OPTIONAL, 2, 0, 3, -TRIANGLES_FAR,             \
            TRIANGLES_FAR, "points [x,y,z] at t = 0, in place of a file")
#define ROW_MESH_FACES(DOC)                                                                        \
    IMP_ROW_OF(IMP_KIND_INTEGER, "faces", "1", NULL, IMP_PARAMETER_OPTIONAL, 2, 0, 0, 0, 0x1p32,   \
               DOC)
#define ROW_MESH_VELOCITIES                                                                        \
    IMP_ROW("velocities", "length/time", NULL, IMP_PARAMETER_OPTIONAL, 2, 0, 3, -TRIANGLES_FAR,    \
            TRIANGLES_FAR, "velocity of each point; default: at rest")

#define ROW_MESH_SCALE                                                                             \
    IMP_ROW(                                                                                       \
        "scale", "1", "1", IMP_PARAMETER_SCALAR_OK, 1, 0, 0, -TRIANGLES_FAR, TRIANGLES_FAR,        \
        "factor of all points, or one each of x, y and z, as from a file's unit to the scene's")

/* Adds the points and faces of the file or of the lists, scaled; what was left out or changed
 * becomes a note. */
imp_status mesh_take_shape(const imp_value *values, triangles *to, imp_create_error *why);

/* Takes the velocities of that many points, for free(), into *velocity, which is NULL or has room
 * for them; it stays NULL if they are at rest. */
imp_status mesh_take_velocities(const imp_value *values, size_t points, double **velocity,
                                imp_create_error *why);

#endif
