/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_SHELLS_H
#define TOOLS_SIMULATE_SHELLS_H

#include "tools/simulate/patches.h"

/* Closed surfaces, and which side of their patches is outside
 * ===========================================================
 * The library tells which patches hang together, and on which side of each the normal du x dv is
 * (imp_scene_get_closure). Which of the two sides is outside, the sign of the volume tells
 * (mass.h). */

typedef struct shells {
    imp_facing *facing; /* by patch */
    size_t count;
} shells;

/* *where: a point of the edge that borders on nothing (OPEN), or where orientations contradict each
 * other (ONE_SIDED). Call shells_free in any case. */
shape_verdict shells_find(shells *s, const patches *p, vec *where, imp_error *why);
void shells_free(shells *s);

#endif
