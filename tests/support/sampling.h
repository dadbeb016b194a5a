/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SAMPLING_H
#define TESTS_SUPPORT_SAMPLING_H

#include <stdint.h>

#include "core/surface/region.h"
#include "tests/support/oracle_number.h"

/* Where bounds are tried: drawn from a seed, with the corners of all kinds well represented. */

/* Inside a domain, whose times may be infinite: whole, half, tiny, a single value, at either end;
 * times also far from 0. */
imp_region sample_region(uint64_t *random, const double lo[3], const double hi[3]);

/* A box of x, y, z, t: near the origin, far, tiny, a point. Times are inside [t_lo, t_hi]. */
imp_box4 sample_box(uint64_t *random, double t_lo, double t_hi);

/* A point of the box lo..hi in n dimensions, often at an end or in the middle. */
void sample_point(uint64_t *random, int n, const double *lo, const double *hi, double *p);

/* Another point of the box: anywhere, close by, or different in one number only. */
void sample_partner(uint64_t *random, int n, const double *lo, const double *hi, const double *p,
                    double *partner);

/* Models of some x, y, z over a region, as a surface might give them, and of t; and the
 * functions they are models of: polynomials of s and a term that fills the remainder. */
typedef struct sample_models {
    imp_region region;
    imp_model in[4];
    double rest[3]; /* coefficient of the product of all s that x, y, z depends on */
} sample_models;

sample_models sample_map_arguments(uint64_t *random, double t_lo, double t_hi);

/* x, y, z, t at p, exactly. */
void sample_value(const sample_models *models, const double p[3], number x[4]);

/* s_j = (p_j - c_j) / d_j; 0 where d_j is. */
void sample_normalized(const imp_region *region, const double p[3], number s[3]);

#endif
