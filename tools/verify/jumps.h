/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_JUMPS_H
#define TOOLS_VERIFY_JUMPS_H

#include "tools/verify/enclose.h"

/* Values at which points of a pair may be in no cell
 * ==================================================
 * Where parts of a formula meet at a value of a clock, both count there. Cells end at that value,
 * so that a part of one stage (a shape or a map, of either surface) that ends there and one of
 * another stage that begins there are in no cell together: such values are proved by themselves.
 * If one stage alone has parts that meet there, no pair of points is left out. Where the claim
 * begins or ends, a part on the other side counts. */

typedef struct jumps {
    double *at[CLOCKS_MAX]; /* of each clock, in order */
    size_t count[CLOCKS_MAX];
} jumps;

/* Finds the values for a pair, with the maps of `side`. To be freed; false: memory ran out. */
bool jumps_find(const place side[2], jumps *found);
void jumps_free(jumps *j);

bool jumps_has(const jumps *j, size_t clock, double at);

#endif
