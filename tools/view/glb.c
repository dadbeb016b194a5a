/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/json_memory.h"
#include "tools/cli/output.h"
#include "tools/view/animation.h"
#include "tools/view/palette.h"

/* glTF 2.0 (Khronos, 2021): a JSON text of accessors, meshes, nodes and animations, and one buffer
 * behind it. z is up here and y there, so one node above all turns the world. */

enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963, FLOATS = 5126, INDICES = 5125 };

typedef struct glb {
    const film *film;
    FILE *bytes; /* of the buffer */
    size_t length;
    json_t *accessors, *views, *meshes, *nodes, *channels, *samplers, *materials, *roots;
    bool failed;    /* no memory */
    bool too_large; /* a number is none of 32 bits */
    int times;      /* accessor of the frames' moments */
} glb;

static void append(glb *g, json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0) g->failed = true;
}

/* --- The buffer ------------------------------------------------------------------------------- */

static void put_u32(FILE *file, uint32_t word)
{
    for (int k = 0; k < 4; ++k) fputc((int)(word >> (8 * k) & 255), file);
}

static void put_float(glb *g, float value)
{
    uint32_t word;
    if (!isfinite(value)) g->too_large = true;
    memcpy(&word, &value, sizeof word);
    put_u32(g->bytes, word);
    g->length += 4;
}

static int add_view(glb *g, size_t from, int target)
{
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)from,
                             "byteLength", (json_int_t)(g->length - from));
    if (target != 0) json_object_set_new(view, "target", json_integer(target));
    append(g, g->views, view);
    return (int)json_array_size(g->views) - 1;
}

static int add_accessor(glb *g, int view, int component, size_t count, const char *type)
{
    append(g, g->accessors,
           json_pack("{s:i, s:i, s:I, s:s}", "bufferView", view, "componentType", component,
                     "count", (json_int_t)count, "type", type));
    return (int)json_array_size(g->accessors) - 1;
}

/* Adds the least and greatest value of each component, as rounded; glTF requires them for positions
 * and times. */
static void add_ends(glb *g, int accessor, const float *lo, const float *hi, size_t n)
{
    json_t *a = json_array_get(g->accessors, (size_t)accessor), *min = json_array(),
           *max = json_array();
    for (size_t k = 0; k < n; ++k) {
        append(g, min, json_real((double)lo[k]));
        append(g, max, json_real((double)hi[k]));
    }
    if (json_object_set_new(a, "min", min) != 0 || json_object_set_new(a, "max", max) != 0)
        g->failed = true;
}

/* Adds `count` vectors, minus those of `base` unless it is NULL. */
static int add_vectors(glb *g, const vec *x, const vec *base, size_t count, bool ends, int target)
{
    const size_t from = g->length;
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const float value = (float)(x[i].x[k] - (base != NULL ? base[i].x[k] : 0));
            lo[k] = fminf(lo[k], value), hi[k] = fmaxf(hi[k], value);
            put_float(g, value);
        }
    const int accessor = add_accessor(g, add_view(g, from, target), FLOATS, count, "VEC3");
    if (ends) add_ends(g, accessor, lo, hi, 3);
    return accessor;
}

static int add_numbers(glb *g, const double *x, size_t count, const char *type, size_t components,
                       bool ends)
{
    const size_t from = g->length;
    for (size_t i = 0; i < count * components; ++i) put_float(g, (float)x[i]);
    const int accessor = add_accessor(g, add_view(g, from, 0), FLOATS, count, type);
    const float lo = (float)x[0], hi = (float)x[count - 1];
    if (ends) add_ends(g, accessor, &lo, &hi, 1);
    return accessor;
}

static void put_corner(void *context, const mesh *m, const size_t c[3], size_t cell)
{
    glb *g = context;
    (void)m, (void)cell;
    for (int k = 0; k < 3; ++k) put_u32(g->bytes, (uint32_t)c[k]);
    g->length += 12;
}

static int add_triangles(glb *g, const mesh *m)
{
    const size_t from = g->length;
    mesh_triangles(m, put_corner, g);
    return add_accessor(g, add_view(g, from, ELEMENT_ARRAY_BUFFER), INDICES, 3 * m->triangle_count,
                        "SCALAR");
}

/* --- Animation -------------------------------------------------------------------------------- */

static void add_channel(glb *g, int node, const char *path, const char *interpolation, int output)
{
    append(g, g->channels,
           json_pack("{s:i, s:{s:i, s:s}}", "sampler", (int)json_array_size(g->samplers), "target",
                     "node", node, "path", path));
    append(g, g->samplers,
           json_pack("{s:i, s:s, s:i}", "input", g->times, "interpolation", interpolation, "output",
                     output));
}

static bool moves(const track *t, size_t frames)
{
    for (size_t k = 1; k < frames && t->rigid; ++k)
        if (memcmp(&t->poses[0], &t->poses[k], sizeof t->poses[0]) != 0) return true;
    for (size_t k = 1; k < frames && !t->rigid; ++k)
        if (memcmp(t->point, t->point + k * t->count, t->count * sizeof *t->point) != 0)
            return true;
    return false;
}

static void animate_rigid(glb *g, const track *t, int node)
{
    const size_t n = g->film->frames;
    double *turns = calloc(4 * n, sizeof *turns), *shifts = calloc(3 * n, sizeof *shifts);
    if (turns == NULL || shifts == NULL) g->failed = true;
    for (size_t k = 0; k < n && !g->failed; ++k) {
        memcpy(turns + 4 * k, t->poses[k].turn, sizeof t->poses[k].turn);
        memcpy(shifts + 3 * k, t->poses[k].shift.x, sizeof t->poses[k].shift.x);
    }
    if (!g->failed) {
        add_channel(g, node, "rotation", "LINEAR", add_numbers(g, turns, n, "VEC4", 4, false));
        add_channel(g, node, "translation", "LINEAR", add_numbers(g, shifts, n, "VEC3", 3, false));
    }
    free(turns);
    free(shifts);
}

/* Animates the weights: target k - 1 is the shape of frame k; at that frame its weight is 1 and all
 * others are 0. */
static void animate_shape(glb *g, int node)
{
    const size_t n = g->film->frames, targets = n - 1;
    double *weights = calloc(n * targets, sizeof *weights);
    if (weights == NULL) {
        g->failed = true;
        return;
    }
    for (size_t k = 1; k < n; ++k) weights[k * targets + k - 1] = 1;
    add_channel(g, node, "weights", "LINEAR",
                add_numbers(g, weights, n * targets, "SCALAR", 1, false));
    free(weights);
}

/* Animates presence as a scale of 1 or 0. */
static void animate_presence(glb *g, int node, const bool *there)
{
    const size_t n = g->film->frames;
    double *scales = calloc(3 * n, sizeof *scales);
    if (scales == NULL) {
        g->failed = true;
        return;
    }
    for (size_t k = 0; k < 3 * n; ++k) scales[k] = there[k / 3];
    add_channel(g, node, "scale", "STEP", add_numbers(g, scales, n, "VEC3", 3, false));
    free(scales);
}

/* --- Meshes and nodes ------------------------------------------------------------------------- */

static int add_material(glb *g, colour c)
{
    append(g, g->materials,
           json_pack("{s:b, s:{s:[f,f,f,f], s:f, s:f}}", "doubleSided", 1, "pbrMetallicRoughness",
                     "baseColorFactor", pow((double)c.r, 2.2), pow((double)c.g, 2.2),
                     pow((double)c.b, 2.2), 1.0, "metallicFactor", 0.0, "roughnessFactor", 0.55));
    return (int)json_array_size(g->materials) - 1;
}

static json_t *targets_of(glb *g, const track *t)
{
    json_t *targets = json_array();
    for (size_t k = 1; k < g->film->frames; ++k) {
        const vec *point = t->point + k * t->count, *normal = t->normal + k * t->count;
        const int at = add_vectors(g, point, t->point, t->count, true, ARRAY_BUFFER);
        const int n = add_vectors(g, normal, t->normal, t->count, false, ARRAY_BUFFER);
        append(g, targets, json_pack("{s:i, s:i}", "POSITION", at, "NORMAL", n));
    }
    return targets;
}

static int add_node(glb *g, const char *name, size_t surface, int mesh_index)
{
    char label[256];
    snprintf(label, sizeof label, "%.200s, surface %zu", name, surface);
    append(g, g->nodes,
           json_pack("{s:o, s:i}", "name", output_json_text(label), "mesh", mesh_index));
    const int node = (int)json_array_size(g->nodes) - 1;
    append(g, g->roots, json_integer(node));
    return node;
}

static void add_track(glb *g, const track *t)
{
    const bool moving = moves(t, g->film->frames), shape = moving && !t->rigid;
    const int points = add_vectors(g, t->point, NULL, t->count, true, ARRAY_BUFFER);
    const int normals = add_vectors(g, t->normal, NULL, t->count, false, ARRAY_BUFFER);
    const int triangles = add_triangles(g, t->mesh);
    json_t *primitive =
        json_pack("{s:{s:i, s:i}, s:i, s:i}", "attributes", "POSITION", points, "NORMAL", normals,
                  "indices", triangles, "material", add_material(g, palette_colour(t->mesh->body)));
    if (shape && json_object_set_new(primitive, "targets", targets_of(g, t)) != 0) g->failed = true;
    append(g, g->meshes, json_pack("{s:[o]}", "primitives", primitive));
    const int node = add_node(g, imp_scene_body_name(g->film->stage.scene, t->mesh->body),
                              t->mesh->surface, (int)json_array_size(g->meshes) - 1);
    if (shape) animate_shape(g, node);
    if (moving && t->rigid) animate_rigid(g, t, node);
    if (!t->always_there) animate_presence(g, node, t->there);
}

/* --- The file --------------------------------------------------------------------------------- */

static json_t *document(glb *g)
{
    static const char about[] = "impinge " PACKAGE_VERSION;
    append(g, g->nodes,
           json_pack("{s:s, s:[f,f,f,f], s:O}", "name", "scene, z up", "rotation", -sqrt(0.5), 0.0,
                     0.0, sqrt(0.5), "children", g->roots));
    json_t *root =
        json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:O, s:O, s:O, s:O, s:O, s:[{s:I}]}", "asset",
                  "version", "2.0", "generator", about, "scene", 0, "scenes", "nodes",
                  (int)json_array_size(g->nodes) - 1, "nodes", g->nodes, "meshes", g->meshes,
                  "materials", g->materials, "accessors", g->accessors, "bufferViews", g->views,
                  "buffers", "byteLength", (json_int_t)g->length);
    if (json_array_size(g->channels) > 0 &&
        json_object_set_new(root, "animations",
                            json_pack("[{s:s, s:O, s:O}]", "name", "motion", "channels",
                                      g->channels, "samplers", g->samplers)) != 0)
        g->failed = true;
    return root;
}

static void write_chunk(FILE *file, const char *data, size_t length, uint32_t kind, int padding)
{
    put_u32(file, (uint32_t)((length + 3) / 4 * 4));
    put_u32(file, kind);
    fwrite(data, 1, length, file);
    for (; length % 4 != 0; ++length) fputc(padding, file);
}

static void write_glb(FILE *file, const char *json, const char *bytes, size_t length)
{
    const size_t text = (strlen(json) + 3) / 4 * 4;
    put_u32(file, 0x46546C67); /* "glTF" */
    put_u32(file, 2);
    put_u32(file, (uint32_t)(12 + 8 + text + 8 + (length + 3) / 4 * 4));
    write_chunk(file, json, strlen(json), 0x4E4F534A, ' ');
    write_chunk(file, bytes, length, 0x004E4942, 0);
}

static void begin(glb *g)
{
    json_t **const arrays[] = {&g->accessors, &g->views,    &g->meshes,    &g->nodes,
                               &g->channels,  &g->samplers, &g->materials, &g->roots};
    for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; ++k) {
        *arrays[k] = json_array();
        if (*arrays[k] == NULL) g->failed = true;
    }
}

static void end(glb *g)
{
    json_t *const arrays[] = {g->accessors, g->views,    g->meshes,    g->nodes,
                              g->channels,  g->samplers, g->materials, g->roots};
    for (size_t k = 0; k < sizeof arrays / sizeof arrays[0]; ++k) json_decref(arrays[k]);
}

static imp_code refuse(imp_error *error, const char *why)
{
    error->code = IMP_ERROR_USAGE;
    snprintf(error->text, sizeof error->text, "%s", why);
    return error->code;
}

static imp_code add_tracks(glb *g, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < g->film->count && !g->failed && code == IMP_SUCCESS; ++k) {
        add_track(g, &g->film->tracks[k]);
        code = allowance_check(g->film->stage.allowance, "the file was written", error);
    }
    if (code != IMP_SUCCESS) return code;
    if (g->failed && !g->too_large) return mesh_no_memory(error);
    if (g->too_large)
        return refuse(error,
                      "glTF holds numbers of 32 bits, up to 3.4e+38: coordinates or times here "
                      "are larger; choose a larger unit");
    if (g->length > UINT32_MAX / 2)
        return refuse(error,
                      "glTF holds less than 4 GiB: ask for fewer moments (--frames) or less exact "
                      "surfaces (--tolerance)");
    return code;
}

static void add_times(glb *g)
{
    const film *f = g->film;
    double *seconds = calloc(f->frames, sizeof *seconds);
    if (seconds == NULL) g->failed = true;
    for (size_t k = 0; k < f->frames && !g->failed; ++k) seconds[k] = f->times[k] - f->times[0];
    if (!g->failed && f->frames > 1)
        g->times = add_numbers(g, seconds, f->frames, "SCALAR", 1, true);
    free(seconds);
}

imp_code animation_glb(const film *f, FILE *file, imp_error *error)
{
    char *bytes = NULL, *text = NULL;
    size_t size = 0;
    glb g = {.film = f, .bytes = open_memstream(&bytes, &size)};
    if (g.bytes == NULL) return mesh_no_memory(error);
    begin(&g);
    add_times(&g);
    imp_code code = add_tracks(&g, error);
    json_t *root = code == IMP_SUCCESS ? document(&g) : NULL;
    text = json_memory_text(root, JSON_COMPACT | JSON_REAL_PRECISION(17));
    if (fclose(g.bytes) != 0 || (code == IMP_SUCCESS && (text == NULL || g.failed)))
        code = mesh_no_memory(error);
    if (code == IMP_SUCCESS) write_glb(file, text, bytes, size);
    free(text);
    free(bytes);
    json_decref(root);
    end(&g);
    return code;
}
