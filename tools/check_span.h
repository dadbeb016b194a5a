/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SPAN_H
#define TOOLS_CHECK_SPAN_H

#include <stdbool.h>

/* Intervals that proofs are made of
 * =================================
 * What a plugin claims is proved or refuted by an arithmetic that shares nothing with the one the
 * plugin was written in: not <impinge/model.h>, nor <impinge/interval.h>, not even their libm
 * functions. Ends are long doubles: with more digits than the claims have, what a claim loses by
 * rounding outward is enough to prove it. (Where long double is double all answers still hold, and
 * claims that are tight stay unsettled.)
 *
 * [lo, hi], lo <= hi, ends may be infinite; every answer holds all values for all operands, and no
 * NaN. Where nothing is known, it is everything. Roots, logarithms, powers and the arcs of sine and
 * cosine regard that part of an operand where they are defined. */

typedef struct span {
    long double lo, hi;
} span;

span span_make(long double lo, long double hi); /* NaN: infinite */
span span_of(long double x);
span span_whole(void);
span span_pi(void);
span span_e(void);

bool span_is_within(span x, span limits);
bool span_is(span x, long double value); /* that value and no other */
long double span_mag(span x);            /* greatest |z| */
long double span_mid(span x);            /* within x; x finite */
span span_hull(span x, span y);          /* all between */
span span_meet(span x, span y);          /* both are true of something */
span span_plus_minus(long double size);  /* [-size, size] */

/* Sums and products that need no rounding are exact. */
span span_neg(span x);
span span_add(span x, span y);
span span_sub(span x, span y);
span span_mul(span x, span y);
span span_scale(span x, long double k);
span span_inverse(span x);
span span_div(span x, span y);
span span_sqr(span x);
span span_abs(span x);
span span_min(span x, span y);
span span_max(span x, span y);

span span_sqrt(span x);
span span_cbrt(span x);
span span_exp(span x);
span span_log(span x);
span span_sin(span x);
span span_cos(span x);
span span_tan(span x);
span span_asin(span x);
span span_acos(span x);
span span_atan(span x);
span span_sinh(span x);
span span_cosh(span x);
span span_tanh(span x);
span span_whole_power(span x, int n);
span span_power(span x, span y); /* x >= 0 */
span span_angle(span y, span x); /* of the point (x, y), continuous where it is not everything */

#endif
