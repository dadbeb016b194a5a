/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/mesh_gltf_data.h"
#include "plugins/mesh/mesh_gltf_place.h"

/* glTF 2.0, as JSON (.gltf) or binary (.glb): the triangles of the meshes of all nodes of its
 * scene, each node placed by its own transform and those above it. Points, lines, morph targets and
 * skins are left out and counted. */

typedef struct gltf_reader {
    gltf_data data;
    triangles *to;
    bool *passed; /* nodes that are placed already */
    size_t nodes;
} gltf_reader;

/* --- Primitives ------------------------------------------------------------------------------- */

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

static imp_status add_points(gltf_reader *r, const gltf_accessor *a, const gltf_place *place)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 0; k < a->count && status == IMP_STATUS_OK; ++k) {
        const double x[3] = {gltf_accessor_at(a, k, 0), gltf_accessor_at(a, k, 1),
                             gltf_accessor_at(a, k, 2)};
        double y[3];
        gltf_place_point(place, x, y);
        status = triangles_add_point(r->to, y, 0, r->data.fault);
    }
    return status;
}

/* Corner k of a primitive: a number of its points, by its indices or by itself. */
static int64_t corner_at(const gltf_accessor *indices, size_t k)
{
    return indices->bytes != NULL ? (int64_t)gltf_accessor_at(indices, k, 0) : (int64_t)k;
}

/* The triangles of `count` corners, points from `first` on; each second one of a strip goes round
 * the other way. `is_turned`: the place is a reflection. */
static imp_status add_triangles(gltf_reader *r, json_int_t mode, const gltf_accessor *indices,
                                size_t count, size_t points, bool is_turned)
{
    const int64_t first = (int64_t)(r->to->point_count - points);
    const size_t step = mode == MODE_TRIANGLES ? 3 : 1;
    for (size_t k = 0; k + 3 <= count; k += step) {
        int64_t corner[3];
        const bool swaps = is_turned != (mode == MODE_STRIP && k % 2 == 1);
        for (size_t i = 0; i < 3; ++i) {
            const size_t at = mode == MODE_FAN && i == 0 ? 0 : k + i;
            corner[swaps ? 2 - i : i] = corner_at(indices, at);
        }
        for (int i = 0; i < 3; ++i) {
            if (corner[i] >= (int64_t)points)
                return triangles_refuse(r->data.fault, 0,
                                        "triangle %zu of a primitive: index %lld of %zu points", k,
                                        (long long)corner[i], points);
            corner[i] += first;
        }
        const imp_status status = triangles_add_face(r->to, corner, 3, 0, r->data.fault);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status refuse_index(gltf_reader *r, const char *what)
{
    return triangles_refuse(r->data.fault, 0, "%s must be a whole number from 0", what);
}

static imp_status add_primitive(gltf_reader *r, const json_t *primitive, const gltf_place *place)
{
    json_int_t mode, index;
    gltf_accessor points, indices = {.bytes = NULL};
    if (!gltf_count(primitive, "mode", MODE_TRIANGLES, &mode))
        return refuse_index(r, "mode of a primitive");
    const json_t *attributes = json_object_get(primitive, "attributes");
    if (mode < MODE_TRIANGLES || mode > MODE_FAN ||
        json_object_get(attributes, "POSITION") == NULL) {
        triangles_note(&r->to->left_out, 0);
        return IMP_STATUS_OK;
    }
    if (json_object_get(primitive, "targets") != NULL) triangles_note(&r->to->left_out, 0);
    if (!gltf_count(attributes, "POSITION", -1, &index)) return refuse_index(r, "POSITION");
    imp_status status = gltf_accessor_open(&r->data, index, 3, &points);
    if (status == IMP_STATUS_OK && json_object_get(primitive, "indices") != NULL) {
        if (!gltf_count(primitive, "indices", -1, &index)) return refuse_index(r, "indices");
        status = gltf_accessor_open(&r->data, index, 1, &indices);
        if (status == IMP_STATUS_OK &&
            (!mesh_scalar_is_whole(indices.type) || indices.is_normalized ||
             indices.type == SCALAR_INT8 || indices.type == SCALAR_INT16))
            return gltf_refuse(&r->data, "accessors", index, "",
                               "indices must be unsigned whole numbers");
    }
    if (status == IMP_STATUS_OK) status = add_points(r, &points, place);
    if (status != IMP_STATUS_OK) return status;
    return add_triangles(r, mode, &indices, indices.bytes != NULL ? indices.count : points.count,
                         points.count, gltf_place_is_turned(place));
}

/* --- Nodes ------------------------------------------------------------------------------------ */

enum { DEPTH_MAX = 256 };

static imp_status add_mesh(gltf_reader *r, json_int_t index, const gltf_place *place)
{
    const json_t *mesh, *primitive;
    size_t k;
    imp_status status = gltf_find(&r->data, "meshes", index, &mesh);
    if (status != IMP_STATUS_OK) return status;
    json_array_foreach(json_object_get(mesh, "primitives"), k, primitive)
    {
        status = add_primitive(r, primitive, place);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status add_node(gltf_reader *r, const json_t *number, const gltf_place *above,
                           int depth);

static imp_status add_children(gltf_reader *r, const json_t *list, const gltf_place *above,
                               int depth)
{
    size_t k;
    const json_t *child;
    json_array_foreach(list, k, child)
    {
        const imp_status status = add_node(r, child, above, depth);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

/* A node stands in one place of the tree only, so that the tree ends. */
static imp_status add_node(gltf_reader *r, const json_t *number, const gltf_place *above, int depth)
{
    const json_int_t index = json_is_integer(number) ? json_integer_value(number) : -1;
    const json_t *node;
    json_int_t mesh;
    gltf_place place;
    imp_status status = gltf_find(&r->data, "nodes", index, &node);
    if (status != IMP_STATUS_OK) return status;
    if (r->passed[index] || depth > DEPTH_MAX)
        return gltf_refuse(&r->data, "nodes", index, "",
                           depth > DEPTH_MAX ? "too many nodes above it (256)"
                                             : "must have one parent only");
    r->passed[index] = true;
    if (!gltf_place_under(above, node, &place))
        return gltf_refuse(&r->data, "nodes", index, "",
                           "matrix, translation, rotation and scale must be lists of 16, 3, 4 and "
                           "3 numbers");
    if (json_object_get(node, "skin") != NULL) triangles_note(&r->to->left_out, 0);
    if (json_object_get(node, "mesh") != NULL) {
        if (!gltf_count(node, "mesh", -1, &mesh)) return refuse_index(r, "mesh of a node");
        status = add_mesh(r, mesh, &place);
    }
    if (status != IMP_STATUS_OK) return status;
    return add_children(r, json_object_get(node, "children"), &place, depth + 1);
}

/* Without a scene, the nodes that are nobody's children. */
static imp_status add_roots(gltf_reader *r)
{
    const json_t *nodes = json_object_get(r->data.root, "nodes"), *node, *child;
    size_t k, i;
    json_array_foreach(nodes, k, node)
        json_array_foreach(json_object_get(node, "children"), i, child)
    {
        const json_int_t index = json_integer_value(child);
        if (index >= 0 && (uint64_t)index < r->nodes) r->passed[index] = true;
    }
    json_t *roots = json_array();
    bool kept = roots != NULL;
    for (k = 0; k < r->nodes && kept; ++k)
        if (!r->passed[k]) kept = json_array_append_new(roots, json_integer((json_int_t)k)) == 0;
    memset(r->passed, 0, r->nodes * sizeof *r->passed);
    const imp_status status =
        kept ? add_children(r, roots, &gltf_place_identity, 0) : IMP_STATUS_INTERNAL;
    json_decref(roots);
    return status;
}

static imp_status add_scene(gltf_reader *r)
{
    json_int_t index;
    if (!gltf_count(r->data.root, "scene", 0, &index)) return refuse_index(r, "scene");
    if (json_object_get(r->data.root, "scene") == NULL &&
        gltf_item(r->data.root, "scenes", index) == NULL)
        return add_roots(r);
    const json_t *scene;
    const imp_status status = gltf_find(&r->data, "scenes", index, &scene);
    if (status != IMP_STATUS_OK) return status;
    return add_children(r, json_object_get(scene, "nodes"), &gltf_place_identity, 0);
}

/* --- The document ----------------------------------------------------------------------------- */

/* Extensions that change no point, or that are read. */
static bool is_harmless(const char *name)
{
    static const char *const heads[] = {"KHR_materials_", "KHR_texture_",          "KHR_lights_",
                                        "EXT_texture_",   "KHR_mesh_quantization", "KHR_xmp"};
    for (size_t k = 0; k < sizeof heads / sizeof *heads; ++k)
        if (strncmp(name, heads[k], strlen(heads[k])) == 0) return true;
    return false;
}

static imp_status check_document(const json_t *root, triangles_fault *fault)
{
    const char *version =
        json_string_value(json_object_get(json_object_get(root, "asset"), "version"));
    const json_t *extension;
    size_t k;
    if (version == NULL || strncmp(version, "2.", 2) != 0)
        return triangles_refuse(fault, 0, "/asset/version: '%.20s', must be 2.0",
                                version != NULL ? version : "");
    json_array_foreach(json_object_get(root, "extensionsRequired"), k, extension)
    {
        const char *name = json_string_value(extension);
        if (name == NULL || !is_harmless(name))
            return triangles_refuse(fault, 0,
                                    "needs the extension '%.60s'; write the mesh without it",
                                    name != NULL ? name : "");
    }
    return IMP_STATUS_OK;
}

static imp_status read_document(const char *text, size_t length, gltf_data *data, triangles *to)
{
    json_error_t error;
    if (!triangles_may_take(to, length)) return IMP_STATUS_INTERNAL;
    to->held += length; /* what is parsed holds the texts again, buffers in base64 among them */
    json_t *root = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error);
    if (root == NULL)
        return triangles_refuse(data->fault, error.line > 0 ? (size_t)error.line : 0,
                                "JSON: %.100s", error.text);
    data->root = root;
    gltf_reader r = {
        .data = *data, .to = to, .nodes = json_array_size(json_object_get(root, "nodes"))};
    r.passed = calloc(r.nodes + 1, sizeof *r.passed);
    imp_status status = r.passed != NULL ? check_document(root, data->fault) : IMP_STATUS_INTERNAL;
    if (status == IMP_STATUS_OK) status = add_scene(&r);
    to->has_other_files |= r.data.has_other_files;
    gltf_data_clear(&r.data);
    free(r.passed);
    json_decref(root);
    return status;
}

/* --- The file --------------------------------------------------------------------------------- */

enum { GLB_HEAD = 12, CHUNK_HEAD = 8 };

static size_t word_at(const char *bytes)
{
    return (size_t)mesh_scalar_at(SCALAR_UINT32, false, bytes);
}

/* The chunk at *at, whose length is checked, and on behind it. */
static imp_status next_chunk(const char *bytes, size_t length, size_t *at, const char *type,
                             const char **chunk, size_t *chunk_length, triangles_fault *fault)
{
    if (length - *at < CHUNK_HEAD || memcmp(bytes + *at + 4, type, 4) != 0)
        return triangles_refuse_byte(fault, *at, "a chunk '%.4s' must begin here", type);
    *chunk_length = word_at(bytes + *at);
    if (*chunk_length > length - *at - CHUNK_HEAD)
        return triangles_refuse_byte(fault, *at, "a chunk of %zu bytes, but only %zu are left",
                                     *chunk_length, length - *at - CHUNK_HEAD);
    *chunk = bytes + *at + CHUNK_HEAD;
    *at += CHUNK_HEAD + *chunk_length;
    return IMP_STATUS_OK;
}

static imp_status read_binary(const char *bytes, size_t length, gltf_data *data, triangles *to)
{
    const char *text;
    size_t of_text, at = GLB_HEAD;
    if (length < GLB_HEAD || word_at(bytes + 4) != 2)
        return triangles_refuse_byte(data->fault, 4, "the version must be 2");
    imp_status status = next_chunk(bytes, length, &at, "JSON", &text, &of_text, data->fault);
    if (status == IMP_STATUS_OK && length - at >= CHUNK_HEAD)
        status =
            next_chunk(bytes, length, &at, "BIN", &data->binary, &data->binary_length, data->fault);
    return status == IMP_STATUS_OK ? read_document(text, of_text, data, to) : status;
}

imp_status mesh_read_gltf(const char *bytes, size_t length, const char *folder, triangles *to,
                          triangles_fault *fault)
{
    gltf_data data = {.folder = folder, .fault = fault, .to = to};
    const bool is_binary = length >= 4 && memcmp(bytes, "glTF", 4) == 0;
    return (is_binary ? read_binary : read_document)(bytes, length, &data, to);
}
