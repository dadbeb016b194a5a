/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_PATCHES_H
#define TOOLS_SIMULATE_PATCHES_H

#include <impinge/impinge.h>

#include "tools/simulate/limits.h"
#include "tools/simulate/rigid.h"

/* The patches of a body
 * =====================
 * A patch is a surface over its domain in (u, v), or one piece of a surface that consists of pieces
 * (a triangle of a mesh). Everything here is evaluated at one time, with the body's own maps
 * applied. */

typedef struct patch {
    imp_place place;
    double lo[2], hi[2]; /* domain of u and v */
} patch;

typedef struct patches {
    const imp_scene *scene;
    double t;
    const limits *limits; /* end long computations; borrowed */
    patch *patch;
    size_t count;
    double size; /* diagonal of a box around points of all patches, length */
} patches;

/* What was found out about a body. */
typedef enum shape_verdict {
    SHAPE_FOUND,
    SHAPE_OPEN,      /* an edge borders on nothing */
    SHAPE_ONE_SIDED, /* its surfaces have no inside and outside, as a Moebius strip */
    SHAPE_FLAT,      /* it encloses no volume */
    SHAPE_UNBOUNDED, /* a domain is infinite, or points are farther than 1e50 away */
    SHAPE_STOPPED,   /* a limit or a signal came */
    SHAPE_NO_MEMORY,
    SHAPE_FAULT /* of a plugin */
} shape_verdict;

/* Lists the patches of a body at time t. `why` is set with SHAPE_FAULT. Call patches_free in any
 * case. */
shape_verdict patches_read(patches *p, const imp_scene *scene, size_t body, double t,
                           const limits *end, imp_error *why);
void patches_free(patches *p);

/* Most points that one call evaluates. */
enum { PATCH_POINTS_MAX = 129 };

/* n points along a line of the domain of a patch, from one (u, v) to another, both included; n is
 * from 2 to PATCH_POINTS_MAX. */
shape_verdict patch_line(const patches *p, size_t index, const double from[2], const double to[2],
                         int n, vec *x, imp_error *why);

/* Returns the points of a grid over a patch, (cells + 1)^2, those along v next to each other;
 * `cells` is below PATCH_POINTS_MAX. */
shape_verdict patch_grid(const patches *p, size_t index, int cells, vec *at, imp_error *why);

#endif
