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

static inline double vec3_norm(vec3 a) { return sqrt(vec3_dot(a, a)); }

static inline double vec3_norm1(vec3 a) { return fabs(a.x[0]) + fabs(a.x[1]) + fabs(a.x[2]); }

#endif
