/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_EVERYDAY_H
#define TOOLS_BENCH_EVERYDAY_H

#include <stdbool.h>
#include <stdint.h>

/* Families of everyday scenes: two bodies, c apart
 * ================================================ */

/* How the second body follows the first. */
typedef enum everyday_bond {
    BOND_NONE,
    BOND_PARENT, /* the first is its parent */
    BOND_TWICE   /* the first's maps are written once more after its own */
} everyday_bond;

/* Texts are as everyday_expand takes them. */
typedef struct everyday_family {
    const char *name;
    const char *a, *a_maps; /* surfaces and maps, objects of a scene file without outer brackets */
    const char *b, *b_maps;
    everyday_bond bond;
    double t_end;     /* 0: 1 */
    bool meets;       /* they touch, at half of the time; else they never come within gamma */
    const char *gaps; /* a digit k for each c = 10^-k */
    uint64_t goal;    /* pairs that the search for a contact may take; clearance: three times */
    const char *open_contact, *open_clearance; /* digits of the gaps whose goal is not reached */
} everyday_family;

/* All families; a NULL name ends them. */
extern const everyday_family everyday_families[];

/* Makes JSON of a family's text, in memory of its own; NULL: no memory.
 *
 *   '                    "
 *   @x, ~x               x + c, x - c, for a number x
 *   <F N r:z r:z ...>    the keys of a mesh that is turned on a lathe: rings of N corners with
 *                        these radii at these heights, N = 4, 8, ... 64; r/s:z makes teeth of
 *                        radius r and gaps of radius s, two corners each. F is made of the letters
 *                        p: plain; o: open, without its first and last face; i: inclined, its x, y
 *                        and z along (2,-1,2), (2,2,-1), (-1,2,2) */
char *everyday_expand(const char *text, double c);

#endif
