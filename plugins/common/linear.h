/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_LINEAR_H
#define PLUGINS_COMMON_LINEAR_H

#include <impinge/model.h>
#include <impinge/plugin.h>

/* Surfaces that are linear in u, in v and in t
 * ============================================
 * Per coordinate, and with w = 1, u, v, u v,
 *
 *   g(u, v, t) = sum_k (K_k + t V_k) w_k
 *
 * describes points, segments, triangles and parallelograms whose corners move linearly. Over a
 * region this is a quadratic but for the term in u v t, so the inclusion is exact: a remainder of
 * |d_u d_v d_t V_uv| and rounding. Extremes of g and of its derivatives are at corners of
 * the region, because each is linear in each parameter that is left.
 *
 * K_u and K_uv are differences of what the caller gave, rounded once. K_1 is given, and is added
 * last, so that far from the origin the error is hardly more than the rounding of the result. */

enum { LINEAR_1, LINEAR_U, LINEAR_V, LINEAR_UV, LINEAR_TERMS };

/* Limits that keep every number below finite, as for patches. */
#define LINEAR_FAR 1e100
#define LINEAR_LATE 1e50

/* x, y and z of each coefficient lie side by side; the fourth number is 0. */
typedef struct linear {
    double still[LINEAR_TERMS][4];  /* K */
    double motion[LINEAR_TERMS][4]; /* V */
    int64_t depends[4];             /* as in imp_model, of each coordinate */
    int64_t is_affine[4];           /* no products of u, v, t: -1, else 0 */
} linear;

/* A list of COUNT corners, or of their velocities. */
#define ROW_CORNERS(NAME, UNIT, DEFAULT, COUNT, FLAGS, DOC)                                        \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 2, COUNT, 3, -LINEAR_FAR, LINEAR_FAR, DOC)

/* One corner, edge or velocity. */
#define ROW_NEAR_VECTOR(NAME, UNIT, DEFAULT, FLAGS, DOC)                                           \
    IMP_ROW(NAME, UNIT, DEFAULT, FLAGS, 1, 3, 0, -LINEAR_FAR, LINEAR_FAR, DOC)

/* Completes f once its coefficients are set, fourth numbers included. */
void linear_finish(linear *f);

/* Implements imp_surface_type.eval. */
imp_status linear_eval(const void *self, size_t n, const double *p, double *x, double *error);

/* Implements imp_surface_type.rate. */
imp_status linear_rate(const void *self, const imp_region *region, imp_rate_matrix *rates);

/* Implements imp_surface_type.include. */
imp_status linear_include(const void *self, const imp_region *region, imp_model model[3]);

/* Implements imp_surface_type.net: the values at the region's corners. */
imp_status linear_net(const void *self, const imp_region *region, imp_net *net);

#endif
