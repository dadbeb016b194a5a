/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

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

imp_status mesh_read_bytes(mesh_format format, const char *bytes, size_t length, triangles *to,
                           triangles_fault *fault)
{
    imp_status (*const read[])(const char *, size_t, triangles *, triangles_fault *) = {
        [MESH_OBJ] = mesh_read_obj, [MESH_OFF] = mesh_read_off, [MESH_STL] = mesh_read_stl};
    const size_t mark = mark_length(format, bytes, length);
    const imp_status status = read[format](bytes + mark, length - mark, to, fault);
    if (status != IMP_STATUS_OK || to->count > 0) return status;
    return triangles_refuse(fault, 0, "no faces in it; a mesh needs one at least");
}

static bool find_format(const char *path, mesh_format *format)
{
    static const char *const ends[] = {
        [MESH_OBJ] = ".obj", [MESH_OFF] = ".off", [MESH_STL] = ".stl"};
    const size_t length = strlen(path);
    for (int k = 0; k < 3; ++k)
        if (length > 4 && strcasecmp(path + length - 4, ends[k]) == 0) {
            *format = (mesh_format)k;
            return true;
        }
    return false;
}

enum { BYTES_MAX = 1 << 30 };

/* Only files: a pipe or a device might never end. At most as much as the file was long when it was
 * opened; NULL: it cannot be read, or no memory (*status). */
static char *read_whole(const char *path, int row, size_t *length, imp_status *status,
                        imp_create_error *why)
{
    struct stat facts;
    *status = imp_reject(why, row, -1, "'%.180s' cannot be read", path);
    if (stat(path, &facts) != 0 || !S_ISREG(facts.st_mode)) return NULL;
    if (facts.st_size > BYTES_MAX) {
        imp_reject(why, row, -1, "'%.140s' has %lld bytes, may have 2^30; divide the mesh", path,
                   (long long)facts.st_size);
        return NULL;
    }
    FILE *file = fopen(path, "rbe");
    if (file == NULL) return NULL;
    char *bytes = malloc((size_t)facts.st_size + 1);
    if (bytes != NULL) *length = fread(bytes, 1, (size_t)facts.st_size, file);
    *status = bytes == NULL ? IMP_STATUS_INTERNAL : ferror(file) ? *status : IMP_STATUS_OK;
    fclose(file);
    if (*status == IMP_STATUS_OK) return bytes;
    free(bytes);
    return NULL;
}

imp_status mesh_read_file(const char *path, int row, triangles *to, imp_create_error *why)
{
    mesh_format format;
    size_t length = 0;
    imp_status status;
    triangles_fault fault = {0, ""};
    if (!find_format(path, &format))
        return imp_reject(why, row, -1, "'%.160s' ends in none of .obj, .off, .stl", path);
    if (to->keeps_faces && format == MESH_STL)
        return imp_reject(why, row, -1,
                          "'%.120s': triangles of an STL file share no points; write it as .obj or "
                          ".off",
                          path);
    char *bytes = read_whole(path, row, &length, &status, why);
    if (bytes == NULL) return status;
    status = mesh_read_bytes(format, bytes, length, to, &fault);
    free(bytes);
    if (status != IMP_STATUS_PARAMETER) return status;
    if (fault.line > 0)
        return imp_reject(why, row, -1, "'%.80s', line %zu: %s", path, fault.line, fault.text);
    return imp_reject(why, row, -1, "'%.80s': %s", path, fault.text);
}
