/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_JET_H
#define TOOLS_CHECK_JET_H

#include "check_sampling.h"
#include "check_span.h"

/* A function over a box, with its first and second derivatives
 * ============================================================
 * v holds its values, d[j] its derivatives by variable j, h[j][k], j <= k, the second ones.
 * Where it has a kink, d holds all slopes between two points of the box, and h is everything.
 * What does not depend on a variable has 0 there, exactly. */

typedef struct jet {
    int n; /* variables */
    span v, d[BOX_DIMS], h[BOX_DIMS][BOX_DIMS];
} jet;

jet jet_constant(int n, span value);
jet jet_variable(int n, int j, span where);

jet jet_neg(const jet *x);
jet jet_add(const jet *x, const jet *y);
jet jet_sub(const jet *x, const jet *y);
jet jet_mul(const jet *x, const jet *y);
jet jet_scale(const jet *x, span k);
jet jet_div(const jet *x, const jet *y);
jet jet_min(const jet *x, const jet *y);
jet jet_max(const jet *x, const jet *y);
jet jet_power(const jet *x, const jet *y);
jet jet_angle(const jet *y, const jet *x);       /* atan2(y, x) */
jet jet_length(const jet *const x[], int count); /* sqrt(x[0]^2 + ...) */
jet jet_copysign(const jet *x, const jet *y);

/* Functions of one number: value, first and second derivative over a span. */
typedef void jet_function(span x, span g[3]);
jet jet_apply(jet_function *g, const jet *x);
jet_function jet_sqr_, jet_abs_, jet_sqrt_, jet_cbrt_, jet_exp_, jet_log_, jet_sin_, jet_cos_,
    jet_tan_, jet_asin_, jet_acos_, jet_atan_, jet_sinh_, jet_cosh_, jet_tanh_;

/* Values of the function over the box, by what is known there and at a point of it, its centre:
 * the best of three ways, whose excess shrinks with the first, second and third power of the size
 * of the box. */
span jet_values(const jet *box, const jet *centre, const span offset[BOX_DIMS]);

/* The same of its derivative by variable j; two ways. */
span jet_slopes(const jet *box, const jet *centre, const span offset[BOX_DIMS], int j);

#endif
