/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_TUNING_H
#define CORE_BOUNDS_TUNING_H

/* Numbers that decide how much work a search takes, never what it proves
 * ===============================================================
 * Below each is what other values do to the pairs of `impinge bench bicubic spikes tori`, in per
 * cent of the 104593 that were tested when they were measured; witness searches, of which there
 * were 381, where they are what the number is about. */

/* --- What to split (subdivision.c) ------------------------------------------------------------ */

/* Time blurs a node from gamma / this on.
 * 32: -0.1, 128: 0.0 */
#define TUNING_BLUR_OF_GAMMA 64
/* And from 1 / this of what place blurs its pair on.
 * 2: +0.5, 8: -0.6 */
#define TUNING_BLUR_OF_PLACE 4
/* The same where both nodes have nets, whose hulls do not depend on the nodes' times. Bicubic
 * scenes, rational, triangles: 4: +1.6, 8: -0.5, for 2 % more nodes */
#define TUNING_BLUR_BESIDE_NETS 6
/* Weight of what is not linear in time.
 * 1: +1.8, 4: +0.2 */
#define TUNING_TIME_CUT 2
/* The same where one half is enough, unless both nodes have nets.
 * 4: +2.6, 16: -1.2 */
#define TUNING_FREE_TIME_CUT 8
/* Weight of what is not linear in place, of tangent nodes.
 * 2: -0.1, 8: 0.0; of the conformal set 2: +1.1, 8: +5.5 */
#define TUNING_TANGENT_CUT 4
/* And of slopes.
 * 0x1p-6, 0x1p-20: 0.0; of the conformal set 0x1p-6: +11.5 */
#define TUNING_TANGENT_SLOPE 0x1p-12
/* Where gamma has a narrow room, motion that bends within the window counts from 1 / this of place
 * on. Pairs of the arm of tools/data with 3 to 20 mm required, 21467 in all: 1: +30, 4: +15, 64:
 * +2, 256: +25 */
#define TUNING_BEND_OF_PLACE 16
/* u and v are no longer cut: extents below (gamma - gamma_clear) / this.
 * 32, 128: no change */
#define TUNING_TINY 64

/* --- Which roots are only looked at before they are popped (pair_test.c) ---------------------- */

/* A candidate pair's bodies have many if the one so many places before or behind has the same
 * bodies. */
#define TUNING_GLANCES_APART 4

/* --- When to search for a witness (time_of_impact.c) ------------------------------------------ */

/* The remainders of the pair are below gamma / this.
 * 1: +0.2, 4: +0.7; searches 1: +169, 4: -66 */
#define TUNING_WITNESS_GAMMA 2
/* Or above this times its extents.
 * 2, 8: no change */
#define TUNING_WITNESS_EXTENT 4
/* Or precision ends, flat as this times the evaluation error.
 * 8, 32: no change */
#define TUNING_WITNESS_FLAT 16
/* Generations between searches: the four sides halve about once.
 * 2: -0.4, 10: +0.6; searches 2: +62, 10: -28 */
#define TUNING_WITNESS_WAIT 5

/* Points of two nets this part of gamma apart are near enough to be evaluated.
 * Bicubic patches at gamma 1e-6, 0, 0.875: no change */
#define TUNING_WITNESS_NEAR 0.5

/* --- When to look for an upper time (upper_time.c), and how (contact_estimate.c) ---
 *
 * Changes of the pairs of the 100 bicubic scenes at gamma 1e-6, which are 79, and of their
 * instructions in per cent. */

/* Pairs followed before the first search.
 * 4: -2.3, +3 %; 16: +8, 0 % */
#define TUNING_UPPER_FIRST 8
/* And before the next: 1 / this as many more.
 * 2: +3.2, 0 %; 4: -0.2, +1.5 % */
#define TUNING_UPPER_SHARE 3
/* Steps in time at most.
 * 20: 0 */
#define TUNING_MARCH_STEPS 12
/* From this many times the gap sought on, nearest points are only sought roughly.
 * 16: 0, 0 %; 1024: -0.1, -0.3 % */
#define TUNING_MARCH_NEAR 64
/* From there on a Newton step that promises less than this part of the gap is left out.
 * 2^-4: +0.8, +0.3 %; 2^-9: -0.5, +0.1 % */
#define TUNING_MARCH_GAIN 0x1p-6
/* And the time goes on by this part of what would close the gap.
 * 0.8: -0.7, +0.3 %; 0.95: +0.4, +0.8 % */
#define TUNING_MARCH_STRIDE 0.9

/* --- When precision ends (subdivision.c): in units of the evaluation error ---
 *
 * No scene of the sets comes to that. */

/* gamma - gamma_clear is below this.
 * 8, 32: no change */
#define TUNING_PRECISION_ROOM 16
/* And remainders are, where curvatures are below 1.
 * 32, 128: no change */
#define TUNING_PRECISION_REMAINDER 64

/* --- Nodes without bounds (time_of_impact.c) -------------------------------------------------- */

/* Part of the query's time below which a node without bounds is taken for a moment without any.
 * Types with bounds: no change */
#define TUNING_MOMENT 0x1p-20

/* --- How far to cut one pair's window (separation.c, gjk.h, normal_field.c) -------------- */

/* Centres at most.
 * 1: +0.6, 2: 0.0, 6: 0.0 */
#define TUNING_WINDOW_ROUNDS 3
/* Width in w, of 2, below which a new centre is worth it.
 * 0.25: +0.3, 1: -1.0 */
#define TUNING_WINDOW_SHRINKS 0.5
/* Nodes are nearly flat: what bends is below 1 / this of their extents.
 * 16: -0.1, 256: 0.0 */
#define TUNING_FLAT 64
/* Centres at most, of flat nodes.
 * 3, 8: 0.0 */
#define TUNING_FLAT_ROUNDS 4
/* Nodes without normals: rounds along axes that need no search, before one with a search, as long
 * as the range of w, of 2, shrinks below this. Points and straight curves (thin) get one search
 * after them. Instructions of edges, thin rounds 4: +2.5 %, 5: +2 %, 8: 0.0 %; 2, and then as many
 * searches as for other flat nodes: +4.5 % */
#define TUNING_CURVE_ROUNDS 2
#define TUNING_THIN_ROUNDS 6
#define TUNING_CURVE_SHRINKS 1.6
/* Part of the window that hulls of nets have to leave at most, to be sought again at its new start.
 * Pairs of bicubic patches at gamma 1e-6: 0.25: +0.4, 0.75: -0.2 of 81.5, and 1 % more
 * instructions */
#define TUNING_NET_SHRINKS 0.5
/* The same of flat nets, which come to the first contact itself. */
#define TUNING_FLAT_NET_ROUNDS 6
#define TUNING_FLAT_NET_SHRINKS (1 - 0x1p-20)
/* Straight nodes are tried without nets first, unless remainders are more than this part of
 * them. */
#define TUNING_STRAIGHT_BLUR 0x1p-3
/* Two nodes with nets: remainders above 1 / this of what bends are too large for quadratics to
 * show more than hulls. Pairs of bicubic patches, of 68, and instructions: 4: -0.1, +0.7 %; 16: 0,
 * -0.8 %, but proofs of 0.99 of a distance, half-way to contact, take 43 instead of 34 pairs */
#define TUNING_NET_BEND 8
/* At most; six are usual.
 * 6: +1.0, 10: +0.1, 40: 0.0 */
#define TUNING_GJK_STEPS 20
/* Part of the widest gap that is good enough; each step costs instructions.
 * 0.5: +2.5, 0.9: -1.5 */
#define TUNING_GJK_GAP 0.7
/* The same where a lower bound of the distance is sought: the thousandth that is left is what a
 * bracket is narrowed to. Pairs of bicubic patches ended before they meet: 0.7: +70, 0.9: +39,
 * 0.99: +5 */
#define TUNING_GJK_GAP_OF_BOUND 0.999
/* Of normals within 25 degrees, which are nearly tangent.
 * 0.5: 0.0, 0.99: 0.0 */
#define TUNING_FIELD_COSINE 0.9
/* Where fixed axes cut the start of the window: one in SHARE axes that turn has to cut more, or
 * WAIT chances are left out before the next. Pairs of a thread by formula, and instructions of
 * tori, beside trying all: +0.8 %, -4.8 %; the last 64 counted instead of 1024: +3.1 %; none
 * tried: +56 %, -5.7 % */
#define TUNING_FIELD_SHARE 8
#define TUNING_FIELD_WAIT 7

/* --- Distances from a surface (distance.c) ---
 *
 * Per cent of the pairs of the conformal set without its threads. */

/* Remainder beside the distance's size from which on it is not only rounding.
 * 0x1p-30, 0x1p-48: no change */
#define TUNING_DISTANCE_ROUNDING 0x1p-40
/* A node is too large from this part of its extents on.
 * 0.25: +230, 1: -8, but linked tori 1: +10 */
#define TUNING_DISTANCE_EXTENT 0.5
/* Level: the polynomial varies by less than this times the remainder.
 * 4: +8, 64: no change */
#define TUNING_DISTANCE_LEVEL 16
/* Two surfaces that turn within themselves are searched at one moment where rounding varies their
 * distance by less than gamma_clear / this. */
#define TUNING_REST_SLIP 0x1p12

/* A surface slides along the other within itself, if it leaves that by less than 1 / this of
 * gamma_clear. */
#define TUNING_DISTANCE_SLIP 0x1p12
/* Where an axis parts nodes whose parents slid: one in SHARE distances has to show more, or WAIT
 * chances are left out before the next. Pairs, and instructions of tori, beside asking for all:
 * +0.1 %, -8.7 %; 4 and 7: 0.0 %, -6.2 %; counted along the line of ancestors instead: threads +2
 * to +80 % */
#define TUNING_DISTANCE_SHARE 2
#define TUNING_DISTANCE_WAIT 15

/* --- When the searches for contact and for the distance go on in turn (gamma_clear.c) --------- */

/* After so many pairs, and two more for each candidate pair, without a verdict. */
#define TUNING_DECIDE_PAIRS 2000

/* --- The search for a witness (witness.c) ----------------------------------------------------- */

/* At most.
 * 12: +0.1, 48: -0.1; searches 12: +7, 48: -5 */
#define TUNING_NEWTON_STEPS 24
/* Gammas from which on a step has to halve the gap.
 * 4: +0.1, 16: -0.1; searches 4: +11, 16: -12 */
#define TUNING_NEWTON_FAR 8
/* The last step gains less than this of the gap.
 * 1e-3, 1e-5: no change */
#define TUNING_NEWTON_GAIN 1e-4
/* A step that promises to change the gap's square by less than twice this is not tried.
 * 1e-10: edges take 0.03 % more instructions, faces 1 % */
#define TUNING_NEWTON_PROMISE 1e-8

#endif
