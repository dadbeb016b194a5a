/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SURFACE_SPREAD_H
#define CORE_SURFACE_SURFACE_SPREAD_H

#include "core/surface/surface_shift.h"

/* Which way scene parameters move a point
 * =======================================
 * surface_shift.h bounds how far the values of a box move points. Where all maps from the first one
 * that follows a parameter on turn exactly, this file tells the way, too: a point x of the surface
 * at the middle values and time t is, at other values,
 *
 *   x + sum_k s_k way_k + rest,  |s_k| <= 1,
 *
 * where a bound of the rest is of second order in the ranges. */

/* A map, and how its pose depends on what it follows. */
typedef struct spread_map {
    const imp_map_type *type;
    const void *self;
    size_t clock;         /* of the parameter; SIZE_MAX: time, or none */
    bool moves;           /* with time: turn and shift are not set */
    double turn[3][3];    /* the pose at the middle values */
    double shift[3];      /* length */
    double pivot[3];      /* length */
    double off;           /* of the shift, at most; length */
    double turn_by[3][3]; /* what half of the parameter's range adds, to first order */
    double shift_by[3];   /* length */
    double steep;         /* >= the norm of turn_by */
    double drift;         /* speed in time of points before the map, at most */
    double spin;          /* >= |d turn / d time| */
} spread_map;

/* What is known of one surface over one box; `maps` is the caller's room. */
typedef struct surface_spread {
    size_t first, count; /* maps[first] is the first that follows a parameter */
    double second;       /* bounds the rest's part that does not depend on the point; length */
    spread_map *maps;
} surface_spread;

enum { SPREAD_MAPS_MAX = 64 };

/* Makes the spread of a surface without its last `left_out` maps. Where some are held, it tells of
 * companions: each point of the surface at any values has one, such an x, at the middle values, and
 * the rest has the slip. Time is that of queries: what follows the parameter `swept` moves with it;
 * SIZE_MAX: none does. to->maps has room for all maps. False: nothing is known, for instance since
 * a map does not turn exactly. */
bool surface_spread_make(const surface *s, const surface_extent *extent, size_t left_out,
                         const value_box *box, size_t swept, const map_reach *reaches,
                         surface_spread *to);

/* Where the ways are asked for: points within `radius` of `at` at time t, under all but the last
 * `left_out` maps (which the spread may have, too), and at times at most `half` from t. */
typedef struct spread_place {
    double at[3], radius, t, half;
    size_t left_out;
} spread_place;

/* Adds the ways times `sign`, 1 or -1, to `ways`, x, y, z and 0 of each parameter, and a bound of
 * the rest to *rest. False: nothing is known. Any thread. */
bool surface_spread_at(const surface_spread *spread, const surface *s, const spread_place *place,
                       double sign, double (*ways)[4], double *rest);

#endif
