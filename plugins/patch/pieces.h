/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PIECES_H
#define PLUGINS_PATCH_PIECES_H

#include <impinge/formula.h>

/* One model for a region that is in pieces
 * ========================================
 * A piecewise smooth surface has a good model over each piece of a region. One quadratic for them
 * all comes from a few points, as if the surface were smooth; how far it is from the quadratic of
 * each piece, and that one's remainder, bound its own. So a region that a knot crosses is hardly
 * worse than others: it loses what the knot's jump in curvature costs, and no more. */

typedef imp_status pieces_eval(const void *self, size_t n, const double *p, double *x,
                               double *error);

/* Quadratics of x, y, z that follow the surface; how closely is not said. */
imp_status pieces_sample(pieces_eval *eval, const void *self, const imp_region *region,
                         imp_model model[3]);

/* The parameter of the whole as sigma + delta times that of the piece. */
typedef struct pieces_shift {
    double sigma[3], delta[3];
} pieces_shift;

/* Both regions have parameters within the whole's. */
pieces_shift pieces_shift_of(const imp_region *whole, const imp_region *piece);

/* Before the first piece. */
void pieces_begin(imp_model *whole);

/* Includes a piece, whose model is g. */
void pieces_add(imp_model *whole, const imp_model *g, const pieces_shift *shift);

/* The model of the whole, after the last piece. */
imp_model pieces_end(const imp_model *whole);

#endif
