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

typedef struct span {
    double lo, hi;
} span;

/* An enclosure of the range: exact but for rounding. In exact arithmetic the range lies within
 * QUADRATIC_ROUNDING * (sum of abs of the coefficients) of it. */
span quadratic_span(const quadratic *p);

/* Two values that surely occur: no lower bound can exceed the lower, no upper be below the upper.
 */
static inline span quadratic_glimpse(const quadratic *p)
{
    const double slopes = fabs(p->bs) + fabs(p->br) - fabs(p->qsr), curved = p->qss + p->qrr;
    const double lo = curved - slopes, hi = curved + slopes;
    return (span){lo < 0 ? lo : 0, hi > 0 ? hi : 0};
}

#define QUADRATIC_ROUNDING 0x1p-47

#endif
