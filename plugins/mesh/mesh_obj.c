/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/mesh_text.h"

/* Wavefront OBJ: "v x y z" are points, numbered from 1, "f a b c ..." polygons of them; a corner is
 * "point/texture/normal", and -1 the last point so far. What follows the coordinates of a point (a
 * weight, a colour) means nothing to a polygon. */

typedef struct obj_reader {
    mesh_text text;
    triangles *to;
    triangles_fault *fault;
    mesh_corners corners;
} obj_reader;

static imp_status read_point(obj_reader *r)
{
    double x[3];
    const imp_status status = mesh_text_point(&r->text, x, r->fault);
    return status == IMP_STATUS_OK ? triangles_add_point(r->to, x, r->text.line, r->fault) : status;
}

static imp_status read_corner(obj_reader *r, char *word)
{
    int64_t k;
    word[strcspn(word, "/")] = '\0';
    if (!mesh_text_integer(word, &k) || k == 0)
        return triangles_refuse(
            r->fault, r->text.line,
            "point %.40s does not exist; points are numbered from 1, or backwards "
            "from -1",
            word);
    const int64_t points = (int64_t)r->to->point_count, at = k > 0 ? k - 1 : points + k;
    if (at < 0 || at >= points)
        return triangles_refuse(r->fault, r->text.line,
                                "point %lld of a face, but only %lld so far", (long long)k,
                                (long long)points);
    return mesh_corners_add(&r->corners, at) ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status read_face(obj_reader *r)
{
    imp_status status = IMP_STATUS_OK;
    char *word;
    r->corners.count = 0;
    while (status == IMP_STATUS_OK && (word = mesh_text_word(&r->text)) != NULL)
        status = read_corner(r, word);
    if (status != IMP_STATUS_OK) return status;
    return triangles_add_face(r->to, r->corners.at, r->corners.count, r->text.line, r->fault);
}

static bool is_one_of(const char *word, const char *const *list)
{
    while (*list != NULL && strcmp(word, *list) != 0) ++list;
    return *list != NULL;
}

/* What follows may touch something (lines, points, curves, free-form surfaces) or is unknown: it is
 * left out and counted. Names, materials, normals and the like are no things in space. */
static imp_status read_statement(obj_reader *r)
{
    static const char *const silent[] = {"vt",     "vn",       "g",      "o",          "s",
                                         "usemtl", "mtllib",   "mg",     "bevel",      "c_interp",
                                         "lod",    "d_interp", "usemap", "shadow_obj", NULL};
    const char *word = mesh_text_word(&r->text);
    if (strcmp(word, "v") == 0) return read_point(r);
    if (strcmp(word, "f") == 0 || strcmp(word, "fo") == 0) return read_face(r);
    if (!is_one_of(word, silent)) triangles_note(&r->to->left_out, r->text.line);
    return IMP_STATUS_OK;
}

imp_status mesh_read_obj(const char *bytes, size_t length, triangles *to, triangles_fault *fault)
{
    obj_reader r = {.text = {.at = bytes, .end = bytes + length}, .to = to, .fault = fault};
    imp_status status = IMP_STATUS_OK;
    while (status == IMP_STATUS_OK && mesh_text_line(&r.text, true)) status = read_statement(&r);
    if (status == IMP_STATUS_OK) status = mesh_text_status(&r.text);
    mesh_text_clear(&r.text);
    free(r.corners.at);
    return status;
}
