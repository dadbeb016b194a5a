/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_ply_head.h"

/* --- Words ------------------------------------------------------------------------------------ */

static bool is_word(const char *word, const char *wanted)
{
    return word != NULL && strcmp(word, wanted) == 0;
}

/* What stands in a line, for messages. */
static const char *shown(const char *word) { return word != NULL ? word : ""; }

/* Each type has two names. */
static bool find_type(const char *word, mesh_scalar *type)
{
    static const char *const names[][2] = {
        [SCALAR_INT8] = {"char", "int8"},        [SCALAR_UINT8] = {"uchar", "uint8"},
        [SCALAR_INT16] = {"short", "int16"},     [SCALAR_UINT16] = {"ushort", "uint16"},
        [SCALAR_INT32] = {"int", "int32"},       [SCALAR_UINT32] = {"uint", "uint32"},
        [SCALAR_FLOAT32] = {"float", "float32"}, [SCALAR_FLOAT64] = {"double", "float64"}};
    for (int k = 0; k <= SCALAR_FLOAT64; ++k)
        if (is_word(word, names[k][0]) || is_word(word, names[k][1])) {
            *type = (mesh_scalar)k;
            return true;
        }
    return false;
}

/* --- Lines of the head ------------------------------------------------------------------------ */

static imp_status read_format(ply_head *h, mesh_text *text, triangles_fault *fault)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char *word = mesh_text_word(text);
    for (int k = 0; k < 3; ++k)
        if (is_word(word, names[k])) {
            h->format = (ply_format)k;
            return IMP_STATUS_OK;
        }
    return triangles_refuse(fault, text->line,
                            "format '%.40s', must be ascii, binary_little_endian or "
                            "binary_big_endian",
                            shown(word));
}

static imp_status read_element(ply_head *h, mesh_text *text, triangles_fault *fault)
{
    const char *name = mesh_text_word(text);
    ply_element e = {.kind = is_word(name, "vertex") ? PLY_POINTS
                             : is_word(name, "face") ? PLY_FACES
                                                     : PLY_OTHER,
                     .first = h->properties};
    if (is_word(name, "tristrips"))
        return triangles_refuse(fault, text->line,
                                "strips of triangles (tristrips); write the mesh with faces");
    const char *number = mesh_text_word(text);
    if (number == NULL || !mesh_text_integer(number, &e.number) || e.number < 0)
        return triangles_refuse(fault, text->line, "'%.40s' is no number of elements",
                                shown(number));
    if (h->elements == PLY_ELEMENTS_MAX)
        return triangles_refuse(fault, text->line, "more than %d kinds of elements",
                                PLY_ELEMENTS_MAX);
    h->element[h->elements++] = e;
    return IMP_STATUS_OK;
}

static ply_role role_of(ply_kind kind, bool is_list, const char *name)
{
    static const char *const coordinates[] = {[PLY_X] = "x", [PLY_Y] = "y", [PLY_Z] = "z"};
    if (kind == PLY_FACES && is_list &&
        (is_word(name, "vertex_indices") || is_word(name, "vertex_index")))
        return PLY_CORNERS;
    for (int k = PLY_X; k <= PLY_Z; ++k)
        if (kind == PLY_POINTS && !is_list && is_word(name, coordinates[k])) return (ply_role)k;
    return PLY_UNUSED;
}

static bool has_role(const ply_head *h, const ply_element *e, ply_role role)
{
    for (size_t k = 0; k < e->count; ++k)
        if (h->property[e->first + k].role == role) return true;
    return false;
}

static imp_status read_property(ply_head *h, mesh_text *text, triangles_fault *fault)
{
    ply_property p = {.is_list = false};
    if (h->elements == 0)
        return triangles_refuse(fault, text->line, "a property before the first element");
    ply_element *e = &h->element[h->elements - 1];
    const char *word = mesh_text_word(text);
    p.is_list = is_word(word, "list");
    bool known = true;
    if (p.is_list) {
        word = mesh_text_word(text);
        known = find_type(word, &p.count_type);
        if (known) word = mesh_text_word(text);
    }
    if (!known || !find_type(word, &p.type))
        return triangles_refuse(fault, text->line,
                                "'%.40s' is no type of a property, such as float", shown(word));
    p.role = role_of(e->kind, p.is_list, mesh_text_word(text));
    if (p.role != PLY_UNUSED && has_role(h, e, p.role))
        return triangles_refuse(fault, text->line, "the property is there a second time");
    if (h->properties == PLY_PROPERTIES_MAX)
        return triangles_refuse(fault, text->line, "more than %d properties", PLY_PROPERTIES_MAX);
    h->property[h->properties++] = p;
    e->count += 1;
    return IMP_STATUS_OK;
}

/* Points have coordinates, and faces have corners. */
static imp_status check(const ply_head *h, size_t line, triangles_fault *fault)
{
    for (size_t k = 0; k < h->elements; ++k) {
        const ply_element *e = &h->element[k];
        if (e->kind == PLY_POINTS)
            for (int i = PLY_X; i <= PLY_Z; ++i)
                if (!has_role(h, e, (ply_role)i))
                    return triangles_refuse(fault, line, "the element vertex has no property '%c'",
                                            "xyz"[i]);
        if (e->kind == PLY_FACES && !has_role(h, e, PLY_CORNERS))
            return triangles_refuse(fault, line,
                                    "the element face has no list 'vertex_indices' or "
                                    "'vertex_index'");
    }
    return IMP_STATUS_OK;
}

imp_status ply_read_head(ply_head *head, mesh_text *text, triangles_fault *fault)
{
    imp_status status = IMP_STATUS_OK;
    bool has_format = false;
    if (!mesh_text_line(text, false) || !is_word(mesh_text_word(text), "ply"))
        return mesh_text_status(text) == IMP_STATUS_OK
                   ? triangles_refuse(fault, 1, "must begin with the line 'ply'")
                   : IMP_STATUS_INTERNAL;
    while (status == IMP_STATUS_OK && mesh_text_line(text, false)) {
        const char *word = mesh_text_word(text);
        if (is_word(word, "end_header"))
            return has_format
                       ? check(head, text->line, fault)
                       : triangles_refuse(fault, text->line, "no line 'format ...' in the head");
        if (is_word(word, "format"))
            status = read_format(head, text, fault), has_format = true;
        else if (is_word(word, "element"))
            status = read_element(head, text, fault);
        else if (is_word(word, "property"))
            status = read_property(head, text, fault);
        else if (!is_word(word, "comment") && !is_word(word, "obj_info"))
            status = triangles_refuse(fault, text->line,
                                      "'%.40s' in the head, must be element, "
                                      "property, comment or end_header",
                                      word);
    }
    if (status != IMP_STATUS_OK) return status;
    if (mesh_text_status(text) != IMP_STATUS_OK) return IMP_STATUS_INTERNAL;
    return triangles_refuse(fault, text->line, "the file ends before 'end_header'");
}
