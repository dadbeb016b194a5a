/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_VEC_H
#define TOOLS_CLI_VEC_H

#include <math.h>

/* Points and directions. */

typedef struct vec {
    double x[3];
} vec;

static inline vec vec_of(const double x[3]) { return (vec){{x[0], x[1], x[2]}}; }

/* a + s b */
static inline vec vec_along(vec a, double s, vec b)
{
    return (vec){{a.x[0] + s * b.x[0], a.x[1] + s * b.x[1], a.x[2] + s * b.x[2]}};
}

static inline vec vec_add(vec a, vec b) { return vec_along(a, 1, b); }
static inline vec vec_sub(vec a, vec b) { return vec_along(a, -1, b); }
static inline vec vec_scale(double s, vec a) { return (vec){{s * a.x[0], s * a.x[1], s * a.x[2]}}; }

static inline double vec_dot(vec a, vec b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static inline vec vec_cross(vec a, vec b)
{
    return (vec){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                  a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static inline double vec_length(vec a) { return sqrt(vec_dot(a, a)); }

/* Returns the vector scaled to length 1; 0 stays 0. */
static inline vec vec_unit(vec a)
{
    const double length = vec_length(a);
    return length > 0 ? vec_scale(1 / length, a) : a;
}

/* A box of points: begins with vec_box_empty. */
typedef struct vec_box {
    vec lo, hi;
} vec_box;

static inline vec_box vec_box_empty(void)
{
    return (vec_box){{{INFINITY, INFINITY, INFINITY}}, {{-INFINITY, -INFINITY, -INFINITY}}};
}

static inline void vec_box_add(vec_box *box, vec p)
{
    for (int i = 0; i < 3; ++i) {
        if (p.x[i] < box->lo.x[i]) box->lo.x[i] = p.x[i];
        if (p.x[i] > box->hi.x[i]) box->hi.x[i] = p.x[i];
    }
}

#endif
