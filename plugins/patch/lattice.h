/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_LATTICE_H
#define PLUGINS_PATCH_LATTICE_H

#include <impinge/interval.h>
#include <stddef.h>

/* Polynomials over the unit cube, by a lattice of control points
 * ==============================================================
 * F(a, b, c) = sum_ijk B_i(a) B_j(b) B_k(c) net_ijk, of degrees l, m, n in a, b, c from [0, 1];
 * net_ijk at index (i (m+1) + j)(n+1) + k. The same polynomial in x = 2a - 1 and so on is the
 * series sum_ijk R_ijk T_i T_j T_k (chebyshev.h).
 *
 * Over a box, x = centre + half s, and F = sum_ijk C_ijk T_i(s_1) T_j(s_2) T_k(s_3). What has i + j
 * + k <= 2 is a quadratic; the rest is at most the sum of the |C_ijk|, because |T_i| <= 1; and
 * |T_i'| <= i^2 bounds the derivatives. */

enum { LATTICE_SIDE_MAX = 16, LATTICE_POINTS_MAX = 4096 }; /* work space on the stack: 64 kB */

/* Covers second-order terms and the rounding of a bound itself. */
#define LATTICE_SLACK (1 + 0x1p-40)

typedef struct lattice_lane {
    double *net, *series;
    double slip;           /* every number of the net is off by at most this */
    double most;           /* max |net| */
    double sum;            /* sum |R| */
    double noise;          /* as above, and slip */
    imp_interval range;    /* of F */
    imp_interval slope[3]; /* of its derivatives over the whole cube */
} lattice_lane;

typedef struct lattice {
    int degree[3];
} lattice;

static inline size_t lattice_points(const lattice *f)
{
    return (size_t)(f->degree[0] + 1) * (size_t)(f->degree[1] + 1) * (size_t)(f->degree[2] + 1);
}

/* How many numbers stand side by side for each step along an axis. */
static inline size_t lattice_inner(const lattice *f, int axis)
{
    size_t inner = 1;
    for (int j = axis + 1; j < 3; ++j) inner *= (size_t)(f->degree[j] + 1);
    return inner;
}

/* Sets everything that follows from net and slip. `work` has the size of a net. */
void lattice_set(const lattice *f, lattice_lane *lane, double *work);

typedef struct lattice_weights {
    double w[3][LATTICE_SIDE_MAX];
} lattice_weights;

/* The Bernstein polynomials at a point of the cube. */
void lattice_weigh(const lattice *f, const double at[3], lattice_weights *weights);

/* F at a point; *error is at least its error. */
double lattice_at(const lattice *f, const lattice_lane *lane, const lattice_weights *weights,
                  double *error);

/* A box of the cube, as x = centre + half s in [-1, 1]: the matrices that move series there. */
typedef struct lattice_box {
    double shift[3][LATTICE_SIDE_MAX * LATTICE_SIDE_MAX];
} lattice_box;

/* Sets the matrices for coordinates centre[j] -+ half[j], inside [0, 1] but for rounding. */
void lattice_enter(const lattice *f, const double centre[3], const double half[3],
                   lattice_box *box);

/* F over a box, up to its noise: the terms of at most second order, and sums of others. */
typedef struct lattice_terms {
    double mean, linear[3], product[6]; /* C; order of products: IMP_UU ... IMP_TT */
    double size, bowed, rest;           /* sums of |C|, i + j + k >= 1, 2, 3 */
    double along[3];                    /* at least |dF/ds_j - linear_j| */
} lattice_terms;

/* The terms of a series over a box. */
lattice_terms lattice_over(const lattice *f, const lattice_box *box, const double *series);

#endif
