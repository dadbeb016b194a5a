/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_DISTANCE_H
#define CORE_BOUNDS_DISTANCE_H

#include <impinge/impinge.h>

#include "core/bounds/difference.h"

/* One-sided separation: a node's distance from a whole surface
 * ============================================================
 * Where surfaces slide along each other, a node has many neighbours on the other surface, each of
 * which has to be separated from it. The signed distance from the other surface, if its type offers
 * it (imp_surface_type.distance), separates the node from all of them at once: it is a Taylor model
 * over the node, in which the shape that both have in common cancels, however small the gap. */

/* The result of bounding a node's distance from the other node's whole surface over a window. */
typedef struct distance_view {
    bool is_apart;     /* farther than gamma_clear during the whole window */
    bool is_promising; /* not apart, but its halves, with smaller remainders, may be */
    bool has_start;    /* the window's start was cut by distance_cut_start */
    double lower;      /* bound of the distance over the window as passed; length */
    double bend[3];    /* nonlinear extents in u, v, t in the other's frame, about; length */
} distance_view;

/* Returns a view that claims nothing. */
distance_view distance_view_none(const node *a);

/* Whether b's type offers distances of points of a from its surface, and they are worth computing
 * (strategy_distance_pays). */
bool distance_is_known(const node *a, const node *b);

/* The input of distance_cut. If a's motion relative to b, modulo b's symmetry, is within `slip`,
 * a's points are taken at one moment (surface_slip), so that time need not be split. */
typedef struct distance_question {
    const node *a, *b;
    const surface_plane
        *plane;         /* of b's points, replaces its surface; NULL: use b's distance callback */
    double gamma_clear; /* length */
    double moment;
    double slip;     /* of a posed node; INFINITY: not bounded; length */
    bool is_carried; /* `slip` is that of surface_carry_slip: a's points are taken at all times, */
    bool is_bare;    /* and b as it is before its maps */
    unsigned held;   /* parameters of a that stay in the middle: bit 0 u, bit 1 v (slip counts) */
    bool is_ball;    /* the center of the ball that holds a's surface is taken (surface_ball), */
    double radius;   /* and this ball's radius at all times of a is left out; length */
    bool seeks_contact;
    bool is_audited; /* check decisive distances at points (claim_audit.h) */
} distance_question;

/* Whether a slip is known, and small against gamma_clear. */
bool distance_slip_is_small(double slip, double gamma_clear);

/* A slip that is, however it is rounded. */
double distance_slip_enough(double gamma_clear);

/* Whether a's motion relative to b, modulo b's symmetry, is small against gamma_clear. */
bool distance_slides(const distance_question *q);

/* Cuts the window, which lies in both nodes' times, to the times at which points of a may be within
 * gamma_clear of the whole surface of b, or of its plane. If no time is left, view->is_apart is set
 * and the window is unchanged. Preconditions: distance_is_known, or there is a plane and
 * distance_slides; both nodes are bounded; b has no rotating map that a lacks (surface_still_maps),
 * or distance_slides. IMP_ERROR_PLUGIN: the callback breaks the ABI. */
imp_code distance_cut(const distance_question *q, time_window *window, distance_view *view,
                      imp_error *error);

/* Cuts the window's start alone, by the distance over ever shorter parts of the window, so that it
 * is exact but for what the distance is inexact at one time. *is_apart: nothing is left, and the
 * window means nothing. Preconditions are those of distance_cut, and q->is_ball. */
imp_code distance_cut_start(const distance_question *q, time_window *window, bool *is_apart,
                            imp_error *error);

/* Cuts the window to the times at which g, a model over the region, is no greater than gamma_clear,
 * if count is 1, or |g| is, if it is 2. True: at no time, and the window is unchanged. *lower
 * becomes a bound of g, or |g|, over the window as passed, or 0. */
bool distance_cut_heights(const imp_model *g, int count, const imp_region *r, double gamma_clear,
                          time_window *window, double *lower);

/* Computes a Taylor model of the distance of points before common maps, over the region's times. */
imp_status distance_of_points(const distance_question *q, const imp_region *times,
                              const imp_model point[3], imp_model *g);

/* Sets and returns the error for a status that a callback of the surface returned. */
imp_code distance_fault(const surface *s, imp_status status, imp_error *error);

/* --- Balls ------------------------------------------------------------------------------------ */

struct distance_sides;

/* Cuts the window by the distance of one side's center from the other's whole surface, where the
 * side's node is a ball, or such a part of one that has all u and v. The view claims nothing where
 * it is none, or nothing is known of the other. Errors are those of distance_cut. */
imp_code distance_cut_ball(const struct distance_sides *of, int side, double gamma_clear,
                           time_window *window, distance_view *view, imp_error *error);

/* --- Both sides ------------------------------------------------------------------------------- */

/* What is kept of two surfaces, for each of them, so that it is computed once; begins as zeros. The
 * slips are over the common times of both roots and rounded up; 0: not computed yet. */
typedef struct distance_slips {
    float slip[2];          /* surface_slip along the other */
    float carry[2];         /* surface_carry_slip of the other, for all points of this one */
    float ball[2];          /* surface_ball_slip along the other */
    float orbit[2];         /* surface_orbit_slip along the other, */
    unsigned char held[2];  /* with the parameters that need not vary then */
    bool is_bare[2];        /* whether `carry` counts from before the other's maps */
    signed char orbits[2];  /* surface_has_orbits: 1 true, -1 false, 0 not known yet */
    unsigned char searches; /* in which piece_sides_cut was tried */
    float apart;            /* a bound of the distance at all times, found by spines; length */
    float hope;             /* spines may show more than a limit below it, once tried; length */
    unsigned looks;         /* pairs of the two that were looked at, as far as it is counted */
} distance_slips;

/* Two nodes, each of which may be separated from the other's whole surface. */
typedef struct distance_sides {
    const node *node[2], *root[2];
    size_t still_maps[2];  /* surface_still_maps of each surface */
    distance_slips *slips; /* the caller's, of the two surfaces */
    arena_store *store;    /* of temporary memory; NULL: the heap */
    bool seeks_contact;    /* not the least distance */
    bool seeks_start;      /* whether a ball's distance shall cut the window's start exactly */
    bool takes_orbits;     /* whether one point may stand for others, screws included */
    bool is_audited;
} distance_sides;

/* The pieces of two surfaces that seem to be nearest to each other. */
typedef struct piece_hint {
    bool is_known;
    size_t piece[2];
} piece_hint;

/* The result of both nodes' distances from each other's surface. */
typedef struct distance_outcome {
    time_window left; /* of the window; outside, the nodes are farther apart than gamma_clear */
    bool is_apart;    /* during the whole window */
    double lower; /* bound of the distance over what was looked at, if below gamma_clear; length */
    bool has_start;  /* a ball's distance cut the window's start (distance_cut_start) */
    int side;        /* the side whose node to split; -1: none */
    double bend[3];  /* nonlinear extents of that node in the other's frame, about; length */
    piece_hint hint; /* of two roots of many pieces */
} distance_outcome;

/* Whether maps of the other side rotate its surface, so that distances hold only with a slip. */
bool distance_is_turned(const distance_sides *of, int side);

/* Returns an outcome that claims nothing. */
distance_outcome distance_outcome_none(const time_window *window);

/* Tries both nodes until one decides, and adds what they show to *seen. Precondition: both nodes
 * are bounded. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code distance_cut_sides(const distance_sides *of, double gamma_clear, distance_outcome *seen,
                            imp_error *error);

#endif
