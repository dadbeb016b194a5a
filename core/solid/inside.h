/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_INSIDE_H
#define CORE_SOLID_INSIDE_H

#include "core/solid/solid.h"
#include "core/tree/node.h"

/* Is a body, or a part of it, inside a solid one?
 * ===============================================
 * Asked at one time, about two bodies whose surfaces are not known to touch then. Most pairs are
 * decided by boxes; else one point of each connected part of either body is held against the other
 * body, if that is solid. */

typedef struct inside_search inside_search;

/* What is asked. Parts of one body that are nearer to each other than gamma_clear count as being on
 * one side of the other body; edges within gamma and `seam` of each other count as one seam.
 * `from` and `to` are the times of the query, whose trees give the boxes. `watch` must outlive the
 * search. */
typedef struct inside_plan {
    imp_scene *scene;
    double gamma, gamma_clear, from, to;
    const limit_watch *watch;
    double seam; /* length; INFINITY: no limit of its own */
} inside_plan;

inside_search *inside_new(const inside_plan *plan); /* NULL: no memory */
void inside_free(inside_search *s);                 /* NULL is none */

typedef enum inside_state {
    INSIDE_NOBODY,  /* unless surfaces of the two are nearer than gamma_clear then */
    INSIDE_FOUND,   /* and nothing else is said of the surfaces */
    INSIDE_UNKNOWN, /* a part is so near to the solid's surfaces that models do not tell */
    INSIDE_STOPPED  /* by the watch, or as much memory is needed, now counted; ask again */
} inside_state;

typedef struct inside_answer {
    inside_state state;
    imp_side side[2]; /* FOUND: of the two bodies, in the order asked for; the solid's u is NAN */
} inside_answer;

/* Decides whether one of the two bodies is inside the other at time t. Adds to *growth the memory
 * of the trees that it makes, and what it needs itself before it takes that, so that the caller can
 * end the search. Fails where a body that is solid is not closed, with IMP_ERROR_SCENE, and as
 * plugins do. */
imp_code inside_find(inside_search *s, const size_t body[2], double t, inside_answer *answer,
                     tree_growth *growth, imp_error *error);

#endif
