/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_CONTACT_PARABOLOID_H
#define CORE_WITNESS_CONTACT_PARABOLOID_H

#include "core/bounds/net_paraboloid.h"
#include "core/witness/net_eval.h"

/* A separating paraboloid at a contact
 * ====================================
 * Between two surfaces that touch lies their common normal's plane or, where one of them bends
 * beyond it, a surface that bends more than A and less than B along the normal. What is chosen here
 * is proved by net_paraboloid.h. */

/* A surface at the contact: derivatives there, and along which of u and v the point could move both
 * ways. None: it is a corner; one: an edge. */
typedef struct contact_side {
    const net_derivatives *of;
    bool is_free[2];
} contact_side;

/* Sets the normal, from A to B, the directions across it and the curvatures. `apart` leads from A's
 * point to B's. What has no paraboloid gets one that is not usable. */
void contact_paraboloid_choose(const contact_side sides[2], vec3 apart, net_paraboloid *d);

#endif
