/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ARRAY_FILE_H
#define CORE_PLUGIN_ARRAY_FILE_H

#include <impinge/surface.h>
#include <jansson.h>

#include "core/base/place.h"

/* Numbers of a parameter in a file beside the scene
 * =================================================
 * An array of numbers may stand in a file of NumPy's format, "points": {"file": "net.npy"}:
 * versions 1.0 to 3.0, real numbers of 4 and 8 bytes, whole ones of 1 to 8, of either byte order,
 * rows first or columns first; or in an archive of several such files, {"file": "nets.npz",
 * "array": "net"}, as numpy.savez makes it (zip_member.h). Its shape is that of the parameter, so a
 * list of vectors is an array of two dimensions. The file, or the archive's member, is as long as
 * its head says before memory is taken for it, and every number is one that a scene could state:
 * finite, in the parameter's range, exact as a double. */

/* Whether the value stands for a file: an object with "file", where the row has an array of
 * numbers. */
bool array_file_is_asked(const imp_parameter *row, const json_t *json);

/* The names in such an object. */
typedef struct array_name {
    const char *file;
    const char *array; /* NULL: the file is no archive */
} array_name;

/* Returns the names. IMP_ERROR_SCENE: it is neither {"file": NAME} nor one with an array's name. */
imp_code array_file_name(const json_t *json, const place *at, array_name *name, imp_error *error);

/* Whether so many bytes may be taken. */
typedef struct array_file_limit {
    bool (*allows)(void *context, uint64_t bytes);
    void *context;
    uint64_t held; /* bytes of arrays that were read before */
} array_file_limit;

/* Reads the array of that name, or if it is NULL that of a file without one; *bytes becomes the
 * size of its numbers. parameters_clear_value frees the value; on failure there is nothing to
 * clear. IMP_ERROR_LIMIT without a text: the limit, which may be NULL, does not allow it. */
imp_code array_file_read(const imp_parameter *row, const char *path, const char *array,
                         const array_file_limit *limit, const place *at, imp_value *value,
                         uint64_t *bytes, imp_error *error);

#endif
