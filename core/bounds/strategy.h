/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_STRATEGY_H
#define CORE_BOUNDS_STRATEGY_H

#include "core/bounds/time_window.h"
#include "core/bounds/trial_rate.h"

/* Which bounds are tried on a pair of nodes
 * =========================================
 * Every choice between mechanisms is made here. A choice costs pairs or instructions, never
 * soundness: each mechanism proves what it cuts by itself. Plans depend on the two nodes alone, so
 * that a test of a pair gives the same window whenever it is made; where a mechanism seldom pays,
 * trials of the same candidate pair decide, too (trial_rate.h). tuning.h has the numbers.
 *
 *   mechanism               tried                                   because
 *   ----------------------  --------------------------------------  -------------------------------
 *   boxes                   always, first                           a box costs next to nothing
 *   moving boxes alone      roots of bodies with many candidate     few of them are ever popped
 *                           pairs (pair_test.c)
 *   nets asked for          a node that offers one gains by it; of  hulls touch their surfaces at
 *                           straight nodes with a remainder, once   corners, where most contacts
 *                           the pair is popped                      are; quadratics part most
 *                                                                   straight ones
 *   hull against hull       both nets are there, one node gains     a box around a remainder does
 *                                                                   not vanish at a corner
 *   hull against quadratic  one net is there, and its node gains    either shows more than its box
 *   quadratics after hulls  remainders are small beside what        a hull is off by a part of what
 *                           bends; hulls meet; one net is missing   bends, a quadratic by its
 *                                                                   remainder
 *   quadratics, fixed axes  no hull is tried; also where all are    bilinear nodes have no
 *                           flat and one net is missing             remainder; GJK finds the best
 *                                                                   axis
 *   axes that need no       before quadratics, contact only:        vectors across both curves cut
 *   search                  neither node has a normal               the window again and again
 *   axis of the end         after quadratics, contact only: both    once edges have crossed, the
 *                           are nearly flat, the start was cut      axis that was best before is
 *                                                                   wrong
 *   turning field           fixed axes leave the window's start;    it shows more only where one
 *                           else as often as it pays                lies in the other's concave
 *                                                                   side
 *   one-sided distance      no axis parts the pair from the start   what slides along a surface has
 *                           of its nodes' times; its parents slid   many neighbours there, and the
 *                           (while it pays); motion along a face    distance parts it from all
 *   halves left out         both nets are there, one node gains     heights of halves cost a tenth
 *                           (net_halves.h)                          of a test
 *   witness on nets         nets are off by little beside gamma     no surface is evaluated on the
 *                                                                   way
 *
 * A search for the minimum distance takes boxes, quadratics on fixed axes, the turning field and
 * one-sided distances: it needs bounds of the gap, which hulls do not give. */

/* --- Hulls of control nets -------------------------------------------------------------------- */

typedef enum strategy_hulls {
    HULLS_NONE,
    HULLS_OF_ONE,  /* only one node has a net, and gains by it */
    HULLS_OF_BOTH, /* at least one node gains */
    HULLS_FLAT     /* of both, and they are the surfaces or nearly so: bilinear patches, triangles,
                      edges, points */
} strategy_hulls;

/* Which hulls can be tried, by the nets that the nodes were asked for. Nets that other pairs asked
 * for count only where this pair asks for them, too: a test depends on its two nodes alone. */
strategy_hulls strategy_hulls_of(const node *a, const node *b);

static inline bool strategy_has_both_hulls(const node *a, const node *b)
{
    return strategy_hulls_of(a, b) >= HULLS_OF_BOTH;
}

/* Whether the nodes are to be asked for the nets that they offer: one of them gains by its own. */
bool strategy_wants_nets(const node *a, const node *b);

/* Whether that waits until the pair is popped: both nodes are straight but for a remainder. */
bool strategy_waits_for_nets(const node *a, const node *b);

/* Whether both have nets so close to the surfaces that the nets' nearest points are within gamma
 * where the surfaces come within gamma_clear; `room` is what lies between the two. */
bool strategy_has_close_nets(const node *a, const node *b, double room);

/* How a window is cut by hulls: up to `rounds` times at its start, as long as each leaves less than
 * `shrinks` of it. */
typedef struct hull_plan {
    int rounds;
    double shrinks;
} hull_plan;

hull_plan strategy_of_hulls(strategy_hulls hulls); /* precondition: not HULLS_NONE */

/* What follows hulls. */
typedef enum strategy_after_hulls {
    AFTER_HULLS_NOTHING,
    AFTER_HULLS_ONE_CUT,   /* by quadratics along the hulls' axis */
    AFTER_HULLS_QUADRATICS /* the whole plan of quadratics */
} strategy_after_hulls;

/* `found`: the hulls do not meet at the window's start. */
strategy_after_hulls strategy_after(strategy_hulls hulls, const node *a, const node *b, bool found);

/* --- Quadratics ------------------------------------------------------------------------------- */

typedef enum strategy_goal { GOAL_CONTACT, GOAL_DISTANCE } strategy_goal;

/* How a window is cut by quadratics: up to `rounds_across` times along axes that need no search,
 * then by searches, each around the middle of what is left. */
typedef struct quadratic_plan {
    int rounds_across;
    bool is_thin; /* one search is enough */
} quadratic_plan;

quadratic_plan strategy_of_quadratics(const node *a, const node *b, strategy_goal goal);

/* What follows the first search, unless that parted the pair, as most do, or left the window as it
 * was: searches up to `rounds` in all, as long as each leaves less than `shrinks` of w's range,
 * which is 2. */
typedef struct search_plan {
    int rounds;
    double shrinks;
    bool cuts_at_end; /* where a search cut the start, one more at the end of what is left */
} search_plan;

search_plan strategy_of_searches(const node *a, const node *b, strategy_goal goal);

/* Whether a turning axis is tried where fixed axes left `s`. strategy_note_turning tells what came
 * of it: whether `some` of the window is left, and what. */
bool strategy_takes_turning(const w_range *s, trial_rate *turning);
void strategy_note_turning(const w_range *before, const w_range *after, bool some,
                           trial_rate *turning);

/* Whether surfaces at both nodes are nearly parallel: only a field of normals or a distance parts
 * them well. */
bool strategy_is_tangent(const node *a, const node *b);

/* --- One-sided distances ---------------------------------------------------------------------- */

/* What is known of a pair before its distances are asked for. */
typedef struct slide_signs {
    double start;        /* of its window */
    bool is_parted;      /* some axis parts it at a moment */
    bool slides;         /* one node of an ancestor was worth halving alone */
    trial_rate *sliding; /* of its candidate pair; NULL: each chance is taken */
} slide_signs;

/* Whether the nodes may slide along each other, so that their distances are worth asking for.
 * Afterwards strategy_note_distances tells whether that paid. */
bool strategy_takes_distances(const node *a, const node *b, const slide_signs *of,
                              strategy_goal goal);
void strategy_note_distances(const slide_signs *of, bool pays);

/* Whether distances of a from the surface of b are worth the inclusion that maps in common cost:
 * not where both nodes are so small that remainders say something, and they are not tangent. */
bool strategy_distance_pays(const node *a, const node *b, size_t common_maps);

/* Whether `other` is flat and the two move along its plane, but for rounding. */
bool strategy_slides_on_face(const node *own, const node *other);

#endif
