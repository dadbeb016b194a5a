/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_MESH_MESH_GLTF_DATA_H
#define PLUGINS_MESH_MESH_GLTF_DATA_H

#include "plugins/mesh/mesh_scalar.h"
#include "plugins/mesh/triangles.h"

#include <jansson.h>

/* What a glTF document says of bytes: buffers (part of the file, text in base64, or files beside
 * it), views of these, and accessors, which are lists of numbers in a view. No offset, length or
 * count is believed before it fits into the bytes that are there. */

typedef struct gltf_buffer {
    const char *bytes; /* NULL: not asked for so far */
    size_t length;
    char *owned; /* for free(); NULL: part of the file */
} gltf_buffer;

typedef struct gltf_data {
    const json_t *root;
    const char *binary; /* the binary chunk of a .glb; NULL: none */
    size_t binary_length;
    const char *folder;   /* of the file, with '/' at its end; NULL: files are not opened */
    gltf_buffer *buffers; /* as many as the document has; NULL before the first */
    bool has_other_files; /* some were opened */
    triangles_fault *fault;
    triangles *to; /* counts what is held */
} gltf_data;

void gltf_data_clear(gltf_data *d);

/* A list of `count` items of `width` numbers. */
typedef struct gltf_accessor {
    const char *bytes;
    size_t count, stride; /* bytes from item to item */
    int width;
    mesh_scalar type;
    bool is_normalized; /* whole numbers stand for -1 to 1, or 0 to 1 */
} gltf_accessor;

/* The accessor of that number, whose items must be of `width` numbers: 1 or 3. */
imp_status gltf_accessor_open(gltf_data *d, json_int_t index, int width, gltf_accessor *made);

/* Number i of item k, which there are. */
double gltf_accessor_at(const gltf_accessor *a, size_t k, int i);

/* The item of that number in a list of the document, an object; NULL: there is none. */
const json_t *gltf_item(const json_t *root, const char *list, json_int_t index);

/* The item that gltf_item finds; that there is none is refused. */
imp_status gltf_find(const gltf_data *d, const char *list, json_int_t index, const json_t **item);

/* Refuses an item of a list, or what `where` names below it ("/uri"; "": itself). */
imp_status gltf_refuse(const gltf_data *d, const char *list, json_int_t index, const char *where,
                       const char *what);

/* A whole number that is not negative. False: the key has anything else; where it is missing,
 * *value is `preset`, and a preset below 0 is false too. */
bool gltf_count(const json_t *object, const char *key, json_int_t preset, json_int_t *value);

#endif
