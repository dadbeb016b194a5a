/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_SHELLS_H
#define CORE_SOLID_SHELLS_H

#include "core/solid/patches.h"

/* Closed surfaces, and which side of their patches is outside
 * ===========================================================
 * A shell is a set of patches that hang together by seams (edges.h). It is closed if every edge of
 * its patches is a single point or runs along other edges of the body. Where two patches meet at a
 * seam, their normals du x dv point to the same side of the shell exactly if the two edges, each
 * traversed counter-clockwise about its own domain, run in opposite directions. So one patch
 * decides for all of its shell.
 *
 * Edges are compared at points, so that what is found is a premise of proofs about the inside, not
 * a proof: a body that is said to bound a volume is taken to do so where no hole shows. */

typedef struct shells {
    imp_facing *facing; /* by patch; shell SIZE_MAX, sign 0: the patch was left out (shared.h) */
    size_t count;
    double slack;      /* within which edges are the same; length */
    bool shares_edges; /* more than two patches share an edge */
    bool is_doubtful;  /* they do so that shells may lack some patches and be open */
    bool *is_repeated; /* by shell: the body has several of it, of which others are left out */
} shells;

/* Tries edges within 1e-9 of the body's size first, then within `slack` if that is larger: small
 * patches keep their edges where a fine slack closes the body. *closure becomes the answer; if it
 * is not CLOSED, shells are known as far as edges were found. Call solid_shells_free in any
 * case. */
imp_code solid_shells_find(shells *s, const patches *p, double slack, const limit_watch *watch,
                           imp_closure *closure, imp_error *error);
void solid_shells_free(shells *s);

/* Finds shells of patches that are not left out, with edges within `slack` only. s->facing has room
 * for all patches. */
imp_code solid_shells_within(shells *s, const patches *p, double slack, const limit_watch *watch,
                             imp_closure *closure, imp_error *error);

/* Returns the most memory that solid_shells_find takes. */
size_t solid_shells_bytes(size_t count);

#endif
