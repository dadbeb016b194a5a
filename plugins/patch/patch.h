/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_H
#define PLUGINS_PATCH_PATCH_H

#include <impinge/surface.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* A moving patch, polynomial or rational
 * ======================================
 * Over (u, v) in [0, 1]^2, with the Bernstein polynomials B of degrees n and m,
 *
 *   f(u, v, t) = place + t drift + (X + t Y) / W
 *   X = sum_ij B_i(u) B_j(v) w_ij (P_ij - place),   W = sum_ij B_i(u) B_j(v) w_ij
 *   Y = sum_ij B_i(u) B_j(v) w_ij (V_ij - drift)
 *
 * for control points P_ij, velocities V_ij and weights w_ij > 0. `place` and `drift` lie in the
 * middle of the points and of the velocities: what is left is small even far from the origin,
 * and rounding errors scale with it. A polynomial patch has no W; a patch at rest has no Y.
 *
 * The net holds four numbers per control point, (X, W), and if the patch moves a second
 * one, (Y, 0). patch_rate.h and patch_include.h bound a patch over a region; this module makes and
 * evaluates it. */

enum {
    PATCH_DEGREE_MAX = 20, /* buffers on the stack: under 100 kB */
    PATCH_SIDE_MAX = PATCH_DEGREE_MAX + 1,
    PATCH_LANES_MAX = 8,
    PATCH_NUMBERS_MAX = PATCH_SIDE_MAX * PATCH_SIDE_MAX * PATCH_LANES_MAX,
    PATCH_W = 3 /* the lane of W */
};

/* Limits that keep every number below finite: |P|, |V| <= PATCH_FAR, |t| <= PATCH_LATE, and weights
 * from PATCH_LIGHT to PATCH_HEAVY. */
#define PATCH_FAR 1e100
#define PATCH_LATE 1e50
#define PATCH_LIGHT 1e-50
#define PATCH_HEAVY 1e50
#define ROUNDING 0x1p-53 /* relative error of one operation */

/* Covers what the lemmas drop: second-order terms and the rounding of a bound itself, up to some
 * thousand operations on positive terms. */
#define SLACK (1 + 0x1p-40)

/* Control points, and velocities if the patch moves (else NULL), of 3 numbers each; weights if it
 * is rational (else NULL). Point i, j is at index i (degree[1] + 1) + j. */
typedef struct patch_data {
    int degree[2];
    const double *points, *velocities, *weights;
} patch_data;

typedef struct patch {
    int degree[2];
    int lanes; /* numbers per control point: 4 at rest, 8 moving */
    bool rational;
    double units;                     /* error of the net is units ROUNDING most at most */
    double weight_lo;                 /* least weight; 1 if polynomial */
    double place[4], drift[4];        /* of x, y, z, and a 0 */
    double place_radius[4];           /* max |P - place| */
    double drift_radius[4];           /* max |V - drift| */
    double most[PATCH_LANES_MAX];     /* max |net|, per lane */
    double slope[2][PATCH_LANES_MAX]; /* max |difference|, per lane, for d/du and d/dv */
    double noise[PATCH_LANES_MAX];    /* rounding of the series, see patch_series.h */
    double *net;                      /* (n+1)(m+1) groups */
    double *series;                   /* the same polynomials in Chebyshev form */
    double *difference[2];            /* nets of d/du and d/dv: n (m+1), (n+1) m groups */
    double *given;                    /* the data, see patch_keep; room for patch_finish before */
    double *beta[2];                  /* of the degrees: chebyshev_of_bernstein */
} patch;

static inline size_t patch_points(const int degree[2])
{
    return (size_t)(degree[0] + 1) * (size_t)(degree[1] + 1);
}

/* The struct and its arrays as one block, for free(); NULL: no memory. */
patch *patch_allocate(const patch_data *data);

/* Whether the arrays of f have the sizes that this data needs. */
bool patch_has_room(const patch *f, const patch_data *data);

/* Keeps a copy of the data that patch_allocate saw: 3 numbers of each point, then 3 of its velocity
 * if the patch moves, and then its weight if it is rational. */
void patch_keep(patch *f, const patch_data *data);

/* Fills net, place, drift and what bounds them, from the data that patch_allocate saw. */
void patch_set_net(patch *f, const patch_data *data);

/* Fills the net of d/du (side 0) or d/dv, and slope, from the net. */
void patch_set_differences(patch *f, int side);

/* One point, p = (u, v, t) in the domain, and its error. */
void patch_point(const patch *f, const double p[3], double x[3], double error[3]);

/* Implements imp_surface_type.eval. */
imp_status patch_eval(const patch *f, size_t count, const double *p, double *x, double *error);

/* Whether rate and include have bounds for a region. */
imp_status patch_region_status(const imp_region *region);

#endif
