/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_TANGENT_FORMS_H
#define CORE_BOUNDS_TANGENT_FORMS_H

#include "core/bounds/normal_turn.h"

/* Forms of vectors along the two tangents of a frame
 * ================================================== */

/* A symmetric trilinear form of vectors along the tangents; one number for 111, 112, 122, 222. */
typedef struct cubic {
    double x[4];
} cubic;

static inline double form_of(const form *k, const double *x, const double *y)
{
    return k->xx * x[0] * y[0] + k->xy * (x[0] * y[1] + x[1] * y[0]) + k->yy * x[1] * y[1];
}

/* The form C(x, ., .). */
static inline form cubic_by(const cubic *c, const double *x)
{
    return (form){c->x[0] * x[0] + c->x[1] * x[1], c->x[1] * x[0] + c->x[2] * x[1],
                  c->x[2] * x[0] + c->x[3] * x[1]};
}

static inline double cubic_of(const cubic *c, const double *x, const double *y, const double *z)
{
    const form k = cubic_by(c, x);
    return form_of(&k, y, z);
}

static inline form form_abs(form k) { return (form){fabs(k.xx), fabs(k.xy), fabs(k.yy)}; }

/* The vector K x. */
static inline void form_turn(const form *k, const double *x, double y[2])
{
    y[0] = k->xx * x[0] + k->xy * x[1];
    y[1] = k->xy * x[0] + k->yy * x[1];
}

#endif
