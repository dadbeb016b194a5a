/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_AIM_H
#define TOOLS_VERIFY_AIM_H

#include "tools/kernel/kernel.h"

/* Axes that may part a cell, and how to divide it where they do not; guesses, in doubles */

/* Side 0 or 1 along u (0) or v (1), or its pieces; side 2: the values of clock `along`; -1: nothing
 * can be divided. */
typedef struct aim_cut {
    int side;
    size_t along;
} aim_cut;

enum { AIM_AXES = 2 };

typedef struct aim {
    int16_t axes[AIM_AXES][3]; /* that are worth a test */
    int count;
    int16_t best[3]; /* that leaves most between the sides; 0: not known */
    aim_cut cut;
} aim;

/* Looks at a cell; `known`: two axes that did before, in this order better. */
void aim_take(pair *p, const cell *c, const int16_t *const known[2], aim *found);

#endif
