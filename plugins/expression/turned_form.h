/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TURNED_FORM_H
#define PLUGINS_EXPRESSION_TURNED_FORM_H

#include "plugins/expression/builder.h"

/* Formulas that are surfaces of revolution
 * ========================================
 * Three coordinates, in any order and each perhaps shifted by a number, are those of a surface of
 * revolution if
 *
 *   x = R cos(phi),   y = R sin(phi),   z = Z,
 *
 * either of x and y perhaps with the other sign, where phi depends on one of u and v alone, and R
 * and Z on no more than the other one. Points of one value of the other parameter are on one circle
 * about the axis then. The form is found in the operations, by identities of real numbers. */

typedef struct turned_form {
    int along;                      /* which coordinate is z */
    int around;                     /* phi depends on this parameter */
    double center[3];               /* 0 along z; length */
    uint16_t radius, height, angle; /* the operations that compute R, Z and phi */
} turned_form;

/* Adds operations for R. False: it has not that form, as far as is known. */
bool turned_form_find(builder *b, const uint16_t out[3], turned_form *found);

#endif
