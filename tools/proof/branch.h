/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_BRANCH_H
#define TOOLS_PROOF_BRANCH_H

#include <impinge/surface.h>

#include "tools/proof/jet.h"

/* Claims over a region, proved or refuted by branch and bound
 * ============================================================
 * The region is halved until the jets of what is bounded show, box by box, that each claim holds in
 * all of it, or that one is violated at the middle of a box. A claim that is not settled when the
 * budget ends is neither. */

/* x, y, z over a box of so many variables. Each has a value p, and s, the same normalized as in
 * imp_region: p = c + d s. Derivatives are by s. */
typedef struct branch_field {
    int n;
    void (*jets)(void *context, const jet p[], const jet s[], jet out[3]);
    void *context;
} branch_field;

/* About the numbers p of `where`. */
typedef struct branch_claims {
    box where;
    double c[BOX_DIMS], d[BOX_DIMS]; /* c - d <= lo, hi <= c + d; d is 0 where lo is hi */
    double rate[3][BOX_DIMS];        /* by p; INFINITY: none is claimed */
    bool has_models;                 /* n == 3; ranges and remainders, unless they are infinite */
    imp_model model[3];
} branch_claims;

typedef enum branch_kind { BRANCH_RATE, BRANCH_RANGE, BRANCH_REMAINDER } branch_kind;

typedef struct branch_outcome {
    int claims, proved;
    bool refuted;
    unsigned long boxes;

    /* One that is refuted, else one that is not settled: about coordinate i, for rates by variable
     * j. At the point p its value (derivative, coordinate, distance from the quadratic) is surely
     * in `there`; only of what is refuted. */
    branch_kind kind;
    int i, j;
    long double p[BOX_DIMS];
    ld_interval there;
} branch_outcome;

branch_outcome branch_settle(const branch_field *field, const branch_claims *claims,
                             unsigned long budget);

#endif
