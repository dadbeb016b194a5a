/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_TOUCH_H
#define TOOLS_SIMULATE_TOUCH_H

#include "tools/simulate/meeting.h"

/* Where two bodies touch, for the response
 * ========================================
 * A contact's witness is two points no farther apart than gamma, not the nearest two: the direction
 * from one to the other may be far from the normal. So the distance is minimized from there, by
 * Newton's method on both surfaces' parameters; the normal is the direction between the nearest
 * points, which is right at edges and corners too. Nothing of this is part of the promise. */

typedef struct touching {
    vec point;    /* halfway */
    vec normal;   /* unit, from the first body to the second */
    vec drift[2]; /* velocity of either surface at its point beyond the rigid motion: that of a
                     driven body, or of a deformation */
} touching;

/* The scene of `m` is made, the witness is that of `at`, a contact. */
imp_code touching_find(searching *s, const meeting *m, const meeting *at, touching *out);

#endif
