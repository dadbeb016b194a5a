/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_WITNESS_WIDE_SEARCH_H
#define CORE_WITNESS_WIDE_SEARCH_H

#include "core/witness/witness.h"

/* Seeks the nearest points of two nodes at time t from the nearest pairs of points of a grid, one
 * after the other, for nodes so large that their middles lead nowhere; ends where the gap is at
 * most gamma. Symmetric surfaces have several such pairs that are equally near, of which not all
 * lead on, so that one alone would depend on the order of the nodes. IMP_ERROR_PLUGIN: an
 * evaluation failed. */
imp_code witness_seek_widely(const node *const nodes[2], double t, double gamma, witness *found,
                             imp_error *error);

#endif
