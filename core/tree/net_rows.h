/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_NET_ROWS_H
#define CORE_TREE_NET_ROWS_H

#include "core/surface/region.h"

#include <impinge/quad.h>

/* Four rows of four numbers of a bicubic patch
 * ============================================
 * De Casteljau at the middle for four cubics at once. */

typedef struct rows {
    imp_quad row[4];
} rows;

IMP_QUAD_INLINE rows rows_at(const double *x)
{
    return (rows){
        {imp_quad_load(x), imp_quad_load(x + 4), imp_quad_load(x + 8), imp_quad_load(x + 12)}};
}

/* Not in a loop: gcc 12 would make it a copy of memory, for which the rows go through the stack. */
IMP_QUAD_INLINE void rows_store(double *x, rows r)
{
    imp_quad_store(x, r.row[0]);
    imp_quad_store(x + 4, r.row[1]);
    imp_quad_store(x + 8, r.row[2]);
    imp_quad_store(x + 12, r.row[3]);
}

/* Transposes a matrix of four rows. */
IMP_QUAD_INLINE rows rows_turned(rows r)
{
    imp_quad_transpose(r.row);
    return r;
}

/* Transposes the rows if needed, so that the lines along j are columns. It is its own inverse. */
IMP_QUAD_INLINE rows rows_along(rows r, parameter j)
{
    return j == PARAMETER_U ? r : rows_turned(r);
}

/* Both halves of four cubics: the lower has the first four control points, the upper the last
 * four. */
typedef struct halved_rows {
    imp_quad row[7];
} halved_rows;

IMP_QUAD_INLINE halved_rows rows_halved(rows x)
{
    const imp_quad half = imp_quad_all(0.5), *const r = x.row;
    const imp_quad p = half * (r[0] + r[1]), q = half * (r[1] + r[2]), s = half * (r[2] + r[3]);
    const imp_quad pq = half * (p + q), qs = half * (q + s), mid = half * (pq + qs);
    return (halved_rows){{r[0], p, pq, mid, qs, s, r[3]}};
}

IMP_QUAD_INLINE rows rows_of_half(const halved_rows *x, int half)
{
    const imp_quad *r = x->row + 3 * half;
    return (rows){{r[0], r[1], r[2], r[3]}};
}

#endif
