/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_CLOUD_H
#define TOOLS_VERIFY_CLOUD_H

#include "tools/kernel/kernel.h"

/* The axis that parts two sides of a cell at all of its times, as far as points of them tell: each
 * side is divided into some parts, whose corners stand for it at the ends of the clocks' values.
 * What is found is a guess, which the kernel's test of a leaf proves or not. */

enum { CLOUD_PARTS = 16, CLOUD_POINTS = 256, CLOUD_CORNERS = 4 };

typedef struct cloud {
    const cell *of;
    unsigned corners; /* of the clocks: the first of 2^k */
    size_t count[2];
    double x[2][CLOUD_POINTS][CLOUD_CORNERS][3];
    int16_t axis[3];
    double room;   /* between the sides along the axis, less what is claimed; or -INFINITY */
    double always; /* the least of what axes leave that may differ from corner to corner */
    size_t tests;  /* enclosures */
} cloud;

void cloud_find(cloud *l, pair *p, const cell *c);

#endif
