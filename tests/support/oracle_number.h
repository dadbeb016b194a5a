/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ORACLE_NUMBER_H
#define TESTS_SUPPORT_ORACLE_NUMBER_H

#include <mpfi.h>
#include <stdbool.h>

/* Numbers to judge bounds by
 * ==========================
 * A number is an interval of 200 bits that surely holds the exact value, so what an oracle
 * answers can be trusted to some 60 digits. Operations nest like in a formula:
 *
 *     x = num_mul(radius, num_mul(num_cos(v), num_cos(u)));
 *
 * Results come from a pool and last until num_forget. */

typedef mpfi_srcptr number;

/* Gives back all numbers made so far. */
void num_forget(void);

/* A number that may be written to. */
mpfi_ptr num_fresh(void);

number num(double x);
number num_pi(void);
number num_add(number x, number y);
number num_sub(number x, number y);
number num_mul(number x, number y);
number num_div(number x, number y);
number num_neg(number x);
number num_abs(number x);
number num_sqr(number x);
number num_sqrt(number x);
number num_exp(number x);
number num_log(number x);
number num_sin(number x);
number num_cos(number x);
number num_tan(number x);
number num_asin(number x);
number num_acos(number x);
number num_atan(number x);
number num_sinh(number x);
number num_cosh(number x);
number num_tanh(number x);
number num_cbrt(number x);
number num_atan2(number y, number x);
number num_hypot(number x, number y);
number num_power(number x, unsigned n);

/* sum_k coefficient[k * stride] x^k. */
number num_poly(const double *coefficient, size_t count, size_t stride, number x);

/* Surely so. */
bool num_is_less(number x, number y);

/* Neither end is infinite or NaN. */
bool num_is_bounded(number x);

/* Nearest double, to print. */
double num_near(number x);

#endif
