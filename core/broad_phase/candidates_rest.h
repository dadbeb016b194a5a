/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_CANDIDATES_REST_H
#define CORE_BROAD_PHASE_CANDIDATES_REST_H

#include "core/bounds/time_window.h"
#include "core/broad_phase/candidates.h"

/* Pairs at one moment of a slice of time
 * ======================================
 * A pair that only turns within itself, or along the other's symmetry, has at each time the same
 * distance but for the list's slip. In a search of a slice it therefore has trees of one moment of
 * that slice, so that its witness has a time in the slice. So has a side that does not move: its
 * tree of all times would be followed to the smallest node in time, which is no root. These trees
 * last as long as the search: the next slice has another moment.
 *
 * A pair that is screwed along a thread has them, too, as far as the thread reaches beyond what is
 * near at that moment, and where both are threads of one line and lead, one half plane stands for
 * all. What that slips holds for the slice. */

/* A side of a pair that has such a tree. */
typedef struct candidate_moment {
    size_t pair;
    int side;
    candidate *whole; /* of all times, to be put back */
    candidate at;     /* owns its tree */
    half_plane half;  /* at.half, if there is one */
} candidate_moment;

typedef struct candidate_moments {
    candidate_moment *at;
    size_t count, capacity;
    double slip;     /* of these pairs, beside the list's; length */
} candidate_moments; /* begins as {0} */

/* Gives those of `count` pairs of the list from `first` on that rest trees of a moment of the
 * slice, and those that are screwed, if they then slip by no more than slip_most. Failures are
 * those of node_child, or of a callback; nothing is changed then. */
imp_code candidates_rest(const candidate_list *list, size_t first, size_t count,
                         const time_window *within, double slip_most, candidate_moments *moments,
                         imp_stats *stats, imp_error *error);

/* Puts the trees of all times back. No search may use the other trees any more. */
void candidates_wake(const candidate_list *list, candidate_moments *moments, imp_stats *stats);

#endif
