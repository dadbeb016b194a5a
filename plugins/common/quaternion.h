/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_QUATERNION_H
#define PLUGINS_COMMON_QUATERNION_H

#include <impinge/model.h>
#include <impinge/plugin.h>

/* Quaternions that follow a spline
 * ================================
 * The keys of q are unit quaternions; of the two that mean the same orientation, the one nearer to
 * the key before is used. q between keys is not of unit length, but the rotation
 *
 *   R = 1 + 2 (w [v] + [v]^2) / |q|^2,   q = (w, v), [v] = v x
 *
 * is that of q / |q|, and as smooth as q because q stays away from 0:
 *
 * Lemma. With d = p + q for neighbouring keys p, q, |q| is at least (2 |d| - 1) / 3 between them.
 * For d.p = d.q = |d|^2 / 2, and d.r <= |d| for any key r. A step up the slope at p is a part of at
 * most 1 of q - r, so the control point next to p has at least d.p + (d.q - |d|) / 3, and likewise
 * next to q and in the first and last piece (d.(q - p) = 0). The curve is in the hull of such
 * points, so d.q(t) >= |d|^2 / 2 + (|d|^2 / 2 - |d|) / 3, and |q(t)| is at least that by |d|.
 *
 * With p.q >= QUATERNION_NEAR_MIN, |d| >= sqrt(2 + 2 QUATERNION_NEAR_MIN) > 1.47, and |q| > 0.64.
 */

/* Least cosine between quaternions of neighbours, which are half as far apart as their
 * orientations: 170 degrees. */
#define QUATERNION_NEAR_MIN 0.087

/* Checks that neighbours are near. `row`: the parameter's, for the error message. */
imp_status quaternion_keys_check(int row, const imp_value *rotations, imp_create_error *why);

/* Sets keys of a spline of `lanes` lanes: four lanes, from `key` on, to unit quaternions with signs
 * that make neighbours near. */
void quaternion_keys_set(const imp_value *rotations, size_t lanes, imp_interval *key);

/* R of a quaternion over times t. square_range holds |q|^2, `speed` bounds the angular speed. */
void quaternion_matrix(const imp_model q[4], imp_interval square_range, const imp_model *t,
                       double speed, imp_model r[3][3]);

/* R x. */
void quaternion_turn(imp_model r[3][3], const imp_model x[3], imp_model out[3]);

#endif
