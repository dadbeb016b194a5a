/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_TRIANGLE_H
#define PLUGINS_PATCH_TRIANGLE_H

#include "plugins/patch/patch.h"

/* A Bezier triangle as a patch
 * ============================
 * With barycentric coordinates a + b + c = 1 and control points P_kj, j <= k <= n, a triangle of
 * degree n is
 *
 *   f = sum_kj n! / ((n-k)! (k-j)! j!) a^(n-k) b^(k-j) c^j P_kj,
 *
 * P_00, P_n0 and P_nn being its corners. As that number is choose(n, k) choose(k, j), with a = 1 -
 * u, b = u (1 - v) and c = u v
 *
 *   f = sum_k B_k(u) C_k(v),   C_k(v) = sum_j choose(k, j) (1-v)^(k-j) v^j P_kj.
 *
 * That is a patch of degrees n and n: row k of its net is the curve C_k, its degree raised from k
 * to n. The edge u = 0 is the corner P_00, and a region that begins there is a triangle; f is a
 * polynomial there as anywhere, so each bound of a patch holds, and its rates along v fall to 0
 * with u. */

enum { TRIANGLE_DEGREE_MAX = 10 };

static inline size_t triangle_points(int degree)
{
    return (size_t)(degree + 1) * (size_t)(degree + 2) / 2;
}

/* P_kj is at index k (k + 1) / 2 + j. */
typedef struct triangle_data {
    int degree;
    const double *points, *velocities, *weights; /* as in patch_data */
    const double *which; /* which of these the control points are; NULL: 0, 1, 2, ... */
} triangle_data;

/* NULL: no memory. free() it. */
patch *triangle_new(const triangle_data *data);

#endif
