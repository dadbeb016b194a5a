/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SPIN_H
#define PLUGINS_COMMON_SPIN_H

#include "plugins/common/near.h"

#include <impinge/formula.h>

/* From one rotation to another at constant spin
 * =============================================
 * In the time from s = 0 to h a body turns by
 *
 *   R(s) = turn(spin, s) M_0 + s D,   D = (M_h - turn(spin, h) M_0) / h,
 *
 * where M_0 and M_h are the rotations at both ends and turn(w, s) that by the angle |w| s about w.
 * The last term makes R(h) = M_h exactly, while doubles hold turn(spin, h) M_0 only nearly. It is
 * refused where it is more than rounding and the like:
 *
 * Lemma. No entry of h D is above SPIN_MISMATCH, so that no entry of R is beyond 1 + SPIN_MISMATCH,
 * |R x| <= (1 + 3 SPIN_MISMATCH) |x|, and no entry changes faster than |spin| + max |D|: a column
 * of turn M moves like a point at distance 1. */

#define SPIN_MISMATCH 1e-6

/* Entry (i,j) of R is along + cos A across + sin A turned + s drift, A = speed s. */
typedef struct spin_turn {
    near_constant along[3][3], across[3][3], turned[3][3], drift[3][3], speed;
    double spin[3];
} spin_turn;

/* From the rotation of the quaternion `from` to that of `to`, neither 0, in a time within h > 0; a
 * spin is 0 or has a square that is no subnormal. bound[0]: how fast entries change at most,
 * infinite where spin and rotations do not agree; bound[1]: 3 max |D| (1 + |spin| h). */
spin_turn spin_turn_make(const double spin[3], const double from[4], const double to[4],
                         imp_interval h, imp_interval bound[2]);

/* R over times t, of which `start` is s = 0; `speed` bounds how fast entries change. */
void spin_matrix(const spin_turn *r, double start, imp_model t, double speed, imp_model out[3][3]);

/* |x| is at most that. */
double spin_size_upper(const imp_model x[3]);

/* R x, no longer than (1 + 3 SPIN_MISMATCH) |x|. */
void spin_apply(imp_model r[3][3], const imp_model x[3], imp_model out[3]);

#endif
