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
 *   request of nets         one node offers a net that may be       hulls touch their surfaces at
 *                           tighter than its quadratic; straight    corners, where most contacts
 *                           nodes with a remainder wait until the   are; quadratics separate most
 *                           pair is popped                          straight nodes
 *   hull against hull       both nets are made, one may be tighter  a box around a remainder does
 *                                                                   not vanish at a corner
 *   hull against quadratic  one net is made, and may be tighter     either shows more than its box
 *   quadratics after hulls  remainders are small beside what        a hull is off by a part of what
 *                           bends; hulls meet; one net is missing   bends, a quadratic by its
 *                                                                   remainder
 *   quadratics, fixed axes  no hull is tried; also where both are   bilinear nodes have no
 *                           nearly flat and one net is missing      remainder; GJK finds the best
 *                                                                   axis
 *   axes that need no       before quadratics, contact only:        vectors across both curves cut
 *   search                  neither node has a normal               the window again and again
 *   axis of the end         after quadratics, contact only: both    once edges have crossed, the
 *                           are nearly flat, the start was cut      axis that was best before is
 *                                                                   wrong
 *   turning field           fixed axes leave the window's start;    it shows more only where one
 *                           else as often as it pays                lies in the other's concave
 *                                                                   side, or two edges bend towards
 *                                                                   each other
 *   dividing surface        instead of a turning axis between two   surfaces in one another share
 *                           faces, or after one that does not cut   terms of third order and of
 *                           all, where terms of third order are     fourth, too
 *                           what hides the gap
 *   meeting of corners      roots, contact only: a point and a      both time and axis follow from
 *                           bilinear face, or two straight edges    three equations, and the points
 *                           (linear_contact.h)                      there are a witness, mostly
 *   separating paraboloid   a contact is known; up to then only;    a plane or a paraboloid at a
 *                           for nets of at most third order         contact separates much larger
 *                           without weights (net_paraboloid.h)      nodes than axes do
 *   one-sided distance      no axis separates the pair from the     what slides along a surface has
 *                           start of its nodes' times; its parents  many neighbours there, and the
 *                           slid (while it pays); motion along a    distance separates it from all
 *                           face
 *   ball's center           a node has all of a ball (distance_     its distance, less the radius,
 *                           ball.c); ahead of other distances       is that of the whole ball
 *   planes and circles of   two roots, one of many pieces, once     a mesh in a mesh, in a bore, on
 *   pieces                  for each search (piece_sides.h); some   a table, a can in a tube: all
 *                           pieces first                            pieces are parted by one look,
 *                                                                   at all times
 *   halves left out         both nets are made, one may be tighter  heights of halves cost a tenth
 *                           (net_halves.h)                          of a test
 *   witness on nets         nets are off by little beside gamma     no surface is evaluated on the
 *                                                                   way
 *
 * A search for the minimum distance uses boxes, quadratics on fixed axes, the turning field and
 * one-sided distances: it needs lower bounds of the distance, which hulls do not give here. */

/* --- Hulls of control nets -------------------------------------------------------------------- */

typedef enum strategy_hulls {
    HULLS_NONE,
    HULLS_OF_ONE,  /* only one node has a net, which may be tighter than its quadratic */
    HULLS_OF_BOTH, /* at least one net may be tighter than its node's quadratic */
    HULLS_FLAT     /* HULLS_OF_BOTH where both nets are flat, as of triangles, edges and points */
} strategy_hulls;

/* Which hulls can be tried with the nets that were made (node_net_made). A net that another pair
 * requested counts only if this pair would request it, too: a test depends on its two nodes
 * alone. */
strategy_hulls strategy_hulls_of(const node *a, const node *b);

static inline bool strategy_has_both_hulls(const node *a, const node *b)
{
    return strategy_hulls_of(a, b) >= HULLS_OF_BOTH;
}

/* Whether the node offers a net that may be tighter than its quadratic. */
bool strategy_wants_net(const node *n);

/* Whether to request the nodes' nets: one of them does so. */
bool strategy_wants_nets(const node *a, const node *b);

/* Whether the request waits until the pair is popped: both nodes are straight except for a
 * remainder. */
bool strategy_waits_for_nets(const node *a, const node *b);

/* Whether both have nets so close to the surfaces that the nets' nearest points are within gamma
 * where the surfaces come within gamma_clear; `room` is gamma - gamma_clear. */
bool strategy_has_close_nets(const node *a, const node *b, double room);

/* How a window is cut by hulls: up to `rounds` times at its start, while each leaves less than
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
 * then along axes that GJK finds, each for the window that is left. */
typedef struct quadratic_plan {
    int rounds_across;
    bool is_thin; /* one search is enough */
} quadratic_plan;

quadratic_plan strategy_of_quadratics(const node *a, const node *b, strategy_goal goal);

/* What follows the first search, unless it separated the pair, as most do, or left the window
 * unchanged: searches, up to `rounds` in all, while each leaves less than `shrinks` of w's range,
 * whose length is 2. */
typedef struct search_plan {
    int rounds;
    double shrinks;
    bool cuts_at_end; /* if a search cut the start, search once more at the window's end */
} search_plan;

search_plan strategy_of_searches(const node *a, const node *b, strategy_goal goal);

/* Whether to try a turning axis after fixed axes left `s`. strategy_note_turning records the
 * outcome: whether `some` of the window is left, and what. */
bool strategy_takes_turning(const w_range *s, trial_rate *turning);
void strategy_note_turning(const w_range *before, const w_range *after, bool some,
                           trial_rate *turning);

/* Whether the surfaces at both nodes are nearly parallel: only a field of normals or a distance
 * separates them well. */
bool strategy_is_tangent(const node *a, const node *b);

/* --- One-sided distances ---------------------------------------------------------------------- */

/* What is known of a pair before its one-sided distances are computed. */
typedef struct slide_signs {
    double start;        /* of its window */
    bool is_whole;       /* its nodes are two whole surfaces, or large pieces of such */
    bool is_parted;      /* some axis separates it at one moment */
    bool slides;         /* a distance chose one node of an ancestor to be split alone */
    trial_rate *sliding; /* of its candidate pair; NULL: always try */
} slide_signs;

/* Whether the nodes may slide along each other, so that one-sided distances are worth computing.
 * Afterwards strategy_note_distances records whether that paid. */
bool strategy_takes_distances(const node *a, const node *b, const slide_signs *of,
                              strategy_goal goal);
void strategy_note_distances(const slide_signs *of, bool pays);

/* Whether the node is so small that its remainder at one moment is below a part of its extents. */
bool strategy_is_small(const node *n);

/* Whether distances of a from the surface of b are worth the inclusion that `common_maps` maps of
 * both surfaces cost: not if both nodes are so small that remainders are useful, and they are not
 * tangent. */
bool strategy_distance_pays(const node *a, const node *b, size_t common_maps);

/* Whether `other` is flat and the two move along its plane, up to rounding. */
bool strategy_slides_on_face(const node *own, const node *other);

#endif
