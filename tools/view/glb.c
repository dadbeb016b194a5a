/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/json_memory.h"
#include "tools/cli/output.h"
#include "tools/view/animation.h"
#include "tools/view/glb_buffer.h"
#include "tools/view/palette.h"

/* glTF 2.0 (Khronos, 2021): a JSON text of accessors, meshes, nodes and animations, and one buffer
 * behind it. z is up here and y there, so one node above all turns the world. */

/* --- Animation -------------------------------------------------------------------------------- */

static void add_channel(glb *g, int node, const char *path, const char *interpolation, int output)
{
    glb_append(g, g->channels,
               json_pack("{s:i, s:{s:i, s:s}}", "sampler", (int)json_array_size(g->samplers),
                         "target", "node", node, "path", path));
    glb_append(g, g->samplers,
               json_pack("{s:i, s:s, s:i}", "input", g->times, "interpolation", interpolation,
                         "output", output));
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
        add_channel(g, node, "rotation", "LINEAR", glb_add_numbers(g, turns, n, "VEC4", 4, false));
        add_channel(g, node, "translation", "LINEAR",
                    glb_add_numbers(g, shifts, n, "VEC3", 3, false));
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
                glb_add_numbers(g, weights, n * targets, "SCALAR", 1, false));
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
    add_channel(g, node, "scale", "STEP", glb_add_numbers(g, scales, n, "VEC3", 3, false));
    free(scales);
}

/* --- Meshes and nodes ------------------------------------------------------------------------- */

static int add_material(glb *g, colour c)
{
    glb_append(g, g->materials,
               json_pack("{s:b, s:{s:[f,f,f,f], s:f, s:f}}", "doubleSided", 1,
                         "pbrMetallicRoughness", "baseColorFactor", pow((double)c.r, 2.2),
                         pow((double)c.g, 2.2), pow((double)c.b, 2.2), 1.0, "metallicFactor", 0.0,
                         "roughnessFactor", 0.55));
    return (int)json_array_size(g->materials) - 1;
}

static json_t *targets_of(glb *g, const track *t)
{
    json_t *targets = json_array();
    for (size_t k = 1; k < g->film->frames; ++k) {
        const vec *point = t->point + k * t->count, *normal = t->normal + k * t->count;
        const int at = glb_add_vectors(g, point, t->point, t->count, true, GLB_ARRAY_BUFFER);
        const int n = glb_add_vectors(g, normal, t->normal, t->count, false, GLB_ARRAY_BUFFER);
        glb_append(g, targets, json_pack("{s:i, s:i}", "POSITION", at, "NORMAL", n));
    }
    return targets;
}

static int add_node(glb *g, const char *name, size_t surface, int mesh_index)
{
    char label[256];
    snprintf(label, sizeof label, "%.200s, surface %zu", name, surface);
    glb_append(g, g->nodes,
               json_pack("{s:o, s:i}", "name", output_json_text(label), "mesh", mesh_index));
    const int node = (int)json_array_size(g->nodes) - 1;
    glb_append(g, g->roots, json_integer(node));
    return node;
}

static void add_track(glb *g, const track *t)
{
    const bool moving = moves(t, g->film->frames), shape = moving && !t->rigid;
    const int points = glb_add_vectors(g, t->point, NULL, t->count, true, GLB_ARRAY_BUFFER);
    const int normals = glb_add_vectors(g, t->normal, NULL, t->count, false, GLB_ARRAY_BUFFER);
    const int triangles = glb_add_triangles(g, t->mesh);
    json_t *primitive =
        json_pack("{s:{s:i, s:i}, s:i, s:i}", "attributes", "POSITION", points, "NORMAL", normals,
                  "indices", triangles, "material", add_material(g, palette_colour(t->mesh->body)));
    if (shape && json_object_set_new(primitive, "targets", targets_of(g, t)) != 0) g->failed = true;
    glb_append(g, g->meshes, json_pack("{s:[o]}", "primitives", primitive));
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
    glb_append(g, g->nodes,
               json_pack("{s:s, s:[f,f,f,f], s:O}", "name", "scene, z up", "rotation", -sqrt(0.5),
                         0.0, 0.0, sqrt(0.5), "children", g->roots));
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
    glb_put_u32(file, (uint32_t)((length + 3) / 4 * 4));
    glb_put_u32(file, kind);
    fwrite(data, 1, length, file);
    for (; length % 4 != 0; ++length) fputc(padding, file);
}

static void write_glb(FILE *file, const char *json, const char *bytes, size_t length)
{
    const size_t text = (strlen(json) + 3) / 4 * 4;
    glb_put_u32(file, 0x46546C67); /* "glTF" */
    glb_put_u32(file, 2);
    glb_put_u32(file, (uint32_t)(12 + 8 + text + 8 + (length + 3) / 4 * 4));
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
        g->times = glb_add_numbers(g, seconds, f->frames, "SCALAR", 1, true);
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
