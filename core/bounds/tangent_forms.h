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

/* A symmetric form of four such vectors; one number for 1111, 1112, 1122, 1222, 2222. */
typedef struct quartic {
    double x[5];
} quartic;

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

/* The form Q(x, ., ., .). */
static inline cubic quartic_by(const quartic *q, const double *x)
{
    cubic c;
    for (int i = 0; i < 4; ++i) c.x[i] = q->x[i] * x[0] + q->x[i + 1] * x[1];
    return c;
}

static inline form quartic_by_two(const quartic *q, const double *x, const double *y)
{
    const cubic c = quartic_by(q, x);
    return cubic_by(&c, y);
}

static inline form form_abs(form k) { return (form){fabs(k.xx), fabs(k.xy), fabs(k.yy)}; }

static inline cubic cubic_abs(cubic c)
{
    return (cubic){{fabs(c.x[0]), fabs(c.x[1]), fabs(c.x[2]), fabs(c.x[3])}};
}

static inline quartic quartic_abs(quartic q)
{
    return (quartic){{fabs(q.x[0]), fabs(q.x[1]), fabs(q.x[2]), fabs(q.x[3]), fabs(q.x[4])}};
}

/* The vector K x. */
static inline void form_turn(const form *k, const double *x, double y[2])
{
    y[0] = k->xx * x[0] + k->xy * x[1];
    y[1] = k->xy * x[0] + k->yy * x[1];
}

#endif
