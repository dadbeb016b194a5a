/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_NET_DISTANCE_H
#define TESTS_SUPPORT_NET_DISTANCE_H

#include "core/bounds/net_axis.h"
#include "core/bounds/net_halves.h"
#include "core/witness/contact_estimate.h"
#include "tests/support/compose.h"
#include "tests/support/judge.h"
#include "tests/support/netted.h"
#include "tests/support/sphere_scenes.h"
#include "tests/support/suite.h"

/* Exact distances of points of two nets. */

static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};

/* The squared distance of points of two nets. */
static inline number square_between(const netted *const both[2], const double p[2][3])
{
    number x[2][3], sum = num(0);
    for (int side = 0; side < 2; ++side)
        net_value(&both[side]->given, &both[side]->n.region, p[side], x[side]);
    for (int i = 0; i < 3; ++i) sum = num_add(sum, num_sqr(num_sub(x[0][i], x[1][i])));
    return sum;
}

#endif
