/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_SUBDIVISION_H
#define CORE_SOLVER_SUBDIVISION_H

#include "core/bounds/distance.h"
#include "core/bounds/net_halves.h"
#include "core/broad_phase/candidate.h"
#include "core/solver/pair_heap.h"

/* How a pair is split
 * ===================
 * Branch and bound halves one node of a pair along the parameter that contributes most to the
 * looseness of its bounds. All searches share these functions. Choices cost pairs, never
 * soundness. */

/* Return the remainders of both nodes, and how far u and v move points across them; estimated
 * lengths. */
double pair_remainder(const pair *p);
double pair_extent(const pair *p);

/* Whether one of its nodes is a cluster of pieces, which has no points of its own and is always
 * split further. */
bool pair_has_cluster(const pair *p);

/* Descends to one piece on each side, always to the half whose box is nearer. */
imp_code pair_descend(pair *p, const candidate_pair *both, imp_stats *stats, imp_error *error);

/* Descends from the roots to these pieces. */
imp_code pair_descend_to(pair *p, const size_t piece[2], const candidate_pair *both,
                         imp_stats *stats, imp_error *error);

/* Computes a key for the heap, after p->serial is set: the squared distance of the centres at time
 * t. Pairs with an unbounded node come after all others, newest first, so that the search reaches a
 * place that has no bounds at any size before it has searched all of its surroundings. */
double pair_order(const pair *p, double t);

/* Whether evaluation errors are large against `room`, the length to be resolved, and the pair's
 * curvature is below `flat` times these errors: further splits would then only multiply pairs. */
bool pair_precision_ends(const pair *p, const candidate_pair *both, double room, double flat);

typedef struct cut {
    int side; /* 0: a, 1: b; -1: nothing left to split */
    parameter along;
    double gain;
} cut;
#define CUT_NONE ((cut){-1, PARAMETER_U, 0})

/* Returns the paper's cut: the parameter of either node that contributes most to its box. */
cut cut_by_contribution(const pair *p);

/* Returns the cut of Taylor models: the parameter u or v that moves a point most, or time where it
 * bends the motion most. Extents below `scale`, a length, do not matter. `has_nets`: this search
 * requested nets of both nodes, and both have one; nets that other searches made do not count. */
cut cut_by_spread(const pair *p, double scale, bool has_nets);

/* Returns the cut of one side alone, whose nonlinear extents in u, v and t are `bend`, lengths;
 * CUT_NONE: it cannot be split. */
cut cut_alone(const pair *p, int side, const double bend[3], double scale);

/* Returns the cut in time of the node whose motion is least linear within the window, if the
 * nonlinear motion of both exceeds `scale`, a length, and is not small against curvature and
 * remainders in u and v; else CUT_NONE. */
cut cut_by_bend(const pair *p, double scale);

/* Returns a cut in time, for pairs that splitting u and v does not help: halves the node that has
 * the longer times. */
cut cut_in_time(const pair *p);

/* Replaces the nodes by these halves, one after the other; all but the last of each side are bare
 * (node_child_bare). Nodes made are added to `stats`. */
imp_code pair_take_halves(pair *p, const net_half *halves, int count, const candidate_pair *both,
                          imp_stats *stats, imp_error *error);

/* Whether the cut is in time and one half, *half, contains the whole window. */
bool cut_is_free(const cut *c, const pair *p, int *half);

/* Replaces the node that is cut by its half below (0) or above (1) the cut, and cuts the window to
 * its times. *some false: that half has no moment of the window, or none that the other half lacks.
 * Nodes made are added to `stats`. */
imp_code cut_take(const cut *c, int half, const candidate_pair *both, pair *p, bool *some,
                  imp_stats *stats, imp_error *error);

#endif
