/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_ELIMINATE_H
#define TOOLS_SIMULATE_ELIMINATE_H

#include <stdbool.h>
#include <stddef.h>

enum { EQUATIONS_MAX = 4 };

/* Solves `count` linear equations by Gaussian elimination without exchange of rows. Row i of m has
 * the coefficients, then the right side at [i][count]; m is overwritten. False: pivot i is not
 * above least[i], and x has no meaning. */
bool eliminate_solve(size_t count, double m[EQUATIONS_MAX][EQUATIONS_MAX + 1],
                     const double least[EQUATIONS_MAX], double x[EQUATIONS_MAX]);

#endif
