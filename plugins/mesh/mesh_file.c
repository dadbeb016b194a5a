/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"

#include <strings.h>

#include "plugins/mesh/mesh_bytes.h"

/* The bytes of a byte order mark, which some programs begin text with; a binary STL file may begin
 * with any bytes. */
static size_t mark_length(mesh_format format, const char *bytes, size_t length)
{
    static const char mark[] = "\xEF\xBB\xBF", word[] = "solid";
    const size_t of_mark = sizeof mark - 1, of_word = sizeof word - 1;
    if (length < of_mark || memcmp(bytes, mark, of_mark) != 0) return 0;
    if (format != MESH_STL) return of_mark;
    const bool is_text = length >= of_mark + of_word && memcmp(bytes + of_mark, word, of_word) == 0;
    return is_text ? of_mark : 0;
}

imp_status mesh_read_bytes(mesh_format format, const char *bytes, size_t length, const char *folder,
                           triangles *to, triangles_fault *fault)
{
    imp_status (*const read[])(const char *, size_t, triangles *,
                               triangles_fault *) = {[MESH_OBJ] = mesh_read_obj,
                                                     [MESH_OFF] = mesh_read_off,
                                                     [MESH_STL] = mesh_read_stl,
                                                     [MESH_PLY] = mesh_read_ply};
    const size_t mark = mark_length(format, bytes, length);
    const imp_status status = format == MESH_GLTF
                                  ? mesh_read_gltf(bytes, length, folder, to, fault)
                                  : read[format](bytes + mark, length - mark, to, fault);
    if (status != IMP_STATUS_OK || to->count > 0) return status;
    return triangles_refuse(fault, 0, "no faces in it; a mesh needs one at least");
}

static bool find_format(const char *path, mesh_format *format)
{
    static const struct {
        const char *end;
        mesh_format format;
    } ends[] = {{".obj", MESH_OBJ}, {".off", MESH_OFF},   {".stl", MESH_STL},
                {".ply", MESH_PLY}, {".gltf", MESH_GLTF}, {".glb", MESH_GLTF}};
    const size_t length = strlen(path);
    for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k) {
        const size_t of_end = strlen(ends[k].end);
        if (length <= of_end || strcasecmp(path + length - of_end, ends[k].end) != 0) continue;
        *format = ends[k].format;
        return true;
    }
    return false;
}

static imp_status complain(const char *path, int row, const triangles_fault *fault,
                           imp_create_error *why)
{
    if (fault->line > 0)
        return imp_reject(why, row, -1, "'%.80s', line %zu: %s", path, fault->line, fault->text);
    if (fault->byte > 0)
        return imp_reject(why, row, -1, "'%.80s', byte %zu: %s", path, fault->byte - 1,
                          fault->text);
    return imp_reject(why, row, -1, "'%.80s': %s", path, fault->text);
}

/* With the '/' at its end; "" where the process is. NULL: no memory. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash != NULL ? (size_t)(slash - path) + 1 : 0;
    char *folder = malloc(length + 1);
    if (folder == NULL) return NULL;
    memcpy(folder, path, length);
    folder[length] = '\0';
    return folder;
}

imp_status mesh_read_file(const char *path, int row, triangles *to, imp_create_error *why)
{
    mesh_format format;
    size_t length = 0;
    char *bytes = NULL;
    triangles_fault fault = {0, "", 0};
    if (!find_format(path, &format))
        return imp_reject(why, row, -1,
                          "'%.140s' ends in none of .obj, .off, .stl, .ply, .gltf, .glb", path);
    if (to->keeps_faces && (format == MESH_STL || format == MESH_GLTF))
        return imp_reject(why, row, -1,
                          "'%.100s': triangles of such a file share no points; write it as .obj, "
                          ".off or .ply",
                          path);
    imp_status status = mesh_read_whole(path, &bytes, &length, to, &fault);
    to->held = length;
    if (status == IMP_STATUS_PARAMETER) return imp_reject(why, row, -1, "%s", fault.text);
    char *folder = status == IMP_STATUS_OK ? folder_of(path) : NULL;
    if (folder != NULL)
        status = mesh_read_bytes(format, bytes, length, folder, to, &fault);
    else
        status = IMP_STATUS_INTERNAL;
    free(folder);
    free(bytes);
    if (status == IMP_STATUS_OK && !to->has_other_files) imp_repeatable(why);
    to->held = 0;
    return status == IMP_STATUS_PARAMETER ? complain(path, row, &fault, why) : status;
}
