/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_APART_INTERNAL_H
#define TOOLS_VERIFY_APART_INTERNAL_H

#include "tools/verify/apart.h"

/* What prove_apart consists of: apart_cell.c has the cells, apart_axis.c tests one axis,
 * apart_centre.c the centres, apart_round.c that axis for sides that turn, apart_guess.c guesses
 * axes, apart.c tries them and divides. */

typedef enum apart_outcome { APART, DIVIDE, STUCK } apart_outcome;

/* What is known of an axis that does not do it, from the undivided pieces. */
typedef struct apart_trial {
    double left;       /* below 0: what is missing, by what is left over between known points */
    double beyond;     /* by how much known points are beyond each other; else 0 */
    double size[2][2]; /* a piece's dependence on u and v, at most, about */
    double time;       /* the dependence of both on time */
    double clocks[CLOCKS_MAX]; /* and on the values of clocks */
    double width[2];           /* of the bounds of each side */
    split cut; /* where the cell has to be divided, by T or a clock; along < 0: nowhere */
} apart_trial;

/* Returns piece k of a side, in the order of the prover. */
place cell_piece(const prover *p, int side, size_t k);

/* Returns where piece k of a side of the cell lies: the cell's ranges if that is its only piece,
 * else the whole domain of the piece. */
box3 cell_area(const prover *p, const cell *c, int side, size_t k, place *of);

/* Keeps the cell and why it is not proved; returns STUCK. */
apart_outcome apart_fail(prover *p, const cell *c, double found, const char *why);

/* Whether a side turns in the cell by a map of which all angles can be taken: its chain; NULL. */
const orbit *apart_orbit(const prover *p, const cell *c, int side);

/* Whether all angles of a side shall be tried in this cell; and before anything else. */
bool apart_is_round(const prover *p, const cell *c);
bool apart_is_round_first(const prover *p, const cell *c);

/* The axes from A to B that are tried after the hint: the direction of the centres, and a normal of
 * either side; where a side turns, those from its orbit and from the middle of it to the other
 * side, and about which it turns. They are guesses, in doubles; 0: none. */
enum { AXES_AT_REST = 3, AXES = AXES_AT_REST + 4 };
void apart_find_axes(prover *p, const cell *c, double n[AXES][3]);

/* Tests what the aims of both sides bound, which changes by no more than `change_upper` for a unit
 * of length. */
apart_outcome apart_try_aims(prover *p, const cell *c, const aim a[2], double change_upper,
                             apart_trial *tried);

/* Tests aims along an axis, also with all angles at once (apart_round.c). */
apart_outcome apart_by_angles(prover *p, const cell *c, const aim a[2], double change_upper,
                              apart_trial *tried);

/* Tests them with all angles alone. */
apart_outcome apart_by_all_angles(prover *p, const cell *c, const aim a[2], double change_upper,
                                  apart_trial *tried);

/* Tests one axis, which need not be a unit vector; what is known of it then is in *tried. */
apart_outcome apart_by_axis(prover *p, const cell *c, const double n[3], apart_trial *tried);

/* Tests it with all angles alone. */
apart_outcome apart_by_orbit(prover *p, const cell *c, const double n[3], apart_trial *tried);

/* Tests the centres of both surfaces of a cell of single pieces. */
apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried);

#endif
