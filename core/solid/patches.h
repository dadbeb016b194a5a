/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_PATCHES_H
#define CORE_SOLID_PATCHES_H

#include "core/base/limit_watch.h"
#include "core/scene/scene.h"
#include "core/tree/vec.h"

/* The patches of a body at one time
 * =================================
 * A patch is a surface over its domain in (u, v), or one piece of a surface that consists of
 * pieces. Surfaces that do not exist at the time have none. */

typedef struct patch {
    const surface *surface;
    imp_place place;
    double lo[2], hi[2]; /* domain of u and v */
} patch;

typedef struct patches {
    double t;
    patch *patch; /* by surface, then by piece */
    size_t count;
    double size;  /* diagonal of a box around points of all patches, length */
    bool bounded; /* domains are finite, and no point is farther than 1e50 away */
} patches;

/* Lists the patches; free them in any case. Fails with IMP_ERROR_MEMORY, or as surface_eval
 * fails. */
imp_code solid_patches_read(patches *p, const imp_scene *scene, size_t body, double t,
                            imp_error *error);
void solid_patches_free(patches *p);

/* Returns how many patches a body has at most. */
size_t solid_patches_most(const imp_scene *scene, size_t body);

/* Evaluates n points (u, v) of a patch, at most PATCH_POINTS_MAX. `errors` may be NULL, or takes
 * bounds of each point's distance from the exact one; length. Fails as the plugin does. */
enum { PATCH_POINTS_MAX = 129 };
imp_code patch_eval(const patch *p, double t, size_t n, const double (*uv)[2], vec3 *x,
                    double *errors, imp_error *error);

/* Computes the models of a patch over a region, which is at one time; infinite where there are
 * none. Fails as the plugin does. */
imp_code patch_include(const patch *p, const imp_region *region, imp_model model[3],
                       imp_error *error);

/* Sets *at to the corner k of the domain, counter-clockwise from (lo, lo): side k leads from corner
 * k to corner k + 1. */
void patch_corner(const patch *p, int k, double at[2]);

/* Returns the number at k / n of the way; both ends are met exactly. */
static inline double patch_between(double from, double to, int k, int n)
{
    return k == n ? to : from + (to - from) * k / n;
}

#endif
