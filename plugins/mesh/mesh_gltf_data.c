/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_gltf_data.h"

#include "plugins/mesh/mesh_bytes.h"

/* --- The document ----------------------------------------------------------------------------- */

const json_t *gltf_item(const json_t *root, const char *list, json_int_t index)
{
    if (index < 0) return NULL;
    const json_t *item = json_array_get(json_object_get(root, list), (size_t)index);
    return json_is_object(item) ? item : NULL;
}

imp_status gltf_refuse(const gltf_data *d, const char *list, json_int_t index, const char *where,
                       const char *what)
{
    return triangles_refuse(d->fault, 0, "/%s/%lld%s: %s", list, (long long)index, where, what);
}

imp_status gltf_find(const gltf_data *d, const char *list, json_int_t index, const json_t **item)
{
    *item = gltf_item(d->root, list, index);
    if (*item != NULL) return IMP_STATUS_OK;
    return triangles_refuse(d->fault, 0, "/%s/%lld does not exist", list, (long long)index);
}

bool gltf_count(const json_t *object, const char *key, json_int_t preset, json_int_t *value)
{
    const json_t *json = json_object_get(object, key);
    *value = json != NULL ? json_integer_value(json) : preset;
    return (json == NULL || json_is_integer(json)) && *value >= 0;
}

void gltf_data_clear(gltf_data *d)
{
    const size_t count = json_array_size(json_object_get(d->root, "buffers"));
    for (size_t k = 0; k < count && d->buffers != NULL; ++k) free(d->buffers[k].owned);
    free(d->buffers);
    d->buffers = NULL;
}

/* --- Buffers ---------------------------------------------------------------------------------- */

static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/* The bytes of a text in base64 up to its '='; false: it holds another character. */
static bool decode(const char *text, char *bytes, size_t *length)
{
    unsigned bits = 0;
    int have = 0;
    *length = 0;
    for (; *text != '\0' && *text != '='; ++text) {
        const int digit = base64_digit(*text);
        if (digit < 0) return false;
        bits = (bits << 6 | (unsigned)digit) & 0xffff;
        have += 6;
        if (have < 8) continue;
        have -= 8;
        bytes[(*length)++] = (char)(bits >> have & 0xff);
    }
    return text[strspn(text, "=")] == '\0';
}

static imp_status open_text(gltf_data *d, const char *uri, json_int_t index, gltf_buffer *b)
{
    const char *mark = strstr(uri, ";base64,");
    if (mark == NULL) return gltf_refuse(d, "buffers", index, "/uri", "data that is not in base64");
    const char *text = mark + strlen(";base64,");
    const size_t size = strlen(text) / 4 * 3 + 4;
    if (!triangles_may_take(d->to, size)) return IMP_STATUS_INTERNAL;
    d->to->held += size;
    b->owned = malloc(size);
    if (b->owned == NULL) return IMP_STATUS_INTERNAL;
    if (!decode(text, b->owned, &b->length))
        return gltf_refuse(d, "buffers", index, "/uri", "a character that is not base64");
    return IMP_STATUS_OK;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* Folder and name, in which "%20" is a blank. False: too long for `path`. */
static bool write_path(const char *folder, const char *uri, char *path, size_t size)
{
    size_t used = strlen(folder);
    if (used >= size) return false;
    memcpy(path, folder, used);
    while (*uri != '\0') {
        if (used + 1 >= size) return false;
        const int high = *uri == '%' ? hex_digit(uri[1]) : -1;
        const int low = high >= 0 ? hex_digit(uri[2]) : -1;
        const bool is_code = low >= 0 && high + low > 0;
        path[used++] = is_code ? (char)(16 * high + low) : *uri;
        uri += is_code ? 3 : 1;
    }
    path[used] = '\0';
    return true;
}

static imp_status open_file(gltf_data *d, const char *uri, json_int_t index, gltf_buffer *b)
{
    char path[4096];
    if (d->folder == NULL || *uri == '/' || strstr(uri, "://") != NULL)
        return triangles_refuse(d->fault, 0,
                                "/buffers/%lld/uri: '%.60s', must be a file beside this one, or "
                                "data",
                                (long long)index, uri);
    if (!write_path(d->folder, uri, path, sizeof path))
        return gltf_refuse(d, "buffers", index, "/uri", "too long a name");
    d->has_other_files = true;
    if (d->to->why != NULL && !imp_reads(d->to->why, path)) return IMP_STATUS_INTERNAL;
    const imp_status status = mesh_read_whole(path, &b->owned, &b->length, d->to, d->fault);
    if (status == IMP_STATUS_OK) d->to->held += b->length;
    return status;
}

static imp_status load(gltf_data *d, const json_t *buffer, json_int_t index, gltf_buffer *b)
{
    const char *uri = json_string_value(json_object_get(buffer, "uri"));
    json_int_t length;
    imp_status status = IMP_STATUS_OK;
    if (uri == NULL) {
        b->bytes = index == 0 ? d->binary : NULL;
        b->length = d->binary_length;
    } else {
        status = strncmp(uri, "data:", 5) == 0 ? open_text(d, uri, index, b)
                                               : open_file(d, uri, index, b);
        b->bytes = b->owned;
    }
    if (status != IMP_STATUS_OK) return status;
    if (b->bytes == NULL)
        return gltf_refuse(d, "buffers", index, "", "no uri, and no bytes in the file");
    if (!gltf_count(buffer, "byteLength", -1, &length) || (uint64_t)length > b->length)
        return triangles_refuse(d->fault, 0,
                                "/buffers/%lld/byteLength: %lld of %zu bytes that are there",
                                (long long)index, (long long)length, b->length);
    b->length = (size_t)length;
    return IMP_STATUS_OK;
}

static imp_status open_buffer(gltf_data *d, json_int_t index, const gltf_buffer **found)
{
    const json_t *buffer;
    const imp_status status = gltf_find(d, "buffers", index, &buffer);
    if (status != IMP_STATUS_OK) return status;
    if (d->buffers == NULL) {
        const size_t count = json_array_size(json_object_get(d->root, "buffers"));
        d->buffers = calloc(count, sizeof *d->buffers);
        if (d->buffers == NULL) return IMP_STATUS_INTERNAL;
    }
    gltf_buffer *b = &d->buffers[index];
    *found = b;
    return b->bytes != NULL ? IMP_STATUS_OK : load(d, buffer, index, b);
}

/* --- Accessors -------------------------------------------------------------------------------- */

static bool find_type(json_int_t code, mesh_scalar *type)
{
    static const mesh_scalar types[] = {SCALAR_INT8,  SCALAR_UINT8,  SCALAR_INT16,  SCALAR_UINT16,
                                        SCALAR_INT32, SCALAR_UINT32, SCALAR_FLOAT32};
    enum { FIRST = 5120, SIGNED_32 = 5124 };
    if (code < FIRST || code > FIRST + 6 || code == SIGNED_32) return false;
    *type = types[code - FIRST];
    return true;
}

/* The bytes of a view, and how far apart its items are; 0: as close as they are long. */
static imp_status open_view(gltf_data *d, json_int_t index, const char **bytes, size_t *length,
                            size_t *stride)
{
    const json_t *view;
    json_int_t buffer, offset, size, apart;
    const gltf_buffer *b = NULL;
    imp_status status = gltf_find(d, "bufferViews", index, &view);
    if (status != IMP_STATUS_OK) return status;
    if (!gltf_count(view, "buffer", -1, &buffer) || !gltf_count(view, "byteOffset", 0, &offset) ||
        !gltf_count(view, "byteLength", -1, &size) || !gltf_count(view, "byteStride", 0, &apart))
        return gltf_refuse(
            d, "bufferViews", index, "",
            "buffer, byteOffset, byteLength and byteStride must be whole numbers from 0");
    status = open_buffer(d, buffer, &b);
    if (status != IMP_STATUS_OK) return status;
    if ((uint64_t)offset > b->length || (uint64_t)size > b->length - (size_t)offset)
        return gltf_refuse(d, "bufferViews", index, "", "ends behind its buffer");
    *bytes = b->bytes + offset;
    *length = (size_t)size;
    *stride = (uint64_t)apart < SIZE_MAX / 2 ? (size_t)apart : SIZE_MAX / 2;
    return IMP_STATUS_OK;
}

imp_status gltf_accessor_open(gltf_data *d, json_int_t index, int width, gltf_accessor *made)
{
    const json_t *a;
    json_int_t view, offset, code, count;
    size_t length = 0;
    *made = (gltf_accessor){.width = width};
    imp_status status = gltf_find(d, "accessors", index, &a);
    if (status != IMP_STATUS_OK) return status;
    if (json_object_get(a, "sparse") != NULL)
        return gltf_refuse(d, "accessors", index, "",
                           "is sparse; write the mesh without sparse accessors");
    const char *type = json_string_value(json_object_get(a, "type"));
    if (type == NULL || strcmp(type, width == 1 ? "SCALAR" : "VEC3") != 0)
        return gltf_refuse(d, "accessors", index, "",
                           width == 1 ? "type must be SCALAR" : "type must be VEC3");
    if (!gltf_count(a, "bufferView", -1, &view) || !gltf_count(a, "byteOffset", 0, &offset) ||
        !gltf_count(a, "count", -1, &count))
        return gltf_refuse(d, "accessors", index, "",
                           "bufferView, byteOffset and count must be whole numbers from 0");
    if (!gltf_count(a, "componentType", -1, &code) || !find_type(code, &made->type))
        return gltf_refuse(d, "accessors", index, "",
                           "componentType must be 5120 to 5126, and not 5124");
    status = open_view(d, view, &made->bytes, &length, &made->stride);
    if (status != IMP_STATUS_OK) return status;
    const size_t item = (size_t)width * mesh_scalar_size(made->type);
    if (made->stride == 0) made->stride = item;
    const bool fits = (uint64_t)offset <= length && item <= length - (size_t)offset;
    if (count > 0 &&
        (!fits || (uint64_t)count - 1 > (length - (size_t)offset - item) / made->stride))
        return gltf_refuse(d, "accessors", index, "", "ends behind its bufferView");
    made->bytes += count > 0 ? offset : 0;
    made->count = (size_t)count;
    made->is_normalized = json_is_true(json_object_get(a, "normalized"));
    return IMP_STATUS_OK;
}

double gltf_accessor_at(const gltf_accessor *a, size_t k, int i)
{
    static const double full[] = {127, 255, 32767, 65535, 0x1p31 - 1, 0x1p32 - 1};
    const char *at = a->bytes + k * a->stride + (size_t)i * mesh_scalar_size(a->type);
    const double x = mesh_scalar_at(a->type, false, at);
    if (!a->is_normalized || !mesh_scalar_is_whole(a->type)) return x;
    return x < -full[a->type] ? -1 : x / full[a->type];
}
