/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_BYTES_H
#define PLUGINS_MESH_MESH_BYTES_H

#include "plugins/mesh/triangles.h"

/* The bytes of a whole file, for free(). Only of files, since a pipe or a device might never end,
 * and of 2^30 bytes at most. Before the file is opened, its bytes are added to what `to` holds and
 * asked for (triangles_may_take). IMP_STATUS_PARAMETER: it cannot be read, and the fault names it;
 * IMP_STATUS_INTERNAL: no memory, or a limit. */
imp_status mesh_read_whole(const char *path, char **bytes, size_t *length, const triangles *to,
                           triangles_fault *fault);

#endif
