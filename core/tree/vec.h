/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_VEC_H
#define CORE_TREE_VEC_H

#include <math.h>

/* Three-vectors as values. Nothing here is rounded outward: for bounds, the
 * caller's lemma accounts for the rounding. */

typedef struct vec3 {
    double x[3];
} vec3;

static inline vec3 vec3_from(const double *x) { return (vec3){{x[0], x[1], x[2]}}; }

static inline vec3 vec3_add(vec3 a, vec3 b)
{
    return (vec3){{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2]}};
}

static inline vec3 vec3_sub(vec3 a, vec3 b)
{
    return (vec3){{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}

static inline vec3 vec3_scale(vec3 a, double k)
{
    return (vec3){{k * a.x[0], k * a.x[1], k * a.x[2]}};
}

static inline double vec3_dot(vec3 a, vec3 b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                   a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

/* Where squares would underflow, |a| 2^600 is computed instead: of components below 2^-449, the
 * largest of which is 2^-1074 at least, the scaled squares are between 2^-948 and 2^302. Unless |a|
 * is below 2^-1022, the scaling is exact. */
static inline double vec3_norm(vec3 a)
{
    const double square = vec3_dot(a, a);
    if (!(square < 0x1p-900)) return sqrt(square);
    const vec3 scaled = vec3_scale(a, 0x1p600);
    return sqrt(vec3_dot(scaled, scaled)) * 0x1p-600;
}

static inline double vec3_norm1(vec3 a) { return fabs(a.x[0]) + fabs(a.x[1]) + fabs(a.x[2]); }

/* Returns some unit vector across an axis, which is not 0. */
static inline vec3 vec3_across(vec3 axis)
{
    const int i = fabs(axis.x[0]) < fabs(axis.x[1]) ? (fabs(axis.x[0]) < fabs(axis.x[2]) ? 0 : 2)
                                                    : (fabs(axis.x[1]) < fabs(axis.x[2]) ? 1 : 2);
    vec3 e = {{0, 0, 0}};
    e.x[i] = 1;
    const vec3 across = vec3_cross(axis, e);
    return vec3_scale(across, 1 / vec3_norm(across));
}

#endif
