/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SURFACE_SHIFT_H
#define CORE_SURFACE_SURFACE_SHIFT_H

#include "core/surface/surface.h"

/* How far scene parameters move a surface
 * =======================================
 * A surface whose stages follow parameters (clocked.h) is somewhere else at other values. Over a
 * box of values this file bounds by how much each parameter moves any point, and in which box of
 * space the surface stays. */

/* A box of values, the values at which the surface stands, and the times. */
typedef struct value_box {
    size_t count; /* number of parameters */
    const double *lo, *hi;
    const double *at; /* lo <= at <= hi */
    double t_start, t_end;
} value_box;

/* What a stage follows, time or a parameter, in a box. */
typedef struct stage_range {
    double lo, hi;
} stage_range;
static inline stage_range stage_range_of(const shared_instance *p, const value_box *box)
{
    return p->inner != NULL ? (stage_range){box->lo[p->clock], box->hi[p->clock]}
                            : (stage_range){box->t_start, box->t_end};
}

/* The surface before its maps, at all times and values of a box. */
typedef struct surface_extent {
    double lo[3], hi[3]; /* infinite: it is not bounded */
    double speed;        /* length per unit of its clock, or of time if it follows that */
    held_maps held;      /* maps by which no value shifts it but by their slip (held_values.h) */
} surface_extent;

/* No maps are held. A status other than OK is a fault of the type. */
imp_status surface_extent_find(const surface *s, const value_box *box, surface_extent *extent);

/* A surface that time moves by no more than this counts as one that does not follow it. Rates of
 * stages that stay where they are need not be 0: what formulas add for underflow remains. Unit:
 * length. */
#define SURFACE_STILL 0x1p-300

/* Bounds, for the surface without its last `left_out` maps, shift[k] >= the length by which any
 * point of it moves for parameter k alone, from the values `at` to any in the box: together they
 * move it by the sum at most. Where maps are held, this is said of the surface, not of its points:
 * at any values each point is within the sum, and the slip, of one of the surface at the values
 * `at`. `image` becomes a box that holds it at all times and values, and
 * tells whether it depends on time. The extent is that of this box or of a larger one. INFINITY: no
 * bound. A status other than OK is a fault of a map. */
typedef struct surface_image {
    double lo[3], hi[3];
    double drift;      /* how far the times move any point, at most; length */
    double slip;       /* of maps that are held, as later ones stretch it; length */
    bool follows_time; /* drift exceeds SURFACE_STILL, or it does not exist at all times */
} surface_image;
imp_status surface_shift_upper(const surface *s, const surface_extent *extent, size_t left_out,
                               const value_box *box, double *shift, surface_image *image);

/* The surface before a map, at all times and values of a box, and what the map does there. */
typedef struct map_reach {
    double centre[3], radius; /* of a ball that holds it */
    double stretch, speed;    /* of the map: of lengths; per unit of what it follows */
} map_reach;

/* Does what surface_shift_upper does, and tells of each map but the last `left_out`; reaches may be
 * NULL. They are not set where a shift is INFINITY. */
imp_status surface_shift_trace(const surface *s, const surface_extent *extent, size_t left_out,
                               const value_box *box, double *shift, surface_image *image,
                               map_reach *reaches);

#endif
