/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_TOUCH_H
#define TOOLS_SIMULATE_TOUCH_H

#include "tools/simulate/impact.h"
#include "tools/simulate/outline.h"
#include "tools/simulate/placed.h"

/* Where two bodies touch
 * ======================
 * A witness of contact is two points no farther apart than gamma, not the nearest two: the
 * direction from one to the other may be far from the normal. So the nearest points of all patches
 * around the witness are searched (closest.h). Through the middle between them, normal to their
 * line, goes the plane of contact; what the footprints of both bodies on it have in common is the
 * contact's manifold: a point, a segment, or a polygon of up to CONTACT_POINTS corners. Nothing of
 * this is part of what is promised. */

/* A patch and (u, v) on it, of the first and of the second body. */
typedef struct witness {
    imp_place place[2];
    double p[2][2];
} witness;

typedef struct touching {
    vec point;  /* halfway between the nearest points */
    vec normal; /* unit, from the first body to the second */
    double gap;
    size_t count;
    vec corner[CONTACT_POINTS];
    vec drift[CONTACT_POINTS]; /* velocity of the second surface against the first at the corners,
                                  beyond the motion of the bodies: of driven and deforming ones */
    witness nearest;
} touching;

/* Two bodies at one time. */
typedef struct touch_pair {
    const setup *setup;
    const outline *outline[2];
    placed at[2];
    double t;
    double slack; /* up to this far from the plane of contact, points belong to it */
} touch_pair;

imp_code touching_find(const touch_pair *pair, const witness *from, touching *out, imp_error *why);

#endif
