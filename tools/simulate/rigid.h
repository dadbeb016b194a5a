/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_RIGID_H
#define TOOLS_SIMULATE_RIGID_H

#include <stdbool.h>

#include "tools/cli/vec.h"

/* Matrices, and rotations as unit quaternions, for rigid bodies. */

/* Returns a unit vector normal to another one. */
static inline vec vec_normal_to(vec n)
{
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(n.x[i]) < fabs(n.x[least])) least = i;
    const vec axis = {{least == 0, least == 1, least == 2}};
    return vec_unit(vec_cross(n, axis));
}

typedef struct mat3 {
    double m[3][3];
} mat3;

static inline mat3 mat3_diagonal(double d) { return (mat3){{{d, 0, 0}, {0, d, 0}, {0, 0, d}}}; }

static inline vec mat3_apply(const mat3 *a, vec x)
{
    vec y;
    for (int i = 0; i < 3; ++i)
        y.x[i] = a->m[i][0] * x.x[0] + a->m[i][1] * x.x[1] + a->m[i][2] * x.x[2];
    return y;
}

/* a' x */
static inline vec mat3_apply_transposed(const mat3 *a, vec x)
{
    vec y;
    for (int i = 0; i < 3; ++i)
        y.x[i] = a->m[0][i] * x.x[0] + a->m[1][i] * x.x[1] + a->m[2][i] * x.x[2];
    return y;
}

static inline mat3 mat3_add(const mat3 *a, double factor, const mat3 *b)
{
    mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) r.m[i][j] = a->m[i][j] + factor * b->m[i][j];
    return r;
}

/* a b a', for a rotation: b in turned axes. */
static inline mat3 mat3_turned(const mat3 *a, const mat3 *b)
{
    mat3 half, r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            half.m[i][j] =
                a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            r.m[i][j] =
                half.m[i][0] * a->m[j][0] + half.m[i][1] * a->m[j][1] + half.m[i][2] * a->m[j][2];
    return r;
}

static inline double mat3_determinant(const mat3 *a)
{
    const vec x = vec_of(a->m[0]), y = vec_of(a->m[1]), z = vec_of(a->m[2]);
    return vec_dot(x, vec_cross(y, z));
}

/* Returns the greatest magnitude of its numbers. */
static inline double mat3_greatest(const mat3 *a)
{
    double most = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) most = fmax(most, fabs(a->m[i][j]));
    return most;
}

/* By cofactors of a / size, so that nothing overflows; the determinant must not be 0. */
static inline mat3 mat3_inverse(const mat3 *a)
{
    const double size = mat3_greatest(a);
    const mat3 zero = mat3_diagonal(0), b = mat3_add(&zero, 1 / size, a);
    const double d = 1 / mat3_determinant(&b) / size;
    mat3 r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            r.m[j][i] = d * (b.m[i1][j1] * b.m[i2][j2] - b.m[i1][j2] * b.m[i2][j1]);
        }
    return r;
}

/* --- Quaternions (w, x, y, z) ----------------------------------------------------------------- */

typedef struct quat {
    double w;
    vec v;
} quat;

static inline quat quat_identity(void) { return (quat){1, {{0, 0, 0}}}; }

static inline quat quat_unit(quat q)
{
    const double k = 1 / sqrt(q.w * q.w + vec_dot(q.v, q.v));
    return (quat){k * q.w, vec_scale(k, q.v)};
}

/* b first, then a. */
static inline quat quat_mul(quat a, quat b)
{
    vec v = vec_add(vec_scale(a.w, b.v), vec_scale(b.w, a.v));
    return quat_unit((quat){a.w * b.w - vec_dot(a.v, b.v), vec_add(v, vec_cross(a.v, b.v))});
}

/* By the angle |spin| t about spin. */
static inline quat quat_of_spin(vec spin, double t)
{
    const double rate = vec_length(spin), half = 0.5 * rate * t;
    if (!(rate > 0)) return quat_identity();
    return (quat){cos(half), vec_scale(sin(half) / rate, spin)};
}

static inline mat3 mat3_of_quat(quat q)
{
    const double w = q.w, x = q.v.x[0], y = q.v.x[1], z = q.v.x[2];
    return (mat3){{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                   {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                   {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

#endif
