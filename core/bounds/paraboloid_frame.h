/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_PARABOLOID_FRAME_H
#define CORE_BOUNDS_PARABOLOID_FRAME_H

#include <string.h>

#include <impinge/interval.h>

#include "core/base/rounding.h"
#include "core/bounds/net_paraboloid.h"

/* A net in the coordinates of a paraboloid (net_paraboloid.h) */

/* Control points of a bicubic patch at one time: row by row, along the normal and across. */
typedef struct placed {
    imp_quad z[4], x[2][4];
} placed;

/* Raises lines of a net in place from degree n to 3. The points of a line are `step` apart. */
static inline void raise_lines(double *x, int n, int step, int next)
{
    for (; n < 3; ++n)
        for (int line = 0; line < 4; ++line) {
            double *p = x + line * next;
            p[(n + 1) * step] = p[n * step];
            for (int i = n; i > 0; --i)
                p[i * step] = (i * p[(i - 1) * step] + (n + 1 - i) * p[i * step]) / (n + 1);
        }
}

/* Raises a coordinate of a net's control points to a bicubic patch. */
static inline void raise_net(const net *f, const double *x, double raised[16])
{
    const int n = f->degree[0], m = f->degree[1];
    memset(raised, 0, 16 * sizeof *raised);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= m; ++j) raised[4 * i + j] = x[i * (m + 1) + j];
    raise_lines(raised, m, 1, 4);
    raise_lines(raised, n, 4, 1);
}

/* Loads two rows of a coordinate. */
IMP_QUAD_INLINE void rows_of_net(const net *f, const double *x, const int at[2], bool is_bicubic,
                                 imp_quad row[2])
{
    double raised[16];
    if (!is_bicubic) raise_net(f, x, raised);
    for (int k = 0; k < 2; ++k) row[k] = imp_quad_load((is_bicubic ? x : raised) + 4 * at[k]);
}

IMP_QUAD_INLINE imp_quad along(const imp_quad x[3][2], int k, vec3 n)
{
    return imp_quad_all(n.x[0]) * x[0][k] + imp_quad_all(n.x[1]) * x[1][k] +
           imp_quad_all(n.x[2]) * x[2][k];
}

/* Lemma (places). In units of u S, S being size_of: the offset 2 + 2 + 3 roundings, a control point
 * 2, raised up to three times in either direction 4 each, their sum 1; along a vector of size 1.125
 * five more: (7 + 2 + 6 * 4 + 1 + 5) * 1.125 < 64. */
enum { PLACE_ROUNDING = 64 };
_Static_assert((7 + 2 + 6 * 4 + 1 + 5) * 9 < 8 * PLACE_ROUNDING, "rounding of a place");

IMP_QUAD_INLINE void place_rows_of(const net *f, const net_paraboloid *d, double t, bool is_flat,
                                   int first, bool is_bicubic, placed *to)
{
    const double tau = t - f->time, since = t - d->time;
    const int rows_of_two[2] = {first, 3 - first};
    const imp_quad at = {d->at.x[0], d->at.x[1], d->at.x[2], 0};
    const imp_quad velocity = {d->velocity.x[0], d->velocity.x[1], d->velocity.x[2], 0};
    const imp_quad offset =
        (imp_quad_load(f->place) - at) +
        (imp_quad_all(tau) * imp_quad_load(f->drift) - imp_quad_all(since) * velocity);
    imp_quad x[3][2];
    for (int i = 0; i < 3; ++i) {
        rows_of_net(f, f->numbers + i * f->stride, rows_of_two, is_bicubic, x[i]);
        if (f->is_moving) {
            imp_quad v[2];
            rows_of_net(f, f->numbers + (3 + i) * f->stride, rows_of_two, is_bicubic, v);
            for (int k = 0; k < 2; ++k) x[i][k] += imp_quad_all(tau) * v[k];
        }
        for (int k = 0; k < 2; ++k) x[i][k] += imp_quad_all(offset[i]);
    }
    for (int k = 0; k < 2; ++k) {
        const int row = rows_of_two[k];
        to->z[row] = along(x, k, d->normal);
        for (int i = 0; i < 2 && !is_flat; ++i) to->x[i][row] = along(x, k, d->across[i]);
    }
}

/* Fills two rows: the first and the last (0), which hold the patch's corners, or those between. */
IMP_QUAD_INLINE void place_rows(const net *f, const net_paraboloid *d, double t, bool is_flat,
                                int first, placed *to)
{
    if (f->degree[0] == 3 && f->degree[1] == 3)
        place_rows_of(f, d, t, is_flat, first, true, to);
    else
        place_rows_of(f, d, t, is_flat, first, false, to);
}

/* Bounds the sum of the sizes of all numbers whose sum is a coordinate of a control point, of x, y
 * and z together, at any time of the window. */
static inline double size_of(const net *f, const net_paraboloid *d, const time_window *w)
{
    const double late = imp_larger(fabs(w->lo - f->time), fabs(w->hi - f->time));
    const double since = imp_larger(fabs(w->lo - d->time), fabs(w->hi - d->time));
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        sum += f->most[i] + fabs(f->place[i]) + fabs(d->at.x[i]) + late * fabs(f->drift[i]) +
               since * fabs(d->velocity.x[i]);
    return padded_upper(sum, 32);
}

PAD_COVERS(32, 3 + 4 * 3);

#endif
