/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_PIECE_SHADOW_H
#define CORE_BOUNDS_PIECE_SHADOW_H

#include "core/bounds/piece_sides.h"

/* All of one surface at all times of a course, as planes of the other see it
 * ==========================================================================
 * What a surface sweeps while it turns about a line by any angle is round about the line; its
 * points' places along the line and beside it are enough to tell the least n.x, for any n. */

/* Points such that the least value of n.x at all times of the course, but for its way and what is
 * left out (piece_shadow.c), is the least piece_shadow_at of them. Where the course does not spin,
 * they are corners of cells, in order, 4 of each; else places along the line and beside it. */
typedef struct shadow_point {
    vec3 p, axis;
    double radius, slack; /* of a corner's circle about the axis, and of its cell; length */
    size_t cell;          /* whose corner it is */
} shadow_point;

typedef struct piece_shadow {
    const surface_course *course;
    shadow_point *of;
    size_t count;
    double reach;       /* >= |x| + radius + slack of each corner, seen from a; length */
    arena_store *store; /* of its memory */
} piece_shadow;         /* piece_shadow_clear frees */

/* Takes all of of->other. IMP_ERROR_MEMORY. */
imp_code piece_shadow_take(const piece_course *of, piece_shadow *s, imp_error *error);
void piece_shadow_clear(piece_shadow *s);

/* The cell of b as a sees it, but for S(t) and the way. Its slack has what a hoop loses, as numbers
 * are no exact rotation. */
piece_cell piece_shadow_seen(const piece_course *of, const piece_cell *cell);

/* The least n.(S z - c) for points of b, without way and what is left out; n.S z where the course
 * does not spin. *cell is one that has it. */
double piece_shadow_least(const piece_shadow *s, vec3 n, size_t *cell);

/* Nearly the point that has it, for n of any length. */
vec3 piece_shadow_lowest(const piece_shadow *s, vec3 n);

#endif
