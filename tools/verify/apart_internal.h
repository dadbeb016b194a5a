/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_APART_INTERNAL_H
#define TOOLS_VERIFY_APART_INTERNAL_H

#include "tools/verify/apart.h"

/* What prove_apart consists of: apart_cell.c has the cells, apart_axis.c tests one axis or centre,
 * apart_guess.c guesses axes, apart.c tries them and divides. */

typedef enum apart_outcome { APART, DIVIDE, STUCK } apart_outcome;

/* What is known of an axis that does not do it, from the undivided pieces. */
typedef struct apart_trial {
    double left;       /* below 0: what is missing, by what is left over between known points */
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

/* The axes from A to B that are tried after the hint: the direction of the centres, and a normal of
 * either side. They are guesses, in doubles; 0: none. */
enum { AXES = 3 };
void apart_find_axes(prover *p, const cell *c, double n[AXES][3]);

/* Tests one axis, which need not be a unit vector; what is known of it then is in *tried. */
apart_outcome apart_by_axis(prover *p, const cell *c, const double n[3], apart_trial *tried);

/* Tests the centres of both surfaces of a cell of single pieces. */
apart_outcome apart_by_centres(prover *p, const cell *c, apart_trial *tried);

#endif
