/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/glb_buffer.h"

#include <math.h>
#include <string.h>

enum { ELEMENT_ARRAY_BUFFER = 34963, FLOATS = 5126, INDICES = 5125 };

void glb_append(glb *g, json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0) g->failed = true;
}

void glb_put_u32(FILE *file, uint32_t word)
{
    for (int k = 0; k < 4; ++k) fputc((int)(word >> (8 * k) & 255), file);
}

static void put_float(glb *g, float value)
{
    uint32_t word;
    if (!isfinite(value)) g->too_large = true;
    memcpy(&word, &value, sizeof word);
    glb_put_u32(g->bytes, word);
    g->length += 4;
}

static int add_view(glb *g, size_t from, int target)
{
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)from,
                             "byteLength", (json_int_t)(g->length - from));
    if (target != 0) json_object_set_new(view, "target", json_integer(target));
    glb_append(g, g->views, view);
    return (int)json_array_size(g->views) - 1;
}

static int add_accessor(glb *g, int view, int component, size_t count, const char *type)
{
    glb_append(g, g->accessors,
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
        glb_append(g, min, json_real((double)lo[k]));
        glb_append(g, max, json_real((double)hi[k]));
    }
    if (json_object_set_new(a, "min", min) != 0 || json_object_set_new(a, "max", max) != 0)
        g->failed = true;
}

int glb_add_vectors(glb *g, const vec *x, const vec *base, size_t count, bool ends, int target)
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

int glb_add_numbers(glb *g, const double *x, size_t count, const char *type, size_t components,
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
    for (int k = 0; k < 3; ++k) glb_put_u32(g->bytes, (uint32_t)c[k]);
    g->length += 12;
}

int glb_add_triangles(glb *g, const mesh *m)
{
    const size_t from = g->length;
    mesh_triangles(m, put_corner, g);
    return add_accessor(g, add_view(g, from, ELEMENT_ARRAY_BUFFER), INDICES, 3 * m->triangle_count,
                        "SCALAR");
}
