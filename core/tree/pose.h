/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_POSE_H
#define CORE_TREE_POSE_H

#include "core/tree/node.h"

/* Nodes from a shape and a pose
 * =============================
 * A shape is a part of a surface before its maps, if it does not move by itself: order-2 Taylor
 * models in s_u and s_v. A pose is the rotation and shift by rigid maps over a span of times:
 * polynomials of degree 2 in s_t. Their product is the node: it takes a twentieth of the work of an
 * inclusion through the maps, and shape and pose each serve many nodes. Arrays hold x, y
 * and z. */

typedef struct shape_model {
    double a[3], bu[3], bv[3], quu[3], quv[3], qvv[3]; /* length */
    double e[3], lo[3], hi[3];                         /* as in imp_model; length */
    double rate_u[3], rate_v[3];                       /* not loaded as triples */
    double ball;                                       /* of a tube: of the node (node.h); length */
} shape_model;

typedef struct pose_lanes {
    double turn[3][3][3];    /* the matrix; coefficient of 1, s, s^2; column; row */
    double shift[3][3];      /* coefficients of 1, s, s^2; length */
    double turn_error[3][3]; /* remainders, by column and row; */
    double turn_most[3][3];  /* >= |entry|; */
    double turn_rate[3][3];  /* 1 / time */
    double shift_error[3], shift_lo[3], shift_hi[3];
    double shift_rate[3]; /* length / time */
    double pivot[3];      /* length */
    double norm;          /* >= |turn x| / |x| */
} pose_lanes;

/* Fills p from a pose of the surface and its norm (surface_pose_norm_upper). */
void pose_take(pose_lanes *p, const imp_pose *given, double norm);

/* Fills s from finite models. False: they depend on time. */
bool shape_model_take(shape_model *s, const imp_model model[3]);

/* Fills what node_take_model fills with the image of the shape under the pose; n keeps pointers to
 * both. False: the image is not bounded, or the models broke a promise, and n is not filled. */
bool node_take_posed(node *n, const shape_model *s, const pose_lanes *p);

#endif
