/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_TUBE_SEARCH_H
#define CORE_WITNESS_TUBE_SEARCH_H

#include "core/witness/witness.h"

/* Seeks the nearest points of two tubes at time t: first those of their lines, by Newton steps on
 * the nodes' polynomials; then, on each surface at that u, the point that is nearest to the other's
 * line, from four points as if v ran around a circle evenly; then, where this misses by more than
 * the lines do, by Newton steps on the surfaces. *is_loose: the lines say that the surfaces are
 * within gamma there, and no such points were found, so that balls seem to reach farther than
 * surfaces do. Precondition: both nodes have a ball. IMP_ERROR_PLUGIN: an evaluation failed. */
imp_code witness_seek_in_tubes(const node *const nodes[2], double t, double gamma, witness *found,
                               bool *is_loose, imp_error *error);

#endif
