/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_WORLD_H
#define CORE_SOLVER_WORLD_H

#include "core/broad_phase/candidate.h"
#include "core/scene/scene.h"
#include "core/witness/witness.h"

/* Witnesses in world space
 * ========================
 * A pair is searched in the frame that both of its surfaces move in (collect_frames.c). A reported
 * witness is in world space: its points are those that imp_piece_eval returns for its parameters,
 * and its normal turns with the frame. The gap is the distance of these points; if rounding in
 * world space makes that larger than `most`, it is the bound that the search proved. */

/* A witness of a pair in world space, as the library returns it. */
typedef struct world_witness {
    imp_side side[2];
    double gap;       /* length */
    double normal[3]; /* unit, a to b; 0 where it is undefined */
} world_witness;

/* IMP_ERROR_PLUGIN: a map that the search left out fails at time t. */
imp_code world_witness_of(const imp_scene *scene, const candidate_pair *both, const witness *found,
                          double t, double most, world_witness *in_world, imp_error *error);

#endif
