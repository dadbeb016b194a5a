/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_PLACED_H
#define TOOLS_SIMULATE_PLACED_H

#include "tools/simulate/mover.h"

/* A body where it is at one time: its surfaces as its own maps leave them, turned and shifted by
 * its motion. */
typedef struct placed {
    const imp_scene *still;
    size_t body;
    double t;
    bool moves;
    mat3 turn; /* world = position + turn (x - center); of those that move */
    vec position, center;
} placed;

/* `state` is used for bodies that move. */
placed placed_at(const setup *s, size_t body, double t, const mover_state *state);

/* n points (u, v) of a patch, to x. */
enum { PLACED_POINTS_MAX = 9 };
imp_code placed_eval(const placed *p, imp_place place, size_t n, const double (*uv)[2], vec *x,
                     imp_error *why);

/* Between the world and the axes in which the body's own maps leave it. */
vec placed_outward(const placed *p, vec x);
vec placed_inward(const placed *p, vec x);

#endif
