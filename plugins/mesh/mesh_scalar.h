/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_SCALAR_H
#define PLUGINS_MESH_MESH_SCALAR_H

#include <stdbool.h>
#include <stddef.h>

/* Numbers in binary files, of either order of bytes. */

typedef enum mesh_scalar {
    SCALAR_INT8,
    SCALAR_UINT8,
    SCALAR_INT16,
    SCALAR_UINT16,
    SCALAR_INT32,
    SCALAR_UINT32,
    SCALAR_FLOAT32,
    SCALAR_FLOAT64
} mesh_scalar;

size_t mesh_scalar_size(mesh_scalar type); /* bytes */
bool mesh_scalar_is_whole(mesh_scalar type);

/* The number that begins at `bytes`, exactly. */
double mesh_scalar_at(mesh_scalar type, bool is_big_endian, const char *bytes);

#endif
