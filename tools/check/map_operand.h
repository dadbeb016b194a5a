/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_MAP_OPERAND_H
#define TOOLS_CHECK_MAP_OPERAND_H

#include <impinge/surface.h>

#include "tools/check/sampling.h"

/* A test surface for a map
 * ========================
 * A map's apply turns models of x, y, z, t into models. To test it, we need surfaces whose models
 * are right and whose points are exact. We use polynomials with short binary numbers over regions
 * with short binary ends, at points s with short binary numbers: all values are sums of at most
 * eleven multiples of 2^-48 below 2^4, exact in double. The remainder is a term in s_u s_v s_t,
 * which fills it at the corners. */

typedef struct under {
    imp_region region; /* c and d exact */
    imp_model in[4];   /* x, y, z, t */
    double rest[3];    /* coefficient of s_u s_v s_t */
} under;

/* Times are taken from [t_lo, t_hi]. */
under under_draw(uint64_t *random, double t_lo, double t_hi);

/* x, y, z, t at s, multiples of 2^-10 in [-1, 1]. Exact. */
void under_value(const under *surface, const double s[3], double x[4]);

/* Returns the value of a quadratic's ten coefficients at s; *size: the sum of its terms'
 * magnitudes. */
long double under_quadratic(const imp_model *g, const long double s[3], long double *size);

#endif
