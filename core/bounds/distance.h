/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DISTANCE_H
#define CORE_BOUNDS_DISTANCE_H

#include <impinge/impinge.h>

#include "core/bounds/difference.h"

/* One-sided separation: a node's distance from a whole surface
 * ============================================================
 * Where surfaces slide along each other, a node has many neighbours on the other surface, each of
 * which has to be parted from it. The signed distance from the other surface, where its type knows
 * it (imp_surface_type.distance), parts the node from all of them at once: it is a Taylor model
 * over the node, in which what is parallel cancels, however small the gap. */

/* What a node's distance from the other node's whole surface shows over a window. */
typedef struct distance_view {
    bool is_apart;     /* farther than gamma_clear all the time */
    bool is_promising; /* no: but halves of the node, which have smaller remainders, may be */
    double lower;      /* bound of the distance over the window as handed over; length */
    double bend[3];    /* how far u, v and t bend points beside the other surface, about; length */
} distance_view;

/* Returns a view in which nothing is known yet. */
distance_view distance_view_none(const node *a);

/* Whether distances of points of a from the surface of b are known, and worth asking for
 * (strategy_distance_pays). */
bool distance_is_known(const node *a, const node *b);

/* The question that distance_cut answers. If a's motion relative to b, modulo b's symmetry, is
 * within `slip`, a's points are taken at one moment (surface_slip), so that time costs nothing. */
typedef struct distance_question {
    const node *a, *b;
    const surface_plane
        *plane;         /* of b's points, which stands for its surface; NULL: b's type is asked */
    double gamma_clear; /* length */
    double moment;
    double slip;     /* of a node that is posed; INFINITY: it does not slide so; length */
    bool is_audited; /* hold what decides against points (claim_audit.h) */
} distance_question;

/* Whether a's motion relative to b, modulo b's symmetry, is small against gamma_clear. */
bool distance_slides(const distance_question *q);

/* Cuts the window, which lies in both nodes' times, to the times at which points of a may be within
 * gamma_clear of the whole surface of b, or of its plane. If no time is left, *view says so and the
 * window stays as it is. Preconditions: distance_is_known, or there is a plane and distance_slides;
 * both bounded; no map of b alone turns it further (surface_still_maps), or distance_slides.
 * IMP_ERROR_PLUGIN: the callback breaks the ABI. */
imp_code distance_cut(const distance_question *q, time_window *window, distance_view *view,
                      imp_error *error);

/* --- Both sides ------------------------------------------------------------------------------- */

/* Two nodes, each of which may be parted from the other's whole surface. */
typedef struct distance_sides {
    const node *node[2], *root[2];
    size_t still_maps[2]; /* surface_still_maps of each surface */
    float *slip; /* the caller's two numbers: >= surface_slip of each surface along the other, over
                             all times of both; 0: not asked yet */
    bool is_audited;
} distance_sides;

/* What the nodes' distances from each other's surface show. */
typedef struct distance_outcome {
    time_window
        left; /* of the window asked for: outside, the nodes are farther apart than gamma_clear */
    bool is_apart;  /* all the time */
    double lower;   /* bound of the distance over the window, if below gamma_clear; length */
    int side;       /* the side whose node to split; -1: none */
    double bend[3]; /* how far u, v and t bend its points beside the other surface, about; length */
} distance_outcome;

/* Nothing is known yet. */
distance_outcome distance_outcome_none(const time_window *window);

/* Tries node 0, then node 1, until one decides, and adds what they show to *seen. Precondition:
 * both nodes are bounded. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code distance_cut_sides(const distance_sides *of, double gamma_clear, distance_outcome *seen,
                            imp_error *error);

#endif
