/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_bytes.h"

#include <sys/stat.h>

enum { BYTES_MAX = 1 << 30 };

static imp_status refuse(triangles_fault *fault, const char *path)
{
    return triangles_refuse(fault, 0, "'%.120s' cannot be read", path);
}

/* At most as much as the file was long when it was opened. */
imp_status mesh_read_whole(const char *path, char **bytes, size_t *length, const triangles *to,
                           triangles_fault *fault)
{
    struct stat facts;
    *bytes = NULL;
    if (stat(path, &facts) != 0 || !S_ISREG(facts.st_mode)) return refuse(fault, path);
    if (facts.st_size > BYTES_MAX)
        return triangles_refuse(fault, 0, "'%.80s' has %lld bytes, may have 2^30; divide the mesh",
                                path, (long long)facts.st_size);
    if (!triangles_may_take(to, (size_t)facts.st_size)) return IMP_STATUS_INTERNAL;
    FILE *file = fopen(path, "rbe");
    if (file == NULL) return refuse(fault, path);
    *bytes = malloc((size_t)facts.st_size + 1);
    if (*bytes != NULL) *length = fread(*bytes, 1, (size_t)facts.st_size, file);
    const bool failed = ferror(file) != 0;
    fclose(file);
    if (*bytes == NULL) return IMP_STATUS_INTERNAL;
    if (!failed) return IMP_STATUS_OK;
    free(*bytes);
    *bytes = NULL;
    return refuse(fault, path);
}
