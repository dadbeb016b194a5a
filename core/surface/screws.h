/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SCREWS_H
#define CORE_SURFACE_SCREWS_H

#include "core/surface/half_plane.h"

/* Screws
 * ======
 * A surface is a piece of an endless thread if its symmetry is a screw and CLOSED. What is said
 * here holds for points of two surfaces that are not too far from each other: screw motions take
 * them to others, unless these would be beyond an end of the piece. */

/* Whether s is such a piece, without an error. */
bool surface_is_screw_piece(const surface *s);

/* Two pieces with one line, lead and hand are nearest to each other in one half plane that ends at
 * the line, and within one lead along it, if they reach far enough. One of the two is then cut by
 * the half plane, the other one by what is near it.
 *
 * Computes that as surface_half_plane does, for points that are at most `near` apart. */
imp_status surface_screw_section(const surface *const s[2], const half_plane_boxes *boxes,
                                 const imp_region *times, double near, half_plane of[2],
                                 double *slip, int *asked);

/* Any surface that moves along a piece by its screw motions is at rest beside it, as far as the
 * piece reaches. */
typedef struct screw_rest_times {
    const imp_region *times;
    double moment; /* one of them */
    double enough; /* no greater slip is known, as of surface_slip; length */
} screw_rest_times;

typedef struct screw_rest {
    double slip; /* INFINITY: nothing is known; length */
    double near; /* length */
} screw_rest;

/* At each of the times two points that are at most rest->near apart have companions at the moment
 * that are at most rest->slip farther from each other. `bare` and *asked are as of
 * surface_pair_slip. */
imp_status surface_screw_rest(const surface *const s[2], const imp_model bare[2][3],
                              const screw_rest_times *at, screw_rest *rest, int *asked);

#endif
