/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_TREE_TRIPLE_H
#define CORE_TREE_TRIPLE_H

#include <impinge/quad.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/tree/node.h"

/* Three numbers, of x, y and z, as a quad whose fourth lane is 0
 * ==============================================================
 * Nodes, shapes and poses store three numbers of each kind, not four: large scenes have many. */

/* Precondition: the struct that x is in goes on for another 8 bytes, which are read, but whatever
 * they hold becomes 0. */
IMP_QUAD_INLINE imp_quad triple_load(const double *x)
{
    const imp_quad_mask three = {-1, -1, -1, 0};
    return (imp_quad)((imp_quad_mask)imp_quad_load(x) & three);
}

IMP_QUAD_INLINE void triple_store(double x[3], imp_quad y) { memcpy(x, &y, 3 * sizeof *x); }

/* Bounds by how much a node's points move from those at the middle of its times:
 * >= |bt| + 2 |qtt| + |qut| + |qvt|; length. */
IMP_QUAD_INLINE imp_quad triple_motion_upper(const quadratic3 *f)
{
    PAD_COVERS(8, 3); /* three sums */
    const imp_quad motion = imp_quad_abs(triple_load(f->bt)) +
                            imp_quad_all(2) * imp_quad_abs(triple_load(f->qtt)) +
                            imp_quad_abs(triple_load(f->qut)) + imp_quad_abs(triple_load(f->qvt));
    return quad_padded_upper(motion, 8);
}

#endif
