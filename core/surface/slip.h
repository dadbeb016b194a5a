/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SLIP_H
#define CORE_SURFACE_SLIP_H

#include "core/surface/carried.h"
#include "core/surface/region.h"

/* How far a surface moves along another, but for motions of the other within itself
 * =================================================================================
 * For surface_slip.c, slip_screw.c and surface_pair_slip.c. */

typedef struct slip_input {
    const surface *a, *b;
    size_t a_maps, b_maps;   /* number of maps, without the common last ones */
    size_t a_still, b_still; /* how many first maps are taken at one moment, `then` */
    imp_region then;
    imp_symmetry found;    /* of b */
    const imp_model *bare; /* a before its maps */
    double enough;         /* a slip that is not refined; no greater one is known. 0: none */
} slip_input;

/* What the symmetry leaves where it is, in a's coordinates before its maps; and bounds for points
 * of a. */
typedef struct slip_place {
    carried center;      /* unless the symmetry is across a line */
    carried_plane plane; /* the axis is its normal, unless it is about a point; its height matters
                            only across a line */
    double off;          /* error of a's points in b's coordinates before its maps; length */
    double far;          /* >= distance of a's points from the center, or of their middle; length */
} slip_place;

/* Computes *slip, given the symmetry; INFINITY if the motion leaves the symmetry. */
imp_status slip_find(const slip_input *q, const imp_region *times, double *slip);

/* For a symmetry across a line and maps that are exact rotations and shifts: computes how far the
 * plane rises above the middle of a's points from `then` to the given times, along the axis, and
 * >= how far the turn that takes its normal there moves a's points. INFINITY: it is not known. */
imp_status slip_follow_plane(const slip_input *q, const imp_region *times, imp_model *rise,
                             double *tilt);

/* Counts how many of the first maps together only turn s within itself, and bounds their slip from
 * where it is at the moment `then`. */
imp_status slip_first_maps(const surface *s, bool of_pieces, const imp_model bare[3],
                           const imp_region *times, const imp_region *then, size_t *maps,
                           double *slip);

/* slip_find for a screw. It goes on until *slip is at most `enough`, or gives up: INFINITY. */
imp_status slip_find_screw(const slip_input *q, const imp_region *times, double enough,
                           double *slip);

static inline imp_region slip_at_times(const imp_region *r, double from, double to)
{
    const double lo[3] = {r->lo[0], r->lo[1], from}, hi[3] = {r->hi[0], r->hi[1], to};
    return region_make(lo, hi);
}

static inline bool slip_moves_rigidly(const surface *s)
{
    return s->map_count == 0 || surface_is_rigid(s);
}

static inline double slip_dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

#endif
