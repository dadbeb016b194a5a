/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_LD_INTERVAL_H
#define TOOLS_PROOF_LD_INTERVAL_H

#include "tools/proof/ld_ends.h"

/* Interval arithmetic of the proofs
 * =================================
 * The claims of a plugin are proved or refuted by an arithmetic that shares no code with the
 * plugin's: neither <impinge/model.h>, nor <impinge/interval.h>, nor their libm functions. Ends are
 * long doubles. They have more digits than the claims, so that the outward rounding of a claim is
 * enough slack to prove it. (If long double is double, all results still hold, but tight claims
 * stay unsettled.) impinge-verify is built with PROOF_DOUBLE: its ends are doubles, and it has
 * operations of its own (double_interval.h) and functions.
 *
 * [lo, hi], lo <= hi, ends may be infinite; every result contains all values for all operands, and
 * no end is NaN. If nothing is known, the result is the whole line. Roots, logarithms, powers, asin
 * and acos use the part of an operand where they are defined. */

#ifdef PROOF_DOUBLE
#include "tools/proof/double_interval.h"
#else
/* Sums and products that need no rounding are exact. */
ld_interval ld_interval_add(ld_interval x, ld_interval y);
ld_interval ld_interval_sub(ld_interval x, ld_interval y);
ld_interval ld_interval_mul(ld_interval x, ld_interval y);
ld_interval ld_interval_scale(ld_interval x, proof_real k);
ld_interval ld_interval_inverse(ld_interval x);
ld_interval ld_interval_div(ld_interval x, ld_interval y);
ld_interval ld_interval_sqr(ld_interval x);
ld_interval ld_interval_sqrt(ld_interval x);
#endif

ld_interval ld_interval_pi(void);
ld_interval ld_interval_e(void);

ld_interval ld_interval_cbrt(ld_interval x);
ld_interval ld_interval_exp(ld_interval x);
ld_interval ld_interval_log(ld_interval x);
ld_interval ld_interval_sin(ld_interval x);
ld_interval ld_interval_cos(ld_interval x);
ld_interval ld_interval_tan(ld_interval x);
ld_interval ld_interval_asin(ld_interval x);
ld_interval ld_interval_acos(ld_interval x);
ld_interval ld_interval_atan(ld_interval x);
ld_interval ld_interval_sinh(ld_interval x);
ld_interval ld_interval_cosh(ld_interval x);
ld_interval ld_interval_tanh(ld_interval x);
ld_interval ld_interval_integer_power(ld_interval x, int n);
ld_interval ld_interval_power(ld_interval x, ld_interval y); /* x >= 0 */
ld_interval
ld_interval_angle(ld_interval y,
                  ld_interval x); /* of the point (x, y), continuous where it is not everything */

#endif
