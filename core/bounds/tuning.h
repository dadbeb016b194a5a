/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
/* No include guard for the body: core/bounds/tuning.c reads the constants again with other
 * definitions of the two macros. */
#ifndef TUNING_INTEGER
#ifdef IMP_TUNABLE /* tools/impinge-tunable: `impinge bench --tune NAME` changes them */
#define TUNING_INTEGER(name, value) extern int name
#define TUNING_NUMBER(name, value) extern double name
#else
#define TUNING_INTEGER(name, value) enum { name = value }
#define TUNING_NUMBER(name, value) static const double name = value
#endif
#endif

#ifndef CORE_BOUNDS_TUNING_H
#define CORE_BOUNDS_TUNING_H

/* Tuning constants: how much work a search takes, never what it proves
 * ====================================================================
 * Any positive value is sound. `impinge bench --tune NAME` (see core/MEASUREMENTS.md) runs the
 * benchmark sets with several values of one constant, and prints pairs and instructions for
 * each. Numbers without a unit are ratios. */

/* --- What to split (subdivision.c) ------------------------------------------------------------ */

/* Split time once it adds more than gamma / this to a node's remainder. */
TUNING_INTEGER(TUNING_BLUR_OF_GAMMA, 64);
/* Split time only if its part of the remainder is also more than 1 / this of what u and v add.
 * Smaller: fewer nodes split in time, more pairs. */
TUNING_INTEGER(TUNING_BLUR_OF_PLACE, 4);
/* Replaces TUNING_BLUR_OF_PLACE where both nodes have control nets, since the hull of a net does
 * not depend on the node's times. */
TUNING_INTEGER(TUNING_BLUR_BESIDE_NETS, 6);
/* Weight of a node's nonlinear motion in time when the parameter to split is chosen. */
TUNING_INTEGER(TUNING_TIME_CUT, 2);
/* Weight of nonlinear motion where the window lies in one half of the node's time, so that the
 * cut makes one child. Not used if both nodes have nets. */
TUNING_INTEGER(TUNING_FREE_TIME_CUT, 8);
/* Weight of curvature in u and v for nodes with nearly parallel normals (set: conformal). */
TUNING_INTEGER(TUNING_TANGENT_CUT, 4);
/* Weight of extent in u and v for nodes with nearly parallel normals (set: conformal). */
TUNING_NUMBER(TUNING_TANGENT_SLOPE, 0x1p-12);
/* Where gamma - gamma_clear is small against gamma_clear, time is split once the motion's bend
 * within the window exceeds 1 / this of the extents in u and v (`impinge clearance` of
 * tools/data/arm.json with --require 4). */
TUNING_INTEGER(TUNING_BEND_OF_PLACE, 16);
/* u and v are not split once the pair's extents are below (gamma - gamma_clear) / this. */
TUNING_INTEGER(TUNING_TINY, 64);

/* --- Which roots are tested only by their boxes before they are popped (pair_test.c) ---------- */

/* The bodies of a candidate pair have many pairs if the candidate pair this many places before or
 * after it in the list is of the same two bodies. */
TUNING_INTEGER(TUNING_GLANCES_APART, 4);

/* --- When to search for a witness (expand_pair.c) --------------------------------------------- */

/* A witness is sought once the remainders of the pair are below gamma / this. */
TUNING_INTEGER(TUNING_WITNESS_GAMMA, 2);
/* A witness is also sought once the remainders are above this times the pair's extents. */
TUNING_INTEGER(TUNING_WITNESS_EXTENT, 4);
/* A witness is also sought once the pair's curvature is below this times the evaluation error. */
TUNING_INTEGER(TUNING_WITNESS_FLAT, 16);
/* Generations of splits between two witness searches: each of the four sides halves about once. */
TUNING_INTEGER(TUNING_WITNESS_WAIT, 5);
/* Points of two nets nearer than this part of gamma are evaluated on the surfaces. */
TUNING_NUMBER(TUNING_WITNESS_NEAR, 0.5);

/* --- When to look for an upper time (upper_time.c), and how (contact_estimate.c) -------------- */

/* Pairs followed before the first search. */
TUNING_INTEGER(TUNING_UPPER_FIRST, 8);
/* Each further search waits until 1 / this more pairs have been followed. */
TUNING_INTEGER(TUNING_UPPER_SHARE, 3);
/* Pairs without nets that are expanded of a candidate pair before a contact is first sought widely
 * at a window's start. */
TUNING_INTEGER(TUNING_WIDE_FIRST, 32);
/* Each further wide search waits until 1 / this more of them have been expanded. */
TUNING_INTEGER(TUNING_WIDE_SHARE, 1);
/* No wide search is made where, since half as many pairs, the window's start has moved by more than
 * this part of the times that are searched: surfaces that cross, or touch all along a curve, hold
 * it. Without this, `bench tori` takes 2.6 times the instructions. */
TUNING_NUMBER(TUNING_WIDE_LATER, 0x1p-20);
/* Pairs of tubes that are expanded of a candidate pair before v is cut, too (pair_tubes.h). */
TUNING_INTEGER(TUNING_TUBES_MOST, 512);
/* Most steps in time of one search. */
TUNING_INTEGER(TUNING_MARCH_STEPS, 12);
/* Nearest points are refined only roughly while the gap is above this times the gap sought. */
TUNING_INTEGER(TUNING_MARCH_NEAR, 64);
/* While the gap is that large, Newton steps are left out whose predicted reduction is below this
 * part of it. */
TUNING_NUMBER(TUNING_MARCH_GAIN, 0x1p-6);
/* Fraction of the predicted time to contact by which one step advances. Must be below 1. */
TUNING_NUMBER(TUNING_MARCH_STRIDE, 0.9);

/* --- When double precision ends (subdivision.c), in units of the evaluation error ------------- */

/* Precision may end a search once gamma - gamma_clear is below this. */
TUNING_INTEGER(TUNING_PRECISION_ROOM, 16);
/* Precision ends it if the remainders are below this, too, where curvatures are below 1. */
TUNING_INTEGER(TUNING_PRECISION_REMAINDER, 64);

/* --- Nodes without bounds (expand_pair.c) ----------------------------------------------------- */

/* A node without bounds whose time is below this part of the query's time counts as one moment. */
TUNING_NUMBER(TUNING_MOMENT, 0x1p-20);

/* --- How often to cut one pair's window (strategy.c, gjk.h, normal_field.c) ------------------- */

/* Most moments of the window at which an axis is sought. */
TUNING_INTEGER(TUNING_WINDOW_ROUNDS, 3);
/* Another moment is tried once less than this is left of the window's width in w, which is 2. */
TUNING_NUMBER(TUNING_WINDOW_SHRINKS, 0.5);
/* Nodes are nearly flat if their curvature is below 1 / this of their extents. */
TUNING_INTEGER(TUNING_FLAT, 64);
/* Most moments for nodes that are nearly flat. */
TUNING_INTEGER(TUNING_FLAT_ROUNDS, 4);
/* Nodes without normals (curves, points): rounds along the axes that need no search, before one
 * with a search. */
TUNING_INTEGER(TUNING_CURVE_ROUNDS, 2);
/* Replaces TUNING_CURVE_ROUNDS for points and straight curves. */
TUNING_INTEGER(TUNING_THIN_ROUNDS, 6);
/* These rounds go on while less than this is left of the window's width, which is 2. */
TUNING_NUMBER(TUNING_CURVE_SHRINKS, 1.6);
/* The hulls of two nets are searched again at the window's new start if at most this part of the
 * window is left. */
TUNING_NUMBER(TUNING_NET_SHRINKS, 0.5);
/* Replaces TUNING_WINDOW_ROUNDS for two flat nets, whose cuts lead to the first contact itself. */
TUNING_INTEGER(TUNING_FLAT_NET_ROUNDS, 6);
/* Replaces TUNING_NET_SHRINKS for two flat nets. Must be below 1. */
TUNING_NUMBER(TUNING_FLAT_NET_SHRINKS, 1 - 0x1p-20);
/* Straight nodes are tested without nets first, unless their remainders exceed this part of their
 * extents. */
TUNING_NUMBER(TUNING_STRAIGHT_BLUR, 0x1p-3);
/* Two nodes with nets are tested by hulls alone where remainders exceed 1 / this of the
 * curvature, since quadratics would hardly show more. */
TUNING_INTEGER(TUNING_NET_BEND, 8);
/* Most steps of GJK; six are usual. */
TUNING_INTEGER(TUNING_GJK_STEPS, 20);
/* GJK stops at an axis that shows this part of the widest gap. Larger: fewer pairs, more
 * instructions for each. Must be below 1. */
TUNING_NUMBER(TUNING_GJK_GAP, 0.7);
/* Replaces TUNING_GJK_GAP in a search for the minimum distance: what the axis does not show is
 * missing from the bracket (set: clearance). Must be below 1. */
TUNING_NUMBER(TUNING_GJK_GAP_OF_BOUND, 0.999);
/* Normals are nearly parallel if the cosine of their angle exceeds this: 25 degrees. Must be
 * below 1. */
TUNING_NUMBER(TUNING_FIELD_COSINE, 0.9);
/* Between two faces, a dividing surface takes the turning axis' place where that leaves terms of
 * third order that are more than this times the remainders along it (set: saddles). */
TUNING_INTEGER(TUNING_THIRD_OF_REMAINDER, 2);
/* A dividing surface is tried after a turning axis that does not cut all, where this times its
 * terms of third order is more than all that is subtracted. */
TUNING_INTEGER(TUNING_THIRD_SHARE, 2);
/* A turning axis is tried after fixed axes while one trial in this many cuts more than they do. */
TUNING_INTEGER(TUNING_FIELD_SHARE, 8);
/* Opportunities skipped between two trials of a turning axis that does not pay. */
TUNING_INTEGER(TUNING_FIELD_WAIT, 7);

/* --- Distances from a surface (strategy.c, distance_halving.c); sets: conformal, tori --------- */

/* A remainder above this part of the distance's size is more than rounding. */
TUNING_NUMBER(TUNING_DISTANCE_ROUNDING, 0x1p-40);
/* A node is too large for distances if its remainder exceeds this part of its extents. */
TUNING_NUMBER(TUNING_DISTANCE_EXTENT, 0.5);
/* A distance is level if its polynomial varies by less than this times its remainder: the
 * remainder hides the gap. */
TUNING_INTEGER(TUNING_DISTANCE_LEVEL, 16);
/* A distance's remainder below this times that of its points is not looked at further. */
TUNING_INTEGER(TUNING_DISTANCE_OF_POINTS, 4);
/* This part of the remainder that a distance has due to time counts as bending motion, when a
 * contact is sought; 1 doubles the pairs of nuts that never touch. */
TUNING_NUMBER(TUNING_DISTANCE_IN_TIME, 0.5);
/* Two surfaces that turn within themselves are searched at one moment if rounding varies their
 * distance by less than gamma_clear / this. */
TUNING_NUMBER(TUNING_REST_SLIP, 0x1p12);
/* A surface slides along the other within itself if its slip is below gamma_clear / this. */
TUNING_NUMBER(TUNING_DISTANCE_SLIP, 0x1p12);
/* Where an axis separates nodes whose parents slid, distances are tried while one trial in this
 * many shows more. */
TUNING_INTEGER(TUNING_DISTANCE_SHARE, 2);
/* Opportunities skipped between two trials of distances that do not pay. */
TUNING_INTEGER(TUNING_DISTANCE_WAIT, 15);

/* --- When the searches for contact and for the distance alternate (clearance.c) --------------- */

/* The searches alternate after this many pairs without a verdict, plus two for each candidate
 * pair. */
TUNING_INTEGER(TUNING_DECIDE_PAIRS, 2000);

/* --- The search for a witness (witness.c) ----------------------------------------------------- */

/* Most Newton steps. */
TUNING_INTEGER(TUNING_NEWTON_STEPS, 24);
/* While the gap is above this times gamma, a step has to halve it. */
TUNING_INTEGER(TUNING_NEWTON_FAR, 8);
/* The search ends with a step that reduces the gap by less than this part of it. */
TUNING_NUMBER(TUNING_NEWTON_GAIN, 1e-4);
/* A step is left out if its predicted change of the squared gap is below twice this part of it. */
TUNING_NUMBER(TUNING_NEWTON_PROMISE, 1e-8);

/* --- The walk of a witness to neighbouring pieces (piece_walk.c) ------------------------------ */

/* Most pairs of pieces tried in one walk. */
TUNING_INTEGER(TUNING_WALK_TRIES, 64);

/* --- Descent of a witness in time (time_descent.c) -------------------------------------------- */

/* Most further witnesses sought. */
TUNING_INTEGER(TUNING_DESCENT_STEPS, 12);
/* The descent ends where it saves less than this part of the bracket's greatest width. */
TUNING_NUMBER(TUNING_DESCENT_GAIN, 0.0625);

#endif
