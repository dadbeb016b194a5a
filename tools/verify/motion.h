/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_MOTION_H
#define TOOLS_VERIFY_MOTION_H

#include "tools/verify/enclose.h"
#include "tools/verify/net.h"

/* Affine maps of a chain, and polynomials
 * =======================================
 * Most maps take x to M x + d, M and d depending on time alone, and most shapes do not move by
 * themselves: either is bounded once for all boxes of the other. */

/* Notes of each part whether it is an affine map, and turns, or is a polynomial. */
void motion_prepare(statement *s);

/* Bounds the maps of a place over the times from lo to hi, if all of them are affine, *is_affine.
 */
enclosed motion_bound(const place *p, double lo, double hi, motion *m, bool *is_affine,
                      split *divide);

/* How much the elements of a form change over some times, in parts of these. */
enum { CHANGE_PARTS = 16 };

typedef struct form_changes {
    bool are_known; /* false: the maps may not be affine */
    double most[CHANGE_PARTS][4][4];
    double lift[CHANGE_PARTS][4]; /* of w^T N h */
} form_changes;

/* Bounds how much the elements of h^T N^T E N h change over the times from lo to hi from what they
 * are at their middle, and those of w^T N h; N h = M p + d - c, h = (p, 1), E symmetric. */
void motion_form_changes(const place *p, double lo, double hi, const double c[3],
                         ld_interval e[3][3], const double w[3], form_changes *to);

/* Returns an upper bound of how much x^T E x changes, x = M p + d - c, |p[i]| <= size[i]; INFINITY:
 * it is not known. */
double form_change_upper(const form_changes *s, const double size[3]);

/* Returns an upper bound of how much w^T x changes, likewise. */
double form_lift_upper(const form_changes *s, const double size[3]);

/* Returns an upper bound d of |J^T J - 1| for the Jacobian J of a map, at all times from lo to hi.
 * If d < 1, the map is affine at each time, and multiplies no length by less than the root of 1 -
 * d. INFINITY: it may not be affine. */
double map_deviation_upper(const statement *s, size_t map, double lo, double hi, jet *room);

#endif
