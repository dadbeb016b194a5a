/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_GLB_BUFFER_H
#define TOOLS_VIEW_GLB_BUFFER_H

#include <jansson.h>
#include <stdint.h>
#include <stdio.h>

#include "tools/view/film.h"

/* The buffer of a glTF file
 * =========================
 * Numbers stand one after the other in one buffer. The JSON text says by views where they begin,
 * and by accessors what they are; functions that add numbers return the index of the accessor. */

typedef struct glb {
    const film *film;
    FILE *bytes; /* of the buffer */
    size_t length;
    json_t *accessors, *views, *meshes, *nodes, *channels, *samplers, *materials, *roots;
    bool failed;    /* no memory */
    bool too_large; /* a number is none of 32 bits */
    int times;      /* accessor of the frames' moments */
} glb;

/* Appends a value to one of the arrays; `value` NULL: no memory. */
void glb_append(glb *g, json_t *array, json_t *value);

/* Writes a word, the lowest byte first. */
void glb_put_u32(FILE *file, uint32_t word);

enum { GLB_ARRAY_BUFFER = 34962 }; /* a target: what vertices are made of */

/* Adds `count` vectors, minus those of `base` unless it is NULL. `ends`: with the least and
 * greatest value of each component. */
int glb_add_vectors(glb *g, const vec *x, const vec *base, size_t count, bool ends, int target);

/* Adds `count` elements of glTF's type (such as "VEC3") that has so many components. `ends`: with
 * the first and the last number as the least and greatest, for times. */
int glb_add_numbers(glb *g, const double *x, size_t count, const char *type, size_t components,
                    bool ends);

/* Adds the triangles of a mesh as indices of its points. */
int glb_add_triangles(glb *g, const mesh *m);

#endif
