/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_JET_H
#define TOOLS_PROOF_JET_H

#include "tools/proof/box.h"
#include "tools/proof/ld_interval.h"

/* A function over a box, with its first and second derivatives
 * ============================================================
 * v holds its values, d[j] its derivatives by variable j, h[j][k], j <= k, the second ones. Where
 * it has a kink, d holds all slopes between two points of the box, and h is everything. The
 * derivatives by a variable that the function does not depend on are exactly 0. Second derivatives
 * may be left out; then what is computed from the jet has none. */

typedef struct jet {
    int n;             /* variables */
    int bends;         /* n, or 0: second derivatives are left out */
    int on;            /* bit j: it may depend on variable j; the other derivatives are 0 */
    bool is_undefined; /* it, or an operand, may have no value somewhere in the box */
    ld_interval v, d[BOX_DIMS], h[BOX_DIMS][BOX_DIMS];
} jet;

static inline bool jet_has(const jet *x, int j) { return (x->on >> j & 1) != 0; }

jet jet_constant(int n, ld_interval value);
jet jet_variable(int n, int j, ld_interval where);

/* All that either is. */
jet jet_hull(const jet *x, const jet *y);

jet jet_neg(const jet *x);
jet jet_add(const jet *x, const jet *y);
jet jet_sub(const jet *x, const jet *y);
jet jet_mul(const jet *x, const jet *y);
jet jet_scale(const jet *x, ld_interval k);
jet jet_div(const jet *x, const jet *y);
jet jet_min(const jet *x, const jet *y);
jet jet_max(const jet *x, const jet *y);
jet jet_power(const jet *x, const jet *y);
jet jet_angle(const jet *y, const jet *x);       /* atan2(y, x) */
jet jet_length(const jet *const x[], int count); /* sqrt(x[0]^2 + ...) */
jet jet_copysign(const jet *x, const jet *y);

/* Functions of one number: value, first and second derivative over an ld_interval. They return
 * whether the function has a value on all of it. */
typedef bool jet_function(ld_interval x, ld_interval g[3]);
jet jet_apply(jet_function *g, const jet *x);
jet_function jet_sqr_, jet_abs_, jet_sqrt_, jet_cbrt_, jet_exp_, jet_log_, jet_sin_, jet_cos_,
    jet_tan_, jet_asin_, jet_acos_, jet_atan_, jet_sinh_, jet_cosh_, jet_tanh_;

/* Returns whether all of x is at least `least`. What is less by no more than 2^-40 counts as
 * `least`, unless all of x is: where 1 - u^2 ends at 0, rounding takes it below. */
static inline bool jet_is_from(ld_interval x, proof_real least)
{
    const proof_real slack = 0x1p-40F;
    return x.lo >= least - slack && x.hi >= least;
}

/* Range of the function over the box, from its jets over the box and at its centre: the
 * intersection of three bounds, whose excess shrinks with the first, second and third power of the
 * size of the box. */
ld_interval jet_values(const jet *box, const jet *centre, const ld_interval offset[BOX_DIMS]);

/* Narrows the values and first derivatives over the box by those bounds. */
void jet_narrow(jet *wide, const jet *centre, const ld_interval offset[BOX_DIMS]);

/* Range of the function's derivative by variable j, the intersection of two bounds. */
ld_interval jet_slopes(const jet *box, const jet *centre, const ld_interval offset[BOX_DIMS],
                       int j);

#endif
