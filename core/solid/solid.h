/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SOLID_H
#define CORE_SOLID_SOLID_H

#include "core/solid/shells.h"

/* A solid body at one time
 * ========================
 * Its surfaces form shells, each of which is closed: a point is inside a shell that winds around it
 * any number of times but 0. Shells that are wholly inside others, and do not touch them, are walls
 * of cavities, or of solid parts in these, in turn; shells that intersect bound their union. So a
 * point is in the solid exactly if more of the shells around it are outer walls than are walls of
 * cavities. In which order a body's shells come, and where their normals point, is of no
 * consequence. */

typedef struct solid solid;

typedef enum solid_side {
    SOLID_OUTSIDE,
    SOLID_INSIDE,
    SOLID_TOO_NEAR, /* the point is so near to the surfaces that rounding decides */
    SOLID_NOT_CLOSED
} solid_side;

/* Reads the body at time t; *made is NULL if no surface of it exists then. Edges within `slack` of
 * each other are one seam. Whether the body is closed is found out by the first solid_side_of. The
 * scene and the watch must outlive the result. */
imp_code solid_new(const imp_scene *scene, size_t body, double t, double slack,
                   const limit_watch *watch, solid **made, imp_error *error);
void solid_free(solid *s); /* NULL is none */

/* Returns the most memory that a solid keeps. While its shells are sought it takes
 * solid_shells_bytes more. */
size_t solid_bytes(size_t count);

/* Finds the side on which all points lie that are no farther than `off` from x. SOLID_NOT_CLOSED:
 * the surfaces bound no volume, as *error tells. *stopped: the watch ended it, and *side is
 * not set. Fails as plugins do. */
imp_code solid_side_of(solid *s, vec3 x, double off, solid_side *side, bool *stopped,
                       imp_error *error);

#endif
