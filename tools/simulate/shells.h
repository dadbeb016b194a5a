/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_SHELLS_H
#define TOOLS_SIMULATE_SHELLS_H

#include "tools/simulate/patches.h"

/* Closed surfaces, and which side of their patches is outside
 * ===========================================================
 * A shell is a set of patches that hang together by seams (edges.h). It is closed if every edge of
 * its patches is a single point or runs along other edges of the body. Where two patches meet at a
 * seam, their normals du x dv point to the same side of the shell exactly if the two edges, each
 * traversed counter-clockwise about its own domain, run in opposite directions. So one patch
 * decides for all of its shell. Which of the two sides is outside, the sign of the volume tells
 * (mass.h). */

typedef struct shells {
    size_t *of;   /* by patch: the number of its shell, from 0 */
    double *sign; /* by patch: 1, or -1 where its normal points to the other side than that of the
                     shell's first patch */
    size_t count;
} shells;

/* *where: a point of the edge that borders on nothing (OPEN), or where orientations contradict each
 * other (ONE_SIDED). Call shells_free in any case. */
shape_verdict shells_find(shells *s, const patches *p, vec *where, imp_error *why);
void shells_free(shells *s);

#endif
