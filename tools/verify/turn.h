/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_TURN_H
#define TOOLS_VERIFY_TURN_H

#include "tools/verify/motion.h"

/* Maps that depend on time through one angle
 * ==========================================
 * A rotation takes x to m[0] x + cos A m[1] x + sin A m[2] x, A being the only number in it that
 * time changes. So much is read off the steps of a formula; what the m are, and how A goes, does
 * not matter: cos A and sin A are a point of the unit circle. */

typedef struct turning {
    ld_interval m[3][3][4]; /* of 1, cos A and sin A; by row and column, the last one the shift */
    double rate;            /* at which A changes while the claim lasts, about */
} turning;

/* Returns what an affine map is by its angle, to be freed; NULL: it depends on time otherwise, or
 * not at all, or there is no memory. */
turning *turn_of_map(const part *p, const scene_clock *t, jet room[]);

/* A shape that depends on u through one angle alone: its points are s[0] + cos A s[1] + sin A s[2],
 * s functions of v and t. */
typedef struct circle {
    formula *with_numbers; /* of u, v, t, and what cos A and sin A are */
} circle;

/* Returns what a part of a shape is by such an angle; NULL: it is none, or there is no memory. */
circle *circle_of_part(const part *p, jet room[]);
void circle_free(circle *c); /* may be NULL */

/* Computes s over the box, and at its centre, without second derivatives there. */
enum { CIRCLE_PARTS = 3 };
void circle_take(const circle *c, const box3 *where, const double at[3], jet room[],
                 jet wide[CIRCLE_PARTS][3], jet centre[CIRCLE_PARTS][3]);

#endif
