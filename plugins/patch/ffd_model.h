/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_FFD_MODEL_H
#define PLUGINS_PATCH_FFD_MODEL_H

#include "plugins/common/near.h"
#include "plugins/patch/lattice.h"

#include <stdbool.h>

/* Free-form deformation
 * =====================
 * A lattice of control points fills a box; moving them deforms the space inside. With a, b, c the
 * coordinates of a point in the box, limited to [0, 1], and D_ijk how far a control point is from
 * its place in the undeformed lattice,
 *
 *   phi(x,y,z,t) = (x,y,z) + sum_ijk B_i(a) B_j(b) B_k(c) (D_ijk + t velocity_ijk).
 *
 * Inside the box this is Sederberg's and Parry's map, as Bernstein polynomials reproduce the
 * undeformed lattice exactly. Outside, space moves along with the nearest point of the box:
 * continuous and Lipschitz, with a kink at the box unless its outermost layers stay in place.
 *
 * Models of x, y, z lie in some box of a, b, c. There the polynomials become quadratics with a
 * remainder (lattice.h), into which the models are put. */

typedef struct ffd_instance {
    lattice lattice;
    bool moves;
    double lo[3], hi[3];
    near_constant per_length[3]; /* 1 / (hi - lo) */
    lattice_lane shape[3], drift[3];
    double *given; /* 3 numbers of each control point, then 3 of each velocity if it moves */
    double memory[];
} ffd_instance;

/* What the three coordinates share: where in the box the models x, y, z lie. */
typedef struct ffd_place {
    lattice_box box;
    double centre[3], half[3]; /* of a, b, c */
    imp_model s[3];         /* (a - centre) / half and so on; whatever in [-1, 1] where half is 0 */
    imp_model product[6];   /* s_j s_k, j < k */
    imp_model chebyshev[6]; /* 2 s_j^2 - 1 */
    imp_interval stretch[3]; /* da/dx and so on */
    imp_interval times;
    double middle, reach; /* of time */
    imp_model late;       /* t - middle */
} ffd_place;

/* Where the models x lie in the box, over the times of t. */
void ffd_set_place(const ffd_instance *s, const imp_model x[3], imp_model t, ffd_place *place);

/* One coordinate's displacement over the place. Its series at the middle time is shape + middle
 * drift; of drift (t - middle), what is bowed goes to the remainder. */
typedef struct ffd_terms {
    lattice_terms shape, drift;
    double noise, drift_noise;
} ffd_terms;

/* The terms of one coordinate's displacement over the place. */
void ffd_set_terms(const ffd_instance *s, const ffd_place *place, int axis, ffd_terms *terms);

/* Coordinate `axis` of phi, where `at` is that of x. */
imp_model ffd_image(const ffd_instance *s, const ffd_place *place, int axis, const ffd_terms *terms,
                    imp_model at);

/* Sets out->rate of that coordinate; `in` are the models of x, y, z and t. */
void ffd_set_rates(const ffd_instance *s, const ffd_place *place, int axis, const ffd_terms *terms,
                   const imp_model in[4], imp_model *out);

#endif
