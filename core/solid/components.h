/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_COMPONENTS_H
#define CORE_SOLID_COMPONENTS_H

#include "core/solid/patches.h"

/* The connected parts of a body
 * =============================
 * Each patch is connected. Two of them that come nearer to each other than `near` at corners of
 * theirs are on the same side of every surface that both are at least `near` away from. Patches
 * that are connected elsewhere only count as parts of their own, which costs time and nothing
 * else. */

/* Points of a patch: its corners and its middle. */
enum { PATCH_SAMPLES = 5 };
typedef struct patch_samples {
    double uv[PATCH_SAMPLES][2];
    vec3 x[PATCH_SAMPLES];
    double off[PATCH_SAMPLES]; /* the exact points are within these; length */
} patch_samples;

typedef struct components {
    patch_samples *samples; /* by patch */
    size_t *of;             /* by patch: the number of its component, from 0 */
    size_t count;
} components;

/* Finds the components of patches whose domains may be infinite. Call components_free in any case.
 * Fails with IMP_ERROR_MEMORY, or as plugins do. */
imp_code components_find(components *c, const patches *p, double near, imp_error *error);
void components_free(components *c);

/* Returns the most memory that components_find takes. */
size_t components_bytes(size_t count);

#endif
