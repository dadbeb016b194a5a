/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_SPREAD_H
#define CORE_SOLVER_PAIR_SPREAD_H

#include "core/scene/scene.h"
#include "core/surface/surface_spread.h"
#include "core/witness/witness.h"

/* Pairs in a box of values
 * ========================
 * A query at the middle of a box of values keeps room for how far the values move the bodies in any
 * direction. Here a pair is tested again with room for how far they move it along the axis that is
 * tried, which is less, and nearly nothing where the values slide the bodies along each other. */

/* Both bodies of a query, body 0 and body 1 of its scene. */
typedef struct query_spread {
    const imp_scene *scene; /* the one whose surfaces follow the parameters, */
    size_t body[2];         /* and the two in it */
    surface_spread *of[2];  /* of each of their surfaces, */
    bool *known[2];         /* whether it is known, */
    spread_map *maps[2];    /* and the room of all */
    bool is_known;          /* of some surface on both sides */
    size_t left_out;        /* last maps that no spread has */
    size_t parameters;
    double gamma, gamma_clear; /* of the survey: without room for values */
} query_spread;

/* Lets a query that has not begun test its pairs so; NULL: not. `spread` outlives the query. Its
 * contacts may then be farther apart than gamma allows, or later: only what is excluded counts. */
void query_use_spread(imp_query *query, const query_spread *spread);

/* Lets a query that has not begun refuse solids with seams wider than this, whatever its gamma: the
 * gamma of a box has room for how far values move bodies. */
void query_limit_seams(imp_query *query, double seam);

struct impact;
struct pair;

/* Cuts the window of the pair to times at which its nodes may be within the survey's gamma_clear at
 * some values. False: none is left. */
bool pair_spread_cut(const struct impact *im, struct pair *p);

/* Whether a witness of the pair shows that the box has to be halved: some values bring its points
 * about as near as gamma, to first order. */
bool pair_spread_ends(const struct impact *im, const struct pair *p, const witness *seen);

#endif
