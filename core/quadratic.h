/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_QUADRATIC_H
#define CORE_QUADRATIC_H

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

#define QUADRATIC_ROUNDING 0x1p-47

#endif
