/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_RING_NET_H
#define PLUGINS_PATCH_RING_NET_H

#include "plugins/common/frame.h"
#include "plugins/patch/knots.h"
#include "plugins/patch/round_profile.h"

#include <impinge/interval.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Nets that are products of a ring and a profile
 * ==============================================
 * For round_net.c: how far a net is from c + z_j k + q_j E_i, E on a unit circle across k, and what
 * the curves of E and of (q, z) are off by, and go around. */

/* Coordinates of axes and centers that are smaller, by this part of the whole, are rounding. */
#define ROUND_NET_ZERO 0x1p-45

enum { RING_DEGREE_MOST = 20 };

/* Where a net's axis is. */
typedef struct ring_place {
    double center[3]; /* length */
    double axis[3];
    frame frame; /* about the axis */
} ring_place;

/* A net by rings, rows of control points along one side, one for each control point of the other
 * side, the profile. */
typedef struct ring_net {
    const knots *ring, *profile;
    const double *points, *weights;
    size_t ring_step, profile_step; /* between neighbours, in control points */
    int along;                      /* the ring's parameter, 0 for u and 1 for v */
    size_t widest;                  /* the ring whose points lie farthest from its first */
    double radius;                  /* of that ring; length */
    const ring_place *at;
} ring_net;

static inline size_t index_of(const ring_net *n, size_t i, size_t j)
{
    return i * n->ring_step + j * n->profile_step;
}

static inline double weight_of(const ring_net *n, size_t i, size_t j)
{
    return n->weights != NULL ? n->weights[index_of(n, i, j)] : 1;
}

/* Control point k of a plane curve: x, y and the weight. */
typedef void control_point(const ring_net *n, size_t k, double out[3]);

/* The widest ring over its radius. */
void ring_control(const ring_net *n, size_t i, double out[3]);

/* By how much ring j is wider than the unit ring, as a least square, and its mean height. */
void ring_profile_control(const ring_net *n, size_t j, double out[3]);

/* A point's exact coordinates along the frame, from the center. */
void ring_in_frame(const ring_place *r, const double *point, imp_interval out[3]);

/* The point of ring j of control points at a part of its domain. */
void ring_point(const ring_net *n, size_t j, double part, double out[3]);

/* The ring whose points lie farthest from its first. */
size_t ring_widest(const ring_net *n);

/* Fills or widens a profile by all spans of a curve. False: it is neither line nor arc. */
bool ring_take_curve(const ring_net *n, const knots *k, control_point *control, round_profile *p);

/* Returns <= the greatest |q| of a point of the profile's curve, or half of what its heights span:
 * control points may lie far from it. */
double ring_half_size_lower(const ring_net *n);

/* How far control points are from products q_j (x_i, y_i), z_j, at most; and what weights that are
 * no products of two numbers move (ring_take_curve). Also the greatest |q_j|. */
double ring_product_off(const ring_net *n, double *reach);

/* How a plane curve turns about the point 0. */
typedef struct ring_sweep {
    double angle; /* the sum of its spans' angles, nearly; rad */
    double gap;   /* >= angles between spans, and what ends are rounded by; INFINITY: not known */
    double first[2], last[2];
} ring_sweep;

ring_sweep ring_sweep_of(const ring_net *n, const knots *k, control_point *control);

/* Returns a g so that each direction is within g of one in which the curve goes from 0; INFINITY:
 * it is not known to go around. */
double ring_gap(const ring_sweep *s);

/* Returns such a g for all directions of a half plane beside the second axis. */
double ring_half_gap(const ring_sweep *s);

/* --- Vectors and numbers ---------------------------------------------------------------------- */

static inline imp_interval number(double x) { return imp_interval_make(x, x); }

/* Not rounded outward. */
static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline double apart(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(d, d));
}

#endif
