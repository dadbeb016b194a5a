/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_ply_head.h"

/* PLY, behind its head: elements in the head's order, each a value for each property; a list is its
 * length and that many values. As text, values are words, whatever lines they stand in. */

typedef struct ply_reader {
    ply_head head;
    mesh_text *text;
    const char *bytes, *at, *end; /* of a binary file: all of it, and what is left */
    triangles *to;
    triangles_fault *fault;
    mesh_corners corners;
} ply_reader;

/* --- Values ----------------------------------------------------------------------------------- */

/* The line of a text; 0 in a binary file. */
static size_t line_of(const ply_reader *r)
{
    return r->head.format == PLY_TEXT ? r->text->line : 0;
}

static imp_status refuse_end(ply_reader *r)
{
    if (mesh_text_status(r->text) != IMP_STATUS_OK) return IMP_STATUS_INTERNAL;
    static const char text[] = "the file ends before all elements of its head are there";
    if (r->head.format == PLY_TEXT) return triangles_refuse(r->fault, line_of(r), text);
    return triangles_refuse_byte(r->fault, (size_t)(r->end - r->bytes) - 1, text);
}

static imp_status next_word(ply_reader *r, double *x)
{
    const char *word;
    while ((word = mesh_text_word(r->text)) == NULL)
        if (!mesh_text_line(r->text, false)) return refuse_end(r);
    if (mesh_text_number(word, x)) return IMP_STATUS_OK;
    *x = NAN; /* of a property that is not asked for it does not matter */
    return IMP_STATUS_OK;
}

static imp_status next_value(ply_reader *r, mesh_scalar type, double *x)
{
    if (r->head.format == PLY_TEXT) return next_word(r, x);
    const size_t size = mesh_scalar_size(type);
    if ((size_t)(r->end - r->at) < size) return refuse_end(r);
    *x = mesh_scalar_at(type, r->head.format == PLY_BIG_ENDIAN, r->at);
    r->at += size;
    return IMP_STATUS_OK;
}

/* A fault at the value that was read last. */
static imp_status refuse(ply_reader *r, const char *what, double x)
{
    if (r->head.format == PLY_TEXT)
        return triangles_refuse(r->fault, r->text->line, "%s, got %g", what, x);
    return triangles_refuse_byte(r->fault, (size_t)(r->at - r->bytes) - 1,
                                 "%s, got %g (the byte is its last)", what, x);
}

/* --- Elements --------------------------------------------------------------------------------- */

/* The values of a list; kept as corners if they are. */
static imp_status read_list(ply_reader *r, const ply_property *p)
{
    double count, corner;
    imp_status status = next_value(r, p->count_type, &count);
    if (status != IMP_STATUS_OK) return status;
    if (!(count >= 0 && count <= 0x1p32 && floor(count) == count))
        return refuse(r, "the length of a list must be a whole number from 0", count);
    for (double k = 0; k < count && status == IMP_STATUS_OK; ++k) {
        status = next_value(r, p->type, &corner);
        if (status != IMP_STATUS_OK || p->role != PLY_CORNERS) continue;
        if (!(corner >= 0 && corner <= 0x1p32 && floor(corner) == corner))
            return refuse(r, "a corner must be the number of a point, from 0", corner);
        if (!mesh_corners_add(&r->corners, (int64_t)corner)) status = IMP_STATUS_INTERNAL;
    }
    return status;
}

static imp_status read_element(ply_reader *r, const ply_element *e)
{
    double x[3] = {0, 0, 0}, unused;
    imp_status status = IMP_STATUS_OK;
    r->corners.count = 0;
    for (size_t k = 0; k < e->count && status == IMP_STATUS_OK; ++k) {
        const ply_property *p = &r->head.property[e->first + k];
        if (p->is_list)
            status = read_list(r, p);
        else
            status = next_value(r, p->type, p->role <= PLY_Z ? &x[p->role] : &unused);
        if (status == IMP_STATUS_OK && p->role <= PLY_Z && !isfinite(x[p->role]))
            return refuse(r, "a coordinate must be a finite number", x[p->role]);
    }
    if (status != IMP_STATUS_OK || e->kind == PLY_OTHER) return status;
    status = e->kind == PLY_POINTS
                 ? triangles_add_point(r->to, x, line_of(r), r->fault)
                 : triangles_add_face(r->to, r->corners.at, r->corners.count, line_of(r), r->fault);
    if (status == IMP_STATUS_PARAMETER && r->head.format != PLY_TEXT)
        r->fault->byte = (size_t)(r->at - r->bytes);
    return status;
}

/* An element without properties is nothing in the file, whatever its number. */
static imp_status read_elements(ply_reader *r)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < r->head.elements && status == IMP_STATUS_OK; ++k) {
        const ply_element *e = &r->head.element[k];
        for (int64_t n = 0; n < e->number && e->count > 0 && status == IMP_STATUS_OK; ++n)
            status = read_element(r, e);
        if (e->kind == PLY_OTHER && e->number > 0) {
            triangles_note(&r->to->left_out, 0);
            r->to->left_out.count += (size_t)e->number - 1;
        }
    }
    return status;
}

imp_status mesh_read_ply(const char *bytes, size_t length, triangles *to, triangles_fault *fault)
{
    mesh_text text = {.at = bytes, .end = bytes + length};
    ply_reader r = {.text = &text, .bytes = bytes, .end = bytes + length, .to = to, .fault = fault};
    imp_status status = ply_read_head(&r.head, &text, fault);
    r.at = text.at;
    if (status == IMP_STATUS_OK) status = read_elements(&r);
    mesh_text_clear(&text);
    free(r.corners.at);
    return status;
}
