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

/* Goes down to one piece each, always to the half whose box is nearer. */
imp_code pair_descend(pair *p, const candidate_pair *both, imp_stats *stats, imp_error *error);

/* A key for the heap, after p->serial is set: the squared distance of the centres at time t. Where
 * a node has no bounds the pair comes behind all others, the last made first, so that a place that
 * has none down to the smallest region is come to without going through all of its surroundings. */
double pair_order(const pair *p, double t);

/* Whether rounding takes much of `room`, the length that is to be told apart, and the pair is as
 * flat as `flat` times the rounding: then splitting on teaches ever less and only multiplies
 * pairs. */
bool pair_precision_ends(const pair *p, const candidate_pair *both, double room, double flat);

typedef struct cut {
    int side; /* 0: a, 1: b; -1: nothing left to split */
    parameter along;
    double gain;
} cut;
#define CUT_NONE ((cut){-1, PARAMETER_U, 0})

/* The paper: the parameter of either node that contributes most to its box. */
cut cut_by_contribution(const pair *p);

/* Models: what moves a point most along u or v, or bends it in time; what is below `scale`, a
 * length, does not matter. `has_nets`: the search asked for nets of both nodes, and they have some;
 * of a search that asks for none false, whatever others have made. */
cut cut_by_spread(const pair *p, double scale, bool has_nets);

/* The cut of one side alone, whose points u, v and t bend by `bend`, lengths; CUT_NONE: nothing is
 * left to split of it. */
cut cut_alone(const pair *p, int side, const double bend[3], double scale);

/* Time of the node whose points leave linear motion most within the window, where that of both
 * hides more than `scale`, a length, and counts beside what bends and blurs along u and v. Else
 * CUT_NONE. */
cut cut_by_bend(const pair *p, double scale);

/* Nothing more to learn from u and v: the later of the two nodes' times is halved. */
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
