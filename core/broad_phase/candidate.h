/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_CANDIDATE_H
#define CORE_BROAD_PHASE_CANDIDATE_H

#include "core/bounds/distance.h"
#include "core/scene/scene.h"
#include "core/surface/half_plane.h"
#include "core/tree/node.h"

/* Surfaces that a query examines, and pairs of them
 * ================================================= */

/* A surface that exists at some of the query's times. */
typedef struct candidate {
    tree *tree;
    size_t body, surface;
    size_t left_out;   /* number of the surface's last maps that its tree leaves out */
    held_maps held;    /* its first maps that its tree holds at one moment */
    maps_aside aside;  /* further maps that its tree leaves out */
    double eval_error; /* of evaluated points, about; < 0: not measured yet; length */
    size_t still_maps; /* once measured: surface_still_maps, if it has distances */
    bool moves;        /* once measured: a point was seen to move; false if it has pieces */
    half_plane *half;  /* the list's: nodes that miss it are left out; NULL: none are */
} candidate;

/* Two candidates of different bodies that may come near each other. */
typedef struct candidate_pair {
    candidate *side[2];
    distance_slips slips;
    bool rests; /* In slices of time: it moves, but only so that distances differ by at most half of
                   the list's slip from those of one moment. */
    bool screws; /* In slices of time: one surface is a piece of a thread, along which the pair may
                    be as good as at rest, as far as that reaches (screws.h). */
} candidate_pair;

static inline bool candidate_pairs_same_bodies(const candidate_pair *p, const candidate_pair *q)
{
    return p->side[0]->body == q->side[0]->body && p->side[1]->body == q->side[1]->body;
}

/* Whether pair k of a list in the order of the scene is the first of its two bodies. */
static inline bool candidate_pair_is_first(const candidate_pair *pairs, size_t k)
{
    return k == 0 || !candidate_pairs_same_bodies(&pairs[k - 1], &pairs[k]);
}

/* Measures eval_error, still_maps and moves of both, unless they are known: once for each surface
 * of a query, and only if its pairs are expanded. */
imp_code candidate_pair_measure(const candidate_pair *both, imp_error *error);

/* Whether every point of a pair of these nodes may be left out, since one node misses its
 * candidate's half plane: another pair holds points that are as near, but for the list's slip. */
bool candidate_pair_leaves_out(const candidate_pair *both, const node *a, const node *b);

#endif
