/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_SUPERQUADRIC_H
#define PLUGINS_COMMON_SUPERQUADRIC_H

#include <impinge/model.h>
#include <impinge/plugin.h>

/* The superellipse |X|^p + |Y|^p = 1 by its angle
 * ===============================================
 *   (X, Y)(a) = (cos a, sin a) / (|cos a|^p + |sin a|^p)^(1/p),   p = 2 / exponent >= 1.
 *
 * The textbook (cos^e a, sin^e a) draws the same curve, but at infinite speed for exponents e < 1.
 * From the axis that is nearest, at an angle b with w = tan b,
 *
 *   X = G(w),  Y = w G(w),  G = (1 + |w|^p)^(-1/p),   dG/dw = -sgn(w) |w|^(p-1) G^(p+1),
 *                                                     d(w G)/dw = G^(p+1),  dw/db = 1 + w^2. */

typedef struct superellipse {
    double exponent; /* e, 0 < e <= 2 */
    double power;    /* q, nearly p; INFINITY if it overflows */
    double dent;     /* at least |z^2 - z^p| for z in [0, 1] */
} superellipse;

/* Exponents of two superellipses, the first and second number of a row. */
#define ROW_EXPONENTS(DOC)                                                                         \
    IMP_ROW("exponents", "1", "[0.5,0.5]", IMP_PARAMETER_MIN_OPEN, 1, 2, 0, 0, INFINITY, DOC)

/* Checks that each of the two exponents is in (0, 2]. */
imp_status superellipse_check_exponents(const imp_value *exponents, int row, imp_create_error *why);

/* The curve of that exponent, which is in (0, 2]. */
superellipse superellipse_of(double exponent);

/* Computes X and Y at an angle of moderate size. */
void superellipse_at(const superellipse *s, imp_model angle, imp_model *x, imp_model *y);

#endif
