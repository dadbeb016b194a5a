/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/mesh_scalar.h"
#include "plugins/mesh/mesh_text.h"

#include <strings.h>

/* STL. As text: solid, then for each triangle "facet normal ...", "outer loop", three "vertex x y
 * z", "endloop", "endfacet", at last "endsolid". Binary: 80 bytes, the number of triangles, and 50
 * bytes for each: normal and three points in single precision, and two bytes more;
 * little-endian. */

enum { HEAD = 84, RECORD = 50 };

/* Three points and the triangle between them. */
static imp_status add_triangle(triangles *to, double x[3][3], size_t line, triangles_fault *fault)
{
    imp_status status = IMP_STATUS_OK;
    const int64_t first = (int64_t)to->point_count;
    for (int k = 0; k < 3 && status == IMP_STATUS_OK; ++k)
        status = triangles_add_point(to, x[k], line, fault);
    if (status != IMP_STATUS_OK) return status;
    return triangles_add_face(to, (const int64_t[]){first, first + 1, first + 2}, 3, line, fault);
}

static imp_status read_binary(const char *bytes, size_t count, triangles *to,
                              triangles_fault *fault)
{
    for (size_t k = 0; k < count; ++k) {
        double x[3][3];
        const char *record = bytes + HEAD + RECORD * k;
        for (size_t i = 0; i < 9; ++i) {
            x[i / 3][i % 3] = mesh_scalar_at(SCALAR_FLOAT32, false, record + 12 + 4 * i);
            if (!isfinite(x[i / 3][i % 3]))
                return triangles_refuse_byte(fault, HEAD + RECORD * k + 12 + 4 * i,
                                             "triangle %zu (from 0): coordinate %g", k,
                                             x[i / 3][i % 3]);
        }
        const imp_status status = add_triangle(to, x, 0, fault);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

/* --- Text ------------------------------------------------------------------------------------- */

/* The lines of a triangle, in their order. */
static const char *const steps[] = {"facet",  "outer",   "vertex",  "vertex",
                                    "vertex", "endloop", "endfacet"};
enum { STEPS = sizeof steps / sizeof *steps, FIRST_VERTEX = 2 };

static imp_status read_line(mesh_text *text, int *step, double x[3][3], triangles *to,
                            triangles_fault *fault)
{
    const char *word = mesh_text_word(text);
    if (*step == 0 && (strcasecmp(word, "solid") == 0 || strcasecmp(word, "endsolid") == 0))
        return IMP_STATUS_OK;
    if (strcasecmp(word, steps[*step]) != 0)
        return triangles_refuse(fault, text->line, "'%.40s' in place of '%s'", word, steps[*step]);
    imp_status status = IMP_STATUS_OK;
    if (strcmp(steps[*step], "vertex") == 0)
        status = mesh_text_point(text, x[*step - FIRST_VERTEX], fault);
    *step = (*step + 1) % STEPS;
    if (status == IMP_STATUS_OK && *step == 0) status = add_triangle(to, x, text->line, fault);
    return status;
}

static imp_status read_text(const char *bytes, size_t length, triangles *to, triangles_fault *fault)
{
    mesh_text text = {.at = bytes, .end = bytes + length};
    imp_status status = IMP_STATUS_OK;
    int step = 0;
    double x[3][3];
    while (status == IMP_STATUS_OK && mesh_text_line(&text, false))
        status = read_line(&text, &step, x, to, fault);
    if (status == IMP_STATUS_OK) status = mesh_text_status(&text);
    if (status == IMP_STATUS_OK && step != 0)
        status = triangles_refuse(fault, text.line, "the file ends before '%s'", steps[step]);
    mesh_text_clear(&text);
    return status;
}

/* After blanks and empty lines, in capital letters or not. */
static bool begins_with_solid(const char *bytes, size_t length)
{
    static const char word[] = "solid";
    const size_t of_word = sizeof word - 1;
    while (length > 0 && strchr(" \t\r\n", *bytes) != NULL && *bytes != '\0') ++bytes, --length;
    return length >= of_word && strncasecmp(bytes, word, of_word) == 0;
}

/* The length decides: text may begin with any 84 bytes, and a binary file with "solid". Text has no
 * NUL, so that a binary file that was cut is not taken for text. */
imp_status mesh_read_stl(const char *bytes, size_t length, triangles *to, triangles_fault *fault)
{
    const size_t count =
        length >= HEAD ? (size_t)mesh_scalar_at(SCALAR_UINT32, false, bytes + HEAD - 4) : 0;
    if (length >= HEAD && length == HEAD + RECORD * count)
        return read_binary(bytes, count, to, fault);
    if (begins_with_solid(bytes, length) && memchr(bytes, '\0', length) == NULL)
        return read_text(bytes, length, to, fault);
    return triangles_refuse(
        fault, 0,
        "neither text, which begins with 'solid', nor binary: %zu bytes, in place of %zu "
        "for %zu triangles; was it cut?",
        length, HEAD + RECORD * count, count);
}
