/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_JUDGE_H
#define TESTS_SUPPORT_JUDGE_H

#include <stdbool.h>

#include "core/surface/region.h"
#include "tests/support/oracle_number.h"

/* Whether a bound holds for an exact value. Every function answers true, or false and what is
 * wrong in `fault`. Only what is surely wrong counts. */

typedef struct fault {
    char text[512];
} fault;

/* |x - exact| <= error, for three coordinates. */
bool judge_point(const double x[3], const double error[3], const number exact[3], fault *fault);

/* Quadratic and remainder, range, and form of three models, for the value at s. */
bool judge_models(const imp_model model[3], const number s[3], const number exact[3], fault *fault);

/* The patch of a net over a region, exactly: coordinates at p = (u, v, t). */
void net_value(const imp_net *net, const imp_region *region, const double p[3], number x[3]);

/* Requires the point to be within the net's error. */
bool judge_net(const imp_net *net, const imp_region *region, const double p[3],
               const number exact[3], fault *fault);

/* |f_i(p) - f_i(q)| <= sum_j rate_j |p_j - q_j| for one coordinate, n parameters. */
bool judge_rates(int n, const double *rate, const double *p, const double *q, number at_p,
                 number at_q, fault *fault);

#endif
