/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_CONTACT_ESTIMATE_H
#define CORE_WITNESS_CONTACT_ESTIMATE_H

#include "core/bounds/difference.h"
#include "core/bounds/net_paraboloid.h"

/* An estimate of when two nets first touch
 * ========================================
 * Follows the nearest points of two surfaces in time: Newton steps on the distance at one time,
 * then a step to the time at which the gap would be closed at its present speed. Points are those
 * of the nets' patches, so that no surface is evaluated. The result is a guess, to be proved by a
 * witness. */

typedef struct contact_estimate {
    double t;
    double y[4];  /* (s_u, s_v) of a and of b, relative to the nodes; may lie outside */
    double speed; /* at which the gap closes; length/time */
    net_paraboloid paraboloid; /* between the surfaces there */
} contact_estimate;

/* Estimates the first time in the window at which the gap is `gap`. False: none was found. Both
 * nodes have nets. The search begins at the window's start, where A reaches farthest along the axis
 * and B least. The axis points from A to B, or is 0. */
bool contact_estimate_find(const node *a, const node *b, vec3 axis, const time_window *window,
                           double gap, contact_estimate *found);

/* Estimates the nearest points of two nets at time t, starting where contact_estimate_find starts.
 * It ends once the predicted reduction of a step is below `gain` of the gap, or the gap is at most
 * `enough`. Points may leave either node by a half-width. */
void net_nearest(const node *const nodes[2], vec3 axis, double t, double enough, double gain,
                 double y[4]);

#endif
