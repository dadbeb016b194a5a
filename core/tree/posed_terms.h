/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_POSED_TERMS_H
#define CORE_TREE_POSED_TERMS_H

#include <impinge/quad.h>

#include "core/tree/pose.h"
#include "core/tree/triple.h"

/* Terms of third order, and a remainder that turns
 * ================================================
 * The remainder n->e of a node is a box along x, y and z. For a posed node, the terms of third
 * order of the product are known, and the shape's remainder is a box along the body's axes that
 * turns with the pose: a parallelepiped in space, narrower than its bounding box along most axes.
 * Files that use nodes compile these functions for both register widths.
 *
 * Lemma. In the lemma of pose.c (polynomial), with f the quadratic that is kept, x is
 *
 *   f + uut s (su^2 - 1/2) + uvt s su sv + vvt s (sv^2 - 1/2) + (s^2 - 1/2) (utt su + vtt sv)
 *     + sum_j delta_j / e_j R(s)_j e_j + rest,
 *
 *   R(s) = R0 + R1 s + R2 s^2,
 *   uut = R1 cuu, uvt = R1 cuv, vvt = R1 cvv, utt = R2 bu, vtt = R2 bv,
 *
 * and the rest is within n->posed_e: terms of fourth order, rho P, rho delta, the shift's remainder
 * and rounding. Over a window s = s0 + k w, |w| <= 1,
 *
 *   R(s)_j e_j = edge_j + swing_j w + R2_j e_j k^2 w^2,
 *   edge_j = (R0 + (R1 + R2 s0) s0)_j e_j,   swing_j = k (R1 + 2 R2 s0)_j e_j,
 *
 * of which the last is at most the bow, a box. */

typedef struct posed_terms {
    imp_quad uut, uvt, vvt, utt, vtt;
    imp_quad bow;               /* |R2| e k^2 */
    imp_quad edge[3], swing[3]; /* of x, y, z: the three edges, then 0 */
} posed_terms;

/* Matrix times vector, column by column. */
IMP_QUAD_INLINE imp_quad pose_times(const double column[3][3], const double y[3])
{
    return triple_load(column[0]) * imp_quad_all(y[0]) +
           triple_load(column[1]) * imp_quad_all(y[1]) +
           triple_load(column[2]) * imp_quad_all(y[2]);
}

/* Rounding of edges and bow along an axis, in units of u (|R0| + |R1| + |R2|) e; posed_e includes
 * it. s0 is off by 2 u and k by u; |edge| + |swing| + bow are at most one such size.
 *
 *   edge     R2 s0 2 + 1, sum 1, times s0 2 + 1, sum 1, times e 1         9
 *   swing    R2 s0 2 + 1, sums 2, times k 1 + 1, times e 1                8
 *   bow      k^2 2 + 1, times e 1, times R2 1, sums 2                     7
 *   users    of both: dots 3, at an end of the window 1, sums 12,
 *            weights 2, their sums with the rest of the slack 16         34 */
enum { EDGE_ROUNDING = 64 };
_Static_assert((2 + 1 + 1 + 2 + 1 + 1 + 1) + (2 + 1 + 2 + 1 + 1 + 1) + (2 + 1 + 1 + 1 + 2) +
                       (3 + 1 + 12 + 2 + 16) <=
                   EDGE_ROUNDING,
               "rounding of edges");

/* Precondition: n->pose != NULL; |s0| + k <= 1, up to rounding. */
IMP_QUAD_INLINE posed_terms posed_terms_at(const node *n, double s0, double k)
{
    const shape_model *s = n->still;
    const pose_lanes *p = n->pose;
    const imp_quad at = imp_quad_all(s0), by = imp_quad_all(k);
    posed_terms x;
    x.uut = pose_times(p->turn[1], s->quu);
    x.uvt = pose_times(p->turn[1], s->quv);
    x.vvt = pose_times(p->turn[1], s->qvv);
    x.utt = pose_times(p->turn[2], s->bu);
    x.vtt = pose_times(p->turn[2], s->bv);
    x.bow = imp_quad_all(0);
    for (int j = 0; j < 3; ++j)
        x.bow += imp_quad_abs(triple_load(p->turn[2][j])) * imp_quad_all(k * k * s->e[j]);
    imp_quad edge[4], swing[4]; /* columns of x, y, z, then rows */
    edge[3] = swing[3] = imp_quad_all(0);
    for (int j = 0; j < 3; ++j) {
        const imp_quad e = imp_quad_all(s->e[j]);
        const imp_quad bend = triple_load(p->turn[2][j]) * at;
        const imp_quad slope = triple_load(p->turn[1][j]) + bend;
        edge[j] = (triple_load(p->turn[0][j]) + slope * at) * e;
        swing[j] = (slope + bend) * by * e;
    }
    imp_quad_transpose(edge);
    imp_quad_transpose(swing);
    for (int i = 0; i < 3; ++i) x.edge[i] = edge[i], x.swing[i] = swing[i];
    return x;
}

#endif
