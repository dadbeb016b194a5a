/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_SPINE_H
#define CORE_BOUNDS_SPINE_H

#include "core/bounds/distance.h"

/* Spines: what turns, parted as a round bar about the line about which it turns
 * ==============================================================================
 * A thread that turns beside a wall, a shaft of flat sides that whirls in a bore, a roller of flat
 * sides: at each time another part of the surface is the nearest, so that all of it has to be
 * divided, at all times. But all of its points are within a radius of a segment of one line, its
 * spine, which its turning about that line leaves where it is. Where the spine is farther than the
 * radius from the other surface, or from that one's own spine by both radii, so are the points. */

/* The points center + z axis, z in [from, to], in the surface's coordinates before its last maps,
 * which are exact rotations and shifts, after the first `inner`. */
typedef struct spine {
    const surface *of;
    size_t inner;
    double center[3], axis[3]; /* |axis| is within 8 u of 1 */
    double from, to;           /* length */
    double radius;   /* >= the distance of each point of the surface from its foot on the segment */
    bool is_of_type; /* the line is that of the symmetry of the type */
} spine;

/* Chooses the line of a spine: that of the type's symmetry or one about which the first maps turn
 * the surface during the times, whichever is nearer to some of its points. Its segment and radius
 * are those of these points, which may be too small. False: there is none. */
bool spine_choose(const surface *s, const time_window *times, spine *found);

/* Computes a segment and a radius that hold for all points, if the radius is then at most `goal`.
 * *known false: it is not, the surface moves before its last maps, or it has no bounds; the radius
 * is then, if it is greater than before, about one that some point has. */
imp_code spine_measure(spine *of, const time_window *times, double goal, bool *known,
                       imp_error *error);

/* Reduces the radius to the goal, or as far as may be, by what the type says of distances from the
 * surface, if the line is that of its symmetry. */
imp_code spine_reduce(spine *of, const time_window *times, double goal, imp_error *error);

/* Fills the models of the spine's points at the region's times, whose v is z, and a node of them.
 * False: they have no bounds. */
bool spine_node(const spine *of, double from, double to, imp_model x[3], node *n);

/* Bounds the distance of two surfaces by their spines at these times, which both roots have: *lower
 * is a bound, or 0. Bounds below `limit` are of no use; where none above it is found, none is above
 * *hope, about. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code spine_part(const distance_sides *of, const time_window *times, double limit, double *lower,
                    double *hope, imp_error *error);

#endif
