/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_LINEAR_CONTACT_H
#define CORE_BOUNDS_LINEAR_CONTACT_H

#include "core/bounds/time_window.h"

/* When a point meets a flat face, or two straight edges meet
 * ==========================================================
 * Between a point and a bilinear face, or two straight edges, whose corners move linearly, the
 * difference D of their points has two parameters and time: D = 0 is three equations in three
 * unknowns, which a few Newton steps solve. The result is a guess: its axis is to be proved, and
 * its points to be evaluated. */

typedef struct linear_contact {
    double t;
    double y[4]; /* (s_u, s_v) of a and of b, relative to the nodes, in [-1, 1] */
    vec3 axis;   /* from A to B, perpendicular to the face or to both edges at that time; unit */
} linear_contact;

/* Whether the pair is of that kind. Where remainders hide the motion of corners, nets show it:
 * `linear_contact_find` uses those that are made (node_net_made). */
bool linear_contact_is_of(const node *a, const node *b);

/* Seeks the time of the window after its start at which the gap has shrunk to `gap`, and the points
 * that are that far apart then, from `near` on, which was found with less exact nodes; NULL: from
 * the window's start and the nodes' centres. With a gap of 0 it is not sought to the last digits:
 * another search begins from what is found. False: none was found, inside both nodes.
 * Precondition: linear_contact_is_of. `near` may be `found`. */
bool linear_contact_find(const node *a, const node *b, const time_window *window, double gap,
                         const linear_contact *near, linear_contact *found);

#endif
