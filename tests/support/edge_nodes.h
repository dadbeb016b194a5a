/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_EDGE_NODES_H
#define TESTS_SUPPORT_EDGE_NODES_H

#include "tests/support/meeting_nodes.h"

/* Pairs of made-up nodes that touch with an edge or a corner. */

/* The normal of two_caps; and nearly that. */
static const double NORMAL[3] = {0.48, 0.6, 0.64};
static const vec3 ACROSS = {{0.5, 0.61, 0.62}};

/* Makes one side of two_caps an edge along u, which bends by `bend`, or a corner: the other slopes
 * leave the plane, away from the other side. */
static inline void make_edge(meeting *m, int side, double bend, bool is_corner)
{
    const double *n = NORMAL, away = side == 0 ? -1 : 1;
    node *x = side == 0 ? &m->a : &m->b;
    for (int i = 0; i < 3; ++i) {
        const double slope[2] = {is_corner ? 0.05 * away * n[i] : 0, 0.05 * away * n[i]};
        x->f.quu[i] = bend * n[i];
        x->f.qvv[i] = 0;
        x->f.bu[i] = (is_corner ? 0.1 : 1) * x->f.bu[i] + slope[0];
        x->f.bv[i] = 0.1 * x->f.bv[i] + slope[1];
        x->f.a[i] += slope[0] + slope[1];
    }
}

/* Turns the slopes of a side by a quarter turn. */
static inline void swap_parameters(node *x)
{
    double *const pairs[2][2] = {{x->f.bu, x->f.bv}, {x->f.quu, x->f.qvv}};
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 3; ++i) {
            const double was = pairs[k][0][i];
            pairs[k][0][i] = pairs[k][1][i];
            pairs[k][1][i] = was;
        }
}

#endif
