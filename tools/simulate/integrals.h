/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_INTEGRALS_H
#define TOOLS_SIMULATE_INTEGRALS_H

#include "tools/simulate/shells.h"

/* Integrals over shells, from which mass properties follow (mass.h). */

/* VOLUME: I(x.n) / 3. MOMENT, SQUARE: of x_i and x_i^2 over the volume. MIXED: of xy, yz, zx. AREA:
 * I(n). BY_AXIS: I(x n_x), I(y n_y), I(z n_z). */
enum { VOLUME, MOMENT, SQUARE = 4, MIXED = 7, AREA = 10, BY_AXIS = 13, INTEGRALS = 16 };

typedef struct integrals {
    double sum[INTEGRALS], change[INTEGRALS]; /* change: by the last extrapolation, absolute */
    vec origin;                               /* what they are about */
} integrals;

/* Finds the integrals of each shell, with its first patch's normals outward; `cells`, of the finest
 * grid, is a power of 2, at least 4. */
shape_verdict integrals_find(const patches *p, const shells *s, int cells, integrals *each,
                             imp_error *why);

#endif
