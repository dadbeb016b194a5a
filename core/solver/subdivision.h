/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_SUBDIVISION_H
#define CORE_SOLVER_SUBDIVISION_H

#include "core/bounds/distance.h"
#include "core/bounds/net_halves.h"
#include "core/broad_phase/candidate.h"
#include "core/solver/pair_heap.h"

/* How a pair is divided
 * =====================
 * Branch and bound halves one node of a pair along one parameter: that which blurs the pair most.
 * Shared by all searches. Choices cost pairs, never soundness. */

/* Remainders of both nodes, and how much u and v move points across them; length, about. */
double pair_remainder(const pair *p);
double pair_extent(const pair *p);

/* Whether a node of it is a cluster of pieces: it has no points of its own to evaluate, and is
 * halved further whatever its size. */
bool pair_has_cluster(const pair *p);

/* Descends to one piece on each side, always to the half whose box is nearer. */
imp_code pair_descend(pair *p, const candidate_pair *both, imp_stats *stats, imp_error *error);

/* Computes a key for the heap, after p->serial is set: the squared distance of the centres at time
 * t. A pair with a node without bounds comes behind all others, the last made first, so that the
 * search reaches a place without bounds at any size before it has gone through all of its
 * surroundings. */
double pair_order(const pair *p, double t);

/* Whether evaluation errors take much of `room`, the length that is to be told apart, and the
 * pair's curvature is below `flat` times these errors: more splits would then only multiply
 * pairs. */
bool pair_precision_ends(const pair *p, const candidate_pair *both, double room, double flat);

typedef struct cut {
    int side; /* 0: a, 1: b; -1: nothing left to split */
    parameter along;
    double gain;
} cut;
#define CUT_NONE ((cut){-1, PARAMETER_U, 0})

/* The paper's cut: the parameter of either node that contributes most to its box. */
cut cut_by_contribution(const pair *p);

/* The cut of models: the parameter that moves a point most along u or v, or bends its motion most
 * in time. Extents below `scale`, a length, do not matter. `has_nets`: the search asked for nets of
 * both nodes and they have them; false in a search that asks for none, whatever other searches have
 * made. */
cut cut_by_spread(const pair *p, double scale, bool has_nets);

/* The cut of one side alone, whose points u, v and t bend by `bend`, lengths; CUT_NONE: nothing is
 * left to split of it. */
cut cut_alone(const pair *p, int side, const double bend[3], double scale);

/* A cut in time of the node whose motion is least linear within the window, if the nonlinear motion
 * of both exceeds `scale`, a length, and matters beside curvature and remainders in u and v.
 * Otherwise CUT_NONE. */
cut cut_by_bend(const pair *p, double scale);

/* A cut in time where u and v can teach no more: the later of the two nodes' times is halved. */
cut cut_in_time(const pair *p);

/* Puts halves of halves in the places of the nodes, one after the other; those on the way to the
 * last of either side are bare (node_child_bare). What is made is added to `stats`. */
imp_code pair_take_halves(pair *p, const net_half *halves, int count, const candidate_pair *both,
                          imp_stats *stats, imp_error *error);

/* Whether the cut is one in time of which one half holds the whole window; *half tells which. */
bool cut_is_free(const cut *c, const pair *p, int *half);

/* Puts the half of the node that is cut in its place: below the cut (0) or above (1), with the part
 * of the window that lies in its times. *some false: no moment of the window is in that half, or
 * none that the other has not. What is made is added to `stats`. */
imp_code cut_take(const cut *c, int half, const candidate_pair *both, pair *p, bool *some,
                  imp_stats *stats, imp_error *error);

#endif
