/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_COIL_FORM_H
#define PLUGINS_EXPRESSION_COIL_FORM_H

#include "plugins/expression/builder.h"

/* Formulas that are coils
 * =======================
 * Three coordinates, in any order and each perhaps shifted by a number, are those of a coil
 * (plugins/common/coil.h) if
 *
 *   x = R cos(phi),   y = R sin(phi),   z = zeta,
 *
 * where phi and zeta are linear in u and v, and R depends on them by the sines and cosines of
 * multiples of one linear w = a u + b v alone. Along lines of constant w all of R stays, so that
 * these are helices: with p = d zeta / d phi there, zeta = p phi + kappa w + rest, and screw
 * motions that advance by 2 pi p a turn take the surface to itself. The form is found in the
 * operations, by identities of real numbers: nothing is compared numerically but exact doubles. */

typedef struct coil_form {
    int along;        /* which coordinate is z; x is the next one, or the one after that */
    bool is_mirrored; /* x is the one after that: x, y, z are left-handed */
    double center[3]; /* length */
    double w[2];      /* a, b; not both 0 */
    near_constant p, kappa, rest;
    int around; /* phi depends on this parameter alone, and zeta on the other one; or -1 */
    near_constant turning; /* d phi / d of it, then; rad */
    uint16_t radius;       /* the operation that computes R */
    /* R changes no more if w is moved by whole turns of phi, k (2 pi p / kappa), than if each w in
     * it is moved by some |k| (2 pi p / kappa) times this. */
    double drift;
} coil_form;

/* False: it has not that form, as far as is known. */
bool coil_form_find(const builder *b, const uint16_t out[3], coil_form *found);

#endif
