/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_FORM_H
#define TOOLS_VERIFY_FORM_H

#include "tools/verify/motion_internal.h"

/* What motion_form.c and form_turned.c share: quadratic forms of points that move. */

/* Returns the element i, k of N^T E L, where N and L are M and d - c. */
jet form_of(const jet n[3][4], const jet l[3][4], ld_interval e[3][3], int i, int k);

/* Returns the element k of w^T N. */
jet lift_of(const jet n[3][4], const double w[3], int k);

/* Row 4 holds w^T N; the others N^T E N, which is symmetric like E. */
typedef ld_interval form_elements[5][4];

/* The elements of a form over some times, as motion_form_changes takes them. */
typedef struct form_course {
    const place *p;
    double lo, hi;
    const double *c, *w;
    ld_interval (*e)[3];
    form_elements before; /* at the middle */
} form_course;

/* Bounds the changes over the times of a map that turns by those of its mean over all angles, and
 * by how much an angle does. False: none turns, or some may not be affine. */
bool form_turned_changes(const form_course *f, form_changes *to);

#endif
