/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/mesh_text.h"

/* OFF: the word OFF, the numbers of points, faces and edges, a line for each point and each face:
 * "x y z" and "3 a b c", from 0. What follows in these lines (colours, normals) is ignored. */

typedef struct off_reader {
    mesh_text text;
    triangles *to;
    triangles_fault *fault;
    mesh_corners corners;
} off_reader;

static imp_status next_line(off_reader *r, const char *what, int64_t k, int64_t count)
{
    if (mesh_text_line(&r->text, false)) return IMP_STATUS_OK;
    if (mesh_text_status(&r->text) != IMP_STATUS_OK) return IMP_STATUS_INTERNAL;
    return triangles_refuse(r->fault, r->text.line, "the file ends before %s %lld of %lld", what,
                            (long long)k, (long long)count);
}

static imp_status read_count(off_reader *r, int64_t *count, const char *what)
{
    const char *word = mesh_text_word(&r->text);
    if (word != NULL && mesh_text_integer(word, count) && *count >= 0) return IMP_STATUS_OK;
    return triangles_refuse(r->fault, r->text.line,
                            "'%.40s' is no number of %s; after OFF: points, faces, edges",
                            word != NULL ? word : "", what);
}

/* With ST, C and N a point has more behind its coordinates: texture, colour, normal. */
static bool is_head(const char *word)
{
    if (strncmp(word, "ST", 2) == 0) word += 2;
    if (*word == 'C') word += 1;
    if (*word == 'N') word += 1;
    return strcmp(word, "OFF") == 0;
}

static imp_status read_head(off_reader *r, int64_t *points, int64_t *faces)
{
    imp_status status = next_line(r, "line", 1, 2);
    if (status != IMP_STATUS_OK) return status;
    const char *word = mesh_text_word(&r->text);
    if (!is_head(word))
        return triangles_refuse(r->fault, r->text.line,
                                "'%.40s', must begin with OFF, COFF, NOFF, CNOFF, or STOFF", word);
    const char *rest = r->text.next;
    if (rest[strspn(rest, " \t\v\f")] == '\0') status = next_line(r, "line", 2, 2);
    if (status == IMP_STATUS_OK) status = read_count(r, points, "points");
    return status == IMP_STATUS_OK ? read_count(r, faces, "faces") : status;
}

static imp_status read_face(off_reader *r)
{
    int64_t count = 0, corner;
    imp_status status = read_count(r, &count, "corners");
    r->corners.count = 0;
    for (int64_t k = 0; status == IMP_STATUS_OK && k < count; ++k) {
        const char *word = mesh_text_word(&r->text);
        if (word == NULL || !mesh_text_integer(word, &corner))
            return triangles_refuse(r->fault, r->text.line,
                                    "'%.40s' in place of corner %lld of %lld of a face",
                                    word != NULL ? word : "", (long long)k, (long long)count);
        if (!mesh_corners_add(&r->corners, corner)) return IMP_STATUS_INTERNAL;
    }
    if (status != IMP_STATUS_OK) return status;
    return triangles_add_face(r->to, r->corners.at, r->corners.count, r->text.line, r->fault);
}

static imp_status read_all(off_reader *r)
{
    int64_t points = 0, faces = 0;
    imp_status status = read_head(r, &points, &faces);
    for (int64_t k = 0; status == IMP_STATUS_OK && k < points; ++k) {
        double x[3];
        status = next_line(r, "point", k, points);
        if (status == IMP_STATUS_OK) status = mesh_text_point(&r->text, x, r->fault);
        if (status == IMP_STATUS_OK) status = triangles_add_point(r->to, x, r->text.line, r->fault);
    }
    for (int64_t k = 0; status == IMP_STATUS_OK && k < faces; ++k) {
        status = next_line(r, "face", k, faces);
        if (status == IMP_STATUS_OK) status = read_face(r);
    }
    if (status == IMP_STATUS_OK && mesh_text_line(&r->text, false))
        return triangles_refuse(r->fault, r->text.line,
                                "more lines than %lld points and %lld faces", (long long)points,
                                (long long)faces);
    return status == IMP_STATUS_OK ? mesh_text_status(&r->text) : status;
}

imp_status mesh_read_off(const char *bytes, size_t length, triangles *to, triangles_fault *fault)
{
    off_reader r = {.text = {.at = bytes, .end = bytes + length}, .to = to, .fault = fault};
    const imp_status status = read_all(&r);
    mesh_text_clear(&r.text);
    free(r.corners.at);
    return status;
}
