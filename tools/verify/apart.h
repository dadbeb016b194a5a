/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_APART_H
#define TOOLS_VERIFY_APART_H

#include "tools/verify/jumps.h"
#include "tools/verify/round.h"

/* Cells in which two surfaces are proved to be apart */

/* Pieces of either surface, by their places in the order of the pair; of a single piece a box of u
 * and v; and times. */
typedef struct cell {
    size_t first[2], count[2];
    double lo[2][2], hi[2][2]; /* only where count is 1 */
    double t[2];
} cell;

/* What a side's areas were made from, about a centre, for the next test that asks the same of it;
 * and what is known of them before any was divided. */
typedef struct kept_side {
    bool is_kept;
    size_t piece;
    box3 where;
    uint64_t stamp; /* of the values of clocks */
    centre about;
    aim aim;
    bool is_sized; /* what follows is known */
    double size[VARIABLES], clocks[CLOCKS_MAX], width;
} kept_side;

typedef struct prover {
    place side[2];
    values when;              /* of the cell; T is the cell's */
    uint64_t *stamps;         /* the last one that was given to values */
    const uint32_t *order[2]; /* NULL: the pieces' own */
    double apart; /* what is to be proved, a little enlarged for maps left out; length */
    unsigned long tests, tests_most; /* of this leaf */
    double axis[3];                  /* hint; 0: none */
    memory *known;
    const jumps *jumps; /* values at which cells end that are proved by themselves, too */
    areas areas[2];     /* of either side; to be freed */
    kept_side kept[2];  /* what they are of */
    centre centres[2];  /* of either side, as guessed in this leaf or before */
    int centre_count;
    size_t wasted;      /* boxes of centres, since one of them parted a cell */
    size_t spent;       /* boxes of one centre, beyond what it gained (apart_axis.c) */
    size_t round_spent; /* boxes of aims of all angles, likewise (apart_round.c); and */
    bool round_helps;   /* whether they parted the last cell for which they were tried */
    bool has_guessed;   /* in this leaf */
    bool has_missed;    /* the last guess, of these pieces, found that one is not round */
    size_t missed[2];
    const cell *leaf; /* that is being proved */
    cell tried;       /* of the last test, and */
    aim aim;          /* what it tried there, for A */
    bool is_round;    /* that was tried with all angles of a side at once */
    cell worst;       /* where it ended, */
    values worst_when;
    double found;    /* what was found there: two points so near, or INFINITY: nothing but */
    const char *why; /* this; and */
    bool ran_out;    /* that is all: tests_most were too few */
} prover;

/* Forgets what leaves before have told, so that a leaf's effort depends on no other share. */
void prover_forget(prover *p);

/* Makes `c` all of both pieces, if they are single. */
void cell_begin(const prover *p, cell *c);

/* How a cell is divided: side 0 or 1 along u (0) or v (1), or its pieces; side 2: T; side 3: the
 * values of clock `along`. NAN: at the middle. */
typedef struct cut {
    int side, along;
    double at;
} cut;

/* False: there is nothing to divide. Of values, the halves are those of the cell. */
bool cell_split(const prover *p, const cell *c, const cut *by, cell half[2]);

/* Takes one half of the values of a clock, if by->side is 3. `values_restore` takes back what is
 * returned. */
typedef struct values_kept {
    uint64_t stamp;
    double lo, hi;
} values_kept;
values_kept values_halve(prover *p, const cut *by, int half);
void values_restore(prover *p, const cut *by, const values_kept *was);

/* Proves that no two points of the cell at one time are nearer than p->apart. False: p->worst,
 * found and why tell. */
bool prove_apart(prover *p, const cell *c);

#endif
