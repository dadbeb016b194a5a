/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_KERNEL_TREES_H
#define TOOLS_KERNEL_TREES_H

#include "tools/kernel/claim.h"

/* Cells in which two surfaces are proved to be apart */

/* Pieces of either surface, by their places in the order of the pair; of a single piece a box of u
 * and v; and values of the clocks. */
typedef struct cell {
    size_t first[2], count[2];
    range uv[2][2]; /* only where count is 1 */
    range clocks[CLAIM_CLOCKS];
} cell;

typedef struct pair {
    claim *of;
    const surface *side[2];
    uint32_t *order[2]; /* NULL: the pieces' own */
    size_t choices;     /* of parts of stages, in the last cell */
    const char *why;    /* the last cell failed; NULL: it is only not seen to be apart */
} pair;

/* Visits the points of a side in a cell: of each piece, and each choice of a part of each stage, as
 * slopes of u, v and the clocks. `whole`: they exist at all values of the clocks; else at fewer,
 * from whose middle the slopes are. False: p->why tells. */
typedef void leaf_visitor(void *context, const slope x[3], bool whole);
bool leaf_visit(pair *p, const cell *c, int side, leaf_visitor *visit, void *context);

/* Returns whether n.(B - A) is at least |n| p->of->apart for all points of the cell at one time. */
bool leaf_holds(pair *p, const cell *c, const double n[3]);

/* Writes the least box of u and v of a piece of a side, by its place in the order. */
void leaf_box(const pair *p, int side, size_t place, range uv[2]);

bool leaf_point(pair *p, int side, range x[3]); /* encloses the point that the claim states */

/* The trees of a certificate, read and proved leaf by leaf (core/CERTIFICATE.md) */

enum { TREES_TIME = 4, TREES_AXIS, TREES_SAME, TREES_ALONE, TREES_CLOCK };

/* The tree of a pair that is being read. */
typedef struct tree {
    struct trees *w;
    pair p;
    size_t main;    /* the clock that entries call time */
    double axis[3]; /* of the last leaf that named one; or 0 */
} tree;

typedef struct trees {
    bytes *in;
    claim *of;
    uint64_t pairs, leaves;
    /* What is done with a leaf; false: p.why tells. NULL: it is proved. */
    bool (*leaf)(void *context, tree *r, const cell *c, unsigned op);
    void *context;
} trees;

/* Proves that the stated points are as near as stated, then all trees, to the end of the file. */
bool trees_hold(trees *w);

/* Divides a cell: side 0 or 1, along u (0) or v (1), or its pieces; side 2: the values of clock
 * `along`, at `at`. The halves cover it. */
void trees_split(const pair *p, const cell *c, int side, size_t along, double at, cell half[2]);

#endif
