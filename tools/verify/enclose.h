/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_ENCLOSE_H
#define TOOLS_VERIFY_ENCLOSE_H

#include "tools/verify/statement.h"

/* Points of a surface over a box of u, v and t
 * ============================================
 * The formulas of a chain, composed, as jets of u, v and t. A formula may consist of parts with
 * domains of their own: a box in none of them is divided where a part begins or ends. */

enum { U, V, T, VARIABLES };

typedef enum enclosed {
    ENCLOSED,
    ENCLOSED_EMPTY,    /* the surface does not exist there */
    ENCLOSED_SPLIT,    /* divide the box at `at` of variable `along` */
    ENCLOSED_UNSAID,   /* the certificate has no formula for what is there */
    ENCLOSED_UNDEFINED /* a formula has no value at `at` */
} enclosed;

typedef struct box3 {
    double lo[3], hi[3]; /* u, v, t */
} box3;

typedef struct split {
    int along;
    double at;
} split;

/* The steps of the formula of an instance that was computed last, and for what. */
typedef struct memo {
    const formula *of; /* NULL: none */
    jet *value;        /* to be freed */
    box3 where;
    double at[3];
} memo;

typedef struct place {
    const statement *of;
    const chain *chain;
    size_t piece, maps; /* maps that are applied: the first ones */
    jet *room;          /* for twice the steps of any formula */
    memo *memos;        /* of each instance; NULL: nothing is kept */
} place;

/* Computes x, y and z over the box, and at a point of it, there without second derivatives. They
 * are everything where a formula may have no value somewhere in the box. */
enclosed enclose(const place *p, const box3 *where, const double at[3], jet out[3], jet centre[3],
                 split *divide);

/* Sets u and v of *all to the least box that contains the piece; t is not changed. */
void piece_box(const place *p, box3 *all);

/* Returns an upper bound d of |J^T J - 1| for the Jacobian J of a map, at all times from lo to hi.
 * If d < 1, the map is affine at each time, and multiplies no length by less than the root of 1 -
 * d. INFINITY: it may not be affine. */
double map_deviation_upper(const statement *s, size_t map, double lo, double hi, jet *room);

#endif
