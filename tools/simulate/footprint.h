/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_FOOTPRINT_H
#define TOOLS_SIMULATE_FOOTPRINT_H

#include "tools/simulate/outline.h"
#include "tools/simulate/placed.h"
#include "tools/simulate/polygon.h"

/* Where a body stands on a plane
 * ==============================
 * The footprint of a body on a plane of contact is where its surfaces are within `slack` of the
 * plane: for each patch that is, the hull of such points. A flat patch is sampled on a grid with
 * its rim, which finds corners, edges and faces that lie in the plane; of a curved one those points
 * of rows and columns count that are farthest towards the plane, as far as they are on a straight
 * line: these are the lines and rings along which it touches (a cylinder on its side, a torus). */

typedef struct contact_plane {
    vec origin, normal, tangent[2];
    double slack;
} contact_plane;

point2 plane_inward(const contact_plane *plane, vec x);
vec plane_outward(const contact_plane *plane, point2 x);

typedef struct footprint {
    polygon *part;
    size_t count, capacity;
} footprint;

/* Finds the footprint of a body on one side of the plane; `side` is 1 for that which the normal
 * leads away from, -1 for the other. Patches farther than `reach` from `middle` are left out, and
 * the patch `but`, if it is given. */
imp_code footprint_find(footprint *f, const placed *at, const outline *o,
                        const contact_plane *plane, double side, vec middle, double reach,
                        const imp_place *but, imp_error *why);

/* Adds a single point. False: no memory. */
bool footprint_add(footprint *f, point2 *points, size_t count);
void footprint_free(footprint *f);

#endif
