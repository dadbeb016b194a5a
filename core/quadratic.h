/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_QUADRATIC_H
#define CORE_QUADRATIC_H

#include <math.h>

/* The range of one quadratic over a square
 * ========================================
 * p(s, r) = bs s + br r + qss s^2 + qsr s r + qrr r^2 for s, r in [-1, 1]. */

typedef struct quadratic {
    double bs, br, qss, qsr, qrr;
} quadratic;

/* A lower bound over the square: exact but for rounding. In exact arithmetic the minimum is at
 * least this - QUADRATIC_ROUNDING * (sum of abs of the coefficients). */
double quadratic_lower(const quadratic *p);

/* The same where `edge` is known to be a lower bound over the square's edge. */
double quadratic_inner_lower(const quadratic *p, double edge);

/* A value that surely occurs: no lower bound can exceed it. */
static inline double quadratic_glimpse(const quadratic *p)
{
    const double x = p->qss + p->qrr - (fabs(p->bs) + fabs(p->br) - fabs(p->qsr));
    return x < 0 ? x : 0;
}

#define QUADRATIC_ROUNDING 0x1p-47

#endif
