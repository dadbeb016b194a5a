/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PIECE_WALK_H
#define CORE_SOLVER_PIECE_WALK_H

#include "core/solver/subdivision.h"
#include "core/witness/witness.h"

/* A witness that walks to neighbouring pieces
 * ===========================================
 * Nearest points of two pieces may lie on an edge beyond which the next piece is nearer still, as
 * on the two triangles of a flat side. The walk keeps the piece of one surface and seeks among
 * those of the other whose boxes are nearer than the witness; then the other way round. */

typedef struct piece_walk {
    pair single; /* two pieces, of which `seen` is a witness at time t */
    witness seen;
    double t;
    int first; /* the side whose pieces are tried first */
} piece_walk;

/* Walks from w->single as far as that lowers w->seen.gap_upper, within the nodes of `from`, an
 * ancestor of it. Searches are counted in `stats`. IMP_ERROR_PLUGIN: an evaluation failed. */
imp_code piece_walk_on(piece_walk *w, const pair *from, const candidate_pair *both,
                       imp_stats *stats, imp_error *error);

#endif
