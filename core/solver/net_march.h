/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_NET_MARCH_H
#define CORE_SOLVER_NET_MARCH_H

#include "core/solver/relative.h"

/* When two nets meet, about
 * =========================
 * The nearest points of two surfaces, followed in time: Newton steps on the distance at one time, then on to
 * the time at which it would be gone at the speed at which it shrinks. Points are those of the nets' patches,
 * so that no surface is evaluated; what is found is a guess, to be proved by a witness. */

typedef struct net_meeting {
    double t;
    double y[4];  /* where: (s_u, s_v) of a and of b, relative to the nodes, which may be left */
    double speed; /* at which the gap closes; length/time */
} net_meeting;

/* From where both nodes, of which each has a net, reach farthest along the axis, from A to B or 0, and the start
 * of the window on: the first time in it, about, at which the gap is `gap`. False: none was found. */
bool net_march(const node *a, const node *b, vec3 axis, const time_window *window, double gap,
               net_meeting *found);

/* Where they are nearest to each other at one time, found from there too, until a step promises less than `gain`
 * of the gap; or a place where they are no farther apart than `enough`. Either node may be left by a
 * half-width. */
void net_nearest(const node *const nodes[2], vec3 axis, double t, double enough, double gain,
                 double y[4]);

#endif
