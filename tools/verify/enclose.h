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

/* The values of clocks. One of them, `main`, is the T of boxes; what follows another has all its
 * values from lo to hi at once. */
typedef struct values {
    size_t count, main;
    uint64_t stamp; /* of these ranges, and of no others */
    double lo[CLOCKS_MAX], hi[CLOCKS_MAX];
} values;

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
    int along; /* U, V, T, or VARIABLES + a clock other than T */
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
    const values *when; /* not NULL */
} place;

/* Whether T is what the stage follows. */
static inline bool place_follows_main(const place *p, size_t stage_index)
{
    return p->of->stages[p->chain->stages[stage_index]].clock == p->when->main;
}

/* The box, with the values of the stage's clock for T. */
box3 place_box(const place *p, size_t stage_index, const box3 *where);

/* The middle of an interval, within it. */
static inline double middle(double lo, double hi)
{
    const double mid = 0.5 * lo + 0.5 * hi;
    return mid < lo ? lo : mid > hi ? hi : mid;
}

/* Computes x, y and z over the box, and at a point of it, there without second derivatives. They
 * are everything where a formula may have no value somewhere in the box. */
enclosed enclose(const place *p, const box3 *where, const double at[3], jet out[3], jet centre[3],
                 split *divide);

/* Sets u and v of *all to the least box that contains the piece; t is not changed. */
void piece_box(const place *p, box3 *all);

/* The piece of stage k of a chain. */
const piece *enclose_piece(const place *p, size_t stage_index);

/* Finds the part of the piece of a stage in which a box is; *divide where it is in several. */
enclosed enclose_choose(const place *p, size_t stage_index, const box3 *where, const part **found,
                        split *divide);

/* Finds the part of a piece in which its own box is. */
enclosed enclose_choose_part(const piece *all, const box3 *own, const part **found, split *divide);

/* Returns whether a part of one surface ends at a value of its clock, within the claim, at which a
 * part of the other begins, so that no cell holds both; *at: the value. */
bool enclose_ends_meet(const statement *s, const chain *a, const chain *b, double *at);

/* Returns the next part after `p` that the whole box is in, or NULL: boxes without a size, and ends
 * that are known to an ulp, may be in several. */
const part *enclose_next_part(const piece *all, const part *p, const box3 *b);

/* Finds the part of a surface's shape, or why there is none. */
enclosed enclose_part(const place *p, const box3 *where, const part **found, split *divide);

#endif
