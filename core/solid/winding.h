/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_WINDING_H
#define CORE_SOLID_WINDING_H

#include "core/solid/patches.h"
#include "core/solid/solid_angle.h"

/* The solid angle of a patch of any type
 * ======================================
 * Enclosed by models and points alone: the patch is divided into parts whose boxes do not hold the
 * point x, each part is replaced by triangles, and the difference is bounded (winding.c). */

/* What is asked of all patches alike. */
typedef struct winding_view {
    double t;
    vec3 x;       /* exact; length */
    double slack; /* edges of patches may be so far from those of their neighbours; length */
    double
        fineness; /* edges are divided until a chord is off by this part of its distance from x */
} winding_view;

typedef struct winding_sum {
    enclosed_angle seen;
    double distance; /* no point of the patches is nearer to x than this; length */
} winding_sum;       /* begins as {{0, 0}, INFINITY} */

/* Adds the solid angle of a patch, times its sign. Where x is too near to tell, the error is at
 * least FULL_ANGLE and the distance 0. Fails as the plugin does. */
imp_code winding_add(const winding_view *view, const patch *p, int sign, winding_sum *sum,
                     imp_error *error);

#endif
